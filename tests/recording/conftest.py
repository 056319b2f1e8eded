"""A short made-up run of the sedan, shared by the tests of the recording."""

import pytest
from synthetic import s_curve


@pytest.fixture(scope="session")
def run():
    """Six seconds of an S-curve with 3.4 deg of roll."""
    return s_curve(duration=6.0)
