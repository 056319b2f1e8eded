"""Parameter box: the uncertain parameters of the paper's Table 2 and the points that an analysis visits in it."""

from collections.abc import Iterator
from itertools import product

import numpy as np

from ars_mujoco.analysis.loop import RPM

TABLE_2 = {  # least and greatest value, SI
    "leakage": (4e-13, 2e-12),  # m^3/s/Pa  k_Li
    "capacitance": (4e-14, 8e-14),  # m^3/Pa  C_H
    "inertia": (0.1, 0.25),  # kg m^2  Theta
    "viscous_friction": (6.5, 26.5),  # Nms/rad  r_v
    "speed": (1500 * RPM, 6000 * RPM),  # rad/s  n
}
MIDDLE = {name: 0.5 * sum(ends) for name, ends in TABLE_2.items()}
PLANT = ("leakage", "capacitance", "inertia", "viscous_friction")  # what the hydraulic poles depend on

Point = dict[str, float]


def grid(names: tuple[str, ...], levels: int = 2) -> Iterator[Point]:
    """Points of the box over `names`, `levels` values a parameter with both ends; two levels are the corners."""
    axes = [np.linspace(*TABLE_2[name], levels).tolist() for name in names]
    return (dict(zip(names, values, strict=True)) for values in product(*axes))


def one_at_a_time(names: tuple[str, ...], levels: int = 2) -> Iterator[Point]:
    """Points with one of `names` off the box's middle, and the rest on it."""
    return (MIDDLE | {name: value} for name in names for value in np.linspace(*TABLE_2[name], levels).tolist())
