"""The level over a car: a horizontal bar with a scale of degrees, and a bar fixed to the body that tilts against it.

From behind, half a degree and three degrees of roll are told apart at a glance; a label says the figure.
"""

from dataclasses import dataclass

import numpy as np
import rerun as rr

from ars_mujoco.recording.recording import Geom
from ars_mujoco.recording.rerun.look import Look
from ars_mujoco.recording.rerun.solids import extent

SCALE = range(-6, 7)  # deg
WIDER = 1.45  # half width of the level over that of the body
THICKNESS = 0.012  # m
GAP = 0.12  # m above the roof and behind the tail
LEVEL_COLOR = (225, 228, 232, 150)
BODY_BAR_RGBA = (1.0, 0.79, 0.16, 1.0)


@dataclass(frozen=True)
class Level:
    """Where the bars lie in the body's frame: `center` (3,) m and half width m."""

    center: np.ndarray
    half_width: float


def level_over(geoms: list[Geom]) -> Level:
    """The level that stands over and behind the solids of a body."""
    low, high = extent(geoms)
    center = np.array((low[0] - GAP, 0.0, high[2] + GAP))
    return Level(center, WIDER * max(abs(low[1]), abs(high[1])))


def log_level(stream: rr.RecordingStream, entity: str, level: Level, height: float) -> None:
    """The horizontal bar and its scale below `entity`, the car's chase; `height` m of the body at rest."""
    center = level.center + (0, 0, height)
    half_size = (THICKNESS, level.half_width, THICKNESS / 2)
    bar = rr.Boxes3D(half_sizes=[half_size], centers=[center], colors=[LEVEL_COLOR], fill_mode="solid")
    stream.log(f"{entity}/level", bar, static=True)
    stream.log(f"{entity}/scale", rr.LineStrips3D(_scale(level, center), colors=[LEVEL_COLOR], radii=-1.0), static=True)


def log_body_bar(stream: rr.RecordingStream, entity: str, level: Level, look: Look) -> None:
    """The bar that tilts with the body, below `entity`, the body."""
    color = look.geom_color(np.array(BODY_BAR_RGBA))
    bar = rr.Boxes3D(
        half_sizes=[(THICKNESS, level.half_width, THICKNESS)],
        centers=[level.center - (THICKNESS, 0, 0)],
        colors=[color],
        fill_mode="solid",
    )
    stream.log(f"{entity}/level_bar", bar, static=True)


def log_label(stream: rr.RecordingStream, entity: str, level: Level, height: float, look: Look, row: int) -> None:
    """The place of the label in the chase's frame; its text comes with the poses. `row` counts runs upward."""
    place = level.center + (0, 0, height + 0.14 + 0.16 * row)
    color = look.geom_color(np.array(BODY_BAR_RGBA)) | 0xFF
    label = rr.Points3D([place], colors=[color], radii=0.005, show_labels=True)
    stream.log(entity, label, static=True)


def _scale(level: Level, center: np.ndarray) -> np.ndarray:
    """Ticks (n, 2, 3) a degree apart at both ends, longer at 0 and at 5 degrees."""
    angle = np.radians(np.array(SCALE))
    inner = level.half_width * np.where(np.array(SCALE) % 5 == 0, 0.93, 0.965)
    ticks = []
    for side in (-1, 1):
        radii = (inner, level.half_width)
        ends = [np.column_stack((0 * angle, side * r * np.cos(angle), r * np.sin(angle))) for r in radii]
        ticks.append(np.stack(ends, 1))
    return np.concatenate(ticks) + center
