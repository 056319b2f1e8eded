"""The control unit: samples sensors and commands, and asks for currents, a side of the direction valve, and so on.

    M_c ─> p_c = (|M_c| + M_F)/D + p_ret ─> PI on each pressure ─> settings of the valves ─> currents

It is a torque control by pressures: it never sees an angle. What friction in the motor takes is fed forward as the
commanded torque moves it. The front is raised to the rear, of whose pressure it cannot fall short. The direction valve
moves only at low pressure, and pressure is raised only where the valve's sensor shows it in place: otherwise both
valves are open and the pump circulates. So it is too where nothing is asked for, below the activation speed, after a
failed test, and where the fail-safe valve is shut.

Before the car drives off a test pressure against the shut fail-safe valve proves that valve, which must hold the oil,
and the front pressure valve, which must hold the pressure.
"""

from typing import Any

from ars_mujoco.actuators.valve_controlled.block import REAR_NODE
from ars_mujoco.hydraulics.pressure_valve import current_for, setting_for
from ars_mujoco.hydraulics.vane_motor import friction_torque
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, number, quantity

STANDING = 0.5  # m/s, below which the car counts as standing
IN_PLACE = 0.1  # of its stroke, within which the direction valve counts as switched
RELEASED = 0.5  # of the least torque, below which the direction valve goes back to its centre


class Control(Parameters):
    """What the unit does."""

    sample_time: float = quantity("s", ge=0)  # 0: at every physics step
    activation_speed: float = quantity("m/s", ge=0)  # of the car, from which on it acts
    release_speed: float = quantity("m/s", ge=0)  # below which it no longer does
    least_torque: float = quantity("Nm", ge=0)  # both bars together: less than this leaves the direction valve centred
    switching_pressure: float = quantity("Pa", gt=0)  # below which the direction valve may move
    front_pressure: float = quantity("Pa", gt=0)  # largest, over the reservoir's
    rear_pressure: float = quantity("Pa", gt=0)
    gain: float = number(ge=0)  # of the pressure loops: setting over error
    integral_time: float = quantity("s", gt=0)
    authority: float = quantity("Pa", ge=0)  # of the loops; beyond such an error they do not integrate
    test_pressure: float = quantity("Pa", gt=0)
    test_settling: float = quantity("s", ge=0)  # before and after it, for the switching valves to move
    test_rise: float = quantity("s", gt=0)  # within which the pressure must be there
    test_tolerance: float = quantity("Pa", gt=0)


class UnitState(Parameters):
    """What the unit keeps from sample to sample, its outputs among it."""

    side: float = channel("1", "side that the direction valve is asked for")
    fail_safe: float = channel("1", "opening that the fail-safe valve is asked for")
    front_current: float = channel("A", "current asked of the front pressure valve")
    rear_current: float = channel("A", "current asked of the rear pressure valve")
    front_pressure: float = channel("Pa", "commanded front pressure over the reservoir's, 0 while it circulates")
    rear_pressure: float = channel("Pa", "commanded rear pressure over the reservoir's, 0 while it circulates")
    front_integral: float = channel("Pa", "integral of the front pressure loop")
    rear_integral: float = channel("Pa", "integral of the rear pressure loop")
    front_torque: float = channel("Nm", "commanded torque of the front bar at the last sample")
    rear_torque: float = channel("Nm", "commanded torque of the rear bar at the last sample")
    active: float = channel("1", "1 while the unit acts, 0 while it only circulates")
    test: float = channel("s", "time into the test before driving off")
    failed: float = channel("1", "1 after a failed test")


@kernel
def sample(p: Any, unit: Any, block: Any, command: Any, conditions: Any) -> None:
    """One sample: `unit` is a UnitState, changed in place; of `block`, a BlockState, only what sensors show is read.

    `conditions` are the sample time (s), the road speed (m/s), the opening (0 to 1) that the fail-safe valve is
    allowed, and the pump's flow (m^3/s), which follows from the engine speed.
    """
    period, road_speed, allowed, flow = conditions
    testing = _test(p, unit, block, period, road_speed)
    unit.fail_safe = 0.0 if testing or unit.failed == 1.0 else allowed
    unit.active = 1.0 if unit.fail_safe == 1.0 and _drives(p.control, unit.active, road_speed) else 0.0
    front, rear = unit.active * command.front.torque, unit.active * command.rear.torque
    wanted = 1.0 if testing else _side(p.control, unit.side, front + rear)
    is_low = max(block.front_sensed, block.rear_sensed) < p.control.switching_pressure
    if wanted != unit.side and is_low:
        unit.side = wanted
    outlet, is_in_place = p.block.return_pressure, abs(block.spool - unit.side) < IN_PLACE
    if testing and is_in_place and _is_test_pressure_asked(p.control, unit):
        _hold(p, unit, (p.control.test_pressure, outlet), flow)
    elif unit.active == 1.0 and wanted != 0.0 and unit.side == wanted and is_in_place:
        most = p.control.front_pressure, p.control.rear_pressure
        front_rate, rear_rate = (front - unit.front_torque) / period, (rear - unit.rear_torque) / period
        leading = min(_pressure(p, p.front, wanted * front, wanted * front_rate, flow), most[0])
        lagging = min(_pressure(p, p.rear, wanted * rear, wanted * rear_rate, flow), most[1])
        _regulate(p, unit, block, (max(leading, lagging), lagging), (period, flow))
    else:
        _circulate(unit)
    unit.front_torque, unit.rear_torque = front, rear


