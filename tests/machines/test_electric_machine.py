"""Electric machine: torque over speed within the circles of current and voltage, losses, braking with joined phases."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled
from scipy.optimize import minimize

from ars_mujoco.machines.electric_machine import (
    ElectricMachine,
    copper_loss,
    current_within,
    drag,
    field_current,
    shorted_torque,
    torque_constant,
    torque_currents,
)

RPM = math.pi / 30.0
PARAMETERS = {
    "pole_pairs": 4, "flux": "0.020 V*s", "resistance": "30 mohm", "inductance": "150 uH", "current_limit": "75 A",
    "field_current_limit": "60 A", "modulation": 0.95, "iron": "4e-4 Nms/rad", "hysteresis": "0.01 Nm",
    "friction": "0.02 Nm", "sign_speed": "1.5 rad/s",
}  # fmt: skip
MACHINE = filled(ElectricMachine(**PARAMETERS))
HARDY = filled(ElectricMachine(**PARAMETERS | {"field_current_limit": "75 A"}))  # magnets that bear any field current
AMPLE = filled(ElectricMachine(**PARAMETERS | {"current_limit": "1 kA"}))  # the voltage alone limits it
KT = torque_constant(MACHINE)
speeds, supplies = st.floats(-900.0, 900.0), st.floats(36.0, 52.0)


def voltage(d: float, q: float, speed: float) -> float:
    """Amplitude (V) of a phase at currents (A), by the equations themselves."""
    electrical = 4 * speed
    return math.hypot(0.03 * d - electrical * 150e-6 * q, 0.03 * q + electrical * (150e-6 * d + 0.02))


def allowed(supply: float) -> float:
    return 0.95 * supply / math.sqrt(3.0)


@pytest.mark.parametrize(("rpm", "torque"), [(0, 9.0), (2500, 9.0), (3000, 8.4), (4000, 6.3), (5000, 4.4)])
def test_torque_over_speed_is_the_published_one(rpm, torque):
    assert KT * torque_currents(HARDY, rpm * RPM, 48.0)[1] == pytest.approx(torque, abs=0.06)


def test_magnets_that_bear_60_A_cost_torque_at_5000_rpm():
    assert KT * torque_currents(MACHINE, 5000 * RPM, 48.0)[1] == pytest.approx(3.5, abs=0.05)


def test_its_power_peaks_at_2_64_kW():
    power = [KT * torque_currents(HARDY, speed, 48.0)[1] * speed for speed in np.linspace(0.0, 600.0, 601)]
    assert max(power) == pytest.approx(2640.0, rel=0.03)


def test_at_36_V_it_does_at_three_quarters_of_the_speed_what_it_does_at_48():
    for rpm in (2500, 3000, 4000):
        low, high = (torque_currents(MACHINE, s * rpm * RPM, u)[1] for s, u in ((0.75, 36.0), (1.0, 48.0)))
        assert low == pytest.approx(high, rel=0.05)  # but for the resistance, which does not scale


def test_it_heats_its_windings_with_253_W_at_9_Nm():
    assert copper_loss(MACHINE, 9.0 / KT, 0.0) == pytest.approx(253.0, abs=0.5)


@given(speed=speeds, supply=supplies)
def test_what_it_gives_keeps_to_both_circles(speed, supply):
    for current in torque_currents(MACHINE, speed, supply):
        field = field_current(MACHINE, current, speed, supply)
        assert -60.0 <= field <= 0.0
        assert math.hypot(current, field) <= 75.0 * (1 + 1e-9)
        if current != 0.0:
            assert voltage(field, current, speed) <= allowed(supply) * (1 + 1e-9)


@pytest.mark.parametrize("machine", [MACHINE, AMPLE], ids=["75 A", "1 kA"])
@pytest.mark.parametrize(
    ("rpm", "supply"), [(1000, 36.0), (2800, 36.0), (3500, 36.0), (2800, 48.0), (3500, 48.0), (4500, 48.0)]
)
def test_no_other_currents_give_more_torque(machine, rpm, supply):
    speed, limit = rpm * RPM, machine.current_limit
    within = [
        {"type": "ineq", "fun": lambda x: limit**2 - x @ x},
        {"type": "ineq", "fun": lambda x: allowed(supply) ** 2 - voltage(x[0], x[1], speed) ** 2},
    ]
    for side, end in zip((-1.0, 1.0), torque_currents(machine, speed, supply), strict=True):
        start = (-40.0, 0.5 * end)
        best = minimize(lambda x, s=side: -s * x[1], start, bounds=[(-60.0, 0.0), (-limit, limit)], constraints=within)
        assert end == pytest.approx(best.x[1], rel=2e-3, abs=1e-3)


@given(speed=speeds, supply=supplies)
def test_turned_the_other_way_it_gives_the_other_torque(speed, supply):
    least, most = torque_currents(MACHINE, speed, supply)
    assert torque_currents(MACHINE, -speed, supply) == pytest.approx((-most, -least), abs=1e-9)


@given(speed=st.floats(-500.0, 500.0), power=st.floats(0.0, 4000.0))
def test_the_current_within_a_power_takes_it(speed, power):
    current = current_within(MACHINE, speed, 0.3, power)
    taken = KT * current * speed + copper_loss(MACHINE, current, 0.0) + 0.3 * current
    assert taken == pytest.approx(power, rel=1e-6, abs=1e-6) or (speed < 0.0 and taken >= power)


def test_shorted_it_brakes_like_a_damper_when_slow_and_most_at_477_rpm():
    assert shorted_torque(MACHINE, 1e-3) == pytest.approx(-0.32e-3, rel=1e-6)
    by_speed = [-shorted_torque(MACHINE, rpm * RPM) for rpm in range(1, 3000)]
    assert max(by_speed) == pytest.approx(8.0, rel=1e-4)
    assert np.argmax(by_speed) + 1 == pytest.approx(477, abs=1)


def test_its_drag_is_the_iron_and_windage_of_57_W_at_3500_rpm_with_friction():
    speed = 3500 * RPM
    assert drag(MACHINE, speed) * speed == pytest.approx(57.4 + 0.02 * speed, rel=0.01)
    assert drag(MACHINE, -speed) == -drag(MACHINE, speed)
