"""The page of a run: what it says of each metric."""

import pytest

from ars_mujoco.recording.recording import Recording
from ars_mujoco.recording.rerun.notes import notes


@pytest.mark.parametrize(
    ("metric", "line"),
    [
        ({"value": 3.45678901, "unit": "deg"}, "| m | 3.4568 deg |"),
        ({"value": 7.0, "unit": "1", "at_least": True}, "| m | >= 7 |"),
        ({"value": None, "unit": "1", "reason": "too little roll"}, "| m | none: too little roll |"),
        ({"value": 8.1, "unit": "1", "note": "peaks differ by 3 %"}, "| m | 8.1 (peaks differ by 3 %) |"),
        (0.5, "| m | 0.5 |"),
    ],
)
def test_a_metric_is_told_with_its_unit_bound_reason_and_note(metric, line):
    assert line in notes(Recording("run", {}, metrics={"m": metric})).splitlines()


def test_the_rows_of_a_metrics_table_are_told():
    table = [{"acceleration": 0.3, "roll": 0.1}, {"acceleration": 0.6, "roll": 0.4}]
    text = notes(Recording("run", {}, metrics={"m": {"value": None, "unit": "deg/g", "table": table}}))
    assert "acceleration 0.3, roll 0.1<br>acceleration 0.6, roll 0.4" in text


def test_nested_inputs_are_told_by_dotted_names():
    text = notes(Recording("run", {}, inputs={"actuator": {"name": "passive", "front": {"stiffness": 900.0}}}))
    assert "| actuator.name | passive |" in text
    assert "| actuator.front.stiffness | 900 |" in text
