"""The reduced circuit: pump control, pump, line, relief valve and vane motor as six states (the verification set).

    command ─> outer loop ─> inner loop ─> servo valve ─> swash plate ─> pump ═ line ═ vane motor ─> bar
                   ^                                        (X)                (dp)      (phi, w)
                   └────────────────────── phi ─────────────────────────────────────────────┘

Signs: positive stroke X delivers into the side whose pressure difference dp drives the motor to positive phi; positive
phi twists the bar, and the bar pushes the body to negative roll. Both loops live inside the substeps, because holding
either over a physics step costs accuracy; a control unit that samples gives its stroke command as `stroke_bias`
instead and sets `gain` to zero.

Constants divide before they multiply (1 / inertia * torque), so that a division leaves the loop over the substeps.
"""

from ars_mujoco.actuators.pump_controlled.swash_plate_loop import SwashPlateLoop, valve_command
from ars_mujoco.hydraulics.control_cylinder import ControlCylinder
from ars_mujoco.hydraulics.line import Line, capacitance, capacitance_slope
from ars_mujoco.hydraulics.metering_edge import MeteringEdge
from ars_mujoco.hydraulics.oil import Oil
from ars_mujoco.hydraulics.pump import Pump, flow_loss, ideal_flow, torque_loss
from ars_mujoco.hydraulics.relief_valve import ReliefValve, relief_flow
from ars_mujoco.hydraulics.servo_valve import ServoValve, spool_acceleration
from ars_mujoco.hydraulics.swash_plate import SwashPlate, held, stroke_rate
from ars_mujoco.hydraulics.vane_motor import VaneMotor, friction_torque, stop_torque
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.channels import channel, counted, drawn, lost
from ars_mujoco.schema.parameters import Parameters, quantity

NOTHING = (0.0,) * 11


class Circuit(Parameters):
    """Components that one axle's circuit has at every stage of simplification."""

    servo_valve: ServoValve
    swash_plate: SwashPlate
    swash_plate_loop: SwashPlateLoop
    pump: Pump
    relief_valve: ReliefValve
    motor: VaneMotor
    oil: Oil | None = None  # these three where pump control is more than third order
    metering_edge: MeteringEdge | None = None
    control_cylinder: ControlCylinder | None = None


class ReducedCircuit(Circuit):
    """Components of one axle's reduced circuit."""

    line: Line
    charge_power: float = quantity(
        "W", ge=0
    )  # constant drawn by charge and control supply, all of it throttled to heat


class CircuitState(Parameters):
    """State of one axle's circuit."""

    spool: float = channel("1", "servo valve stroke, fraction of full")
    spool_rate: float = channel("1/s", "its rate")
    stroke: float = channel("1", "pump stroke, fraction of full")
    pressure: float = channel("Pa", "pressure difference across the motor")
    angle: float = channel("rad", "angle of the motor")
    rate: float = channel("rad/s", "its rate")


class CircuitEnergy(Parameters):
    """Energies of one axle since the start, integrated in the substeps with the weights of the states."""

    shaft: float = drawn("work of the pump shaft, less what came back")
    recovered: float = counted("work given back to the shaft, as a positive number")
    pump_torque_loss: float = lost("lost to the pump's torque loss")
    pump_leakage: float = lost("lost to leakage in the pump, its flow loss")
    motor_leakage: float = lost("lost to leakage in the motor")
    relief: float = lost("lost over the relief valve")
    friction: float = lost("lost to friction in the motor")
    capacitance: float = lost("taken by the oil's capacitance as it varies with the angle")
    charge: float = drawn("drawn by charge and control supply")
    charge_loss: float = lost("of charge, what never reaches the circuit")
    motor: float = counted("work of the motor on the bar")
    throughput: float = counted("integral of |shaft| + |motor| power")


@kernel
def rates(circuit, bar_stiffness: float, state, stroke_command: float, twist: float):
    """Derivatives of the six states and the powers behind the energies, as two tuples.

    The states are (spool, spool_rate, stroke, pressure, angle, rate); the equations are those of the verification set
    (paper eqs. 18 to 20, 24 to 29). The powers are (W) shaft, pump torque loss, pump leakage, motor leakage, relief,
    friction, capacitance, motor, and the bar torque (Nm).
    """
    spool, spool_rate, stroke, pressure, angle, rate = state
    command = valve_command(circuit.swash_plate_loop, circuit.swash_plate, stroke_command, stroke)
    plant, powers = plant_rates(circuit, bar_stiffness, stroke, pressure, angle, rate, twist)
    control = (
        spool_rate,
        spool_acceleration(circuit.servo_valve, spool, spool_rate, command),
        stroke_rate(circuit.swash_plate, spool),
    )
    return control + plant, powers


