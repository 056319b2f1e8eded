"""The detailed circuit: any stage of pump control before either plant, the reduced one or the full circuit.

The verification set (`third_order_circuit.advance`) takes both as one. Here they are two, each at its own pace: in a
substep the pump control goes first, with the motor's angle and the pump's pressure predicted from their slopes; then
the plant follows by classical Runge-Kutta with the stroke between both ends as a cubic. The prediction is off by h^3
in the angle, so the whole is of third order; by h^2 in the pressure, whose force on the swash plate hardly moves it.
"""

from typing import ClassVar

import numpy as np

from ars_mujoco.actuators.pump_controlled.full_plant import (
    ANGLE,
    BAR_TORQUE,
    BYPASS_LOSS,
    CAPACITANCE,
    CHARGE,
    CHARGE_LOSS,
    CHECK,
    FRICTION,
    LINE,
    MOTOR,
    MOTOR_LEAKAGE,
    POWERS,
    PUMP_LEAKAGE,
    RATE,
    RELIEF,
    SHAFT,
    STATES,
    TANK_LEAKAGE,
    TORQUE_LOSS,
    A,
    B,
    full_rates,
    rest,
)
from ars_mujoco.actuators.pump_controlled.pump_control import FULL, advance_pump_control, control_power, stroke_speed
from ars_mujoco.actuators.pump_controlled.third_order_circuit import CircuitEnergy, plant_rates
from ars_mujoco.hydraulics.bypass_valve import BypassValve
from ars_mujoco.hydraulics.charge_pump import ChargePump
from ars_mujoco.hydraulics.check_valve import CheckValve
from ars_mujoco.hydraulics.fail_safe_valve import FailSafeValve
from ars_mujoco.hydraulics.oil import Fluid
from ars_mujoco.hydraulics.pipe import Pipe
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.channels import counted, lost
from ars_mujoco.schema.parameters import Parameters, number, quantity

REDUCED_PLANT, FULL_PLANT = 0.0, 1.0


class Detail(Parameters):
    """What a detailed circuit has beside the components of a reduced one; blocks that are not in use stay zero."""

    stage: float = number()  # of the pump control: THIRD_ORDER, REDUCED or FULL
    plant: float = number()  # REDUCED_PLANT or FULL_PLANT
    fluid: Fluid
    pipe: Pipe
    charge_pump: ChargePump
    check_valve: CheckValve
    bypass_valve: BypassValve
    fail_safe_valve: FailSafeValve
    tank_leakage: float = quantity("m^3/s/Pa", ge=0)  # of one side to the tank


class FullCircuitEnergy(CircuitEnergy):
    """Energies of one axle since the start; what the reduced plant does not have stays zero."""

    line: float = lost("lost to the flow through the lines and the fail-safe valve")
    check: float = lost("lost over the check valves")
    bypass: float = lost("lost over the bypass valve")
    tank_leakage: float = lost("lost to leakage to the tank")
    charge_pump: float = counted("of charge, work of the shaft on the charge pump")


class DetailState(Parameters):
    """Its state: chamber pressures (Pa) and piston speed (m/s) of the pump control, and the plant's STATES."""

    RECORD: ClassVar[np.dtype] = np.dtype(
        [("p_a", "f8"), ("p_b", "f8"), ("piston_rate", "f8"), ("plant", "f8", STATES)]
    )


WORK = np.dtype(
    [
        ("state", "f8", STATES),
        ("trial", "f8", STATES),
        ("slopes", "f8", (4, STATES)),
        ("powers", "f8", (4, POWERS)),
        ("sums", "f8", POWERS),
    ]
)


def start_detailed(axle, state) -> None:
    """Fill the axle state `state` with the circuit at rest and charged, the cylinder's chambers halfway to supply."""
    if axle.detail.stage == FULL:
        edge = axle.circuit.metering_edge
        state.detail.p_a = state.detail.p_b = 0.5 * (edge.supply_pressure + edge.return_pressure)
    start_plant(axle, state.detail.plant)


def start_plant(axle, x: np.ndarray) -> None:
    """Fill the STATES `x` with those at rest; the reduced plant's are all zero."""
    if axle.detail.plant == FULL_PLANT:
        rest(axle.circuit, axle.detail, x)


@kernel
def control_state(now):
    """The state of the pump control as `pump_control.advance_pump_control` takes it."""
    circuit, detail = now.circuit, now.detail
    return circuit.spool, circuit.spool_rate, detail.p_a, detail.p_b, circuit.stroke, detail.piston_rate


@kernel
def drawn_by_control(axle, state) -> float:
    """Power (W) drawn from the control supply, besides CHARGE; the reduced plant's constant has it already."""
    return control_power(axle.circuit, axle.detail, state) if axle.detail.plant == FULL_PLANT else 0.0


@kernel
def detailed_rates(axle, x, dx, power, stroke, twist, valves) -> None:
    """Derivatives and powers of the plant, see `full_circuit.full_rates`; the reduced one's pressure is state A."""
    if axle.detail.plant == FULL_PLANT:
        full_rates(axle.circuit, axle.detail, axle.stiffness, x, dx, power, stroke, twist, valves[0], valves[1])
        return
    rates, powers = plant_rates(axle.circuit, axle.stiffness, stroke, x[A], x[ANGLE], x[RATE], twist)
    dx[:], power[:] = 0.0, 0.0
    dx[A], dx[ANGLE], dx[RATE] = rates
    for i in range(len(powers)):
        power[i] = powers[i]
    power[CHARGE] = power[CHARGE_LOSS] = axle.circuit.charge_power


