"""What a recording shows and tells of the rigs themselves; what their stabilizers add stands between."""

from collections.abc import Iterable
from dataclasses import dataclass

from ars_mujoco.schema.events import Condition
from ars_mujoco.schema.plots import Plot, Tab, merged

CORNERS = {"fl": "front left", "fr": "front right", "rl": "rear left", "rr": "rear right"}


@dataclass(frozen=True)
class RigPlots:
    """Tabs of a rig that stand before and after those of its stabilizers."""

    before: tuple[Tab, ...] = ()
    after: tuple[Tab, ...] = ()

    def around(self, *groups: Iterable[Tab]) -> tuple[Tab, ...]:
        """The tabs of the rig with those of all `groups` between, equal names merged."""
        return merged(self.before, *groups, self.after)


def _corners(signal: str) -> tuple[str, ...]:
    return tuple(f"{corner}.{signal}" for corner in CORNERS)


BODY = Tab(
    "body",
    (
        Plot("roll", ("body.roll",)),
        Plot("lateral acceleration", ("body.lateral_acceleration", "sensor.lateral_acceleration")),
        Plot("yaw rate", ("body.yaw_rate",)),
    ),
)
TIRES = Tab(
    "tires",
    (
        Plot("tire vertical force", _corners("tire.vertical_force")),
        Plot("tire lateral force", _corners("tire.lateral_force")),
        Plot("tire slip angle", _corners("tire.slip_angle")),
    ),
)
DRIVING = Tab(
    "driving",
    (
        Plot("speed", ("body.speed",)),
        Plot("steering", ("driver.steer",)),
        Plot("sideslip", ("body.sideslip",)),
    ),
)
ENDS = Tab("ends", (Plot("travel of the ends", ("ends.travel",)),))

SEDAN = RigPlots(before=(BODY,), after=(TIRES, DRIVING))
ROLL_PLANE = RigPlots(before=(BODY,))
BENCH = RigPlots(after=(ENDS,))

SEDAN_EVENTS = tuple(
    Condition(f"{corner}.tire.vertical_force", "at_most", 0.0, "WARN", f"the {name} wheel lifts off")
    for corner, name in CORNERS.items()
)
