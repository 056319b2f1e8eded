"""Oscillation: a sine of one frequency, or one whose frequency sweeps from a first to a last."""

import math
from functools import cache, partial
from typing import Annotated

import numpy as np
from pydantic import BeforeValidator, ValidationInfo, field_validator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, derived, number, quantity

HIGHEST = 100.0  # Hz; the parabolas over steps of 1 ms that the circuit gets are then within 0.2 % of the amplitude
SPACINGS = ("linear", "logarithmic")
LINEAR, LOGARITHMIC = 0.0, 1.0

# the frequency is frequency + rise tau, or frequency exp(growth tau), tau being the time since the start
OSCILLATION = np.dtype([(name, "f8") for name in "amplitude offset phase start end frequency rise growth".split()])


class Sine(Parameters):
    """offset + amplitude sin(2 pi frequency (t - start) + phase); held before its start and after its last period."""

    amplitude: float
    frequency: float = quantity("Hz", gt=0, le=HIGHEST)
    phase: float = quantity("rad", default=0.0)
    offset: float = 0.0
    start: float = quantity("s", ge=0, default=0.0)
    periods: float | None = number(gt=0, default=None)  # else to the end of the cycle

    def oscillation(self) -> tuple[float, ...]:
        """The numbers of OSCILLATION."""
        end = self.start + self.periods / self.frequency if self.periods else math.inf
        return self.amplitude, self.offset, self.phase, self.start, end, self.frequency, 0.0, 0.0


class Sweep(Parameters):
    """A sine whose frequency goes from the first to the last within the duration; held before and after."""

    amplitude: float
    spacing: Annotated[float, BeforeValidator(lambda spacing: _spacing(spacing))] = LOGARITHMIC
    first_frequency: float = quantity("Hz", ge=0, le=HIGHEST)
    last_frequency: float = quantity("Hz", ge=0, le=HIGHEST)
    duration: float = quantity("s", gt=0)
    offset: float = 0.0
    start: float = quantity("s", ge=0, default=0.0)

    @field_validator("first_frequency", "last_frequency")
    @classmethod
    def _has_a_logarithm(cls, frequency, info: ValidationInfo):
        if frequency == 0.0 and info.data.get("spacing") == LOGARITHMIC:
            raise ValueError("a logarithmic sweep never reaches 0 Hz; allowed: more, or spacing: linear")
        return frequency

    @field_validator("last_frequency")
    @classmethod
    def _differs_from_the_first(cls, frequency, info: ValidationInfo):
        if frequency == info.data.get("first_frequency"):
            raise ValueError("must differ from the first frequency; one that stays is a sine's")
        return frequency

    def oscillation(self) -> tuple[float, ...]:
        """The numbers of OSCILLATION."""
        first, last, duration = self.first_frequency, self.last_frequency, self.duration
        if self.spacing == LOGARITHMIC:
            rise, growth = 0.0, math.log(last / first) / duration
        else:
            rise, growth = (last - first) / duration, 0.0
        return self.amplitude, self.offset, 0.0, self.start, self.start + duration, first, rise, growth


@cache
def SineOf(unit: str) -> type[Sine]:  # noqa: N802 (reads as a type)
    """A Sine of a quantity of the dimension of `unit`."""
    return derived(
        Sine,
        f"SineOf({unit})",
        partial(SineOf, unit),
        amplitude=(float, quantity(unit)),
        offset=(float, quantity(unit, default=0.0)),
    )


@cache
def SweepOf(unit: str) -> type[Sweep]:  # noqa: N802
    """A Sweep of a quantity of the dimension of `unit`."""
    return derived(
        Sweep,
        f"SweepOf({unit})",
        partial(SweepOf, unit),
        amplitude=(float, quantity(unit)),
        offset=(float, quantity(unit, default=0.0)),
    )


@kernel
def oscillating(p, t: float) -> float:
    """Value at `t` (s) of an OSCILLATION; its phase is the integral of the frequency since the start."""
    since = min(max(t, p.start), p.end) - p.start
    if p.growth != 0.0:
        turns = p.frequency * math.expm1(p.growth * since) / p.growth
    else:
        turns = since * (p.frequency + 0.5 * p.rise * since)
    return p.offset + p.amplitude * math.sin(2.0 * math.pi * turns + p.phase)


def _spacing(spacing: object) -> float:
    if spacing not in SPACINGS:
        raise ValueError(f"unknown; allowed: {', '.join(SPACINGS)}")
    return float(SPACINGS.index(spacing))
