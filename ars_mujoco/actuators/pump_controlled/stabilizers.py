"""Both axles' stabilizers under one control unit: the part that every rig shares."""

import mujoco
import numpy as np

from ars_mujoco.actuators.pump_controlled import pole_compensator, pressure_feedback
from ars_mujoco.actuators.pump_controlled.axle import DETAILED, PUMP_CONTROLLED, Axle, AxleState, stabilize
from ars_mujoco.actuators.pump_controlled.bar_angle_loop import BarAngleLoop, limited, outer_gain
from ars_mujoco.actuators.pump_controlled.drive_speed import DRIVE, DriveState, set_speed, take_work
from ars_mujoco.actuators.pump_controlled.pole_compensator import PoleCompensator, compensated
from ars_mujoco.actuators.pump_controlled.pressure_feedback import PressureFeedback, fed_back
from ars_mujoco.bridge.world import BURST, stop
from ars_mujoco.control.control_unit import DELAY_LINE, ControlUnit, delayed, samples_now
from ars_mujoco.excitation.knots import SIGNAL, value
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import record_dtype

BURST_PRESSURE = 1e8  # Pa; no relief valve lets a real circuit get near 1000 bar
BARS = ("front_bar_left", "front_bar_right", "rear_bar_left", "rear_bar_right")
BAR_ADDRESSES = np.dtype([("position", "f8", 4), ("velocity", "f8", 4)])

# commanded openings over time, 0 shut and 1 open
VALVES = np.dtype([("bypass", SIGNAL), ("fail_safe", SIGNAL)])
PARAMETERS = np.dtype(
    [
        ("front", record_dtype(Axle)),
        ("rear", record_dtype(Axle)),
        ("drive", DRIVE),
        ("loop", record_dtype(BarAngleLoop)),
        ("unit", record_dtype(ControlUnit)),
        ("front_valves", VALVES),
        ("rear_valves", VALVES),
        ("feedback", record_dtype(PressureFeedback)),  # a gain of 0: none
        ("compensator", record_dtype(PoleCompensator)),  # a frequency of 0: none
    ]
)
FILTERS = np.dtype([("feedback", pressure_feedback.STATE), ("compensator", pole_compensator.STATE)])
STATE = np.dtype(
    [
        ("front", record_dtype(AxleState)),
        ("rear", record_dtype(AxleState)),
        ("drive", record_dtype(DriveState)),
        ("delay", DELAY_LINE),
        ("front_stroke", "f8"),  # stroke commands that a sampling unit last computed
        ("rear_stroke", "f8"),
        ("front_filters", FILTERS),
        ("rear_filters", FILTERS),
    ]
)


@kernel
def stabilize_both(
    p, now, later, drive_out, front_out, rear_out, time, step, road_speed,
    front_command, rear_command, front_twist, rear_twist, work,
):  # fmt: skip
    """Advance both axles by `step` s; return their bar torques (front, rear) in Nm.

    The outs are a DriveOutput and two AxleOutput records; an engine turns with the road speed (m/s). Commands are
    (c0, c1, c2) over the step as in `reduced_circuit.advance`; twists and work as in `axle.stabilize`.
    A continuous unit delays the commanded angle and leaves the outer loop to the substeps; a sampling unit computes the
    outer loop itself and delays the stroke.
    """
    pumps = p.front.circuit.pump, p.rear.circuit.pump
    set_speed(p.drive, now.drive, later.drive, drive_out, pumps, time, road_speed)
    front_gain, rear_gain = _gain(p.front, p.loop), _gain(p.rear, p.loop)
    front_command, rear_command = _limited(p.loop, front_command), _limited(p.loop, rear_command)
    front_bias = rear_bias = 0.0
    later.delay = now.delay
    if p.unit.sample_time == 0.0:
        if p.unit.delay > 0.0:
            front, rear = delayed(p.unit, later.delay, front_command[0], rear_command[0], step)
            front_command, rear_command = (front, 0.0, 0.0), (rear, 0.0, 0.0)
    else:
        later.front_stroke, later.rear_stroke = now.front_stroke, now.rear_stroke
        later.front_filters, later.rear_filters = now.front_filters, now.rear_filters
        if samples_now(p.unit, time, step):
            later.front_stroke = _stroke(
                p, now.front_filters, later.front_filters, now.front.circuit, front_gain, front_command[0]
            )
            later.rear_stroke = _stroke(
                p, now.rear_filters, later.rear_filters, now.rear.circuit, rear_gain, rear_command[0]
            )
        front_bias, rear_bias = delayed(p.unit, later.delay, later.front_stroke, later.rear_stroke, step)
        front_gain = rear_gain = 0.0
    front_valves, rear_valves = _openings(p.front, p.front_valves, time), _openings(p.rear, p.rear_valves, time)
    torques = stabilize(
        p, now, later, front_out, rear_out, front_twist, rear_twist,
        _demand(front_command, front_gain, front_bias, front_valves),
        _demand(rear_command, rear_gain, rear_bias, rear_valves), (front_valves, rear_valves), step, work,
    )  # fmt: skip
    done = _shaft_work(later.front) - _shaft_work(now.front) + _shaft_work(later.rear) - _shaft_work(now.rear)
    take_work(p.drive, now.drive, later.drive, drive_out, done, step)
    return torques


