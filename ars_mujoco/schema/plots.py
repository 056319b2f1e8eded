"""Plots: which channels stand together, and under which tab, as plain data that rigs and actuators declare."""

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Plot:
    """One time axis, one unit: the `channels` that a run has of those named here, each with its own colour."""

    name: str
    channels: tuple[str, ...]


@dataclass(frozen=True)
class Tab:
    """A few plots below each other, three at most where they are to be read."""

    name: str
    plots: tuple[Plot, ...]


def axles(*signals: str) -> tuple[str, ...]:
    """Each of `signals` of the front axle and of the rear."""
    return tuple(f"{axle}.{signal}" for signal in signals for axle in ("front", "rear"))


def merged(*groups: Iterable[Tab]) -> tuple[Tab, ...]:
    """The tabs of all `groups`: those of one name are one, and so are plots of one name in a tab, each where it first
    appears.
    """
    found: dict[str, dict[str, dict[str, None]]] = {}  # the channels, as keys, of a plot of a tab
    for tab in (tab for group in groups for tab in group):
        plots = found.setdefault(tab.name, {})
        for plot in tab.plots:
            plots.setdefault(plot.name, {}).update(dict.fromkeys(plot.channels))
    return tuple(
        Tab(name, tuple(Plot(plot, tuple(channels)) for plot, channels in plots.items()))
        for name, plots in found.items()
    )


def recorded(tabs: Iterable[Tab], channels: Iterable[str]) -> tuple[Tab, ...]:
    """`tabs` without the channels that a run does not have, and without what is empty then."""
    known, found = set(channels), []
    for tab in tabs:
        plots = [Plot(plot.name, tuple(name for name in plot.channels if name in known)) for plot in tab.plots]
        if any(plot.channels for plot in plots):
            found.append(Tab(tab.name, tuple(plot for plot in plots if plot.channels)))
    return tuple(found)
