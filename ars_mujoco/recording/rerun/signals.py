"""A run's signals in Rerun, in display units: channels of one plot, one quantity or all corners share an entity."""

from collections.abc import Sequence

import numpy as np

from ars_mujoco.recording.rerun.batch import Batch
from ars_mujoco.recording.rerun.display import axis_range, series_name, unit_and_factor
from ars_mujoco.recording.rerun.entities import corner_of, entity_of, place_of
from ars_mujoco.recording.rerun.look import Look
from ars_mujoco.schema.channels import Channel
from ars_mujoco.schema.plots import Plot, Tab


class Signals:
    """The signals of a run below `root`, placed by its `tabs`; knows the extremes of what was added so far."""

    def __init__(self, channels: dict[str, Channel], tabs: Sequence[Tab], root: str, look: Look):
        self.channels, self.tabs, self.root, self.look = channels, tabs, root, look
        self.columns = {name: column for column, name in enumerate(channels)}
        self.factors = np.array([unit_and_factor(channel)[1] for channel in channels.values()])
        self.entities: dict[str, list[str]] = {}
        for channel in channels.values():
            self.entities.setdefault(root + entity_of(channel, tabs), []).append(channel.name)
        self.low = np.full(len(channels), np.inf)
        self.high = np.full(len(channels), -np.inf)

    def style(self, batch: Batch) -> None:
        """Names, colors and widths of the series, once."""
        for entity, names in self.entities.items():
            labels = [self.look.label(series_name(self.channels[name])) for name in names]
            colors = [self.look.series_color(corner_of(name), place_of(name, self.tabs)) for name in names]
            batch.add(entity, "SeriesLines:names", np.array([labels]))
            batch.add(entity, "SeriesLines:colors", np.array([colors], np.uint32))
            batch.add(entity, "SeriesLines:widths", np.full((1, len(names)), self.look.width, np.float32))

    def append(self, batch: Batch, values: np.ndarray) -> None:
        """`values` (rows, nchannel) SI at the times of the batch."""
        shown = values * self.factors
        self.low = np.fmin(self.low, np.fmin.reduce(shown))
        self.high = np.fmax(self.high, np.fmax.reduce(shown))
        for entity, names in self.entities.items():
            batch.add(entity, "Scalars:scalars", shown[:, [self.columns[name] for name in names]])

    def extremes(self, plot: Plot) -> tuple[float, float]:
        """Least and greatest value of the plot's channels, in the unit they are shown in."""
        columns = [self.columns[name] for name in plot.channels if name in self.columns]
        return min(self.low[columns], default=np.inf), max(self.high[columns], default=-np.inf)

    def paths(self, plot: Plot) -> list[str]:
        """The entities of the plot, each once."""
        known = [self.channels[name] for name in plot.channels if name in self.channels]
        return list(dict.fromkeys(self.root + entity_of(channel, self.tabs) for channel in known))


def plot_range(runs: list[Signals], plot: Plot) -> tuple[float, float]:
    """The y range of a plot over all `runs`."""
    lows, highs = zip(*(run.extremes(plot) for run in runs), strict=True)
    channel = next(run.channels[name] for run in runs for name in plot.channels if name in run.channels)
    return axis_range(min(lows), max(highs), unit_and_factor(channel)[0])
