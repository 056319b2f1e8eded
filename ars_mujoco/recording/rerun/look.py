"""The look of a run: in its own colors, or as the pale ghost of a comparison."""

from dataclasses import dataclass

import numpy as np

from ars_mujoco.recording.rerun.display import CORNER_COLORS, PALETTE, rgba32


@dataclass(frozen=True)
class Look:
    """`name` stands before labels and series; `tint` (0 to 255) and `opacity` (0 to 1) make a ghost of the run."""

    name: str = ""
    tint: tuple[int, int, int] | None = None
    opacity: float = 1.0

    def label(self, text: str) -> str:
        """`text` with the run's name before it, where it has one."""
        return f"{self.name.replace('_', ' ')}: {text}" if self.name else text

    def geom_color(self, rgba: np.ndarray) -> int:
        """The color of a solid, `rgba` (4,) from 0 to 1."""
        color = self.tint or np.rint(np.asarray(rgba[:3]) * 255)
        return rgba32(color, round(255 * float(rgba[3]) * self.opacity))

    def series_color(self, corner: str | None, place: int) -> int:
        """The color of a signal: its corner's, else by its place in the plot; every signal of a ghost has its tint."""
        return rgba32(self.tint or (CORNER_COLORS[corner] if corner else PALETTE[place % len(PALETTE)]))

    @property
    def width(self) -> float:
        """The width of a plotted line, in points."""
        return 1.0 if self.tint else 1.8


OWN = Look()
GHOST_TINTS = ((176, 176, 186), (196, 164, 132), (150, 170, 140), (170, 150, 180))


def ghost(name: str, number: int) -> Look:
    """The look of the `number`-th ghost of a comparison."""
    return Look(name, GHOST_TINTS[number % len(GHOST_TINTS)], 0.35)
