"""The interpreted twin: steps from one state, compiled here and interpreted in a process of its own."""

import subprocess
import sys

import mujoco
import numpy as np
import shipped

from ars_mujoco.bridge.callback import installed

TWIN = """
import sys
from importlib import import_module
from ars_mujoco.rigs.rig import rig
import mujoco, numpy as np
from ars_mujoco.bridge.callback import installed
from ars_mujoco.kernels.kernel import interpreted
assert interpreted
folder, name, system, steps = sys.argv[1], sys.argv[2], sys.argv[3], int(sys.argv[4])
pair = rig(name, import_module(system))
model = mujoco.MjModel.from_binary_path(f"{folder}/model.mjb")
data = mujoco.MjData(model)
mujoco.mj_setState(model, data, np.load(f"{folder}/state.npy"), mujoco.mjtState.mjSTATE_INTEGRATION)
worlds = []
with installed(pair, model, data):
    for _ in range(steps):
        mujoco.mj_step(model, data)
        worlds.append(data.userdata.copy())
np.save(f"{folder}/interpreted.npy", worlds)
"""


def twins_apart(simulation, data, steps, folder, monkeypatch) -> float:
    """The largest difference in the world, relative to each number's peak, of `steps` compiled steps from `data` and of
    the same interpreted.
    """
    mujoco.mj_saveModel(simulation.model, str(folder / "model.mjb"))
    np.save(folder / "state.npy", shipped.state_of(simulation.model, data))
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    pair = (simulation.rig.NAME, simulation.rig.system.__name__)
    subprocess.run([sys.executable, "-c", TWIN, str(folder), *pair, str(steps)], check=True)
    compiled = []
    with installed(simulation.rig, simulation.model, data):
        for _ in range(steps):
            mujoco.mj_step(simulation.model, data)
            compiled.append(data.userdata.copy())
    compiled, interpreted = np.array(compiled), np.load(folder / "interpreted.npy")
    apart = np.abs(interpreted - compiled).max(axis=0) / np.maximum(np.abs(compiled).max(axis=0), 1e-300)
    print(f"{apart.max():.1e} apart, relative to each number's peak")
    return apart.max()
