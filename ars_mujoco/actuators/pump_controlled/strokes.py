"""Strokes: from commanded bar angles to what both pumps are asked for, and both circuits on their drive.

This part every stage shares; `circuits` is the module of one stage, with its `advance_circuits`, `report` and
`openings`. The outer loop runs in the car's control unit. A continuous unit delays the commanded angle and leaves the
outer loop to the circuits' substeps; a sampling unit computes the outer loop itself and delays the stroke.
"""

import numpy as np

from ars_mujoco.actuators.pump_controlled import pole_compensator, pressure_feedback
from ars_mujoco.actuators.pump_controlled.bar_angle_loop import BarAngleLoop, limited, outer_gain
from ars_mujoco.actuators.pump_controlled.drive_speed import DRIVE, DriveState, set_speed, take_work
from ars_mujoco.actuators.pump_controlled.pole_compensator import PoleCompensator, compensated
from ars_mujoco.actuators.pump_controlled.pressure_feedback import PressureFeedback, fed_back
from ars_mujoco.control.control_unit import DELAY_LINE, delayed, samples_now
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import record_dtype

BURST_PRESSURE = 1e8  # Pa; no relief valve lets a real circuit get near 1000 bar

FILTERS = np.dtype([("feedback", pressure_feedback.STATE), ("compensator", pole_compensator.STATE)])


def parameters(axle: np.dtype) -> np.dtype:
    """The record of a pump-controlled bar whose axles have the record `axle`."""
    return np.dtype(
        [
            ("front", axle),
            ("rear", axle),
            ("drive", DRIVE),
            ("loop", record_dtype(BarAngleLoop)),
            ("pressure_feedback", record_dtype(PressureFeedback)),  # a gain of 0: none
            ("compensator", record_dtype(PoleCompensator)),  # a frequency of 0: none
        ]
    )


def states(axle: np.dtype) -> np.dtype:
    """The record of its state, whose axles have the record `axle`."""
    return np.dtype(
        [
            ("front", axle),
            ("rear", axle),
            ("drive", record_dtype(DriveState)),
            ("delay", DELAY_LINE),
            ("front_stroke", "f8"),  # stroke commands that a sampling unit last computed
            ("rear_stroke", "f8"),
            ("front_filters", FILTERS),
            ("rear_filters", FILTERS),
        ]
    )


@kernel
def advance_stage(p, now, later, out, work, command, twists, moment, circuits):
    """Advance both axles; return their bar torques (front, rear) in Nm, as the contract's `advance` does."""
    step, unit = moment.step, moment.unit
    pumps = p.front.circuit.pump, p.rear.circuit.pump
    set_speed(p.drive, now.drive, later.drive, out.drive, pumps, moment.time, moment.road_speed)
    front_gain, rear_gain = outer_gain(p.loop, pumps[0].speed), outer_gain(p.loop, pumps[1].speed)
    front_command, rear_command = _limited(p.loop, command.front.angle), _limited(p.loop, command.rear.angle)
    front_bias = rear_bias = 0.0
    later.delay = now.delay
    if unit.sample_time == 0.0:
        if unit.delay > 0.0:
            front, rear = delayed(unit, later.delay, front_command[0], rear_command[0], step)
            front_command, rear_command = (front, 0.0, 0.0), (rear, 0.0, 0.0)
    else:
        later.front_stroke, later.rear_stroke = now.front_stroke, now.rear_stroke
        later.front_filters, later.rear_filters = now.front_filters, now.rear_filters
        if samples_now(unit, moment.time, step):
            period = unit.sample_time
            later.front_stroke = _stroke(
                p, now.front_filters, later.front_filters, now.front.circuit, front_gain, front_command[0], period
            )
            later.rear_stroke = _stroke(
                p, now.rear_filters, later.rear_filters, now.rear.circuit, rear_gain, rear_command[0], period
            )
        front_bias, rear_bias = delayed(unit, later.delay, later.front_stroke, later.rear_stroke, step)
        front_gain = rear_gain = 0.0
    front_valves, rear_valves = circuits.openings(command.inputs)
    front_demand = _demand(front_command, front_gain, front_bias, twists.front.held, front_valves)
    rear_demand = _demand(rear_command, rear_gain, rear_bias, twists.rear.held, rear_valves)
    torques = circuits.advance_circuits(
        p, now, later, front_demand, rear_demand, (front_valves, rear_valves), step, work
    )
    out.front.bar.command, out.rear.bar.command = front_command[0], rear_command[0]
    circuits.report(p.front, now.front, out.front, twists.front.angle, work)
    if p.rear.substeps > 0.0:
        circuits.report(p.rear, now.rear, out.rear, twists.rear.angle, work)
    shaft = circuits.shaft_work
    done = shaft(later.front) - shaft(now.front) + shaft(later.rear) - shaft(now.rear)
    asked = max(abs(command.front.angle[0]), abs(command.rear.angle[0]))
    take_work(p.drive, now.drive, later.drive, out.drive, done, asked, step)
    return torques


@kernel
def sense(p, now, sensors) -> None:
    """Write angle and torque (Nm, by the pressure difference) of both motors."""
    front, rear = now.front.circuit, now.rear.circuit
    sensors.front_angle, sensors.rear_angle = front.angle, rear.angle
    sensors.front_torque = p.front.circuit.motor.displacement * front.pressure
    sensors.rear_torque = p.rear.circuit.motor.displacement * rear.pressure


@kernel
def is_beyond(p, state) -> bool:
    """Whether a circuit's substeps have burst, or its vane went far past the stop."""
    return _is_beyond(p.front, state.front.circuit) or _is_beyond(p.rear, state.rear.circuit)


@kernel
def _is_beyond(axle, circuit) -> bool:
    too_far = abs(circuit.angle) > 2.0 * axle.circuit.motor.stop_angle
    return axle.substeps > 0.0 and (too_far or abs(circuit.pressure) > BURST_PRESSURE)


@kernel
def _stroke(p, now, later, circuit, gain, command, period):
    # the stroke command of a sample; limited before the feedback too, which so keeps damping while the error is large
    stroke = saturate(gain * (command - circuit.angle), 1.0)
    if p.compensator.frequency > 0.0:
        stroke = compensated(p.compensator, now.compensator, later.compensator, stroke, period)
    if p.pressure_feedback.gain != 0.0:
        stroke -= fed_back(p.pressure_feedback, now.feedback, later.feedback, circuit.pressure, period)
    return saturate(stroke, 1.0)


@kernel
def _demand(command, gain, bias, twist, valves):
    # where a valve is told to cut the motor off, the unit swashes the pump back in place of pumping against it
    bypass, fail_safe = valves
    connected = (1.0 - bypass) * fail_safe
    return command, connected * gain, connected * bias, twist


@kernel
def _limited(loop, command):
    # a command over the limit is held there for the whole step
    c0, c1, c2 = command
    first = limited(loop, c0)
    return (c0, c1, c2) if first == c0 else (first, 0.0, 0.0)
