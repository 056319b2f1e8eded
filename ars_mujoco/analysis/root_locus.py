"""Root locus: the closed loop's poles over the gain of the bar-angle loop (paper Fig. 11)."""

from typing import Any

import control
import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DARK, LIGHT, MIDDLE_GREY, label
from ars_mujoco.analysis.linearization import actuator
from ars_mujoco.analysis.loop import Loop
from ars_mujoco.analysis.stable_region import critical_gain

GAINS = np.linspace(0.0, 300.0, 601)  # 1/rad
CIRCLES = (100.0, 200.0, 400.0, 800.0)  # rad/s, natural frequencies drawn


def compute(loop: Loop) -> dict[str, Any]:
    """Poles for each gain, for the loop's own and for the one at which it begins to oscillate by itself."""
    system = actuator(loop)["angle", "stroke_command"]
    critical = critical_gain(loop)
    gains = GAINS if loop.is_detailed else np.union1d(GAINS, _break_gains(system))
    return {
        "units": {"gain": "1/rad", "poles": "rad/s as (real, imaginary)"},
        "gain": gains.tolist(),
        "loci": _pairs(control.root_locus_map(system, gains).loci),
        "open_loop": _pairs(system.poles()),
        "own": {"gain": loop.gain, "poles": _pairs(_poles(system, loop.gain))},
        "critical": {"gain": critical, "poles": _pairs(_poles(system, critical))},
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: the loop's own poles by frequency and damping, one of each pair."""
    own = result["own"]
    poles = sorted((complex(*each) for each in own["poles"] if each[1] >= 0.0), key=abs)
    told = ", ".join(f"{abs(pole):.0f} ({-pole.real / abs(pole):.2f})" for pole in poles)
    return [
        {"quantity": f"poles at K_p {own['gain']:.3g}: rad/s (damping)", "value": told},
        {"quantity": "K_p at which this loop begins to oscillate", "value": f"{result['critical']['gain']:.1f} 1/rad"},
    ]


def draw(result: dict[str, Any]) -> Figure:
    """The loci, with the open loop's poles, the loop's own and the critical ones."""
    figure = Figure(figsize=(6.6, 6.2), layout="constrained")
    ax = figure.subplots()
    angle = np.linspace(0.5 * np.pi, 1.5 * np.pi, 200)
    for radius in CIRCLES:
        ax.plot(radius * np.cos(angle), radius * np.sin(angle), color=LIGHT, lw=0.7, ls=":")
        ax.annotate(f"{radius:g}", (0.0, radius), fontsize=7, color=MIDDLE_GREY, ha="right", va="bottom")
    for i, locus in enumerate(np.swapaxes(np.array(result["loci"]), 0, 1)):
        ax.plot(*locus.T, color=DARK, lw=1.1, label=None if i else f"0 to {GAINS[-1]:g} 1/rad")
    own, critical = result["own"], result["critical"]
    ax.plot(*np.transpose(result["open_loop"]), "x", color=DARK, label="open loop")
    ax.plot(*np.transpose(own["poles"]), "o", color=DARK, mfc="white", label=f"K_p {own['gain']:.3g}")
    text = f"K_p {critical['gain']:.3g}, critical"
    ax.plot(*np.transpose(critical["poles"]), "s", color=ACCENT, ms=4, label=text)
    ax.axvline(0.0, color=MIDDLE_GREY, lw=0.7)
    ax.set_aspect("equal")
    ax.set_xlim(-700.0, 200.0)
    ax.set_ylim(-15.0, 920.0)
    title = "Root locus over the bar-angle loop's gain; circles: natural frequency"
    label(ax, title, "real part (rad/s)", "imaginary part (rad/s), upper half")
    ax.get_legend().set_loc("upper left")
    return figure


def _break_gains(system: control.StateSpace) -> list[float]:
    """Gains at which two branches of the root locus meet on the real axis, where -1/system has an extreme; the system
    has no zeros.
    """
    meetings = np.roots(np.polyder(np.poly(system.A)))
    gains = [-1.0 / system(s).real for s in meetings if abs(s.imag) < 1e-6 * abs(s)]
    return [gain for gain in gains if 0.0 < gain < GAINS[-1]]


def _poles(system: control.StateSpace, gain: float) -> np.ndarray:
    return control.feedback(gain * system).poles()


def _pairs(poles: np.ndarray) -> list:
    return np.stack([np.real(poles), np.imag(poles)], axis=-1).tolist()
