"""The accumulator: a gas that expands without heat as its oil is drawn."""

import math

import pytest
from records import filled

from ars_mujoco.hydraulics.accumulator import Accumulator, accumulator_energy, accumulator_rate, gas_volume

ACCUMULATOR = filled(Accumulator(volume="25 cm^3", pressure="5 bar", exponent=1.4))
PRESSURES = [2e5, 4.9e5, 5e5, 8e5, 20e5]


@pytest.mark.parametrize("pressure", PRESSURES)
def test_its_gas_follows_the_polytrope(pressure):
    assert pressure * gas_volume(ACCUMULATOR, pressure) ** 1.4 == pytest.approx(5e5 * 25e-6**1.4, rel=1e-12)


@pytest.mark.parametrize("pressure", PRESSURES)
def test_oil_takes_the_place_of_gas(pressure):
    nudge = 1e-5 * pressure
    gone = gas_volume(ACCUMULATOR, pressure - nudge) - gas_volume(ACCUMULATOR, pressure + nudge)
    assert accumulator_rate(ACCUMULATOR, pressure, 1e-5) * gone / (2.0 * nudge) == pytest.approx(1e-5, rel=1e-8)


@pytest.mark.parametrize("pressure", PRESSURES)
def test_its_energy_is_the_work_of_the_oil_that_came_in(pressure):
    steps = 4000
    volumes = [gas_volume(ACCUMULATOR, 5e5 + (pressure - 5e5) * i / steps) for i in range(steps + 1)]
    over = [(pressure - 5e5) * (i + 0.5) / steps for i in range(steps)]
    work = math.fsum(p * (volumes[i] - volumes[i + 1]) for i, p in enumerate(over))
    assert accumulator_energy(ACCUMULATOR, pressure) == pytest.approx(work, rel=1e-5, abs=1e-9)
