"""The claims, held against the shipped actuator once for all tests, with coarser sweeps than the command's."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from ars_mujoco.analysis import compensators, frequency_response
from ars_mujoco.reproduce.claim import Claim
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.reproduce import GROUPS, reproduce


@pytest.fixture(scope="session")
def coarse():
    """Sweeps that take a tenth of the time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(frequency_response, "FREQUENCIES", frequency_response.FREQUENCIES[::4])
        patch.setattr(compensators, "TIMINGS", ((0.0, 0.0), (1e-3, 0.0), (5e-3, 0.0)))
        patch.setattr(compensators, "RATIOS", np.geomspace(0.2, 10.0, 9))
        for name in ("GAINS", "CORNERS", "NEW_DAMPINGS"):
            patch.setattr(compensators, name, getattr(compensators, name)[::2])
        yield


@pytest.fixture(scope="session")
def evidence(coarse) -> Evidence:
    return Evidence()


@pytest.fixture(scope="session")
def claims(evidence) -> dict[str, Claim]:
    """Every claim by its id."""
    return {claim.id: claim for group in GROUPS for claim in group.claims(evidence)}


@dataclass(frozen=True)
class Written:
    """What the command wrote into `folder`, returned as `numbers`, and told of its progress."""

    folder: Path
    numbers: dict
    progress: dict[str, float]


@pytest.fixture(scope="session")
def written(evidence, claims, tmp_path_factory) -> Written:
    folder, progress = tmp_path_factory.mktemp("reproduce"), {}
    return Written(folder, reproduce(evidence, folder, progress.__setitem__), progress)


@pytest.fixture
def with_settings(coarse):
    """The claim of an id, held against an actuator with other settings."""

    def find(name: str, *settings: str) -> Claim:
        changed = Evidence(settings)
        return next(group.functions[name](changed) for group in GROUPS if name in group.functions)

    return find
