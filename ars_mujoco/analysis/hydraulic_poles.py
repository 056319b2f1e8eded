"""Hydraulic poles: natural frequency and damping over the box of Table 2, beside what the paper prints (Table 3)."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ars_mujoco.analysis.figure import DARK, LIGHT, MIDDLE_GREY, label, legend_beside
from ars_mujoco.analysis.linearization import hydraulic_matrix
from ars_mujoco.analysis.loop import Loop
from ars_mujoco.analysis.parameter_box import PLANT, Point, grid, one_at_a_time

PAPER = {"frequency": [686.0, 1320.0], "damping": [0.037, 0.139]}  # Table 3, rad/s and 1
LEVELS = 5  # values a parameter: damping need not be extreme at a corner
UNITS = {"frequency": "rad/s", "damping": "1"}


def pole_pair(loop: Loop) -> tuple[float, float]:
    """(natural frequency rad/s, damping) of eq. 43, whose characteristic polynomial is s^2 + 2 d w s + w^2."""
    A = hydraulic_matrix(loop)
    frequency = math.sqrt(np.linalg.det(A))
    return frequency, -np.trace(A) / (2.0 * frequency)


def compute(loop: Loop) -> dict[str, Any]:
    """The loop's own pair, the pairs over the full box and with one parameter off its middle, and their ranges."""
    full, single = (_pairs(loop, points) for points in (grid(PLANT, LEVELS), one_at_a_time(PLANT, LEVELS)))
    frequency, damping = pole_pair(loop)
    return {
        "units": UNITS,
        "own": {"frequency": frequency, "damping": damping},
        "full_box": _ranges(full) | {"pairs": full},
        "one_at_a_time": _ranges(single) | {"pairs": single},
        "paper": PAPER,
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: the ranges beside the paper's."""
    return [
        {
            "quantity": f"hydraulic {name}, {way.replace('_', ' ')}",
            "value": "{:.{d}f} to {:.{d}f}{}".format(*result[way][name], unit, d=digits),
            "paper": "{:.{d}f} to {:.{d}f}{}".format(*PAPER[name], unit, d=digits),
        }
        for way in ("full_box", "one_at_a_time")
        for name, unit, digits in (("frequency", " rad/s", 0), ("damping", "", 3))
    ]


def draw(result: dict[str, Any]) -> Figure:
    """Damping over frequency, with the paper's range as a box."""
    figure = Figure(figsize=(8.0, 4.4), layout="constrained")
    ax = figure.subplots()
    for way, text, style in (
        ("full_box", "Table 2, full box", {"color": LIGHT, "s": 7}),
        ("one_at_a_time", "one parameter at a time", {"color": DARK, "s": 20, "marker": "D"}),
    ):
        ax.scatter(*np.transpose(result[way]["pairs"]), label=text, linewidths=0, **style)
    own = result["own"]
    ax.scatter(own["frequency"], own["damping"], marker="+", s=120, color=DARK, label="this actuator")
    (low, high), (least, most) = PAPER["frequency"], PAPER["damping"]
    size = {"width": high - low, "height": most - least}
    ax.add_patch(Rectangle((low, least), **size, fill=False, ec=MIDDLE_GREY, ls="--", label="Table 3 as printed"))
    title = "Hydraulic poles over the uncertain parameters"
    label(ax, title, "natural frequency (rad/s)", "damping ratio (1)", legend=False)
    legend_beside(figure, ax)
    return figure


def _pairs(loop: Loop, points: Iterable[Point]) -> list[tuple[float, float]]:
    return [pole_pair(loop.at(point)) for point in points]


def _ranges(pairs: list[tuple[float, float]]) -> dict[str, list[float]]:
    least, most = np.min(pairs, axis=0), np.max(pairs, axis=0)
    return {name: [float(least[i]), float(most[i])] for i, name in enumerate(UNITS)}
