"""Set-up: from validated files to a model whose userdata holds the whole world, at rest at the start of the cycle."""

from importlib import import_module

from ars_mujoco.control.controller import Controller
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.simulation.simulation import Simulation


def prepare(cycle: Cycle, actuator: Parameters, controller: Controller, vehicle: Parameters) -> Simulation:
    """The simulation of `cycle` with these parts.

    Raises InputError where they do not fit together, and ArsError where the car has no rest or no statics.
    """
    return import_module(f"ars_mujoco.rigs.setup.{cycle.rig}").set_up(cycle, actuator, controller, vehicle)
