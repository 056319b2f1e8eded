"""Set-up of the bench."""

import numpy as np

from ars_mujoco.actuators.actuator import Actuator, PumpControlled
from ars_mujoco.control.controller import Controller
from ars_mujoco.cycle import Cycle
from ars_mujoco.errors import InputError
from ars_mujoco.setup.start import Start
from ars_mujoco.simulation import Simulation
from ars_mujoco.vehicle.bench import Bench


def set_up(start: Start, cycle: Cycle, actuator: Actuator, controller: Controller, vehicle: Bench) -> Simulation:
    """The bench's simulation: its one axle is the front."""
    if start.law:
        raise InputError("controller.law: the bench's cycle commands the bar itself; allowed on sedan and roll_plane")
    if not isinstance(actuator, PumpControlled):
        raise InputError(f"actuator '{actuator.kind}' has nothing to command on the bench; allowed: pump_controlled")
    parameters, manoeuvre = start.parameters, cycle.manoeuvre
    start.fill_stabilizer("front", actuator, vehicle.stiffness, 0.0)
    parameters.command, parameters.ends = manoeuvre.command.signal(), manoeuvre.ends.signal()
    parameters.arm, parameters.ends_height = vehicle.arm, vehicle.height - vehicle.link_length
    if np.abs(parameters.ends.values).max() >= vehicle.arm:
        raise InputError(f"manoeuvre.ends: the ends move too far; allowed: less than the arm's {vehicle.arm:g} m")
    return start.stored()
