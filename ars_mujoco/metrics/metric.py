"""Metrics: the figures a run is judged by, each declared once with its unit and meaning.

`measure(run)` gives a `Value` for every metric of `METRICS`: a number, or None with the reason why this run has none.
Metrics see recordings only. Angles are in deg and lateral accelerations in g, as engineers quote them; the rest is SI.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ars_mujoco.control.target import target_roll
from ars_mujoco.recording.recording import Recording

G = 9.80665  # m/s^2
BAR = 1e5  # Pa
RPM = np.pi / 30.0  # rad/s

LEAST_REFERENCE_ROLL = 0.3  # deg; a reference that rolls less gives no factor
ROLL_RESOLUTION = 0.05  # deg; a run that rolls less has a factor of "at least"
PATH_TOLERANCE = 0.02  # of the peak lateral acceleration; runs further apart were not on the same path
LATE = 0.01  # s; a recording that ends sooner before its window's end than this is whole

PASSIVE_BAND = (0.1, 0.4)  # g, least squares of the passive roll gradient
TABLE = (0.3, 0.45, 0.6, 0.8)  # g, the rows of the roll table
TARGET_CHECKS = (0.3, 0.6, 0.8)  # g
FIT = 0.01  # g, half width of the straight line through a row of the table
QUASI_STATIC = (0.5, 0.05)  # s, g; a slow circle changes its lateral acceleration by less than this in that time

LEAST_THROUGHPUT = 1.0  # J; below it the audit's error is absolute
STORED = ("oil", "bar", "inertia", "oil_motion")
LOSSES = (
    "pump_torque_loss", "pump_leakage", "motor_leakage", "relief", "friction", "capacitance", "line", "check", "bypass",
    "tank_leakage", "charge_loss",
)  # fmt: skip


@dataclass(frozen=True)
class Run:
    """What the metrics are taken from.

    `window` (start, end) s of the manoeuvre; `reference` and `locked` are the runs the roll is compared with;
    `target` is the roll an active bar aims at, as knots (lateral acceleration m/s^2, roll rad), empty for a bar that
    aims at none; `wall_time` s is what the run took.
    """

    recording: Recording
    window: tuple[float, float]
    reference: Recording | None = None
    locked: Recording | None = None
    target: tuple[tuple[float, float], ...] = ()
    wall_time: float | None = None


@dataclass(frozen=True)
class Value:
    """A measured metric: `value` in `unit`, or None with the reason in `note`, which else holds remarks.

    `at_least` marks a value that is only a lower bound; `table` holds rows where one number cannot say it.
    """

    value: float | None
    unit: str = ""
    note: str = ""
    at_least: bool = False
    table: tuple[dict[str, float], ...] = ()

    def __str__(self) -> str:
        if self.value is None:
            return f"none ({self.note})"
        return f"{'>= ' if self.at_least else ''}{self.value:.4g}{'' if self.unit == '1' else ' ' + self.unit}"


class NotMeasurableError(Exception):
    """This run does not have that metric; the message is the reason."""


@dataclass(frozen=True)
class Metric:
    """A metric's declaration and the function that takes it from a run."""

    name: str
    unit: str
    description: str
    function: Callable[[Run], float | Value]

    def __call__(self, run: Run) -> Value:
        """Measure; a metric that the run does not have is a Value of None with the reason."""
        try:
            result = self.function(run)
        except NotMeasurableError as reason:
            return Value(None, self.unit, str(reason))
        return replace(result if isinstance(result, Value) else Value(float(result)), unit=self.unit)


METRICS: dict[str, Metric] = {}


def metric(unit: str, description: str) -> Callable:
    """Declare the decorated function as the metric of its own name."""

    def declare(function: Callable[[Run], float | Value]) -> Callable[[Run], float | Value]:
        METRICS[function.__name__] = Metric(function.__name__, unit, description, function)
        return function

    return declare


def measure(run: Run) -> dict[str, Value]:
    """Every metric of `run`, by name."""
    return {name: metric(run) for name, metric in METRICS.items()}


# ---- roll


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


def _column(recording: Recording, name: str) -> np.ndarray:
    if name not in recording.channels:
        raise NotMeasurableError(f"the run has no channel {name}")
    if not recording.time.size:
        raise NotMeasurableError("nothing was recorded")
    values = recording[name]
    if not np.isfinite(values).all():
        raise NotMeasurableError(f"{name} is not finite at {recording.time[~np.isfinite(values)][0]:.3f} s")
    return values


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
    roll = _column(recording, "body.roll")
    return _within(recording, window, np.degrees(roll - roll[0]))


