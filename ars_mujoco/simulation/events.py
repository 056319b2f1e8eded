"""Events: moments of a run that are worth a line, found in its channels."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ars_mujoco.recording.recording import Event, Recording

CORNERS = {"fl": "front left", "fr": "front right", "rl": "rear left", "rr": "rear right"}
AXLES = ("front", "rear")
FULL_STROKE = 0.999  # of the pump, from where it counts as saturated
QUIET = 0.25  # s for which a condition must have been gone before it is told again


@dataclass(frozen=True)
class Condition:
    """A condition on one channel, and what to say when it begins to hold."""

    channel: str
    holds: Callable[[np.ndarray], np.ndarray]
    level: str
    text: str


CONDITIONS = (
    *(
        Condition(f"{corner}.tire.vertical_force", lambda force: force <= 0.0, "WARN", f"the {name} wheel lifts off")
        for corner, name in CORNERS.items()
    ),
    *(
        Condition(
            f"{axle}.pump.stroke", lambda x: np.abs(x) >= FULL_STROKE, "INFO", f"the {axle} pump is at full stroke"
        )
        for axle in AXLES
    ),
    *(
        Condition(
            f"{axle}.pump.extrapolation", lambda x: x > 0.0, "WARN", f"the {axle} pump leaves the range of its losses"
        )
        for axle in AXLES
    ),
    *(
        Condition(f"{axle}.relief.power", lambda power: power > 0.0, "WARN", f"the {axle} relief valve opens")
        for axle in AXLES
    ),
)


class Watch:
    """Finds events chunk by chunk; a condition that flickers is told once."""

    def __init__(self):
        self._last_held = dict.fromkeys(CONDITIONS, -np.inf)  # s

    def events(self, chunk: Recording) -> list[Event]:
        """The events that begin in `chunk`, in the order of time."""
        found = [event for condition in CONDITIONS for event in self._onsets(condition, chunk)]
        return sorted(found, key=lambda event: event.time)

    def _onsets(self, condition: Condition, chunk: Recording) -> Iterator[Event]:
        if condition.channel not in chunk.channels:
            return
        held = chunk.time[condition.holds(chunk[condition.channel])]
        if held.size:
            begins = np.diff(held, prepend=self._last_held[condition]) > QUIET
            self._last_held[condition] = held[-1]
            yield from (Event(float(time), condition.level, condition.text) for time in held[begins])
