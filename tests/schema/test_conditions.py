"""Conditions as data."""

import numpy as np
import pytest

from ars_mujoco.schema.events import Condition

VALUES = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])


@pytest.mark.parametrize(
    ("relation", "of_size", "where"),
    [
        ("above", False, [2.0]),
        ("at_least", False, [1.0, 2.0]),
        ("at_most", False, [-2.0, -1.0, 0.0, 1.0]),
        ("below", False, [-2.0, -1.0, 0.0]),
        ("above", True, [-2.0, 2.0]),
        ("at_least", True, [-2.0, -1.0, 1.0, 2.0]),
        ("below", True, [0.0]),
    ],
)
def test_a_condition_holds_where_its_relation_does(relation, of_size, where):
    condition = Condition("x", relation, 1.0, "INFO", "it happens", of_size)
    assert VALUES[condition.holds(VALUES)].tolist() == where


def test_what_is_not_finite_holds_nothing():
    assert not Condition("x", "at_most", 1.0, "INFO", "").holds(np.array([np.nan])).any()


@pytest.mark.parametrize(
    ("relation", "level", "complaint"),
    [
        ("at_leest", "INFO", "x: unknown relation 'at_leest'; did you mean 'at_least'?; known: above, at_least"),
        ("above", "WARNING", "x: unknown level 'WARNING'; did you mean 'WARN'?; known: INFO, WARN, ERROR"),
    ],
)
def test_a_condition_that_nobody_understands_is_refused(relation, level, complaint):
    with pytest.raises(ValueError) as refusal:
        Condition("x", relation, 1.0, level, "")
    assert str(refusal.value).startswith(complaint)
