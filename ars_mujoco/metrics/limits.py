"""Limits: how far a run went beyond what its parameters were measured for."""

import numpy as np

from ars_mujoco.metrics.metric import NotMeasurableError, Run, Value, column, metric

BAR = 1e5  # Pa
RPM = np.pi / 30.0  # rad/s
WITHIN = 1.0 - 1e-9  # of a limit, at which a command is held there
ENDING = ".pump.extrapolation"


@metric("s", "time that pumps spend outside the range that their losses were given for")
def loss_extrapolation(run: Run) -> Value:
    blocks = [name.removesuffix(ENDING) for name in run.recording.channels if name.endswith(ENDING)]
    if not blocks:
        raise NotMeasurableError("the run records no pump")
    outside = {block: column(run.recording, block + ENDING) for block in blocks}
    notes = [_farthest(run, block, far) for block, far in outside.items() if np.any(far > 0.0)]
    rows = np.any([far > 0.0 for far in outside.values()], axis=0)
    return Value(float(np.sum(np.diff(run.recording.time)[rows[:-1]])), note="; ".join(notes))


def _farthest(run: Run, block: str, far: np.ndarray) -> str:
    """When the pump of a block first leaves the range of its losses, and where it is farthest outside."""
    time, i = run.recording.time, int(np.argmax(far))
    speed, pressure = (abs(run.recording[f"{block}.{name}"][i]) for name in ("pump.speed", "motor.pressure"))
    stroke = f"{block}.pump.stroke"  # a pump of fixed displacement has none
    part = f"stroke {100 * abs(run.recording[stroke][i]):.1f} %, " if stroke in run.recording.channels else ""
    return (
        f"the losses of the {block} pump are extrapolated from {time[far > 0.0][0]:.3f} s on, at most by "
        f"{100 * far[i]:.2g} % at {time[i]:.3f} s ({part}{speed / RPM:.0f} rpm, {pressure / BAR:.1f} bar)"
    )


@metric("s", "time that commands of the bars' angles are held at the actuator's limit")
def command_limited(run: Run) -> Value:
    if not run.held_at:
        raise NotMeasurableError("the actuator holds no command at an angle")
    asked = {axle: np.abs(column(run.recording, f"{axle}.bar.command")) for axle in run.held_at if _has(run, axle)}
    held = {axle: asked[axle] >= WITHIN * run.held_at[axle] for axle in asked}
    notes = [_held(run, axle, rows) for axle, rows in held.items() if rows.any()]
    rows = np.any(list(held.values()), axis=0)
    return Value(float(np.sum(np.diff(run.recording.time)[rows[:-1]])), note="; ".join(notes))


def _has(run: Run, axle: str) -> bool:
    return axle == "front" or f"{axle}.bar.command" in run.recording.channels


def _held(run: Run, axle: str, rows: np.ndarray) -> str:
    """Where a bar's command is held, and from when on."""
    angle, time = np.degrees(run.held_at[axle]), run.recording.time[rows][0]
    return f"the command of the {axle} bar is held at {angle:.4g} deg, from {time:.3f} s on"
