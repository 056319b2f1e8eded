"""Report: from the state of one axle's circuit now to what it records."""

from ars_mujoco.actuators.pump_controlled.full_circuit import control_state, detailed_rates, drawn_by_control
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
from ars_mujoco.actuators.pump_controlled.third_order_circuit import rates, stored_energy
from ars_mujoco.hydraulics.pump import extrapolation, ideal_flow
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import numbers, share


@kernel
def report_third_order(axle, now, out, twist, work) -> None:
    """What the verification set records, at a twist (rad) of the bar."""
    circuit, state = axle.circuit, now.circuit
    _, powers = rates(circuit, axle.stiffness, numbers(state), 0.0, twist)
    shaft, loss, pump_leakage, motor_leakage, relief, friction, _, motor, _ = powers
    out.motor.output_power, out.motor.friction_power, out.motor.leakage_power = motor, friction, motor_leakage
    out.pump.shaft_power, out.pump.loss_power, out.pump.leakage_power = shaft, loss, pump_leakage
    out.pump.extrapolation = extrapolation(circuit.pump, state.stroke, state.pressure)
    out.relief.power, out.charge.power = relief, circuit.charge_power
    _report_storage(axle, state, out, twist)
    _report_circuit(circuit, now, out)


@kernel
def report_cylinder(axle, now, out, twist, work) -> None:
    """What a reduced plant records whose pump control has a cylinder."""
    _report_detailed(axle, now, out, twist, work)
    _report_storage(axle, now.circuit, out, twist)


@kernel
def report_full(axle, now, out, twist, work) -> None:
    """What the full circuit records."""
    _report_detailed(axle, now, out, twist, work)
    circuit, detail, x = axle.circuit, axle.detail, now.detail.plant
    lumps = int(detail.pipe.lumps)
    out.motor.pressure_a, out.motor.pressure_b = x[A + lumps], x[B + lumps]
    out.pump.pressure_a, out.pump.pressure_b = x[A], x[B]
    out.charge.pressure, out.valve.bypass, out.valve.fail_safe = x[GALLERY], x[BYPASS], x[FAIL_SAFE]
    oil, torsion, inertia, stop, moving = stored_energies(circuit, detail, axle.stiffness, x, twist)
    out.energy.oil, out.energy.bar, out.energy.inertia = oil, torsion + stop, inertia
    out.energy.oil_motion = moving


@kernel
def _report_detailed(axle, now, out, twist, work):
    circuit, x, power = axle.circuit, now.detail.plant, work.powers[0]
    detailed_rates(axle, x, work.slopes[0], power, now.circuit.stroke, twist, (x[BYPASS], x[FAIL_SAFE]))
    out.motor.output_power, out.motor.friction_power = power[MOTOR], power[FRICTION]
    out.motor.leakage_power, out.pump.leakage_power = power[MOTOR_LEAKAGE], power[PUMP_LEAKAGE]
    out.pump.shaft_power, out.pump.loss_power, out.relief.power = power[SHAFT], power[TORQUE_LOSS], power[RELIEF]
    out.charge.power = power[CHARGE] + drawn_by_control(axle, control_state(now))
    out.pump.extrapolation = extrapolation(circuit.pump, now.circuit.stroke, x[A] - x[B])
    out.pump.control_pressure = now.detail.p_a - now.detail.p_b
    _report_circuit(circuit, now, out)


@kernel
def _report_circuit(circuit, now, out):
    state = now.circuit
    out.bar.angle = state.angle
    out.motor.pressure, out.motor.rate = state.pressure, state.rate
    out.pump.speed, out.pump.stroke = circuit.pump.speed, state.stroke
    out.pump.flow = ideal_flow(circuit.pump, state.stroke)
    share(out.energy, now.energy)


@kernel
def _report_storage(axle, state, out, twist):
    oil, torsion, inertia, stop = stored_energy(axle.circuit, axle.stiffness, state, twist)
    out.energy.oil, out.energy.bar, out.energy.inertia = oil, torsion + stop, inertia
