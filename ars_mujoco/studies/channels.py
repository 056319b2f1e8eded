"""Channels: all that a run of any rig with any shipped actuator can record."""

from itertools import product

from ars_mujoco.actuators.registry import actuator_schema, system_for
from ars_mujoco.rigs.rig import rig
from ars_mujoco.schema import library
from ars_mujoco.schema.channels import Channel
from ars_mujoco.schema.document import read

RIGS = ("sedan", "roll_plane", "bench")


def recorded_channels() -> list[tuple[str, list[Channel]]]:
    """(rig, channels) of every rig with every system that a shipped actuator names."""
    files = [read(actuator_schema(), name, "actuator").value for name in library.shipped("actuator")]
    systems = dict.fromkeys(map(system_for, files))
    return [(name, list(rig(name, system).channels.values())) for name, system in product(RIGS, systems)]
