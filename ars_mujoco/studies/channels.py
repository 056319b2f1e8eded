"""Channels: all that a run of any rig can record."""

from importlib import import_module

from ars_mujoco.schema.channels import Channel, channels

RIGS = ("sedan", "roll_plane", "bench")


def recorded_channels() -> list[tuple[str, list[Channel]]]:
    """The channels that each rig can record, by the rig's name."""
    return [(rig, channels(import_module(f"ars_mujoco.rigs.{rig}").Output)) for rig in RIGS]
