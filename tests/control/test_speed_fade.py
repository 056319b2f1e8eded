"""The speed fade: nothing below one speed, everything above another, a line between."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.control.speed_fade import SpeedFade, fade

FADE = filled(SpeedFade(begin="1 m/s", full="5 m/s"))


@given(speed=st.floats(0.0, 60.0))
def test_it_is_linear_between_its_speeds(speed):
    assert fade(FADE, speed) == pytest.approx(np.interp(speed, [1.0, 5.0], [0.0, 1.0]), abs=1e-15)


def test_backwards_counts_as_forwards():
    assert fade(FADE, -3.0) == fade(FADE, 3.0)
