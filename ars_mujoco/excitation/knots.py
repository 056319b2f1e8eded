"""Signal: a quantity over time as a few knots, and how they are joined."""

from collections.abc import Sequence
from functools import cache
from typing import Annotated, Literal

import numpy as np
from pydantic import ValidationInfo, create_model, field_validator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.units import Unit

KNOTS = 32
JOINS = ("step", "linear", "smooth")
STEP, LINEAR, SMOOTH = range(3)

# count and join are whole numbers held as floats: the record lies in an array of float64
SIGNAL = np.dtype(
    [("count", np.float64), ("join", np.float64), ("times", np.float64, KNOTS), ("values", np.float64, KNOTS)]
)


class Knots(Parameters):
    """A quantity over time: [time, value] pairs and how they are joined; held before the first and after the last."""

    join: Literal["smooth", "linear", "step"] = "smooth"  # smooth is s^3 (10 - 15 s + 6 s^2)
    knots: tuple[tuple[float, float], ...]

    @field_validator("knots")
    @classmethod
    def _make_a_signal(cls, knots, info: ValidationInfo):
        try:
            signal(*zip(*knots, strict=True) if knots else ((), ()), info.data.get("join", "smooth"))
        except InputError as error:
            raise ValueError("; ".join(error.problems)) from None
        return knots

    def signal(self) -> np.record:
        """The SIGNAL record of the knots, in s and SI."""
        return signal(*zip(*self.knots, strict=True), self.join)


@cache
def KnotsOf(unit: str, **limits: float) -> type[Knots]:  # noqa: N802 (reads as a type)
    """Knots whose values carry a unit of the dimension of `unit`; `limits` are those of a Quantity."""
    knot = tuple[Annotated[float, Unit("s")], Annotated[float, Unit(unit, **limits)]]
    return create_model(f"KnotsOf({unit})", __base__=Knots, knots=(tuple[knot, ...], ...))


def signal(times: Sequence[float], values: Sequence[float], join: str = "smooth") -> np.record:
    """The SIGNAL record of `values` at `times` (s), joined by a "step", a "linear" or a "smooth" (quintic) piece.

    Before its first knot and after its last a signal keeps their values. Raises InputError with every problem found.
    """
    problems = _problems(times, values, join)
    if problems:
        raise InputError(*problems)
    record = np.zeros(1, SIGNAL).view(np.recarray)[0]
    record.count, record.join = len(times), JOINS.index(join)
    record.times[: len(times)] = times
    record.values[: len(values)] = values
    return record


def _problems(times, values, join) -> list[str]:
    problems = []
    if join not in JOINS:
        problems.append(f"join: {join!r} is none of {', '.join(JOINS)}")
    if len(times) != len(values):
        problems.append(f"a signal needs as many values as times, not {len(values)} values at {len(times)} times")
    if not 1 <= len(times) <= KNOTS:
        problems.append(f"a signal has 1 to {KNOTS} knots, not {len(times)}")
    if not np.all(np.isfinite([*times, *values])):
        problems.append("times and values of a signal must be finite")
    pairs = zip(times, times[1:], strict=False)
    if first := next(((before, after) for before, after in pairs if not after > before), None):
        problems.append(f"times of a signal must rise: {first[1]} s comes after {first[0]} s")
    return problems


@kernel
def knot(p, t):
    """Index of the last knot at or before `t` (s), 0 before the first."""
    k, last = 0, int(p.count) - 1
    while k < last and p.times[k + 1] <= t:
        k += 1
    return k


@kernel
def value(p, t):
    """Value at `t` (s): of the last knot at or before it for a step, between that and the next knot for the others."""
    k = knot(p, t)
    if p.join == STEP or k == int(p.count) - 1:
        return p.values[k]
    s = max(0.0, (t - p.times[k]) / (p.times[k + 1] - p.times[k]))
    if p.join == SMOOTH:
        s = s * s * s * (10.0 + s * (6.0 * s - 15.0))
    return p.values[k] + s * (p.values[k + 1] - p.values[k])


@kernel
def slope(p, t):
    """Rate of change at `t` (1/s), from the right at a knot; a step has none."""
    k = knot(p, t)
    if p.join == STEP or k == int(p.count) - 1 or t < p.times[0]:
        return 0.0
    span = p.times[k + 1] - p.times[k]
    s = (t - p.times[k]) / span
    rise = 30.0 * (s * (1.0 - s)) ** 2 if p.join == SMOOTH else 1.0
    return rise * (p.values[k + 1] - p.values[k]) / span


@kernel
def read_all(signals, values, t: float) -> None:
    """Write the values at `t` (s) of an array of SIGNALs into an array."""
    for i in range(len(signals)):
        values[i] = value(signals[i], t)


@kernel
def read_none(signals, values, t: float) -> None:
    """The same where there are none."""
