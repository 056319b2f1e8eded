"""The shipped vehicles, their models, and tires that only stand."""

import mujoco
import numpy as np
import pytest

from ars_mujoco.schema.document import read
from ars_mujoco.vehicle.bench import Bench
from ars_mujoco.vehicle.model import build
from ars_mujoco.vehicle.rest import solve
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import Sedan


@pytest.fixture(scope="session")
def sedan() -> Sedan:
    return read(Sedan, "sedan", "vehicle").value


@pytest.fixture(scope="session")
def roll_plane() -> RollPlane:
    return read(RollPlane, "roll_plane", "vehicle").value


@pytest.fixture(scope="session")
def bench() -> Bench:
    return read(Bench, "bench", "vehicle").value


@pytest.fixture
def sedan_model(sedan):
    return build(sedan)


@pytest.fixture
def roll_plane_model(roll_plane):
    return build(roll_plane)


@pytest.fixture
def stand(sedan):
    """mj_forward with four vertical springs in place of the tires; the loads (N) stay in `stand.loads`."""

    def forward(model, data):
        mujoco.mj_fwdPosition(model, data)
        for i, corner in enumerate(("fl", "fr", "rl", "rr")):
            wheel, tire = model.body(f"{corner}_wheel").id, (sedan.front if corner[0] == "f" else sedan.rear).tire
            forward.loads[i] = data.xfrc_applied[wheel, 2] = tire.stiffness * (tire.radius - data.xpos[wheel, 2])
        mujoco.mj_forward(model, data)

    forward.loads = np.zeros(4)
    return forward


@pytest.fixture
def resting(sedan_model, stand):
    """(model, data) of the sedan at rest."""
    data = mujoco.MjData(sedan_model)
    solve(sedan_model, data, stand)
    return sedan_model, data
