"""Set-up: from validated files to a model whose userdata holds the whole world, at rest at the start of the cycle."""

from importlib import import_module
from pathlib import Path

from ars_mujoco.actuators.actuator import Actuator, PumpControlled
from ars_mujoco.actuators.pump_controlled.drive import fill_drive
from ars_mujoco.control.control_unit import check_timing
from ars_mujoco.control.controller import Controller
from ars_mujoco.control.law import law
from ars_mujoco.machines.engine import Engine
from ars_mujoco.manoeuvres.cycle import Cycle, Valves
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import fill
from ars_mujoco.simulation.simulation import Simulation
from ars_mujoco.vehicle.bench import Bench
from ars_mujoco.vehicle.model import specify
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import Sedan


def prepare(cycle: Cycle, actuator: Actuator, controller: Controller, vehicle: Bench | RollPlane | Sedan) -> Simulation:
    """The simulation of `cycle` with these parts.

    Raises InputError where they do not fit together, and ArsError where the car has no rest or no statics.
    """
    rig = import_module(f"ars_mujoco.rigs.{cycle.rig}")
    start = Start(rig, specify(vehicle), cycle, law(Path(controller.law)) if controller.law else None)
    check_timing(controller.unit, start.step)
    fill(start.parameters.stabilizers.loop, controller.loop)
    fill(start.parameters.stabilizers.unit, controller.unit)
    if isinstance(actuator, PumpControlled):
        if isinstance(actuator.drive, Engine) and cycle.rig != "sedan":
            raise InputError(
                f"actuator.drive.kind: 'engine' turns with the road speed, which the rig {cycle.rig} has not; "
                "allowed: constant, table, electric"
            )
        if cycle.valves != Valves() and actuator.circuit != "full":
            raise InputError(
                f"valves: the circuit '{actuator.circuit}' has none to command; allowed with actuator.circuit: full"
            )
        fill_drive(start.parameters.stabilizers.drive, actuator.drive)
    if controller.pressure_feedback:
        fill(start.parameters.stabilizers.feedback, controller.pressure_feedback)
    if controller.compensator:
        fill(start.parameters.stabilizers.compensator, controller.compensator)
    set_up = import_module(f"ars_mujoco.rigs.setup.{cycle.rig}").set_up
    return set_up(start, cycle, actuator, controller, vehicle)
