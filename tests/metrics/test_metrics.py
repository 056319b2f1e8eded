"""Metrics of made-up runs whose answers are known by hand."""

import numpy as np
import pytest
from made_up import TIME, recording, values

from ars_mujoco.metrics.metric import METRICS, G, Run, measure
from ars_mujoco.recording.recording import Recording

TARGET = ((0.0, 0.0), (0.3 * G, 0.0), (0.6 * G, np.radians(0.3)), (0.8 * G, np.radians(1.3)))


def swaying(roll: float, acceleration: float = 0.6, offset: float = 0.0, time=TIME) -> Recording:
    """Roll (deg) and lateral acceleration (g) of these amplitudes, 1 Hz, about a roll of `offset` deg."""
    wave = np.sin(2 * np.pi * time)
    return recording(
        time, body__roll=np.radians(offset + roll * wave), body__lateral_acceleration=acceleration * G * wave
    )


def circling(roll_of_g, top: float = 0.9, side: float = 1.0) -> Recording:
    """A slow circle from straight ahead to `top` g in 50 s; `roll_of_g` gives the roll (deg)."""
    time = np.linspace(0, 50, 5001)
    g = top * time / 50
    roll = np.radians([roll_of_g(each) for each in g])
    return recording(time, body__roll=side * roll, body__lateral_acceleration=side * g * G)


def on_target(g: float, target=TARGET) -> float:
    return np.degrees(np.interp(g * G, *np.transpose(target)))


def test_every_metric_is_declared_with_a_unit_and_a_meaning():
    assert {
        "peak_roll",
        "roll_reduction_factor",
        "roll_gradient",
        "drawn_energy",
        "loss_extrapolation",
        "real_time_factor",
    } <= set(METRICS)
    for name, metric in METRICS.items():
        assert metric.name == name
        assert metric.unit
        assert metric.description


def test_every_metric_of_an_empty_run_is_none_with_a_reason():
    for value in values(recording(time=np.zeros(0), body__roll=0.0), wall_time=1.0).values():
        assert value.value is None
        assert value.note


def test_roll_counts_from_its_value_before_the_manoeuvre():
    measured = values(swaying(roll=2.0, offset=-0.7))
    assert measured["peak_roll"].value == pytest.approx(2.0)
    assert measured["rms_roll"].value == pytest.approx(2.0 / 2**0.5)
    assert measured["peak_roll"].unit == "deg"


def test_roll_outside_the_window_does_not_count():
    roll = np.where(TIME < 5, 1.0, 4.0) * (TIME > 1)
    assert values(recording(body__roll=np.radians(roll)), window=(0.0, 4.0))["peak_roll"].value == pytest.approx(1.0)


def test_roll_to_the_left_counts_as_much():
    roll = np.radians(np.interp(TIME, [0, 5, 10], [0, -3.0, 0]))
    assert values(recording(body__roll=roll))["peak_roll"].value == pytest.approx(3.0)


def test_the_rms_does_not_depend_on_where_the_samples_lie():
    dense_first = np.concatenate([np.linspace(0, 5, 20001)[:-1], np.linspace(5, 10, 2001)])
    even, uneven = (values(swaying(2.0, time=time))["rms_roll"].value for time in (TIME, dense_first))
    assert uneven == pytest.approx(even, rel=1e-4)


def test_the_peak_lateral_acceleration_is_in_g():
    measured = values(swaying(2.0, acceleration=0.61))["peak_lateral_acceleration"]
    assert (measured.value, measured.unit) == (pytest.approx(0.61), "g")


def test_the_factors_compare_the_runs_two_by_two():
    measured = values(swaying(0.5), reference=swaying(4.0), locked=swaying(1.5))
    assert measured["roll_reduction_factor"].value == pytest.approx(8.0)
    assert measured["roll_reduction_factor_rms"].value == pytest.approx(8.0)
    assert measured["roll_reduction_factor_against_locked"].value == pytest.approx(3.0)
    assert measured["roll_reduction_factor_of_locked"].value == pytest.approx(4.0 / 1.5)
    assert not measured["roll_reduction_factor"].at_least
    assert not measured["roll_reduction_factor"].note


def test_a_reference_that_hardly_rolls_gives_no_factor():
    measured = values(swaying(0.1), reference=swaying(0.29))["roll_reduction_factor"]
    assert measured.value is None
    assert "0.290 deg is under 0.3 deg" in measured.note


def test_a_run_that_hardly_rolls_has_at_least_a_factor():
    measured = values(swaying(0.01), reference=swaying(4.0))["roll_reduction_factor"]
    assert measured.at_least
    assert measured.value == pytest.approx(4.0 / 0.05)
    assert str(measured) == ">= 80"


@pytest.mark.parametrize(("acceleration", "remarked"), [(0.609, False), (0.613, True), (0.587, True)])
def test_runs_that_did_not_share_the_path_are_remarked(acceleration, remarked):
    measured = values(swaying(0.5, acceleration), reference=swaying(4.0, 0.6))["roll_reduction_factor"]
    assert measured.value == pytest.approx(8.0)
    assert ("lateral acceleration peaks" in measured.note) == remarked


def test_without_the_other_run_there_is_no_factor():
    measured = values(swaying(0.5))
    assert measured["roll_reduction_factor"].note == "no reference run to compare with"
    assert measured["roll_reduction_factor_against_locked"].note == "no locked run to compare with"


