"""One axle: its motor between the direction valve's two ports, and the bar that it twists.

    node ──[P A]──┬─ chamber A ─┐         [P A], [P B], [A T], [B T] are edges of the direction valve, at the front
    return ─[A T]─┘             ├─ motor ─> bar        with an edge of the fail-safe valve in series
    node ──[P B]──┬─ chamber B ─┘
    return ─[B T]─┘             check valves let both chambers draw from the reservoir

    C p_a' = q_pa - q_at + q_check - k dp - D w,    Theta w' = D dp - c (phi - psi) - M_F

All pressures are over the reservoir's. A chamber has the hose to it in its capacitance.
"""

import math
from collections import namedtuple
from typing import Any

from ars_mujoco.hydraulics.check_valve import CheckValve, check_flow
from ars_mujoco.hydraulics.direction_valve import A, B, pressure_opening, return_opening
from ars_mujoco.hydraulics.orifice import in_series, rounded_root
from ars_mujoco.hydraulics.vane_motor import VaneMotor, friction_torque, stop_torque
from ars_mujoco.kernels.kernel import inlined, kernel
from ars_mujoco.schema.channels import channel, counted, drawn, lost
from ars_mujoco.schema.parameters import Parameters, quantity

ROUNDING = 1e5  # Pa, below which the edges flow laminar
RESERVOIR = 0.0  # Pa
NOTHING_BEFORE = 1.0  # m^3/s/Pa^0.5, wider than any valve


class Axle(Parameters):
    """What a user writes of one axle."""

    node_capacitance: float = quantity("m^3/Pa", gt=0)  # of the oil between pressure valves and direction valve
    chamber_capacitance: float = quantity("m^3/Pa", gt=0)  # of the oil in one chamber and its hose
    check_valve: CheckValve
    motor: VaneMotor


class AxleState(Parameters):
    """State of one axle."""

    chamber_a: float = channel("Pa", "pressure in chamber A over the reservoir's, drives to positive angle", scale=1e2)
    chamber_b: float = channel("Pa", "pressure in chamber B over the reservoir's", scale=1e2)
    angle: float = channel("rad", "angle of the motor between the bar's halves", scale=1e-6)
    rate: float = channel("rad/s", "its rate", scale=1e-6)


class AxleEnergy(Parameters):
    """Energies of one axle since the start, in the order of the powers of `axle_rates`."""

    oil_supply: float = drawn("drawn with the oil from the valve block, less what was given to the return line")
    edges: float = lost("lost in the edges of direction and fail-safe valve")
    check: float = lost("lost over the check valves")
    leakage: float = lost("lost to leakage in the motor")
    friction: float = lost("lost to friction in the motor")
    motor: float = counted("work of the motor on the bar")


# Q/sqrt(dp) of the ways from the node to both chambers, and from them to the return line
Ports = namedtuple("Ports", "into_a into_b out_a out_b")
# m^3/s taken from the node, and given to the return line
Exchange = namedtuple("Exchange", "taken returned")


@kernel
def ports(direction: Any, spool: float, before: float) -> Ports:
    """The ways through the direction valve; `before` is Q/sqrt(dp) of what stands between it and the motor, if any."""
    return Ports(
        _edge(direction, pressure_opening(direction, spool, A), before),
        _edge(direction, pressure_opening(direction, spool, B), before),
        _edge(direction, return_opening(direction, spool, A), before),
        _edge(direction, return_opening(direction, spool, B), before),
    )


@inlined
def axle_rates(p, pressures, twist, ways, state):
    """Derivatives of AxleState, powers (W) as AxleEnergy lists them, the bar's torque (Nm), and the Exchange.

    `p` has the Axle and the bar's torsion as `stiffness` (Nm/rad); `pressures` (Pa) are those of node and return line.
    """
    (node, outlet), (chamber_a, chamber_b, angle, rate), motor = pressures, state, p.axle.motor
    into_a, into_b = _flow(ways.into_a, node - chamber_a), _flow(ways.into_b, node - chamber_b)
    out_a, out_b = _flow(ways.out_a, chamber_a - outlet), _flow(ways.out_b, chamber_b - outlet)
    check_a = check_flow(p.axle.check_valve, RESERVOIR, chamber_a)
    check_b = check_flow(p.axle.check_valve, RESERVOIR, chamber_b)
    difference = chamber_a - chamber_b
    swept, leak = motor.displacement * rate, motor.leakage * difference
    friction, bar = friction_torque(motor, rate), p.stiffness * (angle - twist)
    taken, returned = into_a + into_b, out_a + out_b
    derivatives = (
        (into_a - out_a + check_a - leak - swept) / p.axle.chamber_capacitance,
        (into_b - out_b + check_b + leak + swept) / p.axle.chamber_capacitance,
        rate,
        (motor.displacement * difference - bar - stop_torque(motor, angle) - friction) / motor.inertia,
    )
    powers = (
        node * taken - outlet * returned,
        into_a * (node - chamber_a) + into_b * (node - chamber_b)
        + out_a * (chamber_a - outlet) + out_b * (chamber_b - outlet),
        -check_a * chamber_a - check_b * chamber_b,
        leak * difference,
        friction * rate,
        bar * rate,
    )  # fmt: skip
    return derivatives, powers, bar, Exchange(taken, returned)


@kernel
def axle_stored(p, twist, state):
    """Energy (J) stored in (oil, bar with the motor's stop, motor's inertia)."""
    beyond = max(abs(state.angle) - p.axle.motor.stop_angle, 0.0)
    return (
        0.5 * p.axle.chamber_capacitance * (state.chamber_a**2 + state.chamber_b**2),
        0.5 * p.stiffness * (state.angle - twist) ** 2 + 0.5 * p.axle.motor.stop_stiffness * beyond * beyond,
        0.5 * p.axle.motor.inertia * state.rate**2,
    )


@kernel
def _edge(direction, opening, before):
    edge = opening * direction.flow / math.sqrt(direction.pressure)
    return in_series(edge, before) if before < NOTHING_BEFORE else edge


@kernel
def _flow(way, difference):
    # most ways are shut
    return way * rounded_root(difference, ROUNDING) if way > 0.0 else 0.0
