"""Set-up of the roll plane."""

from ars_mujoco.control.controller import Controller
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.rigs.setup.car import fill_addresses, fill_reference, law_of, torsion
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.simulation.simulation import Simulation
from ars_mujoco.vehicle.model import specify
from ars_mujoco.vehicle.roll_plane import RollPlane


def set_up(cycle: Cycle, actuator: Parameters, controller: Controller, vehicle: RollPlane) -> Simulation:
    """The roll plane's simulation."""
    start = Start(specify(vehicle), cycle, actuator, controller.unit, law_of(controller))
    parameters, model = start.parameters, start.simulation.model
    fill_addresses(parameters.at, start.rig.addresses(model))
    start.fill_system(torsion(vehicle.front), torsion(vehicle.rear), has_road=False)
    fill_reference(start, controller, vehicle)
    parameters.acceleration, parameters.mass = cycle.manoeuvre.acceleration.signal(), vehicle.mass
    return start.stored()
