"""Display units, names and axes."""

import pytest

from ars_mujoco.recording.rerun.display import axis_range, quantity_of, series_name, unit_and_factor
from ars_mujoco.schema.channels import Channel


@pytest.mark.parametrize(
    ("name", "unit", "shown", "one"),
    [
        ("body.roll", "rad", "deg", 57.29578),
        ("body.lateral_acceleration", "m/s^2", "g", 0.1019716),
        ("front.motor.pressure", "Pa", "bar", 1e-5),
        ("front.pump.flow", "m^3/s", "L/min", 6e4),
        ("body.speed", "m/s", "km/h", 3.6),
        ("front.pump.speed", "rad/s", "rpm", 9.549297),
        ("fl.suspension.rate", "m/s", "m/s", 1.0),
        ("suspension.travel", "m", "mm", 1e3),
        ("fl.suspension.travel", "rad", "deg", 57.29578),
        ("supply.voltage", "V", "V", 1.0),
        ("made.up", "kg", "kg", 1.0),
    ],
)
def test_a_channel_is_shown_in_an_engineers_unit(name, unit, shown, one):
    assert unit_and_factor(Channel(name, unit, "")) == (shown, pytest.approx(one))


def test_quantities_of_motors_and_supplies_have_names():
    named = [quantity_of(Channel("made.up", unit, "")) for unit in ("A", "V", "V*s")]
    assert named == ["current", "voltage", "flux"]


def test_a_series_is_named_with_its_unit():
    assert series_name(Channel("front.bar.angle", "rad", "")) == "front bar angle [deg]"


def test_noise_about_zero_does_not_fill_the_plot():
    assert axis_range(-0.01, 0.01, "deg") == (-1.06, 1.06)


def test_an_axis_shows_a_power_of_ten_where_smaller_labels_find_no_room():
    assert axis_range(-7.2, 7.2, "deg") == pytest.approx((-10.6, 10.6))
    assert axis_range(-3.4, 3.4, "deg") == pytest.approx((-3.604, 3.604))


def test_an_axis_of_nothing_is_still_one():
    assert axis_range(float("inf"), -float("inf"), "deg") == (-1.0, 1.0)
