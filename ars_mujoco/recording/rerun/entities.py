"""Where signals live in a Rerun file: those of one plot, one quantity or all corners share an entity."""

from collections.abc import Sequence

from ars_mujoco.recording.rerun.display import CORNERS, quantity_of
from ars_mujoco.schema.channels import Channel
from ars_mujoco.schema.plots import Tab


def corner_of(channel: str) -> str | None:
    """The corner a channel belongs to: "fl" of `fl.tire.camber`."""
    first = channel.split(".")[0]
    return first if first in CORNERS else None


def entity_of(channel: Channel, tabs: Sequence[Tab]) -> str:
    """Where a channel lives: with the others of its plot, `/signals/body/roll`; beside the plots with those of the same
    quantity, `/signals/front/power`, or of the four corners, `/signals/tire/camber`.

    Few entities: each costs as much a chunk as a thousand values.
    """
    name = channel.name
    for tab in tabs:
        for plot in tab.plots:
            if name in plot.channels:
                return f"/signals/{tab.name}/{plot.name}".replace(" ", "_")
    parts = name.split(".")
    if corner_of(name):
        return "/signals/" + "/".join(parts[1:])
    return f"/signals/{parts[0]}/{quantity_of(channel)}"


def place_of(channel: str, tabs: Sequence[Tab]) -> int:
    """The place of a channel among the series of its plot, 0 where it is in none."""
    return next((plot.channels.index(channel) for tab in tabs for plot in tab.plots if channel in plot.channels), 0)
