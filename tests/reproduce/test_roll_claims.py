"""Roll of the vehicle."""

import pytest
from verdicts import ours, verdict


def test_a_factor_of_4_takes_far_less_than_12_hz_on_the_roll_plane(claims):
    needed, at_12_hz, locked = ours(claims["roll_and_bandwidth"])
    assert needed < 2.0
    assert at_12_hz > 4.0
    assert 3.0 < locked < 4.0
    assert verdict(claims["roll_and_bandwidth"]) == "does not follow from the roll plane"


def test_the_pump_s_dynamics_are_sufficient_and_its_flow_is_the_limit(claims):
    own, fast, slow, quick = ours(claims["pump_dynamics"])
    assert slow < own < quick
    assert fast == pytest.approx(own, rel=0.15)
    assert slow > 4.0
    assert verdict(claims["pump_dynamics"]) == "reproduced"


def test_1400_nm_in_front_hold_a_car_level_to_1_g(claims):
    assert ours(claims["torque_required"])[0] == pytest.approx(1.02, abs=0.01)
    assert verdict(claims["torque_required"]) == "reproduced"


def test_holding_the_middle_position_copies_a_bump_like_a_solid_bar(claims):
    torque, held = ours(claims["copying"])
    assert held == pytest.approx(5700 * 0.2014, rel=1e-3)
    assert torque == pytest.approx(held, rel=0.01)
    assert verdict(claims["copying"]).startswith("does not follow")
