"""The direction valve: which ways are open, and that sides are alike."""

import numpy as np
import pytest
from records import filled

from ars_mujoco.hydraulics.direction_valve import A, B, DirectionValve, pressure_opening, return_opening

VALVE = filled(
    DirectionValve(overlap="0.1", flow="9 L/min", pressure="1 bar", time="20 ms", leakage="2e-13 m^3/s/Pa", power="5 W")
)


def test_at_an_end_pressure_goes_to_one_side_and_the_other_to_the_return_line():
    assert (pressure_opening(VALVE, 1.0, A), return_opening(VALVE, 1.0, B)) == (1.0, 1.0)
    assert (pressure_opening(VALVE, 1.0, B), return_opening(VALVE, 1.0, A)) == (0.0, 0.0)


def test_centred_it_gives_no_pressure_and_both_sides_lie_at_the_return_line():
    assert pressure_opening(VALVE, 0.0, A) == pressure_opening(VALVE, 0.0, B) == 0.0
    assert return_opening(VALVE, 0.0, A) == return_opening(VALVE, 0.0, B) == pytest.approx(0.1 / 1.1)


@pytest.mark.parametrize("spool", np.linspace(-1.0, 1.0, 21))
def test_no_side_has_pressure_and_return_line_at_once(spool):
    for side in (A, B):
        assert min(pressure_opening(VALVE, spool, side), return_opening(VALVE, spool, side)) == pytest.approx(0.0)


@pytest.mark.parametrize("spool", np.linspace(-1.0, 1.0, 9))
def test_its_sides_are_alike(spool):
    assert pressure_opening(VALVE, spool, A) == pressure_opening(VALVE, -spool, B)
    assert return_opening(VALVE, spool, A) == return_opening(VALVE, -spool, B)
