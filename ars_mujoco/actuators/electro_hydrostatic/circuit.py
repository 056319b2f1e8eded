"""The circuit of one axle: a pump that turns either way, two lines, a vane motor, and a cushion of gas on the low side.

          ┌── line A ──[fail-safe]── chamber A ┐           pump_a  motor_a
    pump ─┤   relief                  bypass │ ├─ motor ─> bar          (phi, w)
          └── line B ──[fail-safe]── chamber B ┘           pump_b  motor_b
                     check valves on both chambers, fed by the accumulator, which takes what the reliefs let go

Pressures are absolute. Positive speed of the pump delivers into side A, which drives the motor to positive phi. With
J of rotor and pump, Theta of the motor, D_p and D of their displacements:

    J w_m' = T - D_p dp - T_loss,   C p_a' = D_p w_m - k dp - D w + ...,   Theta w' = D dp - c (phi - psi) - M_F

Each side has twice C_H. The pump moves oil from one side to the other, so that both change and the difference feels
them in series: C_H. Only while a check valve holds the low side does the difference feel one side alone, 2 C_H. All
leakage runs from side to side, in pump and motor (the paper's k_Li), so no oil is ever lost: what the accumulator once
gave, as the low side was drawn down, stays in the lines and keeps their mean at half the highest pressure.

Where the file has no fail-safe valve, a line and its chamber are one and their two pressures run alike. All elasticity
is linear, C_H being the paper's for oil under pressure: neither the swept volume nor air at 5 bar makes a side softer.
"""

from ars_mujoco.hydraulics.accumulator import Accumulator, accumulator_energy, accumulator_rate
from ars_mujoco.hydraulics.bypass_valve import BypassValve, bypass_flow
from ars_mujoco.hydraulics.check_valve import CheckValve, check_flow
from ars_mujoco.hydraulics.fail_safe_valve import FailSafeValve, fail_safe_flow
from ars_mujoco.hydraulics.fixed_pump import FixedPump, loss_torque
from ars_mujoco.hydraulics.relief_valve import ReliefValve, one_way_relief
from ars_mujoco.hydraulics.valve_opening import opening_rate
from ars_mujoco.hydraulics.vane_motor import VaneMotor, friction_torque, stop_torque
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class Lines(Parameters):
    """Both lines and the motor's chambers at their ends."""

    capacitance: float = quantity("m^3/Pa", gt=0)  # C_H, of both sides in series
    chamber_share: float = number(gt=0, lt=1)  # of a side's oil, between fail-safe valve and motor


class Circuit(Parameters):
    """Components of one axle's circuit; the two valves are options."""

    pump: FixedPump
    rotor_inertia: float = quantity("kg*m^2", gt=0)  # J, electric machine and pump
    lines: Lines
    relief_valve: ReliefValve
    check_valve: CheckValve
    accumulator: Accumulator
    motor: VaneMotor
    bypass_valve: BypassValve | None = None  # joins the chambers; shut without current
    fail_safe_valve: FailSafeValve | None = None  # one in each line, moved together; shut without current


