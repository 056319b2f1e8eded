"""Claims about the equations as they are printed: each beside its right form, the difference as a number."""

import math

import control
import numpy as np

from ars_mujoco.hydraulics.control_cylinder import chamber_volumes, common_capacitance
from ars_mujoco.hydraulics.line import capacitance
from ars_mujoco.hydraulics.metering_edge import common_flow, edge_flow_a, edge_flow_b
from ars_mujoco.reproduce.claim import (
    CONTRADICTS_ITSELF,
    ROUNDING,
    Finding,
    Group,
    Number,
    Verdict,
    agreement,
    apart,
    does_not_follow,
    holds,
)
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.sizing import BAR, MAX_ANGLE, MAX_PRESSURE, corner_frequency
from ars_mujoco.schema.units import measure

EQUAL = 1e-9  # relative; two forms of one equation agree to this
CONSERVED = 1e-4  # of the oil, by the trapezoidal rule
LOAD = 10.0 * BAR  # Pa, across the control cylinder
UNITS = {  # nomenclature's unit of a symbol, and the one that its equation or table needs
    "c_stabi": ("N/m", "Nm/rad"),
    "C_H": ("m/N", "m^3/Pa"),
    "r_v": ("Nm/deg", "Nms/rad"),
    "K_oil": ("N/m^2", "Pa"),
    "k_Li": ("m^3/s/Pa", "m^3/s/Pa"),
    "C_y": ("m^2/s", "m^2/s"),
    "B^2, text below eq. 10": ("m*s^2/kg", "m^5/kg"),
}

GROUP = Group("Equations as printed")


@GROUP.claim("eqs. 3 to 6", "The chambers' pressures and volumes both follow from the piston's position.")
def chamber_equations(evidence: Evidence) -> Finding:
    cylinder = evidence.cylinder
    travel = np.linspace(0.0, float(cylinder.travel), 2001)
    grows, shrinks = np.transpose([chamber_volumes(cylinder, x) for x in travel.tolist()])
    printed, right = (_oil_left(volume, float(cylinder.area) * travel) for volume in (shrinks, grows))
    return Finding(
        ours=(
            Number("oil left in closed chamber A after a full stroke, as printed", 100 * printed, "%"),
            Number("with V_A and V_B exchanged", 100 * right, "%"),
        ),
        verdict=holds(abs(printed - 1.0) < CONSERVED, CONTRADICTS_ITSELF),
        why="Eq. 3 lets chamber A grow with x, so that its pressure falls; eq. 5 lets it shrink. Eqs. 5 and 6 are "
        "exchanged.",
    )


@GROUP.claim(
    "eqs. 4 and 13", "Chamber B's pressure builds up with Q_B - A_AC x' (eq. 4), and with Q_B + A_AC x' (eq. 13)."
)
def chamber_b(evidence: Evidence) -> Finding:
    cylinder, (a, b) = evidence.cylinder, chamber_volumes(evidence.cylinder, 0.0)
    stiffness = float(evidence.fluid.bulk_modulus * cylinder.area**2)
    right, printed = (stiffness / a + sign * stiffness / b for sign in (1.0, -1.0))
    return Finding(
        ours=(
            Number("spring of the oil in the closed cylinder, eq. 13", right / 1e6, "kN/mm"),
            Number("the same with eq. 4", printed / 1e6, "kN/mm"),
        ),
        verdict=_same(right, printed, CONTRADICTS_ITSELF),
        why="With eq. 4 both pressures fall together: no pressure difference, no spring, no eigenfrequency. Eq. 13 is "
        "right.",
    )


@GROUP.claim("eq. 8", "The common capacitance of both chambers is V_0/2 plus (A_AC x)^2/(2 V_0), over K_oil.")
def cylinder_capacitance(evidence: Evidence) -> Finding:
    cylinder, fluid, travel = evidence.cylinder, evidence.fluid, float(evidence.cylinder.travel)
    middle, end = (common_capacitance(cylinder, fluid, x, MAX_PRESSURE) for x in (0.0, travel))
    share = float(cylinder.area * travel / chamber_volumes(cylinder, 0.0)[0])
    return _series(share, float(end / middle), "at full stroke", "")