@kernel
def plant_rates(circuit, bar_stiffness: float, stroke: float, pressure: float, angle: float, rate: float, twist: float):
    """Derivatives of (pressure, angle, rate) at a pump stroke, and the powers of `rates` (eqs. 24 to 29)."""
    pump, motor = circuit.pump, circuit.motor
    flow = ideal_flow(pump, stroke)
    relief = relief_flow(circuit.relief_valve, pressure)
    friction = friction_torque(motor, rate)
    bar_torque = bar_stiffness * (angle - twist)
    pump_leakage, motor_leakage = flow_loss(pump, stroke, pressure), motor.leakage * pressure
    derivatives = (
        (flow - (pump_leakage + motor_leakage) - relief - motor.displacement * rate)
        / capacitance(circuit.line, motor, angle, pressure),
        rate,
        1.0 / motor.inertia * (motor.displacement * pressure - bar_torque - stop_torque(motor, angle) - friction),
    )
    loss = torque_loss(pump, stroke, pressure) * pump.speed
    powers = (
        flow * pressure + loss,
        loss,
        pump_leakage * pressure,
        motor_leakage * pressure,
        relief * pressure,
        friction * rate,
        -0.5 * capacitance_slope(circuit.line, motor, angle, pressure) * rate * pressure * pressure,
        bar_torque * rate,
        bar_torque,
    )
    return derivatives, powers


@kernel
def advance(
    circuit, bar_stiffness, now, later, energy_now, energy_later, command, gain, stroke_bias, twist, step, count
) -> float:
    """Advance the circuit by `step` s in `count` classical Runge-Kutta substeps; return the mean bar torque (Nm).

    `now` and `later` are CircuitState records (they may be the same), `energy_*` CircuitEnergy records. The stroke
    command at a stage is the saturated `stroke_bias + gain (phi_c(t) - phi)`, where `command` = (c0, c1, c2) is the
    commanded angle c0 + c1 t + c2 t^2 (rad) since the start of the step. `bar_stiffness` is c_stabi
    (Nm/rad), the torsion of both halves in series; the bar's twist (rad) is held.
    """
    demand, h = (command, gain, stroke_bias, twist), step / count
    state, sums = read(now), NOTHING
    for i in range(count):
        t = i * h
        k1, p1 = _stage(circuit, bar_stiffness, demand, t, state)
        k2, p2 = _stage(circuit, bar_stiffness, demand, t + 0.5 * h, along(state, k1, 0.5 * h))
        k3, p3 = _stage(circuit, bar_stiffness, demand, t + 0.5 * h, along(state, k2, 0.5 * h))
        k4, p4 = _stage(circuit, bar_stiffness, demand, t + h, along(state, k3, h))
        state, sums = _runge_kutta(circuit, state, k1, k2, k3, k4, h), _accumulate(sums, p1, p2, p3, p4)
    return _write(circuit, state, sums, later, energy_now, energy_later, step, count)


@kernel
def advance_both(
    f, r, f_stiffness, r_stiffness, f_now, r_now, f_later, r_later,
    f_energy_now, r_energy_now, f_energy_later, r_energy_later, f_demand, r_demand, step, count,
):  # fmt: skip
    """Advance two circuits, front and rear, in lockstep; return their mean bar torques (Nm).

    The arguments are those of `advance`, of the front and of the rear one; a demand is (command, gain, stroke_bias,
    twist). Two independent chains of arithmetic in one loop take little longer than one, because a processor works on
    both at once; the results are those of `advance`.
    """
    f_state, r_state, f_sums, r_sums = read(f_now), read(r_now), NOTHING, NOTHING
    h = step / count
    for i in range(count):
        t = i * h
        k1, p1 = _stage(f, f_stiffness, f_demand, t, f_state)
        l1, q1 = _stage(r, r_stiffness, r_demand, t, r_state)
        k2, p2 = _stage(f, f_stiffness, f_demand, t + 0.5 * h, along(f_state, k1, 0.5 * h))
        l2, q2 = _stage(r, r_stiffness, r_demand, t + 0.5 * h, along(r_state, l1, 0.5 * h))
        k3, p3 = _stage(f, f_stiffness, f_demand, t + 0.5 * h, along(f_state, k2, 0.5 * h))
        l3, q3 = _stage(r, r_stiffness, r_demand, t + 0.5 * h, along(r_state, l2, 0.5 * h))
        k4, p4 = _stage(f, f_stiffness, f_demand, t + h, along(f_state, k3, h))
        l4, q4 = _stage(r, r_stiffness, r_demand, t + h, along(r_state, l3, h))
        f_state, f_sums = _runge_kutta(f, f_state, k1, k2, k3, k4, h), _accumulate(f_sums, p1, p2, p3, p4)
        r_state, r_sums = _runge_kutta(r, r_state, l1, l2, l3, l4, h), _accumulate(r_sums, q1, q2, q3, q4)
    return (
        _write(f, f_state, f_sums, f_later, f_energy_now, f_energy_later, step, count),
        _write(r, r_state, r_sums, r_later, r_energy_now, r_energy_later, step, count),
    )