@kernel
def circuit_rates(circuit, bar_stiffness, twist, torque, valves, state):
    """Derivatives of (pump_a, pump_b, motor_a, motor_b, accumulator, bypass, fail_safe, speed, angle, rate), the powers
    (W) of pump torque loss, pump leakage, motor leakage, relief, check, valves, friction and the motor on the bar, and
    the bar torque (Nm).

    `torque` (Nm) turns the pump, `valves` are the commanded openings (bypass, fail-safe), 0 shut and 1 open.
    """
    pump_a, pump_b, motor_a, motor_b, low, bypass, fail_safe, speed, angle, rate = state
    pump, motor = circuit.pump, circuit.motor
    over_pump, over_motor = pump_a - pump_b, motor_a - motor_b
    pump_leak, motor_leak = pump.leakage * over_pump, motor.leakage * over_motor
    relief_a = one_way_relief(circuit.relief_valve, pump_a - low)
    relief_b = one_way_relief(circuit.relief_valve, pump_b - low)
    check_a, check_b = check_flow(circuit.check_valve, low, motor_a), check_flow(circuit.check_valve, low, motor_b)
    bypassed, bypass_rate = _bypass(circuit.bypass_valve, bypass, valves[0], over_motor)

    delivered = pump.displacement * speed - pump_leak
    taken = motor.displacement * rate + motor_leak + bypassed
    line_a, line_b = delivered - relief_a, -delivered - relief_b
    chamber_a, chamber_b = check_a - taken, check_b + taken
    drops = (pump_a - motor_a, pump_b - motor_b)
    pressure_rates, valve_power = _compress(circuit, fail_safe, drops, (line_a, line_b, chamber_a, chamber_b))
    low_rate = accumulator_rate(circuit.accumulator, low, relief_a + relief_b - check_a - check_b)

    loss, friction = loss_torque(pump, speed, over_pump), friction_torque(motor, rate)
    bar_torque = bar_stiffness * (angle - twist)
    turning = motor.displacement * over_motor - bar_torque - stop_torque(motor, angle) - friction
    derivatives = (
        *pressure_rates,
        low_rate,
        bypass_rate,
        _fail_safe_rate(circuit.fail_safe_valve, fail_safe, valves[1]),
        1.0 / circuit.rotor_inertia * (torque - pump.displacement * over_pump - loss),
        rate,
        1.0 / motor.inertia * turning,
    )
    powers = (
        loss * speed,
        pump_leak * over_pump,
        motor_leak * over_motor,
        relief_a * (pump_a - low) + relief_b * (pump_b - low),
        check_a * (low - motor_a) + check_b * (low - motor_b),
        valve_power + bypassed * over_motor,
        friction * rate,
        bar_torque * rate,
    )
    return derivatives, powers, bar_torque


@kernel
def stored_energies(circuit, bar_stiffness, twist, state):
    """Energy (J) now stored over that at rest in (oil, accumulator, rotor, bar with the motor's stop, motor)."""
    pump_a, pump_b, motor_a, motor_b, low, _, _, speed, angle, rate = state
    rest, side, share = circuit.accumulator.pressure, 2.0 * circuit.lines.capacitance, circuit.lines.chamber_share
    lines, chambers = (pump_a - rest) ** 2 + (pump_b - rest) ** 2, (motor_a - rest) ** 2 + (motor_b - rest) ** 2
    beyond = max(abs(angle) - circuit.motor.stop_angle, 0.0)
    return (
        0.5 * side * ((1.0 - share) * lines + share * chambers),
        accumulator_energy(circuit.accumulator, low),
        0.5 * circuit.rotor_inertia * speed * speed,
        0.5 * bar_stiffness * (angle - twist) ** 2 + 0.5 * circuit.motor.stop_stiffness * beyond * beyond,
        0.5 * circuit.motor.inertia * rate * rate,
    )


@kernel
def _compress(circuit, opening, drops, flows):
    # rates of the four pressures under the flows into lines and chambers; and the power lost in the fail-safe valves,
    # under the pressure drops from lines to chambers
    (drop_a, drop_b), (line_a, line_b, chamber_a, chamber_b) = drops, flows
    valve, side = circuit.fail_safe_valve, 2.0 * circuit.lines.capacitance
    if valve.flow > 0.0:
        flow_a, flow_b = fail_safe_flow(valve, opening, drop_a), fail_safe_flow(valve, opening, drop_b)
        chamber = circuit.lines.chamber_share * side
        line = side - chamber
        rates = (
            (line_a - flow_a) / line,
            (line_b - flow_b) / line,
            (chamber_a + flow_a) / chamber,
            (chamber_b + flow_b) / chamber,
        )
        return rates, flow_a * drop_a + flow_b * drop_b
    rate_a, rate_b = 1.0 / side * (line_a + chamber_a), 1.0 / side * (line_b + chamber_b)
    return (rate_a, rate_b, rate_a, rate_b), 0.0


@kernel
def _bypass(valve, opening, command, difference):
    # flow from chamber A to chamber B, and the rate of the opening; neither where there is no such valve
    if valve.flow > 0.0:
        return bypass_flow(valve, opening, difference), opening_rate(valve, opening, command)
    return 0.0, 0.0


@kernel
def _fail_safe_rate(valve, opening, command):
    return opening_rate(valve, opening, command) if valve.flow > 0.0 else 0.0
