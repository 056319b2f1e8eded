"""The plots of a recording: which signals stand together, under which tab; and where each signal lives in the file."""

from collections.abc import Iterable
from dataclasses import dataclass

from ars_mujoco.recording.rerun.display import CORNERS, quantity_of
from ars_mujoco.schema.channels import Channel


@dataclass(frozen=True)
class Plot:
    """One time axis, one unit: the `channels` that a run has of those named here."""

    name: str
    channels: tuple[str, ...]


@dataclass(frozen=True)
class Tab:
    """At most three plots below each other."""

    name: str
    plots: tuple[Plot, ...]


def _corners(signal: str) -> tuple[str, ...]:
    return tuple(f"{corner}.{signal}" for corner in CORNERS)


def _axles(*signals: str) -> tuple[str, ...]:
    return tuple(f"{axle}.{signal}" for signal in signals for axle in ("front", "rear"))


def _axle_tab(name: str, prefix: str) -> Tab:
    return Tab(
        name,
        (
            Plot("bar angle", (f"{prefix}bar.command", f"{prefix}bar.angle", f"{prefix}bar.twist")),
            Plot("bar torque", (f"{prefix}bar.torque",)),
            Plot("motor pressure", (f"{prefix}motor.pressure",)),
        ),
    )


def _side_pressures(axle: str) -> Plot:
    sides = ("motor.pressure_a", "motor.pressure_b", "charge.pressure")
    return Plot(f"{axle} pressures", tuple(f"{axle}.{signal}" for signal in sides))


def _energy_plots(expand) -> tuple[Plot, ...]:
    return (
        Plot("power", expand("pump.shaft_power", "motor.output_power")),
        Plot("losses", expand("pump.loss_power", "motor.friction_power", "relief.power")),
        Plot("energy since the start", expand("energy.shaft", "energy.recovered")),
    )


TABS = (
    Tab(
        "body",
        (
            Plot("roll", ("body.roll",)),
            Plot("lateral acceleration", ("body.lateral_acceleration", "sensor.lateral_acceleration")),
            Plot("yaw rate", ("body.yaw_rate",)),
        ),
    ),
    _axle_tab("front axle", "front."),
    _axle_tab("rear axle", "rear."),
    _axle_tab("bar", ""),
    Tab(
        "circuit",
        (
            _side_pressures("front"),
            _side_pressures("rear"),
            Plot("valve openings", _axles("valve.bypass", "valve.fail_safe")),
        ),
    ),
    Tab(
        "pump",
        (
            Plot("pump stroke", _axles("pump.stroke")),
            Plot("pump flow", _axles("pump.flow")),
            Plot("travel of the ends", ("ends.travel",)),
        ),
    ),
    Tab("energy", _energy_plots(_axles)),
    Tab("pump energy", _energy_plots(lambda *signals: signals)),
    Tab(
        "drive",
        (
            Plot("pump speed", _axles("pump.speed")),
            Plot("gear", ("drive.gear",)),
            Plot("power of the drive", ("drive.power",)),
        ),
    ),
    Tab(
        "tires",
        (
            Plot("tire vertical force", _corners("tire.vertical_force")),
            Plot("tire lateral force", _corners("tire.lateral_force")),
            Plot("tire slip angle", _corners("tire.slip_angle")),
        ),
    ),
    Tab(
        "driving",
        (
            Plot("speed", ("body.speed",)),
            Plot("steering", ("driver.steer",)),
            Plot("sideslip", ("body.sideslip",)),
        ),
    ),
)


def tabs_of(channels: Iterable[str]) -> list[Tab]:
    """The tabs, and the plots in them, of which a run has at least one channel."""
    found = []
    for tab in TABS:
        plots = [Plot(plot.name, tuple(c for c in plot.channels if c in channels)) for plot in tab.plots]
        plots = tuple(plot for plot in plots if plot.channels)
        if plots:
            found.append(Tab(tab.name, plots))
    return found


def corner_of(channel: str) -> str | None:
    """The corner a channel belongs to: "fl" of `fl.tire.camber`."""
    first = channel.split(".")[0]
    return first if first in CORNERS else None


def entity_of(channel: Channel) -> str:
    """Where a channel lives: with the others of its plot, `/signals/body/roll`; beside the plots with those of the same
    quantity, `/signals/front/power`, or of the four corners, `/signals/tire/camber`.

    Few entities: each costs as much a chunk as a thousand values.
    """
    name = channel.name
    for tab in TABS:
        for plot in tab.plots:
            if name in plot.channels:
                return f"/signals/{tab.name}/{plot.name}".replace(" ", "_")
    parts = name.split(".")
    if corner_of(name):
        return "/signals/" + "/".join(parts[1:])
    return f"/signals/{parts[0]}/{quantity_of(channel)}"


def place_of(channel: str) -> int:
    """The place of a channel among the series of its plot, 0 where it is in none."""
    return next((plot.channels.index(channel) for tab in TABS for plot in tab.plots if channel in plot.channels), 0)
