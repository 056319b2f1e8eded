"""Events: when conditions on a run's channels begin to hold."""

import numpy as np

from ars_mujoco.recording.recording import Recording
from ars_mujoco.schema.channels import Channel
from ars_mujoco.schema.events import Condition
from ars_mujoco.simulation.events import Watch

TIME = np.linspace(0.0, 4.0, 4001)
FULL = Condition("pump.stroke", "at_least", 0.999, "INFO", "full stroke", of_size=True)
OPEN = Condition("relief.power", "above", 0.0, "WARN", "the relief valve opens")


def run(**signals) -> Recording:
    channels = {name.replace("_", "."): Channel(name.replace("_", "."), "", "") for name in signals}
    return Recording("made up", channels, time=TIME, values=np.column_stack(list(signals.values())))


def told(watch: Watch, *chunks: Recording) -> list[tuple[float, str]]:
    return [(round(event.time, 3), event.text) for chunk in chunks for event in watch.events(chunk)]


def between(*spans: tuple[float, float]) -> np.ndarray:
    return sum(((start <= TIME) & (stop > TIME)).astype(float) for start, stop in spans)


def test_a_condition_is_told_when_it_begins_to_hold_with_either_sign():
    stroke = between((1.0, 1.5)) - between((3.0, 3.5))
    assert told(Watch([FULL]), run(pump_stroke=stroke)) == [(1.0, "full stroke"), (3.0, "full stroke")]


def test_one_that_flickers_is_told_once():
    stroke = between((1.0, 1.1), (1.2, 1.3), (1.4, 1.5), (1.9, 2.0))
    assert told(Watch([FULL]), run(pump_stroke=stroke)) == [(1.0, "full stroke"), (1.9, "full stroke")]


def test_chunks_tell_what_the_whole_tells():
    whole = run(pump_stroke=between((1.0, 2.5)), relief_power=between((0.5, 0.6), (1.99, 3.0)))
    expected = [(0.5, "the relief valve opens"), (1.0, "full stroke"), (1.99, "the relief valve opens")]
    assert told(Watch([FULL, OPEN]), whole) == expected
    assert told(Watch([FULL, OPEN]), whole.part(0.0, 2.0), whole.part(2.0, 5.0)) == expected


def test_a_condition_on_what_a_run_does_not_have_is_never_told():
    assert told(Watch([FULL]), run(relief_power=TIME)) == []