@GROUP.claim("eq. 32", "The common capacitance of the motor's chambers and lines grows with the angle.")
def motor_capacitance(evidence: Evidence) -> Finding:
    line, motor = evidence.loop.circuit.line, evidence.loop.circuit.motor
    middle, end = (capacitance(line, motor, angle, MAX_PRESSURE) for angle in (0.0, evidence.phi_n))
    share = evidence.D * evidence.phi_n / (evidence.V_L + evidence.D * evidence.phi_n)
    return _series(share, float(end / middle), "at the stop", " The second line's outer inverse is a slip, too.")


@GROUP.claim("eq. 11", "The valve's flow is B y sqrt(|p_S - dp|/2) sign(p_S - dp sign(y)).")
def valve_flow(evidence: Evidence) -> Finding:
    edge, supply, tank = evidence.edge, float(evidence.edge.supply_pressure), float(evidence.edge.return_pressure)
    # y < 0 under a load: A drains, B is fed, both by half of what the supply has beside the load
    drained, _, _ = edge_flow_a(edge, -1.0, tank + 0.5 * (supply - tank + LOAD))
    running, _, _ = common_flow(edge, -1.0, LOAD)
    printed = -common_flow(edge, 1.0, LOAD)[0]  # the size of |p_S - dp|
    leakage = float(edge.leakage) * LOAD
    return Finding(
        ours=(
            Number("flow as printed over that of eq. 9, y < 0 and dp = 10 bar", float(printed / (drained + leakage))),
            Number("with |p_S - dp sign(y)|", float(running / (drained + leakage))),
        ),
        verdict=holds(apart(running, printed) < ROUNDING, does_not_follow("eqs. 9 and 10")),
        why="The root lacks the sign(y) that the last factor has, so a load that helps the piston back slows it down "
        "instead. Eq. 16 lacks it as well.",
    )


@GROUP.claim("eqs. 11 and 14", "Q_A = Q_B (eq. 11) and Q_A = -Q_B (eq. 14).")
def valve_flow_signs(evidence: Evidence) -> Finding:
    middle = 0.5 * float(evidence.edge.supply_pressure + evidence.edge.return_pressure)
    (a, _, _), (b, _, _) = edge_flow_a(evidence.edge, 0.5, middle), edge_flow_b(evidence.edge, 0.5, middle)
    return Finding(
        ours=(
            Number("flow left in the cylinder over Q_A, Q_B counted as in eqs. 10 and 11", float((a - b) / a)),
            Number("counted as in eq. 14", float((a + b) / a)),
        ),
        verdict=holds(abs(a - b) <= EQUAL * abs(a), CONTRADICTS_ITSELF),
        why="Both hold only without any flow. Eqs. 3, 4, 12 and 13 count flows into the chambers, and then eq. 14 is "
        "right; eqs. 10 and 11 count Q_B outwards.",
    )


@GROUP.claim("eq. 17", "The state vector of eq. 16 is [x, x, x'].")
def state_vector(evidence: Evidence) -> Finding:
    printed, right = ("x", "x", "x'"), ("dp", "x", "x'")
    return Finding(
        ours=(
            Number("different states as printed", len(set(printed))),
            Number("states of eq. 16", len(set(right))),
        ),
        verdict=holds(len(set(printed)) == len(set(right)), CONTRADICTS_ITSELF),
        why="Eq. 16's first state is the pressure difference: [dp, x, x'].",
    )


@GROUP.claim(
    "eqs. 19 and 20", "The servo valve is a second-order lag; eq. 20 prints s^2/omega where eq. 19 has s^2/omega^2."
)
def servo_pump_lag(evidence: Evidence) -> Finding:
    valve = evidence.loop.circuit.servo_valve
    frequency, damping = float(valve.frequency), float(valve.damping)
    right, printed = (
        corner_frequency(control.tf([1.0], [square, 2.0 * damping / frequency, 1.0]))
        for square in (frequency**-2, 1.0 / frequency)
    )
    return Finding(
        ours=(Number("-3 dB by eq. 19", right, "rad/s"), Number("-3 dB by eq. 20", printed, "rad/s")),
        verdict=_same(right, printed, CONTRADICTS_ITSELF),
        why="Eq. 20's denominator has terms of different dimension; the omega is squared.",
    )


