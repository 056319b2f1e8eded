"""Margins: gain margin, phase margin and bandwidth, with the loop continuous or closed by a control unit that samples,
and over the pump's speed with a fixed gain beside one that is scheduled with it.

The sampled loop is exact: the actuator's zero-order hold, and the delay as states that hold the commands under way.
"""

import math
from typing import Any

import control
import numpy as np
import scipy.linalg
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DASHES, SHADES, label, legend_beside
from ars_mujoco.analysis.linearization import actuator, open_loop
from ars_mujoco.analysis.loop import RPM, Loop

SAMPLE_TIMES = (1e-3, 2e-3, 5e-3, 10e-3)  # s
DELAYS = (0.0, 2e-3, 5e-3, 10e-3)  # s
SPEEDS = (1500.0, 3000.0, 6000.0)  # rpm
SCHEDULES = {"fixed": 0.0, "scheduled": 1.0}  # K_p ~ 1/n
POINTS = 800  # of frequency, between 1 rad/s and the sampling's limit
FASTEST = 3000.0  # rad/s, beyond every crossing
UNITS = {
    "sample_time": "s",
    "delay": "s",
    "speed": "rad/s",
    "gain": "1/rad",
    "gain_margin": "dB",
    "phase_margin": "deg",
    "bandwidth": "Hz",
}
WANTED = {"gain_margin": 6.0, "phase_margin": 45.0}


def sampled(system: control.StateSpace, sample_time: float, delay: float) -> control.StateSpace:
    """`system` behind a hold of `sample_time` (s) whose output comes `delay` (s) after the sample, in discrete time.

    Of the command under way the younger one acts in the last part of a period where the delay is no whole multiple of
    it; older ones wait in states of their own.
    """
    waiting = int(delay / sample_time + 1e-9)
    late = max(delay - waiting * sample_time, 0.0)
    whole, early_in = _held(system, sample_time - late)
    late_whole, late_in = _held(system, late)
    n = system.nstates
    lags = waiting + 1  # commands kept: u[k-1] ... u[k-lags]
    A, B = np.zeros((n + lags, n + lags)), np.zeros((n + lags, 1))
    A[:n, :n] = whole @ late_whole
    inputs = [B[:n], *(A[:n, n + i : n + i + 1] for i in range(lags))]  # where u[k-i] acts
    inputs[waiting][:] = early_in
    inputs[waiting + 1][:] = whole @ late_in
    B[n] = 1.0
    A[n + 1 :, n:-1] = np.eye(lags - 1)
    C, names = np.hstack([system.C, np.zeros((system.noutputs, lags))]), (system.input_labels, system.output_labels)
    return control.ss(A, B, C, 0.0, sample_time, inputs=names[0], outputs=names[1])


def sampled_loop(loop: Loop, sample_time: float, delay: float) -> control.StateSpace:
    """The open loop, from the angle's error to the angle, with both times in s; continuous where the first is 0."""
    if sample_time == 0.0:
        return open_loop(loop)
    return loop.gain * sampled(actuator(loop)["angle", "stroke_command"], sample_time, delay)


def margins(system: control.StateSpace) -> dict[str, Any]:
    """Margins of an open loop: `gain_margin` dB, `phase_margin` deg, `bandwidth` Hz (-3 dB of the closed loop), and
    whether the closed loop `is_stable`; None where there is no such crossing.

    A resonance may cross unit gain on the far side of -180 deg: of a stable loop the margin is the distance.
    """
    omega = _frequencies(system)
    response = system(np.exp(1j * omega * system.dt)) if system.dt else system(1j * omega)
    gain, phase, *_ = control.stability_margins(control.frd(response, omega, smooth=True))
    is_stable = _is_stable(control.feedback(system))
    return {
        "gain_margin": 20.0 * math.log10(gain) if math.isfinite(gain) else None,
        "phase_margin": float(abs(phase) if is_stable else phase) if math.isfinite(phase) else None,
        "bandwidth": bandwidth(omega, response / (1.0 + response), control.dcgain(control.feedback(system))),
        "is_stable": is_stable,
    }


def bandwidth(omega: np.ndarray, response: np.ndarray, at_rest: float) -> float | None:
    """Frequency (Hz) at which |response|, given at `omega` (rad/s), first falls 3 dB under `at_rest`; else None."""
    level = 20.0 * np.log10(np.abs(response) / at_rest) + 10.0 * math.log10(2.0)
    below = np.flatnonzero(level < 0.0)
    if not len(below) or below[0] == 0:
        return None
    i = below[0]
    share = level[i - 1] / (level[i - 1] - level[i])
    return float(omega[i - 1] * (omega[i] / omega[i - 1]) ** share / (2.0 * math.pi))


