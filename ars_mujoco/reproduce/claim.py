"""Claim: what the paper says at one place, what the running code says of it, and the verdict.

A group declares its claims as functions, each of which turns the `Evidence` into a `Finding`:

    GROUP = Group("Sizing")

    @GROUP.claim("Table 1", "180 bar on the vane motor are 1400 Nm.")
    def motor_torque(evidence): ...
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.reproduce.evidence import Evidence

ROUNDING = 0.006  # relative; numbers no further apart agree as far as the paper prints them
CLOSE = 0.03  # relative; numbers no further apart are reproduced within their distance


class Kind(StrEnum):
    """What can come out of a claim."""

    REPRODUCED = "reproduced"
    WITHIN = "reproduced within"
    HOLDS_ONLY = "holds only"
    DOES_NOT_FOLLOW = "does not follow"
    CONTRADICTS_ITSELF = "contradicts itself"
    NOT_CHECKABLE = "not checkable"


@dataclass(frozen=True)
class Verdict:
    """A kind and how it goes on: within what, only where, from what it does not follow."""

    kind: Kind
    detail: str = ""

    def __str__(self) -> str:
        return f"{self.kind} {self.detail}".rstrip()


REPRODUCED, CONTRADICTS_ITSELF = Verdict(Kind.REPRODUCED), Verdict(Kind.CONTRADICTS_ITSELF)


@dataclass(frozen=True)
class Number:
    """A number of a claim: its `value` in `unit`, the (least, greatest) of a range, or None where there is none."""

    name: str
    value: float | tuple[float, float] | None
    unit: str = "1"

    @property
    def text(self) -> str:
        """The value with its unit."""
        if self.value is None:
            return "none"
        value = " to ".join(map(_digits, np.atleast_1d(self.value).tolist()))
        return value if self.unit == "1" else f"{value} {self.unit}"

    def __str__(self) -> str:
        return f"{self.name} {self.text}"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What came out of a claim; `paper` and `ours` are the numbers held against each other."""

    paper: tuple[Number, ...] = ()
    ours: tuple[Number, ...]
    verdict: Verdict
    why: str
    figure: Callable[[], Figure] | None = None


@dataclass(frozen=True, kw_only=True)
class Claim(Finding):
    """A finding with what it is about: `id` is its anchor, `place` its place in the paper, `text` what it says."""

    id: str
    place: str
    text: str

    def record(self) -> dict[str, Any]:
        """The claim as JSON holds it."""
        return {
            "id": self.id,
            "place": self.place,
            "text": self.text,
            "paper": [_number(each) for each in self.paper],
            "ours": [_number(each) for each in self.ours],
            "told": "; ".join(map(str, self.ours)),
            "verdict": {"kind": self.verdict.kind.value, "detail": self.verdict.detail},
            "why": self.why,
        }


@dataclass(frozen=True)
class Group:
    """Claims under one `title`, in the order of their declaration."""

    title: str
    functions: dict[str, Callable[[Evidence], Claim]] = field(default_factory=dict)

    def claim(self, place: str, text: str) -> Callable:
        """Declare the decorated function of the evidence as the claim of its own name."""

        def declare(function: Callable[[Evidence], Finding]) -> Callable[[Evidence], Claim]:
            def find(evidence: Evidence) -> Claim:
                return Claim(**vars(function(evidence)), id=function.__name__, place=place, text=text)

            self.functions[function.__name__] = find
            return find

        return declare

    def claims(self, evidence: Evidence) -> Iterator[Claim]:
        """Every claim, held against the evidence."""
        return (function(evidence) for function in self.functions.values())


def apart(paper, ours) -> float:
    """Largest relative distance of numbers or ranges of the same shape."""
    return float(np.max(np.abs(np.divide(ours, paper) - 1.0)))


def agreement(paper, ours, otherwise: Verdict) -> Verdict:
    """REPRODUCED to the digits printed, or within the distance where that is small, else `otherwise`."""
    distance = apart(paper, ours)
    if distance <= ROUNDING:
        return REPRODUCED
    return Verdict(Kind.WITHIN, f"{100 * distance:.1f} %") if distance <= CLOSE else otherwise


def holds(condition: bool, otherwise: Verdict) -> Verdict:
    """REPRODUCED where the condition holds, else `otherwise`."""
    return REPRODUCED if condition else otherwise


def does_not_follow(source: str) -> Verdict:
    """The verdict that a claim does not follow from its `source`."""
    return Verdict(Kind.DOES_NOT_FOLLOW, f"from {source}")


def holds_only(where: str) -> Verdict:
    """The verdict that a claim holds in part: only `where`."""
    return Verdict(Kind.HOLDS_ONLY, where)


def _digits(value: float) -> str:
    """Four digits; very small and very large values with an exponent."""
    if value == 0.0 or 1e-3 <= abs(value) < 1e6:
        return f"{value:.0f}" if abs(value) >= 1e4 else f"{value:.4g}"
    mantissa, exponent = f"{value:.3e}".split("e")
    return f"{float(mantissa):g}e{exponent}"


def _number(number: Number) -> dict[str, Any]:
    value = list(number.value) if isinstance(number.value, tuple) else number.value
    return {"name": number.name, "value": value, "unit": number.unit}
