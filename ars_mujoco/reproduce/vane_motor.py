"""Claims about the vane motor, its friction and the main circuit (section 4.2)."""

import math

import numpy as np

from ars_mujoco.analysis.hydraulic_poles import pole_pair
from ars_mujoco.analysis.parameter_box import TABLE_2
from ars_mujoco.hydraulics.vane_motor import friction_torque
from ars_mujoco.reproduce.claim import (
    CONTRADICTS_ITSELF,
    ROUNDING,
    Finding,
    Group,
    Number,
    apart,
    does_not_follow,
    holds,
    holds_only,
)
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.sizing import MAX_PRESSURE, MAX_RATE

LOSSES = (0.02, 0.05)  # of the theoretical torque, section 4.2
MINOR = 1.5  # factor; what changes by less is minor
STATIC = {"coulomb_friction": 20.0, "static_friction": 15.0, "static_decay": 20.0}  # Nm, Nm, s/rad: stated values

GROUP = Group("Vane motor and main circuit (section 4.2)")


@GROUP.claim("section 4.2", "Torque losses between 2 and 5 % of the motor's torque have a minor effect on damping.")
def friction_and_damping(evidence: Evidence) -> Finding:
    frictions = tuple(share * evidence.D * MAX_PRESSURE / math.radians(MAX_RATE) for share in LOSSES)
    least, most = (pole_pair(evidence.loop.at({"viscous_friction": each}))[1] for each in frictions)
    table = tuple(pole_pair(evidence.loop.at({"viscous_friction": each}))[1] for each in TABLE_2["viscous_friction"])
    return Finding(
        paper=(Number("torque losses", (2.0, 5.0), "%"),),
        ours=(
            Number("viscous friction that takes them at 57.5 deg/s", frictions, "Nms/rad"),
            Number("damping with it", (least, most)),
            Number("damping over Table 2's r_v", table),
        ),
        verdict=holds(most / least < MINOR, CONTRADICTS_ITSELF),
        why=f"As viscous friction, which alone is linear, they make the damping {most / least:.1f} times as large; "
        "section 5 and Table 3 say themselves that the torque losses are of the greatest influence. Table 2's r_v is "
        f"{_share(evidence, 0):.1f} to {_share(evidence, 1):.1f} % of the torque at that rate, less than section "
        "4.2's. Coulomb friction has no part in the linear damping.",
    )


@GROUP.claim("section 4.2.1", "For the damping of the open loop, the leakage of motor and pump is very important.")
def leakage_and_damping(evidence: Evidence) -> Finding:
    spread = {
        name: tuple(pole_pair(evidence.loop.at({name: value}))[1] for value in TABLE_2[name])
        for name in ("leakage", "viscous_friction")
    }
    leakage, friction = (ends[1] / ends[0] for ends in spread.values())
    share = evidence.k / evidence.C / (evidence.k / evidence.C + evidence.r_v / evidence.theta)
    return Finding(
        ours=(
            Number("damping over Table 2's leakage", spread["leakage"]),
            Number("damping over Table 2's friction", spread["viscous_friction"]),
            Number("leakage's share of the damping, nominal", 100 * share, "%"),
        ),
        verdict=holds(leakage > MINOR and leakage > 0.5 * friction, does_not_follow("Table 2")),
        why=f"Over Table 2 the leakage changes the damping by a factor of {leakage:.2f}, the friction by "
        f"{friction:.2f}: (k/C_H + r_v/Theta)/(2 omega_H) is mostly friction.",
    )


@GROUP.claim("eq. 28", "Coulomb, viscous and static friction together model the motor's friction.")
def stick_slip(evidence: Evidence) -> Finding:
    circuit = evidence.loop.circuit.copy()
    for name, value in STATIC.items():
        circuit.motor[name] = value
    rates = np.geomspace(0.05, 2.0, 400)  # rad/s, past the rounding of the friction's sign
    slopes = np.array([_slope(circuit.motor, rate) for rate in rates.tolist()])
    growing = rates[slopes / evidence.theta + evidence.k / evidence.C < 0.0]
    limit = evidence.r_v + evidence.k * evidence.theta / evidence.C
    printed = STATIC["static_friction"] * STATIC["static_decay"]
    until = float(growing.max()) if growing.size else 0.0
    return Finding(
        ours=(
            Number("r_H tau_H of the stated values", printed, "Nms/rad"),
            Number("what damps, r_v + k Theta/C_H", limit, "Nms/rad"),
            Number("undamped up to a rate of", math.degrees(until), "deg/s"),
        ),
        verdict=holds(not growing.size, holds_only("where r_H tau_H exp(-tau_H |w|) < r_v + k Theta/C_H")),
        why="Where friction falls with speed faster than all else damps, the motor sticks and slips, and the pressure "
        f"at a time has no limit under refinement of the step. With r_H = {STATIC['static_friction']:g} Nm and tau_H = "
        f"{STATIC['static_decay']:g} s/rad, trace(A) of eq. 43 with the running friction's slope is positive up to "
        f"{math.degrees(until):.1f} deg/s (closed form: {math.degrees(_crossing(printed, limit)):.1f}). The paper "
        "gives no coefficients; runs here use r_H = 0.",
    )


@GROUP.claim(
    "section 4.2, eqs. 29 and 32", "The low-pressure side stays constant, and both sides' capacitances are in series."
)
def one_sided_capacitance(evidence: Evidence) -> Finding:
    series, one_sided = (pole_pair(evidence.loop.at({"capacitance": n * evidence.C}))[0] for n in (1.0, 2.0))
    return Finding(
        ours=(
            Number("omega_H, both sides in series", series, "rad/s"),
            Number("omega_H, high-pressure side alone", one_sided, "rad/s"),
        ),
        verdict=holds(apart(series, one_sided) <= ROUNDING, CONTRADICTS_ITSELF),
        why="Where the low pressure is held, only the high-pressure side's oil yields: V_A/K, which is twice the "
        f"series form of eq. 32 in the middle, and {100 * (1 - one_sided / series):.0f} % off the eigenfrequency.",
    )


def _slope(motor, rate: float) -> float:
    nudge = 1e-5 * rate
    return (friction_torque(motor, rate + nudge) - friction_torque(motor, rate - nudge)) / (2.0 * nudge)


def _crossing(printed: float, limit: float) -> float:
    """Rate (rad/s) at which r_H tau_H exp(-tau_H w) has fallen to `limit`."""
    return max(math.log(printed / limit), 0.0) / STATIC["static_decay"]


def _share(evidence: Evidence, end: int) -> float:
    """Torque of Table 2's least or greatest r_v at 57.5 deg/s, % of that at 180 bar."""
    return 100.0 * TABLE_2["viscous_friction"][end] * math.radians(MAX_RATE) / (evidence.D * MAX_PRESSURE)
