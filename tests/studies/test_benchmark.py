"""The benchmark, and what a closed-loop step may cost."""

import mujoco
import pytest
import shipped

from ars_mujoco.studies.benchmark import measure

ALLOWED = 1.5  # times a bare step of the same model, the verification set on both axles
ALLOWED_IN_FULL = 4.0  # every equation on both axles


def test_a_closed_loop_step_costs_more_than_a_bare_one():
    cost = measure(shipped.simulation("s_curve_120kmh"), rounds=3)
    assert cost.rounds == 3
    assert cost.closed_loop > cost.bare > 0
    assert cost.ratio_quartiles[0] <= cost.ratio <= cost.ratio_quartiles[1]
    assert cost.real_time_factor == pytest.approx(0.001 / cost.closed_loop)
    assert mujoco.get_mjcb_control() is None


@pytest.mark.slow
def test_a_closed_loop_step_is_within_what_is_allowed():
    cost = measure(shipped.simulation("s_curve_120kmh"))
    print(f"{cost.ratio:.3f} times a bare step of {1e6 * cost.bare:.1f} us, quartiles {cost.ratio_quartiles}")
    assert cost.ratio <= ALLOWED


@pytest.mark.slow
def test_a_step_with_every_equation_of_both_axles_is_within_what_is_allowed():
    full = shipped.simulation("s_curve_120kmh", "pump_controlled_full", "actuator.pump_control=full")
    cost = measure(full)
    print(f"{cost.ratio:.3f} times a bare step of {1e6 * cost.bare:.1f} us, quartiles {cost.ratio_quartiles}")
    assert cost.ratio <= ALLOWED_IN_FULL