def compute(loop: Loop) -> dict[str, Any]:
    """Margins of the loop: continuous, with each sample time and delay, and with its own unit where that samples; and
    of the continuous loop at each speed, with a fixed and with a scheduled gain.
    """
    timings = [(0.0, 0.0), *((sample, delay) for delay in DELAYS for sample in SAMPLE_TIMES)]
    own = (loop.unit.sample_time, loop.unit.delay)
    if own[0] > 0.0 and own not in timings:
        timings.append(own)
    rows = [
        {"sample_time": sample, "delay": delay, **margins(sampled_loop(loop, sample, delay))}
        for sample, delay in timings
    ]
    return {
        "units": UNITS,
        "gain": {"value": loop.gain, "unit": "1/rad"},
        "rows": rows,
        "over_speed": {
            name: [_at_speed(loop.scheduled(schedule), rpm * RPM) for rpm in SPEEDS]
            for name, schedule in SCHEDULES.items()
        },
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: the continuous loop, each sample time with no delay and with the most, and each speed."""
    shown = [row for row in result["rows"] if row["delay"] in (DELAYS[0], DELAYS[-1])]
    gain = result["gain"]["value"]
    rows = [{"quantity": f"margins at K_p {gain:.3g}, {_timing(row)}", "value": _told(row)} for row in shown]
    for name, speeds in result["over_speed"].items():
        rows += [
            {"quantity": f"margins at {row['speed'] / RPM:.0f} rpm, K_p {name} {row['gain']:.3g}", "value": _told(row)}
            for row in speeds
        ]
    return rows


def draw(result: dict[str, Any]) -> Figure:
    """Gain margin, phase margin and bandwidth over the sample time, a line for each delay."""
    figure = Figure(figsize=(10.0, 3.6), layout="constrained")
    continuous, *rows = result["rows"]
    axes = figure.subplots(1, 3)
    for ax, name in zip(axes, ("gain_margin", "phase_margin", "bandwidth"), strict=True):
        for delay, shade, dash in zip(DELAYS, SHADES, DASHES, strict=False):
            values = [row for row in rows if row["delay"] == delay and row["sample_time"] in SAMPLE_TIMES]
            times = [0.0] * (delay == 0.0) + [1e3 * row["sample_time"] for row in values]
            numbers = [continuous[name]] * (delay == 0.0) + [_or_nan(row[name]) for row in values]
            ax.plot(times, numbers, dash, color=shade, marker="o", ms=3, label=f"delay {1e3 * delay:g} ms")
        if name in WANTED:
            ax.axhline(WANTED[name], color=ACCENT, lw=0.9, ls="-", label="wanted")
        label(ax, "", "sample time (ms)", f"{name.replace('_', ' ')} ({UNITS[name]})", legend=False)
    axes[0].set_title(f"A control unit that samples, K_p {result['gain']['value']:.3g} 1/rad", loc="left", fontsize=10)
    legend_beside(figure, axes[0])
    return figure


def _at_speed(loop: Loop, speed: float) -> dict[str, Any]:
    at = loop.at({"speed": speed})
    return {"speed": speed, "gain": at.gain, **margins(open_loop(at))}


def _held(system: control.StateSpace, time: float) -> tuple[np.ndarray, np.ndarray]:
    """What the states and a constant input turn into after `time` (s): e^(A t) and its integral times B."""
    n = system.nstates
    block = np.zeros((n + 1, n + 1))
    block[:n, :n], block[:n, n:] = system.A, system.B
    whole = scipy.linalg.expm(block * time)
    return whole[:n, :n], whole[:n, n:]


def _frequencies(system: control.StateSpace) -> np.ndarray:
    last = math.pi / system.dt * (1.0 - 1e-6) if system.dt else FASTEST
    return np.geomspace(1.0, last, POINTS)


def _is_stable(closed: control.StateSpace) -> bool:
    poles = closed.poles()
    return bool(np.all(np.abs(poles) < 1.0) if closed.dt else np.all(poles.real < 0.0))


def _timing(row: dict[str, Any]) -> str:
    if row["sample_time"] == 0.0:
        return "continuous"
    return f"sampled {1e3 * row['sample_time']:g} ms, delay {1e3 * row['delay']:g} ms"


def _told(row: dict[str, Any]) -> str:
    if not row["is_stable"]:
        return "unstable"
    parts = (
        f"{row[name]:.{digits}f} {UNITS[name]}" if row[name] is not None else "none"
        for name, digits in (("gain_margin", 1), ("phase_margin", 0), ("bandwidth", 1))
    )
    return ", ".join(parts)


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value
