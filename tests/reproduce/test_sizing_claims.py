"""Table 1."""

import pytest
from verdicts import ours, verdict

MATCHING = "actuator.front.motor.displacement=4.8869e-4 m^3/rev"  # 1400 Nm at 180 bar


def test_180_bar_are_1501_nm_and_1400_nm_take_168_bar(claims):
    assert ours(claims["motor_torque"]) == pytest.approx([1501.1, 167.87], rel=1e-4)
    assert verdict(claims["motor_torque"]) == "contradicts itself"


def test_3000_rpm_give_61_8_deg_s(claims):
    kinematic, reached = ours(claims["motor_rate"])
    assert kinematic == pytest.approx(61.83, abs=0.01)
    assert 0.9 * kinematic < reached < kinematic
    assert verdict(claims["motor_rate"]) == "contradicts itself"


def test_at_1500_rpm_the_pump_is_too_small(claims):
    assert ours(claims["pump_displacement"]) == pytest.approx([30.92, 3.348], rel=1e-3)
    assert verdict(claims["pump_displacement"]) == "contradicts itself"


def test_the_greatest_leakage_takes_40_and_80_percent_of_the_flow(claims):
    assert ours(claims["leakage_share"])[:2] == pytest.approx([40.0, 80.0])
    assert verdict(claims["leakage_share"]) == "does not follow from Table 2"


def test_1400_nm_twist_the_bar_by_14_07_deg(claims):
    assert ours(claims["bar_angle"])[0] == pytest.approx(14.07, abs=0.01)
    assert verdict(claims["bar_angle"]) == "contradicts itself"


@pytest.mark.parametrize(("name", "omega"), [("servo_valve", 420.0), ("servo_pump", 280.0)])
def test_the_pump_control_has_the_paper_s_corner_frequencies(claims, name, omega):
    assert ours(claims[name])[0] == pytest.approx(omega, rel=1e-4)
    assert verdict(claims[name]) == "reproduced"


@pytest.mark.parametrize(
    ("name", "setting"),
    [
        ("motor_torque", MATCHING),
        ("pump_displacement", "actuator.front.pump.displacement=3.4 cm^3/rev"),
        ("leakage_share", "actuator.front.pump.displacement=3.4 cm^3/rev"),
    ],
)
def test_other_sizes_do_follow(with_settings, name, setting):
    assert verdict(with_settings(name, setting)) == "reproduced"


def test_another_servo_valve_is_not_the_paper_s(with_settings):
    slower = with_settings("servo_valve", "actuator.front.servo_valve.frequency=300 rad/s")
    assert verdict(slower) == "does not follow from Table 1"
