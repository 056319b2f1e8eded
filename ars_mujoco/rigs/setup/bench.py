"""Set-up of the bench."""

from ars_mujoco.actuators.actuator import Actuator, Locked, PumpControlled
from ars_mujoco.control.controller import Controller
from ars_mujoco.excitation.excitation import peak
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.errors import InputError
from ars_mujoco.simulation.simulation import Simulation
from ars_mujoco.vehicle.bench import Bench


def set_up(start: Start, cycle: Cycle, actuator: Actuator, controller: Controller, vehicle: Bench) -> Simulation:
    """The bench's simulation: its one axle is the front."""
    if start.law:
        raise InputError("controller.law: the bench's cycle commands the bar itself; allowed on sedan and roll_plane")
    if not isinstance(actuator, PumpControlled):
        raise InputError(f"actuator '{actuator.kind}' has nothing to command on the bench; allowed: pump_controlled")
    parameters, manoeuvre = start.parameters, cycle.manoeuvre
    if manoeuvre.motor == "held":
        actuator = Locked(kind="locked")
    elif manoeuvre.motor == "free":
        actuator, parameters.stabilizers.loop.gain = _short_circuited(actuator), 0.0
    start.fill_stabilizer("front", actuator, vehicle.stiffness, 0.0)
    if manoeuvre.command:
        parameters.command = manoeuvre.command.record()
    parameters.ends = manoeuvre.ends.record()
    parameters.arm, parameters.ends_height = vehicle.arm, vehicle.height - vehicle.link_length
    if (travel := peak(parameters.ends)) >= vehicle.arm:
        raise InputError(
            f"manoeuvre.ends: a travel of {travel:g} m is too far; allowed: less than the arm's {vehicle.arm:g} m"
        )
    return start.stored()


def _short_circuited(actuator: PumpControlled) -> PumpControlled:
    """`actuator` with the ports of its front motor joined: the oil that it displaces never meets a pressure, so what it
    displaces is nothing to the circuit. Its pump idles.
    """
    motor = actuator.front.motor.model_copy(update={"displacement": 0.0})
    return actuator.model_copy(update={"front": actuator.front.model_copy(update={"motor": motor})})
