"""Steady state: what the proportional loop leaves of the commanded angle, over leakage and gain.

Holding the bar's torque takes pressure, pressure leaks, and the leakage takes a stroke, which takes an error. It is
a/(a + K_v) of the command, with a = k c/D^2 and K_v = K_p V_p n/D; the numbers come from the linearized running code.
"""

from typing import Any

import control
import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DASHES, SHADES, label
from ars_mujoco.analysis.linearization import actuator
from ars_mujoco.analysis.loop import RPM, Loop
from ars_mujoco.analysis.parameter_box import TABLE_2

PAPER = 0.005  # "less than 0.5 percent"
LEAKAGES = np.linspace(*TABLE_2["leakage"], 17)  # m^3/s/Pa
GAINS = (30.0, 45.0, 60.0, 90.0)  # 1/rad
SPEEDS = (1500.0, 3000.0, 6000.0)  # rpm


def error(loop: Loop, gain: float | None = None) -> float:
    """Error at rest over the commanded angle (1), with K_p `gain` (1/rad) or else the loop's own."""
    at_rest = float(control.dcgain(actuator(loop)["angle", "stroke_command"]))
    return 1.0 / (1.0 + (loop.gain if gain is None else gain) * at_rest)


def compute(loop: Loop) -> dict[str, Any]:
    """Error over leakage, for several gains at the loop's speed, and for the loop's gain at several speeds."""
    leaking = [loop.at({"leakage": leakage}) for leakage in LEAKAGES.tolist()]
    speeds = [rpm * RPM for rpm in SPEEDS]
    return {
        "units": {"leakage": "m^3/s/Pa", "gain": "1/rad", "speed": "rad/s", "error": "1"},
        "paper": {"error": PAPER},
        "own": {"gain": loop.gain, "speed": float(loop.circuit.pump.speed), "error": error(loop)},
        "leakage": LEAKAGES.tolist(),
        "over_gain": [{"gain": gain, "error": [error(each, gain) for each in leaking]} for gain in GAINS],
        "over_speed": [
            {"speed": speed, "error": [error(each.at({"speed": speed})) for each in leaking]} for speed in speeds
        ],
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: the loop's own error, and its range over leakage at each speed."""
    paper = f"under {100 * PAPER:g} %"
    own = result["own"]
    told = {f"error at rest, K_p {own['gain']:.3g}": f"{100 * own['error']:.2f} %"} | {
        f"error at rest over leakage, {row['speed'] / RPM:.0f} rpm": "{:.2f} to {:.2f} %".format(
            *(100 * row["error"][end] for end in (0, -1))
        )
        for row in result["over_speed"]
    }
    return [{"quantity": quantity, "value": value, "paper": paper} for quantity, value in told.items()]


def draw(result: dict[str, Any]) -> Figure:
    """Error over leakage, a line a gain and a line a speed."""
    figure = Figure(figsize=(10.0, 3.8), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    leakage = 1e12 * np.array(result["leakage"])
    rpm = result["own"]["speed"] / RPM
    gains = {f"K_p {row['gain']:g} 1/rad": row["error"] for row in result["over_gain"]}
    speeds = {f"{row['speed'] / RPM:.0f} rpm": row["error"] for row in result["over_speed"]}
    titles = f"Error at rest, {rpm:.0f} rpm", f"Error at rest, K_p {result['own']['gain']:.3g} 1/rad at {rpm:.0f} rpm"
    for ax, lines, title in zip(axes, (gains, speeds), titles, strict=True):
        for (text, errors), shade, dash in zip(lines.items(), SHADES, DASHES, strict=False):
            ax.plot(leakage, 100.0 * np.array(errors), dash, color=shade, label=text)
        ax.axhline(100.0 * PAPER, color=ACCENT, lw=1.0, label="paper: under 0.5 %")
        ax.set_ylim(bottom=0.0)
        label(ax, title, "leakage k_Li (1e-12 m^3/s/Pa)", "error over command (%)")
    return figure
