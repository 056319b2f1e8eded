"""Benchmark: the cost of a closed-loop step over a bare mj_step of the same model, in one run.

Rounds alternate between the closed loop (callback, every channel recorded) and the bare step (callback removed, its
last forces held), both from the same state in mid-manoeuvre, so that a machine that slows down slows both.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import mujoco
import numpy as np

from ars_mujoco.bridge.callback import installed
from ars_mujoco.kernels.program import digest, instructions
from ars_mujoco.recording.folder import RunFolder
from ars_mujoco.simulation.sampler import Sampler
from ars_mujoco.simulation.simulation import Simulation, empty_recording, simulate

ROUND = 1000  # steps
RECORDED = 9  # whole runs, with and without a recording; times a run is prepared
LEAD = 2.0  # s driven before the first round, so that everything moves


@dataclass(frozen=True)
class Cost:
    """Medians over the rounds: seconds a step, their ratio round by round, and simulated over wall time."""

    closed_loop: float
    bare: float
    ratio: float
    ratio_quartiles: tuple[float, float]
    real_time_factor: float
    rounds: int


def measure(simulation: Simulation, rounds: int = 60) -> Cost:
    """The cost of a step of `simulation`, from `rounds` interleaved rounds."""
    model, data = simulation.model, simulation.start()
    sampler = Sampler(simulation.rig, model, data, empty_recording(simulation))
    spec = mujoco.mjtState.mjSTATE_INTEGRATION
    state = np.empty(mujoco.mj_stateSize(model, spec))

    def closed_loop() -> None:
        _timed(lambda: sampler.steps(ROUND), closed)

    def bare() -> None:
        _timed(lambda: mujoco.mj_step(model, data, ROUND), open_)

    closed, open_ = [], []
    with installed(simulation.rig, model, data):
        for _ in range(round(LEAD / model.opt.timestep)):
            mujoco.mj_step(model, data)
    mujoco.mj_getState(model, data, state, spec)
    for _ in range(rounds):
        for run in (closed_loop, bare):
            mujoco.mj_setState(model, data, state, spec)
            run()
    ratios = np.divide(closed, open_)
    closed_step, bare_step = np.median(closed) / ROUND, np.median(open_) / ROUND
    return Cost(
        closed_loop=float(closed_step), bare=float(bare_step), ratio=float(np.median(ratios)),
        ratio_quartiles=tuple(float(q) for q in np.quantile(ratios, (0.25, 0.75))),
        real_time_factor=float(model.opt.timestep / closed_step), rounds=rounds,
    )  # fmt: skip


def recording_ratio(simulation: Simulation) -> float:
    """Median over interleaved whole runs of the time with the .rrd written and closed, over the time without."""
    recorded, plain = [], []

    def record() -> None:
        with TemporaryDirectory() as folder, RunFolder(Path(folder), empty_recording(simulation)) as run:
            _timed(lambda: (simulate(simulation, run.append), run.close()), recorded)

    for _ in range(RECORDED):
        record()
        _timed(lambda: simulate(simulation), plain)
    return float(np.median(np.divide(recorded, plain)))


def preparation(simulation: Simulation, prepare: Callable[[], object]) -> dict[str, float]:
    """What comes before a run over the time of a second of it, medians: `prepare`, and the digest of its entry."""
    model, data = simulation.model, simulation.start()
    steps = round(1.0 / model.opt.timestep)
    second, taken = [], {"set_up": [], "digest": []}
    with installed(simulation.rig, model, data):
        for _ in range(RECORDED):
            _timed(lambda: mujoco.mj_step(model, data, steps), second)
            _timed(prepare, taken["set_up"])
            instructions.cache_clear()
            _timed(lambda: digest(simulation.rig.CALLBACK.function), taken["digest"])
    return {name: float(np.median(np.divide(seconds, second))) for name, seconds in taken.items()}


def _timed(function, seconds: list[float]) -> None:
    start = time.perf_counter()
    function()
    seconds.append(time.perf_counter() - start)
