"""One axle's stabilizer: what stands between the two arms, from no bar at all to the pump-controlled motor.

Signs: twist = left arm's angle less the right's (each positive in jounce); positive bar angle and torque push the body
to negative roll, so the torque acts +M on the left half and -M on the right half.

The circuit is integrated over the coming step with the twist held, and its mean bar torque acts on the car over that
same step. The work of a step on the car is torque times the mean of the twist rates at its two ends, so it is known
only at the next call.
"""

from ars_mujoco.channels import Signal
from ars_mujoco.hydraulics.pump import extrapolation
from ars_mujoco.hydraulics.reduced_circuit import (
    CircuitEnergy,
    CircuitState,
    ReducedCircuit,
    advance,
    advance_both,
    rates,
    read,
    stored_energy,
)
from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Number, Parameters, Quantity

NO_BAR, TORSION_BAR, PUMP_CONTROLLED = 0.0, 1.0, 2.0


class Axle(Parameters):
    """Parameters of one axle's stabilizer."""

    kind: Number()  # NO_BAR, TORSION_BAR (passive, or the active bar locked) or PUMP_CONTROLLED
    stiffness: Quantity("Nm/rad", ge=0)  # torsion of the bar, both halves in series
    substeps: Number(ge=0)  # of the circuit in a physics step
    circuit: ReducedCircuit


class AxleState(Parameters):
    """State of one axle's stabilizer."""

    circuit: CircuitState
    energy: CircuitEnergy
    torque: Signal("Nm", "mean bar torque over the last step")
    twist_rate: Signal("rad/s", "rate of the twist at the start of the last step")
    work: Signal("J", "work of the bar on the car up to the start of the last step")


class BarOutput(Parameters):
    angle: Signal("rad", "angle of the motor between the bar's halves")
    command: Signal("rad", "commanded angle")
    twist: Signal("rad", "angle of the left arm less that of the right, positive with the left wheel in jounce")
    torque: Signal("Nm", "torque of the bar, positive pushes the body to negative roll; mean over the coming step")


class MotorOutput(Parameters):
    pressure: Signal("Pa", "pressure difference across the motor")
    rate: Signal("rad/s", "rate of the motor angle")
    output_power: Signal("W", "power of the motor on the bar")
    leakage_power: Signal("W", "lost to leakage in the motor")
    friction_power: Signal("W", "lost to friction in the motor")


class PumpOutput(Parameters):
    stroke: Signal("1", "stroke of the swash plate, fraction of full")
    flow: Signal("m^3/s", "flow of the pump without its leakage")
    shaft_power: Signal("W", "power taken from the shaft, negative where it is given back")
    loss_power: Signal("W", "lost to the pump's torque loss")
    leakage_power: Signal("W", "lost to leakage in the pump, its flow loss")
    extrapolation: Signal("1", "how far the pump is outside the range of its losses, as a share of the range's end")


class ReliefOutput(Parameters):
    power: Signal("W", "lost over the relief valve")


class EnergyOutput(CircuitEnergy):
    work: Signal("J", "work of the bar on the car")
    oil: Signal("J", "stored in the oil's compression")
    bar: Signal("J", "stored in the bar's torsion and the motor's mechanical stop")
    inertia: Signal("J", "stored in the motor's inertia")


class AxleOutput(Parameters):
    """What one axle's stabilizer records."""

    bar: BarOutput
    motor: MotorOutput
    pump: PumpOutput
    relief: ReliefOutput
    energy: EnergyOutput


