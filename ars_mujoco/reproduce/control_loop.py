"""Claims about the position control of the bar (section 5, Figs. 11 and 14)."""

import math
from functools import partial

import control
import numpy as np

from ars_mujoco.analysis import frequency_response, root_locus, stable_region, steady_state
from ars_mujoco.analysis.frequency_response import linear, measured
from ars_mujoco.analysis.linearization import open_loop, pump_control
from ars_mujoco.analysis.loop import RPM
from ars_mujoco.analysis.margins import margins
from ars_mujoco.analysis.parameter_box import TABLE_2, grid
from ars_mujoco.reproduce.claim import (
    REPRODUCED,
    Finding,
    Group,
    Number,
    agreement,
    does_not_follow,
    holds,
    holds_only,
)
from ars_mujoco.reproduce.evidence import SMALL_STEP, Evidence

BANDWIDTH = stable_region.BANDWIDTH
ERROR = steady_state.PAPER
PRINTED = 0.0055  # an error under this prints as 0.5 %
SMALL, LARGE = 0.5, 5.0  # deg: sines up to the one are small, from the other on large
NEARLY = (0.5, 3.0)  # dB, deg; responses no further apart are nearly equivalent
TO = 20.0  # Hz, up to which they are compared
LOW_DAMPING = 0.2
OVERSHOOT = 0.05
GAINS = (0.5, 1.0, 1.5)  # over the loop's own

GROUP = Group("Position control of the bar (section 5, Figs. 11 and 14)")


@GROUP.claim("Fig. 11", "The hydraulic pole pair has a high frequency and very low damping.")
def hydraulic_pair(evidence: Evidence) -> Finding:
    pair = max(_open_poles(evidence), key=abs)
    damping = -pair.real / abs(pair)
    others = [abs(each) for each in _open_poles(evidence) if abs(each) < 0.999 * abs(pair)]
    return Finding(
        ours=(Number("natural frequency", abs(pair), "rad/s"), Number("damping", damping)),
        verdict=holds(damping < LOW_DAMPING and abs(pair) > 2.0 * max(others), does_not_follow("Table 2's middle")),
        why=f"Open loop with the bar's spring, linearized from the running code; the next pole is at "
        f"{max(others):.0f} rad/s.",
        figure=partial(root_locus.draw, evidence.root_locus),
    )


@GROUP.claim("Fig. 11", "The servo pump's poles have a lower frequency than the hydraulic poles.")
def servo_pump_poles(evidence: Evidence) -> Finding:
    pump = np.abs(pump_control(evidence.loop).poles())
    least = float(evidence.hydraulic_poles["full_box"]["frequency"][0])
    return Finding(
        ours=(
            Number("servo pump", (float(pump.min()), float(pump.max())), "rad/s"),
            Number("hydraulic poles, least of Table 2", least, "rad/s"),
        ),
        verdict=holds(pump.max() < least, does_not_follow("Tables 1 and 2")),
        why="The servo pump's poles beside the lowest hydraulic frequency of Table 2's box.",
    )


@GROUP.claim("section 5", "The hydraulic poles' influence on the speed of response is not significant.")
def hydraulic_influence(evidence: Evidence) -> Finding:
    # without oil that yields or inertia the flow turns the motor, and the spring's pressure leaks
    stiff = control.tf([evidence.K_p * evidence.full_flow / evidence.D], [1.0, evidence.k * evidence.c / evidence.D**2])
    ours, without = (
        margins(each)["bandwidth"]
        for each in (open_loop(evidence.loop), pump_control(evidence.loop) * control.ss(stiff))
    )
    return Finding(
        ours=(Number("bandwidth with them", ours, "Hz"), Number("bandwidth without them", without, "Hz")),
        verdict=agreement(without, ours, holds_only("roughly")),
        why="Closed loop with the running circuit, and with oil and motor taken as stiff and massless.",
    )


