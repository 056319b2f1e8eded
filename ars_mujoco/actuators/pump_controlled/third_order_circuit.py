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
from ars_mujoco.kernels.integration import in_substeps
from ars_mujoco.kernels.kernel import inlined, kernel
from ars_mujoco.kernels.records import numbers, store
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.channels import channel, counted, drawn, lost
from ars_mujoco.schema.parameters import Parameters, quantity


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

    spool: float = channel("1", "servo valve stroke, fraction of full", scale=1e-4)
    spool_rate: float = channel("1/s", "its rate", scale=1e-2)
    stroke: float = channel("1", "pump stroke, fraction of full", scale=1e-4)
    pressure: float = channel("Pa", "pressure difference across the motor", scale=1e2)
    angle: float = channel("rad", "angle of the motor", scale=1e-6)
    rate: float = channel("rad/s", "its rate", scale=1e-6)


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


@inlined
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


@inlined
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


@inlined
def axle_rates(axle, demand, t: float, state):
    """The equations of an `axle.Axle` as `kernels.integration` takes them; a demand is (command, gain, bias, twist).

    The stroke command is the saturated `bias + gain (phi_c(t) - phi)`, where `command` = (c0, c1, c2) is the commanded
    angle c0 + c1 t + c2 t^2 (rad) since the start of the step; the bar's twist (rad) is held.
    """
    (c0, c1, c2), gain, bias, twist = demand
    stroke_command = saturate(bias + gain * (c0 + t * (c1 + t * c2) - state[4]), 1.0)
    derivatives, powers = rates(axle.circuit, axle.stiffness, state, stroke_command, twist)
    return derivatives, powers[:8], powers[8:]


@kernel
def advance(axle, now, later, demand, step: float, count: int) -> float:
    """Advance the circuit of `axle` by `step` s in `count` Runge-Kutta substeps; return the mean bar torque (Nm).

    `now` and `later` are axle states (they may be the same); a demand is that of `axle_rates`.
    """
    state, energies, torques = _through_one(axle, demand, numbers(now.circuit), step, count)
    _write(axle, now, later, state, energies, step)
    return torques[0]


@kernel
def advance_both(p, now, later, demands, step: float, count: int):
    """Advance the circuits of front and rear in lockstep; return their mean bar torques (Nm).

    Two independent chains of arithmetic in one loop take little longer than one, because a processor works on both at
    once; the results are those of `advance`.
    """
    before = numbers(now.front.circuit) + numbers(now.rear.circuit)
    state, energies, torques = _through_both(p, demands, before, step, count)
    _write(p.front, now.front, later.front, state[:6], energies[:10], step)
    _write(p.rear, now.rear, later.rear, state[6:], energies[10:], step)
    return torques


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


@inlined
def _both_rates(p, demands, t, state):
    # twelve states, those of the front first
    front, front_powers, front_torque = axle_rates(p.front, demands[0], t, state[:6])
    rear, rear_powers, rear_torque = axle_rates(p.rear, demands[1], t, state[6:])
    return front + rear, front_powers + rear_powers, front_torque + rear_torque


@inlined
def _settled(axle, state):
    spool, spool_rate, stroke, pressure, angle, rate = state
    return spool, spool_rate, held(axle.circuit.swash_plate, stroke), pressure, angle, rate


@inlined
def _both_settled(p, state):
    return _settled(p.front, state[:6]) + _settled(p.rear, state[6:])


@inlined
def _counted(powers):
    # after the eight powers of `rates` what needs |.|: recovered power and throughput
    shaft, motor = powers[0], powers[7]
    return powers + (max(-shaft, 0.0), abs(shaft) + abs(motor))


@inlined
def _both_counted(powers):
    return _counted(powers[:8]) + _counted(powers[8:])


_through_one = in_substeps(axle_rates, _settled, _counted)
_through_both = in_substeps(_both_rates, _both_settled, _both_counted)


@kernel
def _write(axle, now, later, state, energies, step):
    # the new state and energies into their records
    store(later.circuit, state)
    before, after = now.energy, later.energy
    shaft, loss, pump_leakage, motor_leakage, relief, friction, compliance, motor, recovered, throughput = energies
    after.shaft, after.recovered = before.shaft + shaft, before.recovered + recovered
    after.pump_torque_loss, after.pump_leakage = before.pump_torque_loss + loss, before.pump_leakage + pump_leakage
    after.motor_leakage, after.relief = before.motor_leakage + motor_leakage, before.relief + relief
    after.friction, after.capacitance = before.friction + friction, before.capacitance + compliance
    after.charge = before.charge + step * axle.circuit.charge_power
    after.charge_loss = before.charge_loss + step * axle.circuit.charge_power
    after.motor, after.throughput = before.motor + motor, before.throughput + throughput
