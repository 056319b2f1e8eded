"""Stable region of the gain over all of Table 2, by the parameter-space method (Ackermann; paper section 5).

With G the open loop over its gain, the closed loop has roots on the imaginary axis where K = -1/G(jw) is real: at the
imaginary zeros of G(s) - G(-s), found as eigenvalues, so that the boundary is exact and nothing is sampled. Turned by
an angle, K = -e^(j theta)/G(jw), the same gives the gains at which the phase margin is theta; the gain margin shifts
the boundary by its factor. Both bound the region of good damping (Gamma).
"""

import cmath
import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import control
import numpy as np
import scipy.linalg
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DARK, DASHES, LIGHT, MIDDLE_GREY, SHADES, label
from ars_mujoco.analysis.linearization import actuator
from ars_mujoco.analysis.loop import RPM, Loop
from ars_mujoco.analysis.margins import SCHEDULES, WANTED
from ars_mujoco.analysis.parameter_box import MIDDLE, PLANT, TABLE_2, Point, grid

BANDWIDTH = 12.0  # Hz, which the paper asks for (Darling et al. 1992)
SPEEDS = np.linspace(*TABLE_2["speed"], 25)  # rad/s
SHARES = np.linspace(0.0, 1.0, 13)  # of a parameter's range
BOUNDS = ("stable", "gain_margin", "phase_margin", "wanted_bandwidth")
UNITS = {"speed": "rad/s", "leakage": "m^3/s/Pa", "capacitance": "m^3/Pa", "inertia": "kg m^2",
         "viscous_friction": "Nms/rad", "stable_frequency": "rad/s", **dict.fromkeys(BOUNDS, "1/rad")}  # fmt: skip


def boundary(system: control.StateSpace, angle: float = 0.0) -> list[tuple[float, float]]:
    """(gain, frequency rad/s) of the positive gains at which K times `system` passes through -e^(j `angle`), rising.

    With an angle of zero the closed loop then has roots on the imaginary axis.
    """
    A, B, C, pace = _balanced(system)
    turn, n = cmath.exp(-1j * angle), len(A)
    # turn G(s) - conj(turn) G(-s)
    pencil = np.block(
        [[A, np.zeros((n, n)), B], [np.zeros((n, n)), -A, B], [turn * C, turn.conjugate() * C, np.zeros((1, 1))]]
    )
    zeros = scipy.linalg.eig(pencil, np.diag([1.0] * (2 * n) + [0.0]), right=False)
    zeros = zeros[np.isfinite(zeros)]
    frequencies = pace * zeros.imag[(np.abs(zeros.real) < 1e-6 * np.abs(zeros)) & (zeros.imag > 1e-9)]
    gains = [-1.0 / (turn * complex(system(1j * w))) for w in frequencies.tolist()]
    crossings = [(k.real, w) for k, w in zip(gains, frequencies.tolist(), strict=True) if abs(k.imag) < 1e-6 * k.real]
    return sorted(crossings)


def critical_gain(loop: Loop) -> float:
    """The K_p (1/rad, at the pump's speed) at which the loop begins to oscillate by itself."""
    return boundary(_system(loop))[0][0]


def gain_for_bandwidth(system: control.StateSpace, frequency: float) -> float:
    """Least gain at which the closed loop's -3 dB point is at `frequency` (Hz): a quadratic equation in the gain."""
    p, softness = complex(system(2j * math.pi * frequency)), 1.0 / float(control.dcgain(system))  # 0 without a spring
    size = abs(p) ** 2
    # 2 |K p / (1 + K p)|^2 = (K / (K + softness))^2
    square, line, constant = size, 4.0 * size * softness - 2.0 * p.real, 2.0 * size * softness**2 - 1.0
    return float(np.roots([square, line, constant]).real.max())


def bounds(loop: Loop) -> dict[str, float]:
    """Greatest K_p (1/rad, at the pump's speed) that is `stable`, keeps 6 dB of `gain_margin`, 45 deg of
    `phase_margin`, and the least one that reaches the `wanted_bandwidth`; `stable_frequency` (rad/s) is that of the
    oscillation at the stability boundary.
    """
    system = _system(loop)
    critical, frequency = boundary(system)[0]
    return {
        "stable": critical,
        "stable_frequency": frequency,
        "gain_margin": critical * 10.0 ** (-WANTED["gain_margin"] / 20.0),
        "phase_margin": boundary(system, math.radians(WANTED["phase_margin"]))[0][0],
        "wanted_bandwidth": gain_for_bandwidth(system, BANDWIDTH),
    }