@GROUP.claim("section 5", "Increasing the gain increases the speed of response.")
def gain_and_speed(evidence: Evidence) -> Finding:
    found = [margins(share * open_loop(evidence.loop))["bandwidth"] for share in GAINS]
    numbers = tuple(
        Number(f"bandwidth at K_p {share * evidence.K_p:g}", each, "Hz")
        for share, each in zip(GAINS, found, strict=True)
    )
    critical = evidence.root_locus["critical"]["gain"]
    return Finding(
        ours=(*numbers, Number("K_p at which the loop begins to oscillate", critical, "1/rad")),
        verdict=holds(found == sorted(found), does_not_follow("the linear loop")),
        why="Linear closed loop at the pump's own speed.",
    )


@GROUP.claim("section 5", "Settling is without oscillation, with minimum overshoot.")
def overshoot(evidence: Evidence) -> Finding:
    angle = np.degrees(evidence.run(SMALL_STEP)["front.bar.angle"])
    over = float(angle.max() / angle[-1] - 1.0)
    return Finding(
        ours=(Number("overshoot of a step of 1 deg", 100 * over, "%"),),
        verdict=holds(over < OVERSHOOT, does_not_follow(f"K_p = {evidence.K_p:g} 1/rad")),
        why="Running circuit on the bench, with dry friction and every saturation.",
    )


@GROUP.claim("Fig. 14", "For small angles the linear and the nonlinear response are nearly equivalent.")
def small_amplitudes(evidence: Evidence) -> Finding:
    without, with_dry = (_deviation(evidence, name) for name in ("without_dry_friction", "with_dry_friction"))
    nearly = [all(each <= limit for each, limit in zip(found, NEARLY, strict=True)) for found in (without, with_dry)]
    return Finding(
        ours=(
            Number("greatest difference to 20 Hz, without dry friction", without[0], "dB"),
            Number("without dry friction", without[1], "deg"),
            Number("with dry friction", with_dry[0], "dB"),
            Number("with dry friction", with_dry[1], "deg"),
        ),
        verdict=(
            REPRODUCED if all(nearly)
            else holds_only("without dry friction") if nearly[0]
            else does_not_follow("the running equations")
        ),
        why=f"Sines of 0.1 to {SMALL:g} deg on the running circuit. The smaller they are, the more of the torque dry "
        "friction takes; the paper linearizes the viscous part alone.",
        figure=partial(frequency_response.draw, evidence.frequency_response),
    )  # fmt: skip


@GROUP.claim("Fig. 14", "For large angles the system deviates from the linear model.")
def large_amplitudes(evidence: Evidence) -> Finding:
    result = evidence.frequency_response
    rows = [row for row in result["with_dry_friction"] if row["amplitude"] >= LARGE]
    linear_one = margins(open_loop(evidence.loop))["bandwidth"]
    return Finding(
        ours=(
            Number("bandwidth, linear", linear_one, "Hz"),
            *(Number(f"bandwidth at {row['amplitude']:g} deg", row["bandwidth"], "Hz") for row in rows),
        ),
        verdict=holds(all(row["bandwidth"] < 0.5 * linear_one for row in rows), does_not_follow("the pump's flow")),
        why="A sine of this size asks for more flow than the pump has: the response follows at the rate that it gives.",
    )


@GROUP.claim("section 5 (after Darling et al. 1992)", "The system has the bandwidth of 12 Hz that is required.")
def bandwidth_12_hz(evidence: Evidence) -> Finding:
    speeds = TABLE_2["speed"]
    slow, fast = (margins(open_loop(evidence.loop.at({"speed": speed})))["bandwidth"] for speed in speeds)
    own = margins(open_loop(evidence.loop))["bandwidth"]
    largest = _largest_amplitude(evidence)
    everywhere = min(slow, own, fast) >= BANDWIDTH
    return Finding(
        paper=(Number("bandwidth", BANDWIDTH, "Hz"),),
        ours=(
            Number(f"linear, {evidence.speed / RPM:.0f} rpm", own, "Hz"),
            Number("linear, 1500 rpm", slow, "Hz"),
            Number("largest sine that keeps 12 Hz", largest, "deg"),
        ),
        verdict=holds_only(f"up to {largest:.1f} deg at {evidence.speed / RPM:.0f} rpm")
        if own >= BANDWIDTH
        else does_not_follow(f"K_p = {evidence.K_p:g} 1/rad"),
        why="Flow is the limit of larger sines: 57.5 deg/s are an amplitude of "
        f"{57.5 / (2 * math.pi * BANDWIDTH):.2f} deg at 12 Hz. "
        + ("" if everywhere else "At 1500 rpm the same gain does not reach 12 Hz for any amplitude."),
    )


