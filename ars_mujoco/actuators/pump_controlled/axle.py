"""One axle's stabilizer: what stands between the two arms, from no bar at all to the pump-controlled motor.

Signs: twist = left arm's angle less the right's (each positive in jounce); positive bar angle and torque push the body
to negative roll, so the torque acts +M on the left half and -M on the right half.

The circuit is integrated over the coming step with the twist held, and its mean bar torque acts on the car over that
same step. The work of a step on the car is torque times the mean of the twist rates at its two ends, so it is known
only at the next call.
"""

from ars_mujoco.actuators.pump_controlled.full_circuit import (
    FULL_PLANT,
    Detail,
    DetailState,
    advance_detailed,
    control_state,
    detailed_rates,
    drawn_by_control,
)
from ars_mujoco.actuators.pump_controlled.full_plant import (
    BYPASS,
    CHARGE,
    FAIL_SAFE,
    FRICTION,
    GALLERY,
    MOTOR,
    MOTOR_LEAKAGE,
    PUMP_LEAKAGE,
    RELIEF,
    SHAFT,
    TORQUE_LOSS,
    A,
    B,
    stored_energies,
)
from ars_mujoco.actuators.pump_controlled.third_order_circuit import (
    CircuitEnergy,
    CircuitState,
    ReducedCircuit,
    advance,
    advance_both,
    rates,
    read,
    stored_energy,
)
from ars_mujoco.hydraulics.pump import extrapolation, ideal_flow
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.channels import channel, done, stored
from ars_mujoco.schema.parameters import Parameters, number, quantity

NO_BAR, TORSION_BAR, PUMP_CONTROLLED, DETAILED = 0.0, 1.0, 2.0, 3.0


class Axle(Parameters):
    """Parameters of one axle's stabilizer."""

    kind: float = (
        number()
    )  # NO_BAR, TORSION_BAR (passive, or the active bar locked), PUMP_CONTROLLED (the verification set)
    # or DETAILED (any other stage of pump control, or the full circuit)
    stiffness: float = quantity("Nm/rad", ge=0)  # torsion of the bar, both halves in series
    substeps: float = number(ge=0)  # of the circuit in a physics step
    circuit: ReducedCircuit
    detail: Detail


class AxleState(Parameters):
    """State of one axle's stabilizer."""

    circuit: CircuitState
    detail: DetailState
    energy: CircuitEnergy
    torque: float = channel("Nm", "mean bar torque over the last step")
    twist_rate: float = channel("rad/s", "rate of the twist at the start of the last step")
    work: float = channel("J", "work of the bar on the car up to the start of the last step")


class BarOutput(Parameters):
    angle: float = channel("rad", "angle of the motor between the bar's halves")
    command: float = channel("rad", "commanded angle")
    twist: float = channel(
        "rad", "angle of the left arm less that of the right, positive with the left wheel in jounce"
    )
    torque: float = channel(
        "Nm", "torque of the bar, positive pushes the body to negative roll; mean over the coming step"
    )


class MotorOutput(Parameters):
    pressure: float = channel("Pa", "pressure difference across the motor")
    pressure_a: float = channel("Pa", "absolute pressure in the chamber that drives to positive angle (full circuit)")
    pressure_b: float = channel("Pa", "absolute pressure in the other chamber (full circuit)")
    rate: float = channel("rad/s", "rate of the motor angle")
    output_power: float = channel("W", "power of the motor on the bar")
    leakage_power: float = channel("W", "lost to leakage in the motor")
    friction_power: float = channel("W", "lost to friction in the motor")


class PumpOutput(Parameters):
    speed: float = channel("rad/s", "speed of the shaft")
    stroke: float = channel("1", "stroke of the swash plate, fraction of full")
    control_pressure: float = channel(
        "Pa", "pressure difference across the control cylinder (where pump control has one)"
    )
    pressure_a: float = channel("Pa", "absolute pressure at the pump's port to side A (full circuit)")
    pressure_b: float = channel("Pa", "absolute pressure at its port to side B (full circuit)")
    flow: float = channel("m^3/s", "flow of the pump without its leakage")
    shaft_power: float = channel("W", "power taken from the shaft, negative where it is given back")
    loss_power: float = channel("W", "lost to the pump's torque loss")
    leakage_power: float = channel("W", "lost to leakage in the pump, its flow loss")
    extrapolation: float = channel(
        "1", "how far the pump is outside the range of its losses, as a share of the range's end"
    )


