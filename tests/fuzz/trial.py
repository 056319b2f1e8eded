"""Trial: a shipped file with something wrong in it is read, set up and driven for 0.1 s; what came of it."""

import traceback
from dataclasses import replace
from functools import cache
from pathlib import Path
from random import Random
from typing import NamedTuple

import mutations
import numpy as np

from ars_mujoco.actuators.registry import system_for
from ars_mujoco.analysis.fit_losses import fit_losses
from ars_mujoco.metrics.energy import BALANCE, CROSSING, LEAST_CROSSED
from ars_mujoco.recording.recording import Recording
from ars_mujoco.schema import library
from ars_mujoco.schema.document import Document
from ars_mujoco.schema.errors import ArsError
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import Inputs, read_inputs
from ars_mujoco.studies.study import simulation_of

DRIVEN = 0.1  # s
AUDIT = 1e-3  # share of what crossed the borders, or J where less than that did
LONGEST = 2000  # characters of a line that an error may take

# with an error for its user; as another system than those that are compiled here; with closed books and finite
SOUND = ("refused", "read", "ran")

PUMP = """speed (rpm),pressure (bar),displacement (cm^3/rev),flow (L/min),torque (Nm)
1500,0,0,-0.015,0.13
1500,0,1.8,2.685,0.22
1500,150,0,-0.15,0.205
1500,150,1.8,2.55,4.5922
3000,0,0,-0.03,0.16
3000,0,1.8,5.37,0.25
3000,150,0,-0.165,0.235
3000,150,1.8,5.235,4.6222
"""

DRIVES = {"bench": "bench_step_1deg", "roll_plane": "roll_plane_step", "sedan": "s_curve_120kmh"}  # the parts of a rig


class Subject(NamedTuple):
    """A file to be mutated: what it is, itself, and the cycle and the actuator that drive it; None where it is one."""

    kind: str
    path: Path | None
    cycle: str | None = None
    actuator: str | None = None


class Verdict(NamedTuple):
    """What came of the file of a seed: a word of SOUND, or what must not be, and some words more."""

    subject: str
    word: str
    detail: str = ""


@cache
def subjects() -> tuple[Subject, ...]:
    """Every shipped file."""
    of = {kind: list(library.shipped(kind).values()) for kind in library.SHIPPED}
    on_bench = [*(Subject("controller", path, DRIVES["bench"]) for path in of["controller"] if "verif" in path.stem)]
    return (
        *(Subject("cycle", path) for path in of["cycle"]),
        *(Subject("actuator", path, DRIVES[_rig_of(path)]) for path in of["actuator"]),
        *(Subject("controller", path, DRIVES["roll_plane"]) for path in of["controller"]),
        *on_bench,
        *(Subject("vehicle", path, DRIVES[path.parent.name], _plain_on_road(path)) for path in of["vehicle"]),
        Subject("table", library.folder("cycles") / "bench_recorded.csv", "bench_recorded"),
        Subject("pump", None),
    )


@cache
def compiled() -> frozenset[tuple[str, str]]:
    """The rigs and systems that shipped files drive: those that other tests compile too."""
    found = set()
    for subject in subjects():
        if subject.kind in ("cycle", "actuator", "vehicle"):
            cycle = str(subject.path) if subject.kind == "cycle" else subject.cycle
            found.add(_pair(read_inputs(cycle, str(subject.path) if subject.kind == "actuator" else subject.actuator)))
    return frozenset(found)


def trial(seed: int, folder: Path) -> Verdict:
    """What comes of the file that `seed` makes in `folder`, an empty one."""
    random = Random(seed)
    subject = random.choice(subjects())
    name = f"{subject.kind} {subject.path.stem if subject.path else ''}".strip()
    try:
        word, detail = _fit(random, folder) if subject.kind == "pump" else _drive(subject, random, folder)
    except ArsError as error:
        word, detail = _judged(str(error))
    except Exception as error:
        places = [f"{Path(each.filename).name}:{each.lineno}" for each in traceback.extract_tb(error.__traceback__)]
        word, detail = "traceback", f"{type(error).__name__}: {str(error)[:200]} at {', '.join(places[-4:])}"
    return Verdict(name, word, detail)