def test_a_run_cut_short_has_no_peak_and_no_factor():
    cut = swaying(0.5).part(0, 6)
    assert "ends at 5.999 s" in values(cut)["peak_roll"].note
    assert "ends at 5.999 s" in values(cut, reference=swaying(4.0))["roll_reduction_factor"].note
    assert "ends at 5.999 s" in values(swaying(0.5), reference=swaying(4.0).part(0, 6))["roll_reduction_factor"].note


def test_a_run_that_is_not_finite_says_where():
    roll = np.where(TIME > 3.0, np.nan, 0.01)
    assert values(recording(body__roll=roll))["peak_roll"].note == "body.roll is not finite at 3.001 s"


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_passive_gradient_is_the_slope_between_0_1_and_0_4_g(side):
    measured = values(circling(lambda g: 6.0 * g + 20 * max(g - 0.4, 0) ** 2, side=side), window=(0.0, 50.0))
    assert measured["roll_gradient"].value == pytest.approx(6.0, rel=1e-6)


def test_an_active_bar_has_a_table_of_roll_secant_and_tangent():
    run = circling(lambda g: 3.0 * g**2)
    measured = values(run, window=(0.0, 50.0), target=TARGET)["roll_gradient"]
    assert measured.value is None
    assert "table" in measured.note
    assert [row["lateral_acceleration"] for row in measured.table] == [0.3, 0.45, 0.6, 0.8]
    for row in measured.table:
        g = row["lateral_acceleration"]
        assert row["roll"] == pytest.approx(3 * g**2, abs=1e-3)
        assert row["secant"] == pytest.approx(3 * g, abs=2e-3)
        assert row["tangent"] == pytest.approx(6 * g, rel=1e-3)


def test_a_circle_that_stops_early_has_the_rows_it_reached_and_no_gradient():
    half = values(circling(lambda g: 6.0 * g, top=0.5), window=(0.0, 50.0))["roll_gradient"]
    assert half.value == pytest.approx(6.0)
    assert len(half.table) == 2
    third = values(circling(lambda g: 6.0 * g, top=0.35), window=(0.0, 50.0))["roll_gradient"]
    assert third.note == "the run does not sweep 0.1 to 0.4 g"


def test_a_manoeuvre_that_is_not_slow_has_no_gradient():
    assert "not a slow circle" in values(swaying(2.0))["roll_gradient"].note


def test_a_car_on_its_target_map_has_no_error():
    measured = values(circling(on_target), window=(0.0, 50.0), target=TARGET)["target_map_error"]
    assert measured.value < 0.015  # the straight line through 0.01 g either side cuts the map's corners


def test_beyond_its_last_knot_a_target_goes_on_with_its_slope():
    to_1_g = ((0.0, 0.0), (0.3 * G, 0.0), (1.0 * G, np.radians(1.4)))
    to_0_6_g = (*to_1_g[:2], (0.6 * G, np.radians(0.6)))
    run = circling(lambda g: on_target(g, to_1_g))
    measured = values(run, window=(0.0, 50.0), target=to_0_6_g)["target_map_error"]
    assert measured.value < 0.015


def test_the_target_map_error_is_the_largest_at_its_three_points():
    def rolls(g):
        return on_target(g) - 0.2 * (0.5 < g < 0.7)

    measured = values(circling(rolls, side=-1.0), window=(0.0, 50.0), target=TARGET)["target_map_error"]
    assert measured.value == pytest.approx(0.2, abs=0.015)


def test_a_circle_that_does_not_reach_0_8_g_has_no_target_map_error():
    measured = values(circling(on_target, top=0.7), window=(0.0, 50.0), target=TARGET)["target_map_error"]
    assert measured.note == "the run does not sweep through 0.8 g"


def test_the_real_time_factor_is_simulated_over_wall_time():
    assert values(swaying(1.0), wall_time=4.0)["real_time_factor"].value == pytest.approx(2.5)
    assert values(swaying(1.0))["real_time_factor"].value is None


def test_extrapolated_losses_are_told_with_time_and_place():
    time = np.linspace(0.0, 1.0, 1001)
    far = np.clip(0.1 - np.abs(time - 0.3005), 0.0, None)
    signals = {"pump__stroke": -0.5, "pump__speed": 100 * np.pi, "motor__pressure": -330e5}
    run = recording(
        time, **{f"front__{name}": value for name, value in signals.items()}, front__pump__extrapolation=far
    )
    told = measure(Run(run, (0.0, 1.0)))["loss_extrapolation"]
    assert told.value == pytest.approx(0.2)
    assert told.note == (
        "the losses of the front pump are extrapolated from 0.201 s on, at most by 10 % at 0.300 s "
        "(stroke 50.0 %, 3000 rpm, 330.0 bar)"
    )
    inside = recording(time, front__pump__extrapolation=0.0)
    assert measure(Run(inside, (0.0, 1.0)))["loss_extrapolation"].value == 0.0


def test_commands_that_the_actuator_holds_at_its_limit_are_told():
    time = np.linspace(0.0, 1.0, 1001)
    asked = np.where(time > 0.3995, -0.25, 0.1)
    run = recording(time, front__bar__command=asked, rear__bar__command=0.2)
    told = measure(Run(run, (0.0, 1.0), held_at={"front": 0.25, "rear": 0.25}))["command_limited"]
    assert told.value == pytest.approx(0.6)
    assert told.note == "the command of the front bar is held at 14.32 deg, from 0.400 s on"
    assert measure(Run(run, (0.0, 1.0), held_at={"front": 0.3}))["command_limited"].value == 0.0
    assert measure(Run(run, (0.0, 1.0)))["command_limited"].value is None