def _lateral_acceleration(recording: Recording, window: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Time (n,) s and lateral acceleration (n,) g in the window."""
    return _within(recording, window, _column(recording, "body.lateral_acceleration") / G)


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


def _table(acceleration: np.ndarray, roll: np.ndarray):
    """The rows of the roll table that the run reaches."""
    for g in TABLE:
        try:
            value, slope = _fit(acceleration, roll, g)
        except NotMeasurableError:
            continue
        yield {"lateral_acceleration": g, "roll": float(value), "secant": float(value / g), "tangent": float(slope)}


# ---- power and energy, over the whole run


@metric("J", "work drawn by the pumps' shafts, less what they gave back; the charge supply is beside it")
def shaft_energy(run: Run) -> float:
    return _total(run, "shaft")


@metric("J", "work given back at the pumps' shafts")
def recovered_energy(run: Run) -> float:
    return _total(run, "recovered")


@metric("J", "energy drawn by the charge and control supply, all of it dissipated")
def charge_energy(run: Run) -> float:
    return _total(run, "charge")


@metric("W", "largest power drawn by the pumps' shafts together")
def peak_shaft_power(run: Run) -> float:
    return sum(_column(run.recording, f"{axle}.pump.shaft_power") for axle in _axles(run)).max()


@metric("1", "shaft work neither stored, lost nor done on the car, over the throughput of shafts and motors")
def energy_audit_error(run: Run) -> Value:
    axles = [axle for axle in _axles(run) if _change(run, axle, "throughput") > 0]
    if not axles:
        raise NotMeasurableError("no pump ran")
    astray = sum(abs(_astray(run, axle)) for axle in axles)
    throughput = sum(_change(run, axle, "throughput") for axle in axles)
    note = f"absolute, in J: the throughput is {throughput:.3g} J" if throughput < LEAST_THROUGHPUT else ""
    return Value(float(astray / max(throughput, LEAST_THROUGHPUT)), note=note)


@metric("s", "time that pumps spend outside the range that their losses were given for")
def loss_extrapolation(run: Run) -> Value:
    outside = {axle: _column(run.recording, f"{axle}.pump.extrapolation") for axle in _axles(run)}
    notes = [_farthest(run, axle, far) for axle, far in outside.items() if np.any(far > 0.0)]
    rows = np.any([far > 0.0 for far in outside.values()], axis=0)
    return Value(float(np.sum(np.diff(run.recording.time)[rows[:-1]])), note="; ".join(notes))


@metric("1", "simulated time over wall time")
def real_time_factor(run: Run) -> float:
    if run.wall_time is None:
        raise NotMeasurableError("the wall time was not taken")
    if not run.recording.time.size:
        raise NotMeasurableError("nothing was recorded")
    return (run.recording.time[-1] - run.recording.time[0]) / run.wall_time


def _farthest(run: Run, axle: str, far: np.ndarray) -> str:
    """When the pump of an axle first leaves the range of its losses, and where it is farthest outside."""
    time, i = run.recording.time, int(np.argmax(far))
    stroke, speed, pressure = (
        abs(run.recording[f"{axle}.{name}"][i]) for name in ("pump.stroke", "pump.speed", "motor.pressure")
    )
    return (
        f"the losses of the {axle} pump are extrapolated from {time[far > 0.0][0]:.3f} s on, at most by "
        f"{100 * far[i]:.2g} % at {time[i]:.3f} s (stroke {100 * stroke:.1f} %, {speed / RPM:.0f} rpm, "
        f"{pressure / BAR:.1f} bar)"
    )


def _axles(run: Run) -> list[str]:
    """The axles that record a pump's energy."""
    axles = [axle for axle in ("front", "rear") if f"{axle}.energy.shaft" in run.recording.channels]
    if not axles:
        raise NotMeasurableError("the run records no pump")
    return axles


def _change(run: Run, axle: str, name: str) -> float:
    """What an energy channel gained from the first sample to the last [J]."""
    energy = _column(run.recording, f"{axle}.energy.{name}")
    return energy[-1] - energy[0]


def _total(run: Run, name: str) -> float:
    """The same of all axles together [J]."""
    return sum(_change(run, axle, name) for axle in _axles(run))


def _astray(run: Run, axle: str) -> float:
    """Shaft work that the balance of an axle does not find again [J]; the charge supply is drawn and lost alike."""
    drawn = _change(run, axle, "shaft") + _change(run, axle, "charge")
    return drawn - sum(_change(run, axle, name) for name in (*STORED, *LOSSES, "work"))