@kernel
def advance_detailed(axle, now, later, demand, valves, step: float, work) -> float:
    """Advance the circuit of `axle` by `step` s; return the mean bar torque (Nm).

    `now` and `later` are axle states; `demand` is (command, gain, bias, twist) as in `third_order_circuit.axle_rates`,
    `valves` the commanded openings (bypass, fail-safe), `work` a WORK record.
    """
    circuit, detail, count = axle.circuit, axle.detail, int(axle.substeps)
    (c0, c1, c2), gain, bias, twist = demand
    x, k, powers, sums, h = work.state, work.slopes, work.powers, work.sums, step / count
    x[:], sums[:] = now.detail.plant, 0.0
    recovered = throughput = supplied = 0.0
    state = control_state(now)
    for i in range(count):
        t = i * h
        detailed_rates(axle, x, k[0], powers[0], state[4], twist, valves)
        asked = bias + gain * (c0 + t * (c1 + t * c2) - x[ANGLE])
        e = t + h
        ahead = x[ANGLE] + h * (k[0, ANGLE] + 0.5 * h * k[0, RATE])
        asked_rate = gain * (c1 + 2.0 * t * c2 - k[0, ANGLE]) if abs(asked) < 1.0 else 0.0
        command = saturate(asked, 1.0), saturate(bias + gain * (c0 + e * (c1 + e * c2) - ahead), 1.0), asked_rate
        p, p_rate = x[A] - x[B], k[0, A] - k[0, B]
        end = advance_pump_control(circuit, detail, state, command, (p, p + h * p_rate, p_rate), h)
        bend = 0.125 * h * (stroke_speed(circuit, detail, state) - stroke_speed(circuit, detail, end))
        middle = 0.5 * (state[4] + end[4]) + bend
        _along(work.trial, x, k[0], 0.5 * h)
        detailed_rates(axle, work.trial, k[1], powers[1], middle, twist, valves)
        _along(work.trial, x, k[1], 0.5 * h)
        detailed_rates(axle, work.trial, k[2], powers[2], middle, twist, valves)
        _along(work.trial, x, k[2], h)
        detailed_rates(axle, work.trial, k[3], powers[3], end[4], twist, valves)
        for j in range(STATES):
            x[j] += h / 6.0 * (k[0, j] + 2.0 * (k[1, j] + k[2, j]) + k[3, j])
        shaft, motor = sums[SHAFT], sums[MOTOR]
        for j in range(POWERS):
            sums[j] += 1.0 / 6.0 * (powers[0, j] + 2.0 * (powers[1, j] + powers[2, j]) + powers[3, j])
        shaft, motor = sums[SHAFT] - shaft, sums[MOTOR] - motor
        recovered += max(-shaft, 0.0)
        throughput += abs(shaft) + abs(motor)
        supplied += 0.5 * (drawn_by_control(axle, state) + drawn_by_control(axle, end))
        state = end
    _write(axle, now, later, state, x, sums, (recovered, throughput, supplied), h)
    return sums[BAR_TORQUE] / count


@kernel
def advance_apart(p, now, later, front_demand, rear_demand, valves, step: float, work):
    """Advance the circuits of both axles one after the other; return their bar torques (front, rear) in Nm.

    An axle without substeps has no circuit.
    """
    front = advance_detailed(p.front, now.front, later.front, front_demand, valves[0], step, work)
    rear = 0.0
    if p.rear.substeps > 0.0:
        rear = advance_detailed(p.rear, now.rear, later.rear, rear_demand, valves[1], step, work)
    return front, rear


@kernel
def shaft_work(axle) -> float:
    """Work (J) of the shaft on an axle's pump and on a full circuit's charge pump."""
    return axle.energy.shaft + axle.energy.charge_pump


@kernel
def _along(trial, x, slope, h):
    for j in range(STATES):
        trial[j] = x[j] + h * slope[j]


@kernel
def _write(axle, now, later, state, x, sums, others, h):
    # the new states and energies; what a controller senses stands where the reduced circuit has it
    circuit, detail = later.circuit, later.detail
    circuit.spool, circuit.spool_rate, detail.p_a, detail.p_b, circuit.stroke, detail.piston_rate = state
    detail.plant[:] = x
    end = int(axle.detail.pipe.lumps)
    circuit.pressure, circuit.angle, circuit.rate = x[A + end] - x[B + end], x[ANGLE], x[RATE]
    before, after, (recovered, throughput, supplied) = now.energy, later.energy, others
    after.shaft, after.recovered = before.shaft + h * sums[SHAFT], before.recovered + h * recovered
    after.pump_torque_loss = before.pump_torque_loss + h * sums[TORQUE_LOSS]
    after.pump_leakage = before.pump_leakage + h * sums[PUMP_LEAKAGE]
    after.motor_leakage = before.motor_leakage + h * sums[MOTOR_LEAKAGE]
    after.relief, after.friction = before.relief + h * sums[RELIEF], before.friction + h * sums[FRICTION]
    after.capacitance, after.line = before.capacitance + h * sums[CAPACITANCE], before.line + h * sums[LINE]
    after.check, after.bypass = before.check + h * sums[CHECK], before.bypass + h * sums[BYPASS_LOSS]
    after.tank_leakage = before.tank_leakage + h * sums[TANK_LEAKAGE]
    after.charge = before.charge + h * (sums[CHARGE] + supplied)
    after.charge_loss = before.charge_loss + h * (sums[CHARGE_LOSS] + supplied)
    if axle.detail.plant == FULL_PLANT:
        after.charge_pump = before.charge_pump + h * sums[CHARGE]
    after.motor, after.throughput = before.motor + h * sums[MOTOR], before.throughput + h * throughput
