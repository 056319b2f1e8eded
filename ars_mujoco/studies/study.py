"""Study: what the commands run, one cycle with one or several actuators, each measured against the others.

inputs ─> prepare ─> simulate ─> recording ─> folder
                                     └─────> metrics, against the reference and the locked bar on the same cycle
"""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ars_mujoco.actuators.registry import module_of, system_for
from ars_mujoco.actuators.system import is_active
from ars_mujoco.metrics.metric import Run, Value, measure
from ars_mujoco.recording.folder import RunFolder, check_writable
from ars_mujoco.recording.recording import Recording
from ars_mujoco.recording.rerun.comparison import write_comparison
from ars_mujoco.rigs.setup import prepare
from ars_mujoco.schema.errors import ArsError, InputError, SimulationError
from ars_mujoco.simulation.simulation import Simulation, empty_recording, simulate
from ars_mujoco.studies.inputs import Inputs

COMPARISON = "compare.rrd"

Progress = Callable[[str, float], None]  # (name of the run, share of it done)


@dataclass(frozen=True)
class Result:
    """A finished run, by its actuator's name."""

    name: str
    inputs: Inputs
    recording: Recording
    metrics: dict[str, Value]


def study(
    runs: Sequence[Inputs], references: Mapping[str, Inputs], out: Path | None, progress: Progress
) -> list[Result]:
    """Simulate `runs` of one cycle and measure each against the `references`, by role as `read_compared` gives them.

    Each run writes its folder `out`/<actuator>, and several a comparison beside them, unless `out` is None; references
    that are not among the runs write nothing. Raises InputError before anything is written, and SimulationError once
    all were tried where a run failed: its folder then holds what was simulated, those of the others are complete.
    A reference that fails costs the runs what is measured against it.
    """
    each_once = list(dict.fromkeys([*runs, *references.values()]))
    names = dict(zip(each_once, told_apart(each.actuator.name for each in each_once), strict=True))
    folders = {run: out / names[run] for run in runs} if out else {}
    for folder in folders.values():
        check_writable(folder)
    with _Study(runs, references, names, folders, progress) as going:
        going.prepare()
        if out and len(runs) > 1:
            (out / COMPARISON).unlink(missing_ok=True)
        going.drive()
    results = [going.results[run] for run in runs if run in going.results]
    if out and len(results) > 1:
        write_comparison(out / COMPARISON, {result.name: result.recording for result in results})
    for run in runs:
        if run in going.failures:
            raise going.failures[run]
    return results


def simulation_of(inputs: Inputs) -> Simulation:
    """The simulation of `inputs`, which it keeps for its recording. Raises InputError where they cannot be set up."""
    parts = (inputs.cycle.value, inputs.actuator.value, inputs.controller.value, inputs.vehicle.value)
    try:
        return replace(prepare(*parts), inputs=inputs.record())
    except (np.linalg.LinAlgError, ArithmeticError) as error:  # values that are allowed one by one, but not together
        raise InputError(f"vehicle '{inputs.vehicle.name}': its statics cannot be computed: {error}") from None


def told_apart(names: Iterable[str]) -> list[str]:
    """The names, with a number after those that were there before: a, b, a-2."""
    apart: list[str] = []
    for name in names:
        number, unique = 1, name
        while unique in apart:
            number += 1
            unique = f"{name}-{number}"
        apart.append(unique)
    return apart


@dataclass(frozen=True)
class _Driven:
    """A run that is simulated but not yet measured; `wall_time` in s."""

    recording: Recording
    wall_time: float
    folder: RunFolder | None