@kernel
def read(state):
    """A CircuitState record as the tuple that `rates` takes."""
    return state.spool, state.spool_rate, state.stroke, state.pressure, state.angle, state.rate


@kernel
def stored_energy(circuit, bar_stiffness: float, state, twist: float):
    """Energy (J) now stored in (oil, bar torsion, motor inertia, mechanical stop)."""
    beyond = max(abs(state.angle) - circuit.motor.stop_angle, 0.0)
    return (
        0.5 * capacitance(circuit.line, circuit.motor, state.angle, state.pressure) * state.pressure**2,
        0.5 * bar_stiffness * (state.angle - twist) ** 2,
        0.5 * circuit.motor.inertia * state.rate**2,
        0.5 * circuit.motor.stop_stiffness * beyond**2,
    )


@kernel
def _stage(circuit, bar_stiffness, demand, t, state):
    (c0, c1, c2), gain, bias, twist = demand
    stroke_command = saturate(bias + gain * (c0 + t * (c1 + t * c2) - state[4]), 1.0)
    return rates(circuit, bar_stiffness, state, stroke_command, twist)


@kernel
def along(state, rate, h):
    """Six numbers `h` along their rates."""
    return (
        state[0] + h * rate[0],
        state[1] + h * rate[1],
        state[2] + h * rate[2],
        state[3] + h * rate[3],
        state[4] + h * rate[4],
        state[5] + h * rate[5],
    )


@kernel
def _runge_kutta(circuit, state, k1, k2, k3, k4, h):
    w, d = h / 6.0, 2.0
    return (
        state[0] + w * (k1[0] + d * (k2[0] + k3[0]) + k4[0]),
        state[1] + w * (k1[1] + d * (k2[1] + k3[1]) + k4[1]),
        held(circuit.swash_plate, state[2] + w * (k1[2] + d * (k2[2] + k3[2]) + k4[2])),
        state[3] + w * (k1[3] + d * (k2[3] + k3[3]) + k4[3]),
        state[4] + w * (k1[4] + d * (k2[4] + k3[4]) + k4[4]),
        state[5] + w * (k1[5] + d * (k2[5] + k3[5]) + k4[5]),
    )


@kernel
def _accumulate(sums, p1, p2, p3, p4):
    # the powers of `rates` with the weights of the states, then recovered power and throughput, which need |.|
    shaft, motor = _mean(p1[0], p2[0], p3[0], p4[0]), _mean(p1[7], p2[7], p3[7], p4[7])
    return (
        sums[0] + shaft,
        sums[1] + _mean(p1[1], p2[1], p3[1], p4[1]),
        sums[2] + _mean(p1[2], p2[2], p3[2], p4[2]),
        sums[3] + _mean(p1[3], p2[3], p3[3], p4[3]),
        sums[4] + _mean(p1[4], p2[4], p3[4], p4[4]),
        sums[5] + _mean(p1[5], p2[5], p3[5], p4[5]),
        sums[6] + _mean(p1[6], p2[6], p3[6], p4[6]),
        sums[7] + motor,
        sums[8] + _mean(p1[8], p2[8], p3[8], p4[8]),
        sums[9] + max(-shaft, 0.0),
        sums[10] + abs(shaft) + abs(motor),
    )


@kernel
def _mean(a, b, c, d):
    return (a + 2.0 * (b + c) + d) * (1.0 / 6.0)


@kernel
def _write(circuit, state, sums, later, energy_now, energy_later, step, count):
    # the new state and energies into their records; returns the mean bar torque
    later.spool, later.spool_rate, later.stroke, later.pressure, later.angle, later.rate = state
    h = step / count
    shaft, loss, pump_leakage, motor_leakage, relief, friction, compliance, motor, torque, recovered, throughput = sums
    energy_later.shaft = energy_now.shaft + h * shaft
    energy_later.recovered = energy_now.recovered + h * recovered
    energy_later.pump_torque_loss = energy_now.pump_torque_loss + h * loss
    energy_later.pump_leakage = energy_now.pump_leakage + h * pump_leakage
    energy_later.motor_leakage = energy_now.motor_leakage + h * motor_leakage
    energy_later.relief = energy_now.relief + h * relief
    energy_later.friction = energy_now.friction + h * friction
    energy_later.capacitance = energy_now.capacitance + h * compliance
    energy_later.charge = energy_now.charge + step * circuit.charge_power
    energy_later.charge_loss = energy_now.charge_loss + step * circuit.charge_power
    energy_later.motor = energy_now.motor + h * motor
    energy_later.throughput = energy_now.throughput + h * throughput
    return torque / count