@kernel
def _shaft_work(axle):
    # of the pump and of a full circuit's charge pump, on the same shaft
    return axle.energy.shaft + axle.energy.charge_pump


@kernel
def _stroke(p, now, later, circuit, gain, command):
    # the stroke command of a sample; limited before the feedback too, which so keeps damping while the error is large
    stroke = saturate(gain * (command - circuit.angle), 1.0)
    if p.compensator.frequency > 0.0:
        stroke = compensated(p.compensator, now.compensator, later.compensator, stroke, p.unit.sample_time)
    if p.feedback.gain != 0.0:
        stroke -= fed_back(p.feedback, now.feedback, later.feedback, circuit.pressure, p.unit.sample_time)
    return saturate(stroke, 1.0)


@kernel
def _gain(axle, loop):
    return outer_gain(loop, axle.circuit.pump.speed) if axle.kind >= PUMP_CONTROLLED else 0.0


@kernel
def _demand(command, gain, bias, valves):
    # where a valve is told to cut the motor off, the unit swashes the pump back in place of pumping against it
    bypass, fail_safe = valves
    connected = (1.0 - bypass) * fail_safe
    return command, connected * gain, connected * bias


@kernel
def _openings(axle, valves, time):
    # commanded at `time`; only a detailed circuit has valves to command
    if axle.kind == DETAILED:
        return value(valves.bypass, time), value(valves.fail_safe, time)
    return 0.0, 1.0


@kernel
def _limited(loop, command):
    # a command over the limit is held there for the whole step
    c0, c1, c2 = command
    first = limited(loop, c0)
    return (c0, c1, c2) if first == c0 else (first, 0.0, 0.0)


def bar_addresses(model: mujoco.MjModel) -> dict:
    """The numbers of BAR_ADDRESSES, by the model's names."""
    joints = [model.joint(name) for name in BARS]
    return {"position": [j.qposadr[0] for j in joints], "velocity": [j.dofadr[0] for j in joints]}


@kernel
def twist(bars, mj, left: int):
    """Twist of the bar whose left half is number `left` of BARS: (angle rad, rate rad/s, angle held over the step rad).

    A car's twist is held as it is now: MuJoCo's semi-implicit step, too, takes its springs at the start of the step.
    """
    angle = mj.qpos[int(bars.position[left])] - mj.qpos[int(bars.position[left + 1])]
    rate = mj.qvel[int(bars.velocity[left])] - mj.qvel[int(bars.velocity[left + 1])]
    return angle, rate, angle


@kernel
def apply_bar_torques(bars, mj, front: float, rear: float) -> None:
    """Put the bar torques (Nm) on the halves' hinges: +M left, -M right."""
    mj.qfrc_applied[int(bars.velocity[0])], mj.qfrc_applied[int(bars.velocity[1])] = front, -front
    mj.qfrc_applied[int(bars.velocity[2])], mj.qfrc_applied[int(bars.velocity[3])] = rear, -rear


@kernel
def sense_circuits(sensors, now) -> None:
    """Let the controller's sensors read both circuits."""
    front, rear = now.front.circuit, now.rear.circuit
    sensors.front_angle, sensors.rear_angle = front.angle, rear.angle
    sensors.front_pressure, sensors.rear_pressure = front.pressure, rear.pressure


@kernel
def check_circuits(world, stabilizers, state, time: float) -> None:
    """Record that a circuit has left all that is physical: its substeps burst, or its vane went far past the stop."""
    if _is_beyond(stabilizers.front, state.front.circuit) or _is_beyond(stabilizers.rear, state.rear.circuit):
        stop(world, BURST, time)


@kernel
def _is_beyond(axle, circuit) -> bool:
    too_far = abs(circuit.angle) > 2.0 * axle.circuit.motor.stop_angle
    return axle.kind >= PUMP_CONTROLLED and (too_far or abs(circuit.pressure) > BURST_PRESSURE)
