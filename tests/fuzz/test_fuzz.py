"""Whatever a file holds is refused in clear lines, or drives: no traceback, in time, finite, its books closed."""

import pytest
from campaign import verdicts
from trial import SOUND, subjects

from ars_mujoco.schema import library


def unsound(seeds):
    return [(seed, *verdict) for seed, verdict in verdicts(seeds) if verdict[1] not in SOUND]


def test_every_shipped_file_is_mutated():
    """But those of pumps, which are taken by name: no user's file stands in for one."""
    shipped = {path for kind in library.SHIPPED if kind != "pump" for path in library.shipped(kind).values()}
    assert shipped <= {subject.path for subject in subjects()}


def test_mutated_files_are_refused_or_drive():
    assert unsound(range(100)) == []


@pytest.mark.slow
def test_ten_thousand_mutated_files_are_refused_or_drive():
    assert unsound(range(100, 10_100)) == []
