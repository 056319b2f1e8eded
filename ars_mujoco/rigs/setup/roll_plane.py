"""Set-up of the roll plane."""

from ars_mujoco.actuators.actuator import Actuator
from ars_mujoco.control.controller import Controller
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.rigs.setup.car import fill_addresses, fill_reference, fill_stabilizers
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.simulation.simulation import Simulation
from ars_mujoco.vehicle.roll_plane import RollPlane


def set_up(start: Start, cycle: Cycle, actuator: Actuator, controller: Controller, vehicle: RollPlane) -> Simulation:
    """The roll plane's simulation."""
    parameters, model = start.parameters, start.simulation.model
    fill_addresses(parameters.at, start.rig.addresses(model))
    fill_stabilizers(start, actuator, vehicle.front, vehicle.rear)
    fill_reference(parameters.reference, model, actuator, controller, vehicle)
    parameters.acceleration, parameters.mass = cycle.manoeuvre.acceleration.signal(), vehicle.mass
    return start.stored()
