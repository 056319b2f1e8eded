"""Inputs: the four files of a run, and the settings of the command line put where they belong.

A cycle names its actuator, controller and vehicle; a setting reaches through the name into that file:
`--set duration='3 s'` changes the cycle, `--set actuator=passive` which file it names, and
`--set actuator.front.pump.speed='1500 rpm'` a value in that file.
"""

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ars_mujoco import library
from ars_mujoco.actuators.actuator import Actuator
from ars_mujoco.control.controller import Controller
from ars_mujoco.cycle import Cycle
from ars_mujoco.errors import InputError
from ars_mujoco.files import Input, Override, override, read
from ars_mujoco.vehicle.bench import Bench
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import Sedan

VEHICLES = {"bench": Bench, "roll_plane": RollPlane, "sedan": Sedan}
LOCKED = "locked"  # the active bar with its motor held: every run is measured against it too
CASCADE = "cascade"  # the shipped controller that a law in Python stands in
PARTS = ("actuator", "controller", "vehicle")


@dataclass(frozen=True)
class Inputs:
    """What a run is made of, each an Input."""

    cycle: Input
    actuator: Input
    controller: Input
    vehicle: Input

    def record(self) -> dict[str, Any]:
        """Names, hashes, settings and SI values, as a recording keeps them."""
        return {
            kind: {
                "name": each.name,
                "sha256": each.sha256,
                "overrides": list(each.overrides),
                "values": each.value.model_dump(mode="json"),
            }
            for kind, each in vars(self).items()
        }


def read_inputs(
    cycle: str,
    actuator: str | None = None,
    controller: str | None = None,
    vehicle: str | None = None,
    settings: Iterable[str] = (),
) -> Inputs:
    """The inputs of `cycle`, a name or path; the others replace what it names; `settings` are texts "key=value".

    Raises InputError with the problems of all files.
    """
    overrides = [override(text) for text in settings]
    driven = read(Cycle, cycle, "cycle", [each for each in overrides if not _part(each)])
    schemas = {"actuator": Actuator, "vehicle": VEHICLES[driven.value.rig]}
    chosen = {"actuator": actuator, "controller": controller, "vehicle": vehicle}
    parts, problems = {}, []
    for part in PARTS:
        name, beside = chosen[part], None
        if name is None:
            name, beside = getattr(driven.value, part), driven.path.parent
        own = [Override(each.text, each.keys[1:], each.value) for each in overrides if _part(each) == part]
        try:
            if part == "vehicle":
                _check_rig(name, driven.value.rig)
            if part == "controller":
                parts[part] = _read_controller(name, own, beside)
            else:
                parts[part] = read(schemas[part], name, part, own, beside)
        except InputError as error:
            problems += error.problems
    if problems:
        raise InputError(*problems)
    return Inputs(driven, **parts)


def read_compared(
    cycle: str,
    actuators: Iterable[str | None],
    controller: str | None = None,
    vehicle: str | None = None,
    settings: Iterable[str] = (),
) -> tuple[list[Inputs], list[Inputs]]:
    """The inputs of `cycle` with each of `actuators`, and of the runs that these are measured against and do not hold.

    Settings of the actuator are for those that have something to set: not for a plain bar beside an active one.
    """
    of_actuator = [text for text in settings if _part(override(text)) == "actuator"]
    others = [text for text in settings if text not in of_actuator]
    runs = [read_inputs(cycle, name, controller, vehicle, others) for name in actuators]
    settable = [each for each in runs if set(type(each.actuator.value).model_fields) > {"kind"}] or runs
    if of_actuator:
        runs = [
            read_inputs(cycle, str(each.actuator.path), controller, vehicle, [*others, *of_actuator])
            if each in settable
            else each
            for each in runs
        ]
    return runs, [read_inputs(cycle, name, controller, vehicle, others) for name in _references(runs)]


def _read_controller(name: str, own: list[Override], beside: Path | None) -> Input:
    """A controller's file, or a Python file with a law, which then stands in the shipped cascade.

    The law of a controller's file is named from that file's folder.
    """
    if Path(name).suffix != ".py":
        read_file = read(Controller, name, "controller", own, beside)
        law = read_file.value.law and read_file.path.parent / read_file.value.law
    else:
        read_file = read(Controller, CASCADE, "controller", own)
        law = (beside or Path()) / name
        if not law.is_file():
            raise InputError(f"no controller '{law}'; a controller is a shipped name, a YAML file or a Python file")
        read_file = replace(read_file, name=law.stem, path=law, sha256=hashlib.sha256(law.read_bytes()).hexdigest())
    return replace(read_file, value=read_file.value.model_copy(update={"law": law and str(law)}))


def _references(runs: list[Inputs]) -> list[str]:
    """The actuators that roll is measured against and that are not among `runs`; the bench has no roll."""
    cycle = runs[0].cycle.value
    wanted = [] if cycle.rig == "bench" else [cycle.reference, LOCKED]
    return [name for name in dict.fromkeys(wanted) if name not in {each.actuator.name for each in runs}]


def _part(setting: Override) -> str | None:
    """The file besides the cycle that a setting reaches into, if any."""
    return setting.keys[0] if setting.keys[0] in PARTS and len(setting.keys) > 1 else None


def _check_rig(vehicle: str, rig: str) -> None:
    """Refuse a shipped vehicle of another rig with one line, not with one for each of its keys."""
    shipped = library.shipped("vehicle")
    if vehicle in shipped and shipped[vehicle].parent.name != rig:
        fitting = ", ".join(name for name, path in shipped.items() if path.parent.name == rig)
        raise InputError(
            f"vehicle '{vehicle}' is of another rig than the cycle's, {rig}; allowed: {fitting}, or a file"
        )