@kernel
def _side(control, side, torque):
    # +1, 0 or -1 for a torque (Nm) of both bars together; from the side at which it is it goes back later
    least = control.least_torque if side == 0.0 else RELEASED * control.least_torque
    if abs(torque) <= least:
        return 0.0
    return 1.0 if torque > 0.0 else -1.0


@kernel
def _pressure(p, axle, torque, torque_rate, flow):
    # pressure (Pa) for a torque (Nm) to the side of the direction valve that changes at a rate (Nm/s), which moves the
    # motor no faster than the pump's flow does; a torque to the other side cannot be given
    motor, outlet = axle.axle.motor, p.block.return_pressure
    rate = saturate(torque_rate / axle.stiffness, flow / motor.displacement)
    needed = max(torque, 0.0) + friction_torque(motor, rate)
    return outlet + max(needed, 0.0) / motor.displacement


@kernel
def _regulate(p, unit, block, wanted, conditions):
    # pressures (Pa) of front and rear, held by the loops
    (front, rear), (period, flow), control = wanted, conditions, p.control
    front_error, rear_error = front - block.front_sensed, rear - block.rear_sensed
    unit.front_integral = _integrated(control, unit.front_integral, front_error, period)
    unit.rear_integral = _integrated(control, unit.rear_integral, rear_error, period)
    corrected = (
        front + saturate(control.gain * front_error + unit.front_integral, control.authority),
        rear + saturate(control.gain * rear_error + unit.rear_integral, control.authority),
    )
    _hold(p, unit, corrected, flow)
    unit.front_pressure, unit.rear_pressure = front, rear


@kernel
def _integrated(control, integral, error, period):
    # the integral after a sample; a pressure that is far off, as while a motor fills, does not wind it up
    if abs(error) > control.authority:
        return integral
    return saturate(integral + control.gain * error * period / control.integral_time, control.authority)


@kernel
def _hold(p, unit, pressures, flow):
    # ask both valves for pressures (Pa) of front and rear node
    (front, rear), block, outlet = pressures, p.block, p.block.return_pressure
    over_front, over_rear = front - rear, rear - outlet
    works_on = over_front if block.front_reference == REAR_NODE else front - outlet
    unit.front_pressure, unit.rear_pressure = front, rear
    unit.front_current = current_for(block.front_valve, setting_for(block.front_valve, works_on, over_front, flow))
    unit.rear_current = current_for(block.rear_valve, setting_for(block.rear_valve, over_rear, over_rear, flow))


@kernel
def _circulate(unit):
    # both valves open
    unit.front_current = unit.rear_current = unit.front_pressure = unit.rear_pressure = 0.0
    unit.front_integral = unit.rear_integral = 0.0


@kernel
def _drives(control, active, road_speed):
    return road_speed >= (control.release_speed if active == 1.0 else control.activation_speed)


@kernel
def _test(p, unit, block, period, road_speed):
    # whether the test before driving off goes on; a car that drives has passed it
    control = p.control
    judged = control.test_settling + control.test_rise
    length = judged + control.test_settling
    if unit.test >= length:
        return False
    if road_speed > STANDING:
        unit.test = length
        return False
    unit.test += period
    if unit.test - period < judged <= unit.test and not _is_proven(control, block):
        unit.failed = 1.0
    return unit.test < length


@kernel
def _is_test_pressure_asked(control, unit):
    return control.test_settling < unit.test < control.test_settling + control.test_rise


@kernel
def _is_proven(control, block):
    # oil that went on into the front motor would not be at that pressure yet
    return abs(block.front_sensed - control.test_pressure) <= control.test_tolerance