def compute(loop: Loop) -> dict[str, Any]:
    """Bounds at every corner of Table 2, over the speed for each corner of the rest, and what holds everywhere.

    The gain is that at the gain's own speed; `fixed` is the same at all speeds, `scheduled` goes with 1/n.
    """
    corners = [{"corner": point, **bounds(loop.at(point))} for point in grid(tuple(TABLE_2))]
    barless = replace(loop, stiffness=0.0)
    return {
        "units": UNITS,
        "wanted": {"gain_margin": "6 dB", "phase_margin": "45 deg", "wanted_bandwidth": f"{BANDWIDTH:g} Hz"},
        "corners": corners,
        "without_bar": {"stable": min(critical_gain(barless.at(point)) for point in grid(tuple(TABLE_2)))},
        "speed": SPEEDS.tolist(),
        "over_speed": [{"corner": point, **_over_speed(loop.at(point))} for point in grid(PLANT)],
        "share": SHARES.tolist(),
        "over_each": {
            name: [critical_gain(loop.at(MIDDLE | _at(name, share))) for share in SHARES] for name in TABLE_2
        },
        **{
            name: _everywhere(_in_own_gain(loop, each, schedule) for each in corners)
            for name, schedule in SCHEDULES.items()
        },
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: the gain's limits over all corners, fixed and scheduled."""
    rows = []
    for name in SCHEDULES:
        found = result[name]
        good = min(found["gain_margin"], found["phase_margin"])
        rows += [
            {"quantity": f"K_p {name}: stable at all corners", "value": f"under {found['stable']:.1f} 1/rad"},
            {"quantity": f"K_p {name}: 6 dB and 45 deg at all corners", "value": f"up to {good:.1f} 1/rad"},
            {"quantity": f"K_p {name}: 12 Hz at all corners", "value": f"from {found['wanted_bandwidth']:.1f} 1/rad"},
        ]
    rows.append({"quantity": "K_p fixed, without the bar: stable at all corners",
                 "value": f"under {result['without_bar']['stable']:.1f} 1/rad"})  # fmt: skip
    return rows


def draw(result: dict[str, Any]) -> Figure:
    """The plane of speed and gain with the boundaries of every corner and their envelopes; what each parameter does."""
    figure = Figure(figsize=(11.0, 5.0), layout="constrained")
    ax, beside = figure.subplots(1, 2, width_ratios=(3, 2), sharey=True)
    speeds = np.array(result["speed"]) / RPM
    rows = result["over_speed"]
    for row in rows:
        ax.plot(speeds, row["stable"], color=LIGHT, lw=0.6)
    stable, gain, phase, wanted = (np.array([row[name] for row in rows]) for name in BOUNDS)
    ax.plot([], [], color=LIGHT, lw=0.6, label="stability boundary at each corner of Table 2")
    good = np.minimum(gain, phase).min(axis=0)
    ax.plot(speeds, stable.min(axis=0), color=DARK, lw=1.8, label="below: stable at all corners")
    ax.plot(speeds, good, DASHES[1], color=DARK, lw=1.5, label="below: 6 dB and 45 deg at all corners")
    enough = wanted.max(axis=0)
    ax.plot(speeds, enough, DASHES[2], color=MIDDLE_GREY, lw=1.5, label=f"above: {BANDWIDTH:g} Hz at all corners")
    ax.fill_between(speeds, enough, good, where=good > enough, color=LIGHT, alpha=0.3, lw=0)
    ax.axhline(good.min(), color=ACCENT, lw=1.0, ls=":", label=f"fixed K_p {good.min():.0f}: 6 dB, 45 deg everywhere")
    ax.set_ylim(0.0, 400.0)
    label(ax, "Gain of the bar-angle loop over all of Table 2", "pump speed (rpm)", "K_p (1/rad)")
    for (name, gains), shade, marker in zip(result["over_each"].items(), SHADES, "os^vD", strict=True):
        text = f"{name.replace('_', ' ')}: {min(gains):.0f} to {max(gains):.0f}"
        beside.plot(100.0 * np.array(result["share"]), gains, color=shade, lw=1.2, marker=marker, ms=3, label=text)
    title = "Stability boundary, one parameter off the middle"
    label(beside, title, "from least to greatest in Table 2 (%)", "")
    return figure


def _system(loop: Loop) -> control.StateSpace:
    return actuator(loop)["angle", "stroke_command"]


def _balanced(system: control.StateSpace) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """A, B, C with time in units of the fastest pole, and states scaled to be of one size; and that pole (rad/s)."""
    pace = np.abs(system.poles()).max()
    A, (scale, _) = scipy.linalg.matrix_balance(system.A / pace, permute=False, separate=True)
    B, C = system.B / scale[:, None], system.C * scale
    return A, B / np.linalg.norm(B), C / np.linalg.norm(C), pace


def _at(name: str, share: float) -> Point:
    least, greatest = TABLE_2[name]
    return {name: least + share * (greatest - least)}


def _over_speed(loop: Loop) -> dict[str, list[float]]:
    found = [bounds(loop.at({"speed": speed})) for speed in SPEEDS.tolist()]
    return {name: [each[name] for each in found] for name in BOUNDS}


def _in_own_gain(loop: Loop, corner: dict[str, Any], schedule: float) -> dict[str, float]:
    # K_p at a corner's speed as the K_p at the gain's own speed that the schedule turns into it
    at_corner = loop.scheduled(schedule).at(corner["corner"])
    factor = at_corner.gain / at_corner.angle_loop.gain
    return {name: corner[name] / factor for name in BOUNDS}


def _everywhere(found: Iterable[dict[str, float]]) -> dict[str, float]:
    rows = list(found)
    limits = {name: min(row[name] for row in rows) for name in BOUNDS[:-1]}
    return {**limits, BOUNDS[-1]: max(row[BOUNDS[-1]] for row in rows)}
