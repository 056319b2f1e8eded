"""Frequency response of the closed loop: the linear one, and the running circuit's own to sines of several amplitudes.

The running circuit is driven like on the bench, with every saturation, with and without dry friction; the response is
the fundamental of the angle over whole periods, once the start has died away. Both take the control unit as continuous;
what its sampling costs is in `margins`.

Large sines meet two limits: the pump's flow, which takes the bandwidth down, and the spool's speed. At
sqrt(Xdot_max ydot_max), where a full stroke back and forth needs all of it, the phase jumps down by some 80 deg.
"""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, SHADES, label, legend_beside
from ars_mujoco.analysis.linearization import closed_loop
from ars_mujoco.analysis.loop import Loop
from ars_mujoco.analysis.margins import bandwidth
from ars_mujoco.analysis.running_loop import follow, started
from ars_mujoco.kernels.kernel import entry

AMPLITUDES = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)  # deg
DRAWN = (0.1, 0.5, 1.0, 2.0, 5.0, 10.0)
FREQUENCIES = np.geomspace(0.5, 60.0, 40)  # Hz
STEP = 1e-3  # s, the longest over which the command is a parabola
SETTLING, MEASURED = 1.0, 0.5  # s, at least; and never less than two periods
FRICTIONS = {"with_dry_friction": True, "without_dry_friction": False}
UNITS = {"frequency": "Hz", "magnitude": "dB", "phase": "deg", "amplitude": "deg", "bandwidth": "Hz"}


def linear(loop: Loop, frequencies: np.ndarray) -> np.ndarray:
    """Complex response of angle over command at `frequencies` (Hz), of the loop linearized without dry friction."""
    return closed_loop(loop)["angle", "command"](2j * math.pi * np.asarray(frequencies))


def measured(loop: Loop, amplitude: float, frequencies: np.ndarray) -> np.ndarray:
    """Complex response of the running circuit at `frequencies` (Hz) to sines of `amplitude` (rad)."""
    return np.array([_measured_at(loop, amplitude, frequency) for frequency in np.asarray(frequencies).tolist()])


def compute(loop: Loop) -> dict[str, Any]:
    """The linear response, and the measured one at each amplitude with and without dry friction."""
    at_rest = abs(linear(loop, np.zeros(1))[0])
    omega = 2.0 * math.pi * FREQUENCIES

    def told(response: np.ndarray) -> dict[str, Any]:
        return {
            "magnitude": (20.0 * np.log10(np.abs(response))).tolist(),
            "phase": np.degrees(np.unwrap(np.angle(response))).tolist(),
            "bandwidth": bandwidth(omega, response, at_rest),
        }

    smooth = loop.without_dry_friction()
    return {
        "units": UNITS,
        "gain": {"value": loop.gain, "unit": "1/rad"},
        "frequency": FREQUENCIES.tolist(),
        "linear": told(linear(loop, FREQUENCIES)),
        **{
            name: [
                {"amplitude": amplitude} | told(measured(loop if dry else smooth, math.radians(amplitude), FREQUENCIES))
                for amplitude in AMPLITUDES
            ]
            for name, dry in FRICTIONS.items()
        },
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: the bandwidth, linear and at each amplitude."""
    rows = [{"quantity": "bandwidth, linear", "value": _hz(result["linear"]["bandwidth"]), "paper": "12 Hz wanted"}]
    for with_dry, without in zip(*(result[name] for name in FRICTIONS), strict=True):
        told = f"{_hz(with_dry['bandwidth'])}, without dry friction {_hz(without['bandwidth'])}"
        rows.append({"quantity": f"bandwidth at {with_dry['amplitude']:g} deg", "value": told})
    return rows


def draw(result: dict[str, Any]) -> Figure:
    """Bode diagram: magnitude over phase, without dry friction on the left and with it on the right."""
    figure = Figure(figsize=(10.0, 6.0), layout="constrained")
    axes = figure.subplots(2, 2, sharex=True, sharey="row")
    for column, name in zip(axes.T, reversed(FRICTIONS), strict=True):
        drawn = [row for row in result[name] if row["amplitude"] in DRAWN]
        for ax, quantity in zip(column, ("magnitude", "phase"), strict=True):
            for row, shade, marker in zip(drawn, (*SHADES, SHADES[0]), "os^vDx", strict=True):
                ax.semilogx(
                    result["frequency"], row[quantity], color=shade, lw=0.8, marker=marker, ms=3, mfc="none",
                    label=f"{row['amplitude']:g} deg",
                )  # fmt: skip
            ax.semilogx(result["frequency"], result["linear"][quantity], color=ACCENT, lw=1.6, label="linear")
        label(column[0], f"Closed loop, {name.replace('_', ' ')}", "", "angle over command (dB)", legend=False)
        label(column[1], "", "frequency (Hz)", "phase (deg)", legend=False)
    legend_beside(figure, axes[0, 0])
    axes[0, 0].set_ylim(-40.0, 5.0)
    axes[1, 0].set_ylim(-270.0, 10.0)
    return figure


def _measured_at(loop: Loop, amplitude: float, frequency: float) -> complex:
    samples = max(64, math.ceil(1.0 / (frequency * STEP)))
    settling, periods = (max(2, math.ceil(seconds * frequency)) for seconds in (SETTLING, MEASURED))
    axle, state, work = started(loop, 1.0 / (frequency * samples))
    cosine, sine = _fundamental(axle, state, work, loop.gain, amplitude, frequency, settling, periods, samples)
    return complex(sine, cosine) / amplitude


@entry
def _fundamental(axle, state, work, gain, amplitude, frequency, settling, periods, samples):
    """(cosine, sine) amplitudes (rad) of the angle under a command of `amplitude` sin(2 pi `frequency` t)."""
    step, turn = 1.0 / (frequency * samples), 2.0 * math.pi / samples
    cosine = sine = 0.0
    for i in range((settling + periods) * samples):
        first, middle, last = (
            amplitude * math.sin(turn * i),
            amplitude * math.sin(turn * (i + 0.5)),
            amplitude * math.sin(turn * (i + 1)),
        )
        command = first, (4.0 * middle - 3.0 * first - last) / step, 2.0 * (first - 2.0 * middle + last) / (step * step)
        follow(axle, state, work, command, gain, step)
        if i >= settling * samples:
            cosine += state.circuit.angle * math.cos(turn * (i + 1))
            sine += state.circuit.angle * math.sin(turn * (i + 1))
    return 2.0 / (periods * samples) * cosine, 2.0 / (periods * samples) * sine


def _hz(value: float | None) -> str:
    return "none" if value is None else f"{value:.1f} Hz"
