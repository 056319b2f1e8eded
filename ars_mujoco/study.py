"""Study: what the commands run, one cycle with one or several actuators, each measured against the others.

inputs ─> prepare ─> simulate ─> recording ─> folder
                                     └─────> metrics, against the reference and the locked bar on the same cycle
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ars_mujoco.actuators.actuator import PumpControlled
from ars_mujoco.errors import InputError
from ars_mujoco.inputs import LOCKED, Inputs
from ars_mujoco.metrics import Run, Value, measure
from ars_mujoco.recording.comparison import write_comparison
from ars_mujoco.recording.folder import RunFolder
from ars_mujoco.recording.recording import Recording
from ars_mujoco.setup import prepare
from ars_mujoco.simulation import Simulation, empty_recording, simulate

COMPARISON = "compare.rrd"

Progress = Callable[[str, float], None]  # (name of the run, share of it done)


@dataclass(frozen=True)
class Result:
    """A finished run, by its actuator's name."""

    name: str
    inputs: Inputs
    recording: Recording
    metrics: dict[str, Value]


def study(runs: Sequence[Inputs], references: Sequence[Inputs], out: Path | None, progress: Progress) -> list[Result]:
    """Simulate `runs` of one cycle and measure each against the `references` (by actuator) and each other.

    Each run writes its folder `out`/<actuator>, and several a comparison beside them, unless `out` is None; references
    write nothing. Raises InputError and SimulationError; what was simulated up to there is then readable in the folder.
    """
    names = [each.actuator.name for each in runs]
    if len(set(names)) < len(names):
        raise InputError(f"actuators {', '.join(names)}: each needs a name of its own")
    folders = {name: out / name if out else None for name in names}
    simulated = {each.actuator.name: _Simulated(each, None, progress) for each in references}
    simulated |= {each.actuator.name: _Simulated(each, folders[each.actuator.name], progress) for each in runs}
    results = [simulated[name].finish({other: each.recording for other, each in simulated.items()}) for name in names]
    if out and len(runs) > 1:
        write_comparison(out / COMPARISON, {result.name: result.recording for result in results})
    return results


def simulation_of(inputs: Inputs) -> Simulation:
    """The simulation of `inputs`, which it keeps for its recording."""
    parts = (inputs.cycle.value, inputs.actuator.value, inputs.controller.value, inputs.vehicle.value)
    return replace(prepare(*parts), inputs=inputs.record())


class _Simulated:
    """A run that is simulated but not yet measured."""

    def __init__(self, inputs: Inputs, folder: Path | None, progress: Progress):
        self.inputs = inputs
        name, duration = inputs.actuator.name, inputs.cycle.value.duration
        progress(name, 0.0)
        simulation = simulation_of(inputs)
        self.folder = RunFolder(folder, empty_recording(simulation)) if folder else None

        def show(chunk: Recording) -> None:
            if self.folder:
                self.folder.append(chunk)
            progress(name, chunk.time[-1] / duration)

        start = time.perf_counter()
        try:
            self.recording = simulate(simulation, show)
        except BaseException:
            if self.folder:
                self.folder.close()
            raise
        self.wall_time = time.perf_counter() - start

    def finish(self, others: dict[str, Recording]) -> Result:
        """Measure the run, `others` by their actuators' names, and complete its folder."""
        cycle, name = self.inputs.cycle.value, self.inputs.actuator.name
        reference, locked = (
            others.get(each) if each != name else None for each in (Path(cycle.reference).stem, LOCKED)
        )
        run = Run(
            self.recording,
            cycle.window or (0.0, cycle.duration),
            reference=reference,
            locked=locked,
            target=_target(self.inputs),
            wall_time=self.wall_time,
        )
        metrics = measure(run)
        self.recording.metrics = {metric: _told(value) for metric, value in metrics.items()}
        if self.folder:
            self.folder.finish(self.recording)
        return Result(name, self.inputs, self.recording, metrics)


def _told(value: Value) -> dict[str, Any]:
    """A metric as a recording keeps it: a value of None has a reason, the rest only what there is to say."""
    remark = {"reason" if value.value is None else "note": value.note} if value.note else {}
    rest = {"at_least": True} if value.at_least else {}
    table = {"table": list(value.table)} if value.table else {}
    return {"value": value.value, "unit": value.unit, **remark, **rest, **table}


def _target(inputs: Inputs) -> tuple[tuple[float, float], ...]:
    """The roll that an active bar aims at: knots of lateral acceleration (m/s^2) and roll (rad)."""
    reference = inputs.controller.value.reference
    is_active = isinstance(inputs.actuator.value, PumpControlled)
    return tuple(reference.target) if is_active and reference else ()
