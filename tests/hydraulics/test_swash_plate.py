"""Swash plate: an integrator of the spool, and what its stop acts on."""

import numpy as np
import pytest
import shipped
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.hydraulics.swash_plate import SwashPlate, held, stroke_rate

RATE = 250.0  # 1/s
PLATE = filled(SwashPlate(max_rate=f"{RATE} 1/s", stop="stroke"))
PAPER = filled(SwashPlate(max_rate=f"{RATE} 1/s", stop="flow"))
SLOW_VALVE = tuple(f"actuator.{axle}.servo_valve.max_rate=5 1/s" for axle in ("front", "rear"))


@given(spool=st.floats(-1.0, 1.0))
def test_it_integrates_the_spool(spool):
    assert stroke_rate(PAPER, spool) == stroke_rate(PLATE, spool) == RATE * spool


@given(stroke=st.floats(-10.0, 10.0))
def test_the_papers_integrator_knows_no_end_and_a_plate_is_held(stroke):
    assert held(PAPER, stroke) == stroke
    assert held(PLATE, stroke) == min(max(stroke, -1.0), 1.0)


@pytest.mark.parametrize("settings", [(), SLOW_VALVE])
def test_the_cars_pumps_never_stroke_past_full(settings):
    run = shipped.recording("roll_plane_step", None, *settings)
    assert 0.99 < np.abs(run["front.pump.stroke"]).max() <= 1.0 + 1e-12


def test_with_a_slow_valve_the_papers_integrator_winds_up_and_the_car_rolls_for_it():
    paper = tuple(f"actuator.{axle}.swash_plate.stop=flow" for axle in ("front", "rear"))
    wound = shipped.recording("roll_plane_step", None, *SLOW_VALVE, *paper)
    held = shipped.recording("roll_plane_step", None, *SLOW_VALVE)
    assert np.abs(wound["front.pump.stroke"]).max() > 2.0
    assert np.abs(wound["body.roll"]).max() > 2.0 * np.abs(held["body.roll"]).max()
