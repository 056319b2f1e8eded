"""Expectations: the limits a cycle's `expect:` holds its metrics to, and the verdict."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ars_mujoco.metrics.metric import METRICS, Value
from ars_mujoco.schema.suggestion import did_you_mean
from ars_mujoco.schema.units import split, to_si


class Limit(NamedTuple):
    """A bound on a metric, in the metric's unit; `relation` is ">=" or "<="."""

    relation: str
    bound: float

    def holds(self, value: Value) -> bool:
        """Whether a measured value is known to keep the limit: one without a number never is."""
        if value.value is None:
            return False
        if self.relation == ">=":
            return value.value >= self.bound
        return value.value <= self.bound and not value.at_least


@dataclass(frozen=True)
class Failure:
    """A limit that was not kept."""

    metric: str
    limit: Limit
    value: Value

    def __str__(self) -> str:
        expected = Value(self.limit.bound, METRICS[self.metric].unit)
        return f"{self.metric} is {self.value}, expected {self.limit.relation} {expected}"


def limits(metric: str, text: str) -> tuple[Limit, ...]:
    """The limits of one line of `expect:`, like ">= 7", "<= 0.15 deg" or "0.60 +- 0.02 g".

    Raises ValueError, saying what is allowed, where the metric is unknown or the line or its unit is wrong.
    """
    if metric not in METRICS:
        raise ValueError(f"unknown metric{did_you_mean(metric, METRICS)}; known: {', '.join(METRICS)}")
    unit, text = METRICS[metric].unit, str(text).strip()
    if text[:2] in (">=", "<="):
        return (Limit(text[:2], to_si(text[2:], unit)),)
    middle, between, width = text.partition("+-")
    if not between:
        raise ValueError("not a limit; written like '>= 1', '<= 1' or '1 +- 0.1', each with the metric's unit")
    middle, width = to_si(f"{middle} {split(width)[1]}", unit), to_si(width, unit)
    return (Limit(">=", middle - width), Limit("<=", middle + width))


def check(expectations: Mapping[str, Sequence[Limit]], values: Mapping[str, Value]) -> list[Failure]:
    """Every limit that the measured values do not keep, in the order they are written."""
    return [
        Failure(metric, limit, values[metric])
        for metric, bounds in expectations.items()
        for limit in bounds
        if not limit.holds(values[metric])
    ]
