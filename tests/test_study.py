"""Every shipped cycle keeps what it expects, as `ars check` holds it."""

import pytest

from ars_mujoco import library
from ars_mujoco.expectation import check
from ars_mujoco.inputs import read_compared
from ars_mujoco.study import study


def nobody(name, share):
    """Nobody looks at the progress."""


@pytest.mark.parametrize("cycle", library.shipped("cycle"))
def test_a_shipped_cycle_keeps_its_expectations(cycle):
    runs, references = read_compared(cycle, [None])
    (result,) = study(runs, references, None, nobody)
    assert not check(runs[0].cycle.value.expect, result.metrics)


def test_a_setting_of_the_actuator_leaves_the_bar_it_is_compared_with_alone():
    runs, references = read_compared(
        "s_curve_120kmh", ["passive", "pump_controlled"], settings=["actuator.front.pump.speed=1500 rpm"]
    )
    passive, active = runs
    assert passive.actuator.overrides == ()
    assert active.actuator.overrides == ("--set actuator.front.pump.speed=1500 rpm",)
    assert [each.actuator.name for each in references] == ["locked"]
