"""Roll: how much a body rolls, against other runs and against what its controller aims at."""

from collections.abc import Callable, Iterator

import numpy as np

from ars_mujoco.control.target import target_roll
from ars_mujoco.metrics.metric import G, NotMeasurableError, Run, Value, column, metric
from ars_mujoco.recording.recording import Recording

LEAST_REFERENCE_ROLL = 0.3  # deg; a reference that rolls less gives no factor
ROLL_RESOLUTION = 0.05  # deg; a run that rolls less has a factor of "at least"
PATH_TOLERANCE = 0.02  # of the peak lateral acceleration; runs further apart were not on the same path
LATE = 0.01  # s; a recording that ends sooner before its window's end than this is whole

PASSIVE_BAND = (0.1, 0.4)  # g, least squares of the passive roll gradient
TABLE = (0.3, 0.45, 0.6, 0.8)  # g, the rows of the roll table
TARGET_CHECKS = (0.3, 0.6, 0.8)  # g
FIT = 0.01  # g, half width of the straight line through a row of the table
QUASI_STATIC = (0.5, 0.05)  # s, g; a slow circle changes its lateral acceleration by less than this in that time


@metric("deg", "largest roll in the manoeuvre's window, either side")
def peak_roll(run: Run) -> float:
    return _peak(run.recording, run.window)


@metric("deg", "root mean square of the roll over the window")
def rms_roll(run: Run) -> float:
    return _rms(run.recording, run.window)


@metric("g", "largest lateral acceleration in the window, either side")
def peak_lateral_acceleration(run: Run) -> float:
    return _peak_lateral_acceleration(run.recording, run.window)


@metric("1", "peak roll of the reference run over that of this run")
def roll_reduction_factor(run: Run) -> Value:
    return _factor(run.window, "reference", run.reference, run.recording, _peak)


@metric("1", "root mean square roll of the reference run over that of this run")
def roll_reduction_factor_rms(run: Run) -> Value:
    return _factor(run.window, "reference", run.reference, run.recording, _rms)


@metric("1", "peak roll of the run with locked motors over that of this run")
def roll_reduction_factor_against_locked(run: Run) -> Value:
    return _factor(run.window, "locked", run.locked, run.recording, _peak)


@metric("1", "peak roll of the reference run over that of the run with locked motors")
def roll_reduction_factor_of_locked(run: Run) -> Value:
    if run.locked is None:
        raise NotMeasurableError("no locked run to compare with")
    return _factor(run.window, "reference", run.reference, run.locked, _peak)


@metric("deg/g", "slope of the roll on a slow circle, 0.1 to 0.4 g; a bar that follows a target has a table instead")
def roll_gradient(run: Run) -> Value:
    acceleration, roll = _slow_circle(run)
    table = tuple(_table(acceleration, roll))
    if run.target:
        return Value(None, note="the bar follows a target: see the table", table=table)
    low, high = PASSIVE_BAND
    if acceleration.min() > low + FIT or acceleration.max() < high - FIT:
        raise NotMeasurableError(f"the run does not sweep {low} to {high} g")
    band = (acceleration >= low) & (acceleration <= high)
    return Value(float(np.polyfit(acceleration[band], roll[band], 1)[0]), table=table)


@metric("deg", "largest distance of the roll from its target at 0.3, 0.6 and 0.8 g of a slow circle")
def target_map_error(run: Run) -> float:
    if not run.target:
        raise NotMeasurableError("the bar follows no target")
    acceleration, roll = _slow_circle(run)
    aims = np.degrees(target_roll(run.target, np.multiply(TARGET_CHECKS, G)))
    return max(abs(_fit(acceleration, roll, g)[0] - aim) for g, aim in zip(TARGET_CHECKS, aims, strict=True))