def _drive(subject: Subject, random: Random, folder: Path) -> tuple[str, str]:
    inputs = _inputs(subject, random, folder)
    if _pair(inputs) not in compiled():
        return "read", ""
    simulation = simulation_of(inputs)
    recording = simulate(replace(simulation, duration=min(simulation.duration, DRIVEN)))
    finite = np.isfinite(recording.values).all(axis=0)
    if not finite.all():
        return "not finite", ", ".join(np.array(list(recording.channels))[~finite][:5])
    error = _books(recording)
    return ("audit", f"{error:.3g}") if error > AUDIT else ("ran", "")


def _books(recording: Recording) -> float:
    """Energy that no block finds again, over what crossed the blocks' borders, as the metric `energy_audit_error`.

    A run that is cut short ends in the midst of motion. There the energy in a car's bar, whose torque is that of the
    middle of a step, is off by the torque times half of the twist over a step: that is told from what is lost. On the
    bench the motion is known, and the books close at every step.
    """
    astray, crossed = {"front": 0.0, "rear": 0.0}, 0.0
    for channel in recording.channels.values():
        energy, block = recording[channel.name], channel.name.split(".")[0]
        astray[block] = astray.get(block, 0.0) + BALANCE.get(channel.role, 0.0) * (energy[-1] - energy[0])
        crossed += np.abs(np.diff(energy)).sum() if channel.role in CROSSING else 0.0
    for axle in ("front", "rear"):
        if "body.roll" in recording.channels:
            twist, torque = recording[f"{axle}.bar.twist"], recording[f"{axle}.bar.torque"]
            astray[axle] -= 0.5 * torque[-1] * (twist[-1] - twist[-2])
    return sum(map(abs, astray.values())) / max(crossed, LEAST_CROSSED)


def _inputs(subject: Subject, random: Random, folder: Path) -> Inputs:
    """The inputs of a run with a mutated copy of the subject's file."""
    made = folder / subject.path.name
    if subject.kind == "table":
        made.write_bytes(mutations.mutated_table(subject.path.read_text(), random))
        cycle = folder / f"{subject.cycle}.yaml"
        cycle.write_bytes(library.shipped("cycle")[subject.cycle].read_bytes())
        return read_inputs(str(cycle))
    for table in subject.path.parent.glob("*.csv"):  # that a cycle names
        (folder / table.name).write_bytes(table.read_bytes())
    made.write_text(_mutated(subject.path, random))
    if subject.kind == "cycle":
        return read_inputs(str(made))
    return read_inputs(subject.cycle, **{"actuator": subject.actuator, subject.kind: str(made)})


def _fit(random: Random, folder: Path) -> tuple[str, str]:
    (folder / "pump.csv").write_bytes(mutations.mutated_table(PUMP, random))
    fit_losses(folder / "pump.csv", (1, 1, 1), folder / "fit")
    return "ran", ""


def _mutated(source: Path, random: Random) -> str:
    text = source.read_text()
    if (choice := random.random()) < 0.2:
        return mutations.mutated_text(text, random)
    mutate = mutations.mutated_tree if choice < 0.5 else mutations.moved_quantities
    return mutations.written(mutate(Document(source.name, text).tree, random))


def _judged(message: str) -> tuple[str, str]:
    """Whether an error is one that a terminal can show and a user can read."""
    if any(not (each.isprintable() or each == "\n") for each in message):
        return "escape", repr(message[:200])
    if max(map(len, message.split("\n"))) > LONGEST:
        return "quoted", message[:200]
    return "refused", message[:300]


def _pair(inputs: Inputs) -> tuple[str, str]:
    return inputs.cycle.value.rig, system_for(inputs.actuator.value).__name__


def _rig_of(actuator: Path) -> str:
    """The rig that shows most of an actuator at little cost."""
    return "roll_plane" if actuator.stem in ("none", "passive", "locked") else "bench"


def _plain_on_road(vehicle: Path) -> str | None:
    return "passive" if vehicle.parent.name == "sedan" else None
