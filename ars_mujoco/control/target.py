"""Target: the roll that is wanted over lateral acceleration, knots joined by straight lines."""

from itertools import pairwise
from typing import Annotated

import numpy as np
from pydantic import AfterValidator

from ars_mujoco.control.reference_map import KNOTS
from ars_mujoco.schema.units import Unit

FEWEST, MOST = 2, KNOTS - 1  # knots; the reference map needs one more row, where it ends

Knots = tuple[tuple[float, float], ...]


def target_roll(knots: Knots, lateral_acceleration: np.ndarray | float) -> np.ndarray | float:
    """Wanted roll (rad) at lateral accelerations (m/s^2, >= 0); beyond the last knot its slope goes on."""
    accelerations, rolls = np.transpose(knots)
    last = np.clip(np.searchsorted(accelerations, lateral_acceleration, side="right"), 1, len(knots) - 1)
    x0, y0, x1, y1 = accelerations[last - 1], rolls[last - 1], accelerations[last], rolls[last]
    return y0 + (y1 - y0) * (lateral_acceleration - x0) / (x1 - x0)


def _check(knots: Knots) -> Knots:
    problems = []
    if not FEWEST <= len(knots) <= MOST:
        problems.append(f"a target has {FEWEST} to {MOST} knots, not {len(knots)}")
    if knots and knots[0] != (0.0, 0.0):
        problems.append("a target starts at [0 g, 0 deg]: it is odd, left as right")
    for (before, _), (after, _) in pairwise(knots):
        if not after > before:
            problems.append(
                f"lateral accelerations of a target must rise: {after:g} m/s^2 comes after {before:g} m/s^2"
            )
    if problems:
        raise ValueError("; ".join(problems))
    return knots


Target = Annotated[
    tuple[tuple[Annotated[float, Unit("m/s^2", ge=0)], Annotated[float, Unit("rad")]], ...], AfterValidator(_check)
]
