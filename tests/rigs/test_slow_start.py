"""A car that starts slowly: its driver knows it as well as one who starts fast."""

from functools import cache

import numpy as np
import pytest
import shipped

from ars_mujoco.schema.errors import InputError
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

PULL_AWAY = """\
title: Pull away, then a bend
description: From a low speed to 80 km/h, then a left bend of 0.4 g.
rig: sedan
duration: 30 s
manoeuvre:
  kind: follow
  lateral_acceleration: {{knots: [[0 s, 0 g], [20 s, 0 g], [22 s, 0.4 g]]}}
  speed: {{join: linear, knots: [[0 s, {first} km/h], [15 s, 80 km/h]]}}
"""


@pytest.fixture(scope="module")
def pulled_away(tmp_path_factory):
    @cache
    def drive(first: float):
        path = tmp_path_factory.mktemp("cycles") / f"from_{first}.yaml"
        path.write_text(PULL_AWAY.format(first=first))
        return simulate(simulation_of(read_inputs(str(path), "passive")))

    return drive


@pytest.mark.parametrize("first", [0.01, 3, 10, 15])
def test_a_bend_after_pulling_away_is_that_of_a_car_that_came_fast(pulled_away, first):
    slow, fast = pulled_away(first), pulled_away(80)
    for name in ("body.roll", "body.lateral_acceleration", "driver.steer"):
        assert slow[name][-1] == pytest.approx(fast[name][-1], rel=0.005), name
    assert np.abs(slow["body.lateral_acceleration"][slow.time < 15.0]).max() < 1e-6  # he looks ahead to 20 s
    assert slow["body.roll"].max() == pytest.approx(fast["body.roll"].max(), rel=0.01)
    assert fast["body.lateral_acceleration"][-1] == pytest.approx(0.4 * 9.81, rel=0.03)


def test_at_a_crawl_nothing_is_steered():
    crawl = shipped.recording("single_wheel_bump", "passive", "speed=0.01 km/h", "duration=5 s")
    assert np.abs(crawl["driver.steer"]).max() < 1e-9


def test_where_a_car_slides_in_a_brisk_turn_its_driver_learns_it_in_a_gentler_one():
    slippery = ("vehicle.front.tire.mu=0.3", "vehicle.rear.tire.mu=0.3")
    dry, snow = (shipped.simulation("s_curve_120kmh", "passive", *each) for each in ((), slippery))
    known = [shipped.own_copy(each)[1].parameters.driver.understeer for each in (dry, snow)]
    assert known[1] == pytest.approx(known[0], rel=0.5)


def test_a_car_that_turns_for_no_steering_is_refused():
    ice = ("vehicle.front.tire.mu=0.01", "vehicle.rear.tire.mu=0.01")
    with pytest.raises(InputError, match="no steady turn of 0.75 m/s"):
        shipped.simulation("s_curve_120kmh", "passive", *ice)