class _Study:
    """A study that is going on: those that others are measured against drive first, and every run is finished as soon
    as these are there or have failed. As a context it closes the folders of the runs that it did not finish.
    """

    def __init__(
        self,
        runs: Sequence[Inputs],
        references: Mapping[str, Inputs],
        names: Mapping[Inputs, str],
        folders: Mapping[Inputs, Path],
        progress: Progress,
    ):
        self.runs, self.references = runs, references
        self.names, self.folders, self.progress = names, folders, progress
        self.simulations: dict[Inputs, Simulation] = {}
        self.driven: dict[Inputs, _Driven] = {}
        self.results: dict[Inputs, Result] = {}
        self.failures: dict[Inputs, ArsError] = {}
        self._open = ExitStack()

    def __enter__(self) -> "_Study":
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def prepare(self) -> None:
        """Make every simulation, references first. Raises what is wrong with a run; a mere reference may fail."""
        for inputs in dict.fromkeys([*self.references.values(), *self.runs]):
            self.progress(self.names[inputs], 0.0)
            try:
                self.simulations[inputs] = simulation_of(inputs)
            except ArsError as error:
                if inputs in self.runs:
                    raise
                self.failures[inputs] = error

    def drive(self) -> None:
        """Simulate all and finish the runs among them."""
        for inputs in self.simulations:
            try:
                self.driven[inputs] = self._simulate(inputs)
            except SimulationError as error:
                message = f"{self.names[inputs]}: {error}"
                self.failures[inputs] = SimulationError(message, error.time, error.channel, error.samples)
            for run in self._ready():
                self.results[run] = self._finish(run)

    def _simulate(self, inputs: Inputs) -> _Driven:
        simulation, folder = self.simulations[inputs], None
        if inputs in self.folders:
            folder = self._open.enter_context(RunFolder(self.folders[inputs], empty_recording(simulation)))

        def show(chunk: Recording) -> None:
            if folder:
                folder.append(chunk)
            self.progress(self.names[inputs], chunk.time[-1] / simulation.duration)

        start = time.perf_counter()
        recording = simulate(simulation, show)
        return _Driven(recording, time.perf_counter() - start, folder)

    def _ready(self) -> list[Inputs]:
        """The runs to be finished: those that are driven, once nothing that they are measured against is to come."""
        if any(each not in self.driven and each not in self.failures for each in self.references.values()):
            return []
        return [run for run in self.runs if run in self.driven and run not in self.results]

    def _finish(self, run: Inputs) -> Result:
        """Measure a run and complete its folder."""
        driven, cycle = self.driven[run], run.cycle.value
        others = {
            role: self.driven[other].recording
            for role, other in self.references.items()
            if other is not run and other in self.driven
        }
        window = cycle.window or (0.0, cycle.duration)
        told = {"target": _target(run), "wall_time": driven.wall_time, "held_at": _held_at(run)}
        measured = measure(Run(driven.recording, window, **others, **told))
        metrics = {name: self._explained(value) for name, value in measured.items()}
        driven.recording.metrics = {name: _told(value) for name, value in metrics.items()}
        if driven.folder:
            driven.folder.finish(driven.recording)
        return Result(self.names[run], run, driven.recording, metrics)

    def _explained(self, value: Value) -> Value:
        """A metric; where a reference is missing because it failed, with the reason."""
        for role, other in self.references.items():
            if other in self.failures and value.note == f"no {role} run to compare with":
                return replace(value, note=f"{value.note}; {self.failures[other]}")
        return value


def _told(value: Value) -> dict[str, Any]:
    """A metric as a recording keeps it: a value of None has a reason, the rest only what there is to say."""
    remark = {"reason" if value.value is None else "note": value.note} if value.note else {}
    rest = {"at_least": True} if value.at_least else {}
    table = {"table": list(value.table)} if value.table else {}
    return {"value": value.value, "unit": value.unit, **remark, **rest, **table}


def _held_at(inputs: Inputs) -> dict[str, float]:
    """The angles (rad) that the actuator holds a larger command at, by axle."""
    system, file = module_of(inputs.actuator.value), inputs.actuator.value
    return system.held_at(file) if hasattr(system, "held_at") else {}


def _target(inputs: Inputs) -> tuple[tuple[float, float], ...]:
    """The roll that an active bar without a law aims at: knots of lateral acceleration (m/s^2) and roll (rad)."""
    reference = inputs.controller.value.reference
    aims = is_active(system_for(inputs.actuator.value)) and reference and not inputs.law
    return tuple(reference.target) if aims else ()
