"""Set-up of the bench."""

from ars_mujoco.actuators.registry import bare, module_of, system_for
from ars_mujoco.actuators.system import Torsion, is_active
from ars_mujoco.bridge.control import tables_of
from ars_mujoco.control.controller import Controller
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.simulation.simulation import Simulation
from ars_mujoco.vehicle.bench import Bench
from ars_mujoco.vehicle.model import specify


def set_up(cycle: Cycle, actuator: Parameters, controller: Controller, vehicle: Bench) -> Simulation:
    """The bench's simulation: its one bar is the front."""
    if controller.law:
        raise InputError("controller.law: the bench's cycle commands the bar itself; allowed on sedan and roll_plane")
    if not is_active(system_for(actuator)):
        raise InputError(f"actuator '{actuator.kind}' has nothing to command on the bench; allowed: one that is active")
    manoeuvre = cycle.manoeuvre
    start = Start(specify(vehicle), cycle, _driven(actuator, manoeuvre.motor), controller.unit)
    parameters = start.parameters
    start.fill_system(Torsion(vehicle.stiffness, 0.0), None, has_road=False)
    tables = tables_of(start.rig, start.simulation.model)
    if manoeuvre.command:
        parameters.command, tables.command = manoeuvre.command.record(), manoeuvre.command.samples()
    parameters.ends, tables.ends = manoeuvre.ends.record(), manoeuvre.ends.samples()
    parameters.arm, parameters.ends_height = vehicle.arm, vehicle.height - vehicle.link_length
    if (travel := manoeuvre.ends.peak()) >= vehicle.arm:
        raise InputError(
            f"manoeuvre.ends: a travel of {travel:g} m is too far; allowed: less than the arm's {vehicle.arm:g} m"
        )
    return start.stored()


def _driven(actuator: Parameters, motor: str) -> Parameters:
    """The actuator with its motor commanded, held or free."""
    if motor == "held":
        return bare("locked")
    if motor == "commanded":
        return actuator
    module = module_of(actuator)
    if not hasattr(module, "released"):
        raise InputError(f"manoeuvre.motor: the motor of '{actuator.kind}' is never free; allowed: commanded, held")
    return module.released(actuator)
