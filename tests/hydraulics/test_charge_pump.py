"""The charge pump: flow, power and the gallery's relief valve."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.hydraulics.charge_pump import ChargePump, charge_flow, charge_power, charge_relief_flow

BAR = 1e5
SPEED = 100 * math.pi  # 3000 rpm
CHARGE = filled(
    ChargePump(
        displacement="0.5 cm^3/rev",
        efficiency="80 %",
        relief_pressure="21 bar",
        relief_conductance="5e-11 m^3/s/Pa",
        gallery_volume="50 cm^3",
    )
)


def test_half_a_cubic_centimetre_a_turn_is_1_5_litres_a_minute():
    assert charge_flow(CHARGE, SPEED) == pytest.approx(1.5e-3 / 60)


def test_it_costs_the_shaft_its_hydraulic_power_over_its_efficiency():
    assert charge_power(CHARGE, SPEED, 21 * BAR, BAR) == pytest.approx(1.5e-3 / 60 * 20 * BAR / 0.8)


@given(st.floats(0.1 * BAR, 60 * BAR))
def test_it_loses_power_at_any_pressure(pressure):
    hydraulic = charge_flow(CHARGE, SPEED) * (pressure - BAR)
    assert charge_power(CHARGE, SPEED, pressure, BAR) >= hydraulic


@pytest.mark.parametrize(("pressure", "flow"), [(BAR, 0.0), (21 * BAR, 0.0), (26 * BAR, 2.5e-5)])
def test_the_gallery_opens_to_the_tank_over_its_pressure(pressure, flow):
    assert charge_relief_flow(CHARGE, pressure) == pytest.approx(flow)
