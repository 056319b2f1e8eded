"""The ground under a run: a grid around the path driven so far, and the path itself."""

import numpy as np
import rerun as rr

ROAD_SPACING, RIG_SPACING = 10.0, 1.0  # m between the lines of the grid, under a car and under a rig that stands
REACH = 6  # spacings of grid around the path
GRID_COLOR = (110, 116, 126, 110)
TRAIL_COLOR = (255, 213, 79, 200)
# in lengths, not in points of the screen: Rerun draws a long line that starts far away as wide there as near
GRID_RADIUS, TRAIL_RADIUS = 0.002, 0.003  # spacings
TRAIL_STEP = 10  # poses between the points of the trail: 3 m at 120 km/h


class Ground:
    """The ground below `root`, drawn again as the path grows: the last static value stands."""

    def __init__(self, stream: rr.RecordingStream, root: str, spacing: float):
        self.stream, self.entity, self.spacing = stream, f"{root}/world/scene", spacing
        self.path = np.zeros((0, 2))

    def append(self, position: np.ndarray) -> None:
        """`position` (m, 3) of the body, m."""
        if not len(position):
            return
        self.path = np.vstack((self.path, position[::TRAIL_STEP, :2]))
        trail = np.column_stack((self.path, np.full(len(self.path), 0.01)))
        self._log("trail", [trail], TRAIL_COLOR, TRAIL_RADIUS)
        self._log("grid", self._grid(), GRID_COLOR, GRID_RADIUS)

    def _log(self, name: str, strips: list | np.ndarray, color: tuple, radius: float) -> None:
        lines = rr.LineStrips3D(strips, colors=[color], radii=radius * self.spacing)
        self.stream.log(f"{self.entity}/{name}", lines, static=True)

    def _grid(self) -> np.ndarray:
        """Lines (n, 2, 3) around the path."""
        low = (np.floor(self.path.min(0) / self.spacing) - REACH) * self.spacing
        high = (np.ceil(self.path.max(0) / self.spacing) + REACH) * self.spacing
        x, y = (np.arange(low[i], high[i] + self.spacing / 2, self.spacing) for i in (0, 1))
        along_y = [[(value, low[1], 0), (value, high[1], 0)] for value in x]
        along_x = [[(low[0], value, 0), (high[0], value, 0)] for value in y]
        return np.array(along_y + along_x)