@GROUP.claim("section 5", "The parameter-space method gives one fixed gain that performs at all operating points.")
def one_fixed_gain(evidence: Evidence) -> Finding:
    result = evidence.stable_region
    fixed, scheduled = result["fixed"], result["scheduled"]
    good, needed = min(fixed["gain_margin"], fixed["phase_margin"]), fixed["wanted_bandwidth"]
    with_schedule = min(scheduled["gain_margin"], scheduled["phase_margin"])
    return Finding(
        ours=(
            Number("stable at all corners under K_p", fixed["stable"], "1/rad"),
            Number("6 dB and 45 deg at all corners up to", good, "1/rad"),
            Number("12 Hz at all corners from", needed, "1/rad"),
            Number("with K_p ~ 1/n: 12 Hz from", scheduled["wanted_bandwidth"], "1/rad"),
            Number("and 6 dB and 45 deg up to", with_schedule, "1/rad"),
        ),
        verdict=holds(needed <= good, does_not_follow("Table 2")),
        why="Exact boundary over all corners of Table 2. A gain that is stable everywhere exists, but none with 12 Hz "
        "at 1500 rpm and 6 dB and 45 deg at 6000 rpm. "
        + ("A gain that goes with 1/n can do both." if scheduled["wanted_bandwidth"] <= with_schedule else ""),
        figure=partial(stable_region.draw, result),
    )


@GROUP.claim("sections 5 and 7", "Nonlinear simulation shows a steady-state error of less than 0.5 %.")
def steady_state_error(evidence: Evidence) -> Finding:
    own = evidence.steady_state["own"]["error"]
    run = evidence.s_curve
    command, angle = run["front.bar.command"][-1], run["front.bar.angle"][-1]
    box = [steady_state.error(evidence.loop.at(point)) for point in grid(("leakage", "speed"))]
    if max(box) < PRINTED and own < PRINTED:
        verdict = REPRODUCED
    elif own < PRINTED:
        verdict = holds_only("near the least leakage of Table 2")
    else:
        verdict = does_not_follow(f"a leakage of {evidence.k:g} m^3/s/Pa at {evidence.speed / RPM:.0f} rpm")
    return Finding(
        paper=(Number("error, less than", 100 * ERROR, "%"),),
        ours=(
            Number("linearized, own leakage", 100 * own, "%"),
            Number("simulated, at the end of the S-curve", 100 * float((command - angle) / command), "%"),
            Number("over Table 2's leakage and speed", (100 * min(box), 100 * max(box)), "%"),
        ),
        verdict=verdict,
        why="Holding the bar takes pressure, pressure leaks, and a proportional loop pays the leakage with an error of "
        "a/(a + K_v), a = k c/D^2, K_v = K_p V_p n/D.",
        figure=partial(steady_state.draw, evidence.steady_state),
    )


def _open_poles(evidence: Evidence) -> list[complex]:
    return [complex(*pole) for pole in evidence.root_locus["open_loop"]]


def _deviation(evidence: Evidence, name: str) -> tuple[float, float]:
    """Greatest difference (dB, deg) of the measured small sines from the linear response."""
    result = evidence.frequency_response
    within = np.array(result["frequency"]) <= TO
    rows = [row for row in result[name] if row["amplitude"] <= SMALL]
    return tuple(
        float(max(np.abs(np.subtract(row[quantity], result["linear"][quantity]))[within].max() for row in rows))
        for quantity in ("magnitude", "phase")
    )


def _largest_amplitude(evidence: Evidence) -> float:
    """Amplitude (deg) of the sine whose response falls by 3 dB at 12 Hz, by bisection between 0.5 and 10 deg."""
    at_rest = abs(linear(evidence.loop, np.zeros(1))[0])
    least, most = 0.5, 10.0
    for _ in range(7):
        middle = math.sqrt(least * most)
        held = abs(measured(evidence.loop, math.radians(middle), [BANDWIDTH])[0]) > math.sqrt(0.5) * at_rest
        least, most = (middle, most) if held else (least, middle)
    return math.sqrt(least * most)
