"""Shipped cycles, prepared and driven once however many tests look at them; so what is returned must not be changed."""

from copy import copy
from dataclasses import replace
from functools import cache

import mujoco
import numpy as np

from ars_mujoco.bridge.callback import installed, tables_of
from ars_mujoco.recording.recording import Recording
from ars_mujoco.simulation.simulation import Simulation, simulate
from ars_mujoco.studies.inputs import read_compared, read_inputs
from ars_mujoco.studies.study import Result, simulation_of, study

INTEGRATION = mujoco.mjtState.mjSTATE_INTEGRATION


@cache
def simulation(cycle: str, actuator: str | None = None, *settings: str) -> Simulation:
    """The simulation of a cycle."""
    return simulation_of(read_inputs(cycle, actuator, settings=settings))


@cache
def recording(cycle: str, actuator: str | None = None, *settings: str) -> Recording:
    """The recording of a cycle."""
    return simulate(simulation(cycle, actuator, *settings))


@cache
def measured(cycle: str, *settings: str) -> Result:
    """A cycle with its own actuator, measured against its reference and the locked bar."""
    runs, references = read_compared(cycle, [None], settings=settings)
    (result,) = study(runs, references, None, lambda name, share: None)
    return result


def own_copy(shared: Simulation):
    """(simulation, world): a copy with a model of its own, and the initial world in it, both free to change."""
    own = replace(shared, model=copy(shared.model))
    return own, own.model.numeric_data[-own.model.nuserdata :].view(own.rig.WORLD).view(np.recarray)[0]


def tables(own: Simulation) -> np.record:
    """What a simulation reads only, which lies in its model."""
    return tables_of(own.rig, own.model)


def driven(shared: Simulation, seconds: float) -> mujoco.MjData:
    """Data after `seconds` of the cycle."""
    data = shared.start()
    with installed(shared.rig, shared.model, data):
        mujoco.mj_step(shared.model, data, round(seconds / shared.model.opt.timestep))
    return data


def drive_on(simulation: Simulation, data: mujoco.MjData, steps: int = 300) -> np.ndarray:
    """The state that `data` is in after so many steps more."""
    with installed(simulation.rig, simulation.model, data):
        mujoco.mj_step(simulation.model, data, steps)
    return state_of(simulation.model, data)


def state_of(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """Everything that a run is restored from, userdata included."""
    state = np.empty(mujoco.mj_stateSize(model, INTEGRATION))
    mujoco.mj_getState(model, data, state, INTEGRATION)
    return state


def restored(model: mujoco.MjModel, state: np.ndarray) -> mujoco.MjData:
    """New data in that state."""
    data = mujoco.MjData(model)
    mujoco.mj_setState(model, data, state, INTEGRATION)
    return data