@GROUP.claim("eqs. 21 and 22", "Losses are a polynomial in V^i/V_norm, n^j/n_norm and dp^k/p_norm.")
def loss_polynomial(evidence: Evidence) -> Finding:
    loss = evidence.inputs.actuator.value.front.pump.torque_loss
    point = 2.0 * math.pi * evidence.full_flow / evidence.speed, loss.normal_speed, loss.normal_pressure
    right = sum(loss.terms.values())
    printed, other = (
        sum(k * math.prod(n**i / n for n, i in zip(of, term, strict=True)) for term, k in loss.terms.items())
        for of in (point, (*point[:2], point[2] / BAR))
    )
    return Finding(
        ours=(
            Number("loss at nominal over its normal value, (V/V_norm)^i and so on", right),
            Number("as printed, SI", printed),
            Number("as printed, pressure in bar", other),
        ),
        verdict=_same(printed, other, CONTRADICTS_ITSELF),
        why="As printed the value depends on the units that are put in, and a power of zero leaves 1/V_norm. The "
        "powers belong around the quotients.",
    )


@GROUP.claim("eq. 26", "The bar's twist is arcsin((x_l - x_r)/l_stabi).")
def bar_twist(evidence: Evidence) -> Finding:
    arm = evidence.inputs.vehicle.value.arm
    travel = arm * math.sin(math.radians(MAX_ANGLE))
    two_arms = math.degrees(2.0 * math.asin(0.5 * travel / arm))
    return Finding(
        paper=(Number("twist", MAX_ANGLE, "deg"),),
        ours=(Number("travel", 1e3 * travel, "mm"), Number("twist of a bar with two arms", two_arms, "deg")),
        verdict=agreement(MAX_ANGLE, two_arms, does_not_follow("a bar with two arms")),
        why="The printed form is that of one arm that takes all of the travel; of two arms each takes half. The bench "
        "uses the paper's, the cars their arms' own angles.",
    )


@GROUP.claim("nomenclature", "The symbols have the units of the nomenclature.")
def units(evidence: Evidence) -> Finding:
    wrong = [name for name, (printed, needed) in UNITS.items() if measure(printed)[1] != measure(needed)[1]]
    told = "; ".join(f"{name} is in {UNITS[name][1]}, not {UNITS[name][0]}" for name in wrong)
    return Finding(
        ours=(Number("symbols looked at", len(UNITS)), Number("with another dimension than they need", len(wrong))),
        verdict=holds(not wrong, CONTRADICTS_ITSELF),
        why=f"Dimensions compared with the equations and Tables 1 and 2, in which angle counts: {told}.",
    )


def _oil_left(volume: np.ndarray, swept: np.ndarray) -> float:
    """Share of its oil that a closed chamber holds at the end, by eq. 3 over a piston's way of (n,) m^3 `swept`."""
    density = np.exp(-np.trapezoid(1.0 / volume, swept))  # dp/K = -A dx/V
    return float(density * volume[-1] / volume[0])


def _series(share: float, exact: float, where: str, remark: str) -> Finding:
    printed = 1.0 + share**2
    return Finding(
        ours=(
            Number(f"second line as printed over the first, {where}", printed / exact),
            Number("with a minus", (1.0 - share**2) / exact),
        ),
        verdict=_same(exact, printed, does_not_follow("the equation's own first line")),
        why=f"The series of V_0 + a and V_0 - a is V_0/2 minus a^2/(2 V_0): the capacitance falls away from the middle."
        f"{remark}",
    )


def _same(right: float, printed: float, otherwise: Verdict) -> Verdict:
    return holds(abs(printed - right) <= EQUAL * abs(right), otherwise)