class ReliefOutput(Parameters):
    power: float = channel("W", "lost over the relief valve")


class ChargeOutput(Parameters):
    pressure: float = channel("Pa", "absolute pressure of the charge gallery (full circuit)")
    power: float = channel("W", "power drawn by charge and control supply")


class ValveOutput(Parameters):
    bypass: float = channel("1", "opening of the bypass valve (full circuit)")
    fail_safe: float = channel("1", "opening of the fail-safe valve (full circuit)")


class EnergyOutput(CircuitEnergy):
    work: float = done("work of the bar on the car")
    oil: float = stored("stored in the oil's compression")
    bar: float = stored("stored in the bar's torsion and the motor's mechanical stop")
    inertia: float = stored("stored in the motor's inertia")
    oil_motion: float = stored("stored in the moving oil of the lines")


class AxleOutput(Parameters):
    """What one axle's stabilizer records."""

    bar: BarOutput
    motor: MotorOutput
    pump: PumpOutput
    relief: ReliefOutput
    charge: ChargeOutput
    valve: ValveOutput
    energy: EnergyOutput


@kernel
def stabilize(
    p, now, later, front_out, rear_out, front_twist, rear_twist, front_demand, rear_demand, valves, step, work
):
    """Advance both axles by `step` s and return their bar torques (front, rear) in Nm over that step.

    `p`, `now`, `later` are records with a `front` and a `rear` of Axle and AxleState, the outs are AxleOutput records.
    Twists are (now rad, rate now rad/s, held over the step rad); a demand is (command, gain, stroke_bias), as in
    `reduced_circuit.advance`; `valves` are the commanded openings (bypass, fail-safe) of front and rear; `work` is a
    WORK record of the detailed circuit.
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
        front_torque = _alone(p.front, now.front, later.front, front_twist[2], front_demand, valves[0], step, work)
        rear_torque = _alone(p.rear, now.rear, later.rear, rear_twist[2], rear_demand, valves[1], step, work)
    _finish(p.front, now.front, later.front, front_out, front_twist, front_demand, front_torque, step, work)
    _finish(p.rear, now.rear, later.rear, rear_out, rear_twist, rear_demand, rear_torque, step, work)
    return front_torque, rear_torque


@kernel
def _alone(axle, now, later, twist, demand, valves, step, work):
    # bar torque of an axle that does not go in lockstep with its neighbour
    command, gain, stroke_bias = demand
    if axle.kind == PUMP_CONTROLLED:
        return advance(
            axle.circuit, axle.stiffness, now.circuit, later.circuit, now.energy, later.energy,
            command, gain, stroke_bias, twist, step, int(axle.substeps),
        )  # fmt: skip
    if axle.kind == DETAILED:
        return advance_detailed(axle, now, later, (command, gain, stroke_bias, twist), valves, step, work)
    return -axle.stiffness * twist


@kernel
def _finish(axle, now, later, out, twisted, demand, torque, step, work):
    # the work of the step before is known now; the outputs are those of the state now
    twist, twist_rate, _ = twisted
    done = now.work + now.torque * step * 0.5 * (now.twist_rate + twist_rate)
    out.energy.work = done
    out.bar.twist, out.bar.torque = twist, torque
    if axle.kind >= PUMP_CONTROLLED:
        out.bar.command = demand[0][0]
        if axle.kind == PUMP_CONTROLLED:
            _report_reduced(axle, now, out, twist)
        else:
            _report_detailed(axle, now, out, twist, work)
        _report_circuit(axle.circuit, now, out)
    else:
        out.energy.bar = 0.5 * axle.stiffness * twist * twist
    later.work, later.torque, later.twist_rate = done, torque, twist_rate


@kernel
def _report_circuit(circuit, now, out):
    state, energy = now.circuit, now.energy
    out.bar.angle = state.angle
    out.motor.pressure, out.motor.rate = state.pressure, state.rate
    out.pump.speed, out.pump.stroke = circuit.pump.speed, state.stroke
    out.pump.flow = ideal_flow(circuit.pump, state.stroke)
    out.energy.shaft, out.energy.recovered = energy.shaft, energy.recovered
    out.energy.pump_torque_loss, out.energy.pump_leakage = energy.pump_torque_loss, energy.pump_leakage
    out.energy.motor_leakage, out.energy.relief = energy.motor_leakage, energy.relief
    out.energy.friction, out.energy.capacitance = energy.friction, energy.capacitance
    out.energy.line, out.energy.check, out.energy.bypass = energy.line, energy.check, energy.bypass
    out.energy.tank_leakage = energy.tank_leakage
    out.energy.charge, out.energy.charge_pump = energy.charge, energy.charge_pump
    out.energy.charge_loss = energy.charge_loss
    out.energy.motor, out.energy.throughput = energy.motor, energy.throughput


@kernel
def _report_reduced(axle, now, out, twist):
    circuit, state = axle.circuit, now.circuit
    _, powers = rates(circuit, axle.stiffness, read(state), 0.0, twist)
    shaft, loss, pump_leakage, motor_leakage, relief, friction, _, motor, _ = powers
    out.motor.output_power, out.motor.friction_power, out.motor.leakage_power = motor, friction, motor_leakage
    out.pump.shaft_power, out.pump.loss_power, out.pump.leakage_power = shaft, loss, pump_leakage
    out.pump.extrapolation = extrapolation(circuit.pump, state.stroke, state.pressure)
    out.relief.power, out.charge.power = relief, circuit.charge_power
    oil, torsion, inertia, stop = stored_energy(circuit, axle.stiffness, state, twist)
    out.energy.oil, out.energy.bar, out.energy.inertia = oil, torsion + stop, inertia


@kernel
def _report_detailed(axle, now, out, twist, work):
    circuit, detail, x, power = axle.circuit, axle.detail, now.detail.plant, work.powers[0]
    detailed_rates(axle, x, work.slopes[0], power, now.circuit.stroke, twist, (x[BYPASS], x[FAIL_SAFE]))
    out.motor.output_power, out.motor.friction_power = power[MOTOR], power[FRICTION]
    out.motor.leakage_power, out.pump.leakage_power = power[MOTOR_LEAKAGE], power[PUMP_LEAKAGE]
    out.pump.shaft_power, out.pump.loss_power, out.relief.power = power[SHAFT], power[TORQUE_LOSS], power[RELIEF]
    out.charge.power = power[CHARGE] + drawn_by_control(axle, control_state(now))
    out.pump.extrapolation = extrapolation(circuit.pump, now.circuit.stroke, x[A] - x[B])
    out.pump.control_pressure = now.detail.p_a - now.detail.p_b
    if detail.plant != FULL_PLANT:
        oil, torsion, inertia, stop = stored_energy(circuit, axle.stiffness, now.circuit, twist)
        out.energy.oil, out.energy.bar, out.energy.inertia = oil, torsion + stop, inertia
        return
    lumps = int(detail.pipe.lumps)
    out.motor.pressure_a, out.motor.pressure_b = x[A + lumps], x[B + lumps]
    out.pump.pressure_a, out.pump.pressure_b = x[A], x[B]
    out.charge.pressure, out.valve.bypass, out.valve.fail_safe = x[GALLERY], x[BYPASS], x[FAIL_SAFE]
    oil, torsion, inertia, stop, moving = stored_energies(circuit, detail, axle.stiffness, x, twist)
    out.energy.oil, out.energy.bar, out.energy.inertia = oil, torsion + stop, inertia
    out.energy.oil_motion = moving
