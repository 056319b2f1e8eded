"""Limits on metrics: how they are written, kept and missed."""

import pytest

from ars_mujoco.metrics.expectation import Limit, check, limits
from ars_mujoco.metrics.metric import Value


@pytest.mark.parametrize(
    ("metric", "text", "expected"),
    [
        ("roll_reduction_factor", ">= 7", [(">=", 7.0)]),
        ("roll_reduction_factor", "<=1e3", [("<=", 1000.0)]),
        ("target_map_error", "<= 0.15 deg", [("<=", 0.15)]),
        ("target_map_error", "<= 0.01 rad", [("<=", 0.5729578)]),
        ("shaft_energy", "<= 3.5 kJ", [("<=", 3500.0)]),
        ("peak_lateral_acceleration", "0.60 +- 0.02 g", [(">=", 0.58), ("<=", 0.62)]),
        ("roll_gradient", "6 +- 0.5 deg/g", [(">=", 5.5), ("<=", 6.5)]),
    ],
)
def test_limits_are_read_in_the_metrics_unit(metric, text, expected):
    assert [limit.relation for limit in limits(metric, text)] == [relation for relation, _ in expected]
    assert [limit.bound for limit in limits(metric, text)] == pytest.approx([bound for _, bound in expected])


@pytest.mark.parametrize(
    ("metric", "text", "complaint"),
    [
        ("roll_reduction_facto", ">= 7", "did you mean 'roll_reduction_factor'"),
        ("roll_reduction_factor", "about 7", "written like"),
        ("roll_reduction_factor", "", "written like"),
        ("roll_reduction_factor", ">= seven", "not a finite number"),
        ("roll_reduction_factor", ">= nan", "not a finite number"),
        ("roll_reduction_factor", ">= 7 deg", "wrong unit"),
        ("target_map_error", "<= 0.15", "needs a unit"),
        ("shaft_energy", "<= 3 bar", "wrong unit"),
        ("peak_lateral_acceleration", "0.6 +- g", "not a finite number"),
    ],
)
def test_a_limit_that_cannot_be_read_says_what_is_allowed(metric, text, complaint):
    with pytest.raises(ValueError, match=complaint):
        limits(metric, text)


def test_kept_limits_give_no_failure():
    values = {"roll_reduction_factor": Value(7.0, "1"), "peak_lateral_acceleration": Value(0.61, "g")}
    expectations = {
        "roll_reduction_factor": limits("roll_reduction_factor", ">= 7"),
        "peak_lateral_acceleration": limits("peak_lateral_acceleration", "0.60 +- 0.02 g"),
    }
    assert check(expectations, values) == []


def test_a_missed_limit_is_told_with_both_figures():
    (failure,) = check({"target_map_error": [Limit("<=", 0.15)]}, {"target_map_error": Value(0.2, "deg")})
    assert str(failure) == "target_map_error is 0.2 deg, expected <= 0.15 deg"


def test_a_metric_without_a_value_misses_its_limit_for_its_reason():
    value = Value(None, "1", "no reference run to compare with")
    (failure,) = check({"roll_reduction_factor": [Limit(">=", 7.0)]}, {"roll_reduction_factor": value})
    assert str(failure) == "roll_reduction_factor is none (no reference run to compare with), expected >= 7"


def test_not_a_number_keeps_no_limit():
    for relation in (">=", "<="):
        assert not Limit(relation, 1.0).holds(Value(float("nan"), "1"))


def test_a_lower_bound_can_keep_a_lower_limit_only():
    value = Value(80.0, "1", at_least=True)
    assert Limit(">=", 7.0).holds(value)
    assert not Limit("<=", 100.0).holds(value)
