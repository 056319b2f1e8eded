"""The relief valve: closed up to its pressure, then a flow in proportion to the excess, in both directions or one."""

import pytest
from bench import circuit

from ars_mujoco.hydraulics.relief_valve import one_way_relief, relief_flow

VALVE = circuit().relief_valve
BAR = 1e5


@pytest.mark.parametrize("pressure", [0.0, 100 * BAR, 190 * BAR, -190 * BAR])
def test_it_is_closed_up_to_its_pressure(pressure):
    assert relief_flow(VALVE, pressure) == 0.0


@pytest.mark.parametrize("side", [1, -1])
def test_it_passes_50_litres_a_minute_at_100_bar_of_excess(side):
    assert relief_flow(VALVE, side * 290 * BAR) == pytest.approx(side * 0.050 / 60, rel=1e-3)
    assert relief_flow(VALVE, side * 191 * BAR) == pytest.approx(side * 0.0005 / 60, rel=1e-3)


@pytest.mark.parametrize("excess", [0.0, 150 * BAR, 190 * BAR, 230 * BAR])
def test_one_of_the_pair_passes_as_the_pair_does_but_nothing_back(excess):
    assert one_way_relief(VALVE, excess) == relief_flow(VALVE, excess)
    assert one_way_relief(VALVE, -excess) == 0.0
