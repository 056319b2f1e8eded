"""Claims, their numbers, and what makes a verdict."""

import json

import pytest

from ars_mujoco.reproduce.claim import (
    REPRODUCED,
    Finding,
    Group,
    Kind,
    Number,
    agreement,
    apart,
    does_not_follow,
    holds,
    holds_only,
)

OTHERWISE = does_not_follow("Table 2")


@pytest.mark.parametrize(
    ("paper", "ours", "told"),
    [
        (1400.0, 1400.0, "reproduced"),
        (1400.0, 1405.0, "reproduced"),
        (1400.0, 1428.0, "reproduced within 2.0 %"),
        (1400.0, 1501.0, "does not follow from Table 2"),
        ((686.0, 1320.0), (686.0, 1324.0), "reproduced"),
        ((686.0, 1320.0), (590.0, 1320.0), "does not follow from Table 2"),
    ],
)
def test_numbers_agree_to_the_digits_printed_within_a_distance_or_not(paper, ours, told):
    assert str(agreement(paper, ours, OTHERWISE)) == told


def test_the_distance_of_ranges_is_that_of_their_worse_end():
    assert apart((10.0, 20.0), (11.0, 20.0)) == pytest.approx(0.1)
    assert apart((10.0, 20.0), (11.0, 15.0)) == pytest.approx(0.25)


def test_a_condition_decides():
    assert holds(True, OTHERWISE) == REPRODUCED
    assert holds(False, holds_only("at 3000 rpm")).kind == Kind.HOLDS_ONLY


@pytest.mark.parametrize(
    ("number", "told"),
    [
        (Number("torque", 1501.13, "Nm"), "torque 1501 Nm"),
        (Number("frequency", (400.0, 12600.0), "Hz"), "frequency 400 to 12600 Hz"),
        (Number("capacitance", 1.17e-13, "m^3/Pa"), "capacitance 1.17e-13 m^3/Pa"),
        (Number("damping", 0.06034), "damping 0.06034"),
        (Number("share", 0.0, "%"), "share 0 %"),
        (Number("bandwidth", None, "Hz"), "bandwidth none"),
    ],
)
def test_numbers_are_told_with_four_digits_and_their_unit(number, told):
    assert str(number) == told


def test_a_claim_is_one_function_of_its_group():
    group = Group("Sizes")

    @group.claim("Table 1", "Two and two are five.")
    def sum_of_two(evidence):
        ours = (Number("sum", (4.0, evidence)),)
        return Finding(paper=(Number("sum", 5.0),), ours=ours, verdict=OTHERWISE, why="Count.")

    (claim,) = group.claims(3.0)
    assert (claim.id, claim.place, claim.text) == ("sum_of_two", "Table 1", "Two and two are five.")
    assert json.loads(json.dumps(claim.record())) == {
        "id": "sum_of_two",
        "place": "Table 1",
        "text": "Two and two are five.",
        "paper": [{"name": "sum", "value": 5.0, "unit": "1"}],
        "ours": [{"name": "sum", "value": [4.0, 3.0], "unit": "1"}],
        "told": "sum 4 to 3",
        "verdict": {"kind": "does not follow", "detail": "from Table 2"},
        "why": "Count.",
    }
