"""Metrics: the figures a run is judged by, each declared once with its unit and meaning.

`measure(run)` gives a `Value` for every metric of `METRICS`: a number, or None with the reason why this run has none.
Metrics see recordings only. Angles are in deg and lateral accelerations in g, as engineers quote them; the rest is SI.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ars_mujoco.recording.recording import Recording

G = 9.80665  # m/s^2


@dataclass(frozen=True)
class Run:
    """What the metrics are taken from.

    `window` (start, end) s of the manoeuvre; `reference` and `locked` are the runs the roll is compared with;
    `held_at` are the angles (rad) that the actuator holds a larger command at, by axle;
    `target` is the roll an active bar aims at, as knots (lateral acceleration m/s^2, roll rad), empty for a bar that
    aims at none; `wall_time` s is what the run took.
    """

    recording: Recording
    window: tuple[float, float]
    reference: Recording | None = None
    locked: Recording | None = None
    target: tuple[tuple[float, float], ...] = ()
    wall_time: float | None = None
    held_at: Mapping[str, float] = field(default_factory=dict)


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


def column(recording: Recording, name: str) -> np.ndarray:
    """The values (n,) of a channel that a metric needs: they are there, and finite."""
    if name not in recording.channels:
        raise NotMeasurableError(f"the run has no channel {name}")
    if not recording.time.size:
        raise NotMeasurableError("nothing was recorded")
    values = recording[name]
    if not np.isfinite(values).all():
        raise NotMeasurableError(f"{name} is not finite at {recording.time[~np.isfinite(values)][0]:.3f} s")
    return values
