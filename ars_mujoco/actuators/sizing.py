"""Sizing: what the parts of a system must be for what a car requires of it, each by its formula.

A system's folder has a `sizing.py` with a Sizing: the requirement that its own file was made for, and the dimensions
that follow from one. What a requirement does not tell, as friction and leakage, is the file's. Its module names it
`SIZING`.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from ars_mujoco.schema.errors import InputError


class Requirement(NamedTuple):
    """What is required at the bar, and what the parts run at; None where a system has no such thing."""

    torque: float  # Nm
    rate: float  # rad/s, between the bar's halves
    speed: float  # rad/s, of pump or machine at that rate
    pressure: float | None = None  # Pa, over the motor at that torque


class Dimension(NamedTuple):
    """What a part must be: `value` in SI, the unit to show it in, its formula, and what the file has, if anything."""

    name: str
    value: float
    unit: str
    formula: str
    in_file: float | None = None


class Sizing(NamedTuple):
    """Of a system: `size(file, requirement)` gives Dimensions of an axle; `file` is for what else that takes."""

    requirement: Requirement
    size: Callable[[Any, Requirement], list[Dimension]]


def stated(requirement: Requirement, **given: float | None) -> Requirement:
    """`requirement` with what is given in its place. Raises InputError for what the system has not."""
    given = {name: value for name, value in given.items() if value is not None}
    for name in given:
        if getattr(requirement, name) is None:
            has = ", ".join(f"--{each}" for each, value in requirement._asdict().items() if value is not None)
            raise InputError(f"--{name}: the system has none; allowed: {has}")
    return requirement._replace(**given)
