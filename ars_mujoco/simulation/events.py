"""Events: the moments at which conditions on a run's channels begin to hold."""

from collections.abc import Iterable, Iterator

import numpy as np

from ars_mujoco.recording.recording import Event, Recording
from ars_mujoco.schema.events import Condition

QUIET = 0.25  # s for which a condition must have been gone before it is told again


class Watch:
    """Finds the events of `conditions` chunk by chunk; one that flickers is told once, one on no channel never."""

    def __init__(self, conditions: Iterable[Condition]):
        self._last_held = dict.fromkeys(conditions, -np.inf)  # s

    def events(self, chunk: Recording) -> list[Event]:
        """The events that begin in `chunk`, in the order of time."""
        found = [event for condition in self._last_held for event in self._onsets(condition, chunk)]
        return sorted(found, key=lambda event: event.time)

    def _onsets(self, condition: Condition, chunk: Recording) -> Iterator[Event]:
        if condition.channel not in chunk.channels:
            return
        held = chunk.time[condition.holds(chunk[condition.channel])]
        if held.size:
            begins = np.diff(held, prepend=self._last_held[condition]) > QUIET
            self._last_held[condition] = held[-1]
            yield from (Event(float(time), condition.level, condition.text) for time in held[begins])