def _within(recording: Recording, window: tuple[float, float], values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Time (n,) s and values (n,) in the window, ends included."""
    start, end = window
    if recording.time[-1] < end - LATE:
        raise NotMeasurableError(f"the run ends at {recording.time[-1]:.3f} s, its window at {end:.3f} s")
    rows = (recording.time >= start) & (recording.time <= end)
    if not rows.any():
        raise NotMeasurableError(f"the window from {start:.3f} to {end:.3f} s holds no sample")
    return recording.time[rows], values[rows]


def _roll(recording: Recording, window: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Time (n,) s and roll (n,) deg in the window, less the roll before the manoeuvre: the first of the recording."""
    roll = column(recording, "body.roll")
    return _within(recording, window, np.degrees(roll - roll[0]))


def _lateral_acceleration(recording: Recording, window: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Time (n,) s and lateral acceleration (n,) g in the window."""
    return _within(recording, window, column(recording, "body.lateral_acceleration") / G)


def _peak(recording: Recording, window: tuple[float, float]) -> float:
    return np.abs(_roll(recording, window)[1]).max()


def _rms(recording: Recording, window: tuple[float, float]) -> float:
    time, roll = _roll(recording, window)
    if time.size < 2:
        raise NotMeasurableError("the window holds a single sample")
    return np.sqrt(np.trapezoid(roll**2, time) / (time[-1] - time[0]))


def _peak_lateral_acceleration(recording: Recording, window: tuple[float, float]) -> float:
    return np.abs(_lateral_acceleration(recording, window)[1]).max()


def _factor(
    window: tuple[float, float], name: str, other: Recording | None, recording: Recording, size: Callable
) -> Value:
    """`size` of the roll of the run called `name` over that of `recording`."""
    if other is None:
        raise NotMeasurableError(f"no {name} run to compare with")
    if (peak := _peak(other, window)) < LEAST_REFERENCE_ROLL:
        raise NotMeasurableError(f"the {name} run's peak roll of {peak:.3f} deg is under {LEAST_REFERENCE_ROLL} deg")
    roll = size(recording, window)
    return Value(
        float(size(other, window) / max(roll, ROLL_RESOLUTION)),
        note=_paths_apart(name, other, recording, window),
        at_least=bool(roll < ROLL_RESOLUTION),
    )


def _paths_apart(name: str, other: Recording, recording: Recording, window: tuple[float, float]) -> str:
    """A remark where the two runs' peak lateral accelerations differ too much to be compared, else nothing."""
    theirs, ours = (_peak_lateral_acceleration(each, window) for each in (other, recording))
    if abs(ours - theirs) <= PATH_TOLERANCE * theirs:
        return ""
    return f"lateral acceleration peaks at {ours:.3f} g here, at {theirs:.3f} g in the {name} run"


def _slow_circle(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """|lateral acceleration| (n,) g and roll (n,) deg, outward positive, of a run slow enough to be read as statics."""
    time, acceleration = _lateral_acceleration(run.recording, run.window)
    _, roll = _roll(run.recording, run.window)
    span, change = QUASI_STATIC
    if np.abs(np.interp(time + span, time, acceleration) - acceleration).max() > change:
        raise NotMeasurableError(f"not a slow circle: the lateral acceleration changes by over {change} g in {span} s")
    return np.abs(acceleration), roll * np.sign(acceleration)


def _fit(acceleration: np.ndarray, roll: np.ndarray, g: float) -> tuple[float, float]:
    """Roll (deg) and its slope (deg/g) at `g`, by a straight line through the samples near it."""
    near = np.abs(acceleration - g) <= FIT
    if not near.any() or np.ptp(acceleration[near]) < FIT / 2:
        raise NotMeasurableError(f"the run does not sweep through {g} g")
    slope, value = np.polyfit(acceleration[near] - g, roll[near], 1)
    return value, slope


def _table(acceleration: np.ndarray, roll: np.ndarray) -> Iterator[dict[str, float]]:
    """The rows of the roll table that the run reaches."""
    for g in TABLE:
        try:
            value, slope = _fit(acceleration, roll, g)
        except NotMeasurableError:
            continue
        yield {"lateral_acceleration": g, "roll": float(value), "secant": float(value / g), "tangent": float(slope)}