@kernel
def stabilize(p, now, later, front_out, rear_out, front_twist, rear_twist, front_demand, rear_demand, step):
    """Advance both axles by `step` s and return their bar torques (front, rear) in Nm over that step.

    `p`, `now`, `later` are records with a `front` and a `rear` of Axle and AxleState, the outs are AxleOutput records.
    Twists are (now rad, rate now rad/s, held over the step rad); a demand is (command, gain, stroke_bias), as in
    `reduced_circuit.advance`.
    """
    if p.front.kind == PUMP_CONTROLLED and p.rear.kind == PUMP_CONTROLLED:
        front_torque, rear_torque = advance_both(
            p.front.circuit, p.rear.circuit, p.front.stiffness, p.rear.stiffness,
            now.front.circuit, now.rear.circuit, later.front.circuit, later.rear.circuit,
            now.front.energy, now.rear.energy, later.front.energy, later.rear.energy,
            (*front_demand, front_twist[2]), (*rear_demand, rear_twist[2]),
            step, int(max(p.front.substeps, p.rear.substeps)),
        )  # fmt: skip
    else:
        front_torque = _alone(p.front, now.front, later.front, front_twist[2], front_demand, step)
        rear_torque = _alone(p.rear, now.rear, later.rear, rear_twist[2], rear_demand, step)
    _finish(p.front, now.front, later.front, front_out, front_twist, front_demand, front_torque, step)
    _finish(p.rear, now.rear, later.rear, rear_out, rear_twist, rear_demand, rear_torque, step)
    return front_torque, rear_torque


@kernel
def _alone(axle, now, later, twist, demand, step):
    # bar torque of an axle whose neighbour is of another kind
    if axle.kind == PUMP_CONTROLLED:
        command, gain, stroke_bias = demand
        return advance(
            axle.circuit, axle.stiffness, now.circuit, later.circuit, now.energy, later.energy,
            command, gain, stroke_bias, twist, step, int(axle.substeps),
        )  # fmt: skip
    return -axle.stiffness * twist


@kernel
def _finish(axle, now, later, out, twisted, demand, torque, step):
    # the work of the step before is known now; the outputs are those of the state now
    twist, twist_rate, _ = twisted
    work = now.work + now.torque * step * 0.5 * (now.twist_rate + twist_rate)
    out.energy.work = work
    out.bar.twist, out.bar.torque = twist, torque
    if axle.kind == PUMP_CONTROLLED:
        out.bar.command = demand[0][0]
        _report(axle, now, out, twist)
    else:
        out.energy.bar = 0.5 * axle.stiffness * twist * twist
    later.work, later.torque, later.twist_rate = work, torque, twist_rate


@kernel
def _report(axle, now, out, twist):
    circuit = axle.circuit
    state = now.circuit
    _, powers = rates(circuit, axle.stiffness, read(state), 0.0, twist)
    shaft, loss, pump_leakage, motor_leakage, relief, friction, _, motor, _ = powers
    out.bar.angle = state.angle
    out.motor.pressure, out.motor.rate = state.pressure, state.rate
    out.motor.output_power, out.motor.friction_power = motor, friction
    out.motor.leakage_power = motor_leakage
    out.pump.stroke = state.stroke
    out.pump.flow = circuit.pump.displacement * circuit.pump.speed * min(max(state.stroke, -1.0), 1.0)
    out.pump.shaft_power, out.pump.loss_power = shaft, loss
    out.pump.leakage_power = pump_leakage
    out.pump.extrapolation = extrapolation(circuit.pump, state.stroke, state.pressure)
    out.relief.power = relief
    energy = now.energy
    out.energy.shaft, out.energy.recovered = energy.shaft, energy.recovered
    out.energy.pump_torque_loss, out.energy.pump_leakage = energy.pump_torque_loss, energy.pump_leakage
    out.energy.motor_leakage, out.energy.relief = energy.motor_leakage, energy.relief
    out.energy.friction, out.energy.capacitance = energy.friction, energy.capacitance
    out.energy.charge, out.energy.motor, out.energy.throughput = energy.charge, energy.motor, energy.throughput
    oil, torsion, inertia, stop = stored_energy(circuit, axle.stiffness, state, twist)
    out.energy.oil, out.energy.bar, out.energy.inertia = oil, torsion + stop, inertia
