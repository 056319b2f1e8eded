"""Inputs: the four files of a run, and the settings of the command line put where they belong.

A cycle names its actuator, controller and vehicle; a setting reaches through the name into that file:
`--set duration='3 s'` changes the cycle, `--set actuator=passive` which file it names, and
`--set actuator.front.pump.speed='1500 rpm'` a value in that file. A path starts at the folder of the file that names
it, and at the working directory where the command line names it.
"""

import hashlib
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

from ars_mujoco.actuators.registry import actuator_schema, own_system, system_for
from ars_mujoco.actuators.system import is_active
from ars_mujoco.control.controller import Controller
from ars_mujoco.manoeuvres.cycle import Cycle, with_inputs
from ars_mujoco.manoeuvres.unmet import check_met
from ars_mujoco.manoeuvres.unmet import remarks as unmet
from ars_mujoco.schema import library
from ars_mujoco.schema.document import Input, Override, override, read
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.vehicle.bench import Bench
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import Sedan

VEHICLES = {"bench": Bench, "roll_plane": RollPlane, "sedan": Sedan}
REFERENCE, LOCKED = "reference", "locked"  # roles: the cycle's `reference:`, and the shipped bar with its motor held
CASCADE = "cascade"  # the shipped controller that a law in Python stands in
PARTS = ("actuator", "controller", "vehicle")


@dataclass(frozen=True, eq=False)
class Inputs:
    """What a run is made of, each an Input; `law` is the Python file that takes the place of the controller's target,
    `system` that of an actuator which a user brings.

    Two are equal only where they are one and the same, so that they can name the runs of a study.
    """

    cycle: Input
    actuator: Input
    controller: Input
    vehicle: Input
    law: Input | None = None
    system: Input | None = None
    remarks: tuple[str, ...] = ()  # on what the run does not meet

    def record(self) -> dict[str, Any]:
        """Names, hashes, settings and SI values, as a recording keeps them; a law with its path and hash."""
        recorded = {
            kind: {
                "name": each.name,
                "sha256": each.sha256,
                "overrides": list(each.overrides),
                "values": each.value.model_dump(mode="json"),
            }
            for kind, each in vars(self).items()
            if kind not in ("law", "system", "remarks")
        }
        for part, name, code in (("controller", "law", self.law), ("actuator", "system", self.system)):
            if code:
                recorded[part][name] = {"path": str(code.path), "sha256": code.sha256}
        return recorded


def read_inputs(
    cycle: str,
    actuator: str | None = None,
    controller: str | None = None,
    vehicle: str | None = None,
    settings: Iterable[str] = (),
) -> Inputs:
    """The inputs of `cycle`, a name or path; the others replace what it names; `settings` are texts "key=value".

    A law commands active bars only: others run without. Raises InputError with the problems of all files.
    """
    overrides = [override(text) for text in settings]
    chosen = {"actuator": actuator, "controller": controller, "vehicle": vehicle}
    _check_named_once(chosen, overrides)
    own_settings = [each for each in overrides if not _part(each)]
    driven = read(Cycle, cycle, "cycle", own_settings)
    parts, law, system_code, problems = {}, None, None, []
    for part in PARTS:
        name, beside = chosen[part], None
        if name is None:
            name, beside = getattr(driven.value, part), _folder(part, driven, overrides)
        own = [Override(each.text, each.keys[1:], each.value) for each in overrides if _part(each) == part]
        try:
            if part == "actuator":
                parts[part], system_code = _read_actuator(name, own, beside)
            elif part == "controller":
                parts[part], law = _read_controller(name, own, beside)
            else:
                _check_rig(name, driven.value.rig)
                parts[part] = read(VEHICLES[driven.value.rig], name, part, own, beside)
        except InputError as error:
            problems += error.problems
    if problems:
        raise InputError(*problems)
    system = system_for(parts["actuator"].value)
    if driven.value.inputs and is_active(system) and not system.INPUTS:
        raise InputError(f"inputs: the actuator '{parts['actuator'].name}' takes none")
    if taken := system.INPUTS or (driven.value.inputs and _inputs_of_its_actuator(driven, overrides)):
        driven = read(with_inputs(taken), cycle, "cycle", own_settings)
    check_met(driven.value)
    commanded = law if is_active(system) else None
    controlled = parts["controller"].value.model_copy(update={"law": commanded and str(commanded.path)})
    return Inputs(
        driven,
        **parts | {"controller": replace(parts["controller"], value=controlled)},
        law=commanded,
        system=system_code,
        remarks=(
            *(f"{text}: changes nothing" for each in (driven, *parts.values()) for text in each.idle),
            *(f"{each.text}: changes nothing: {why}" for each in overrides if (why := _unheard(each, driven, system))),
            *unmet(driven.value, parts["vehicle"].value),
        ),
    )


def read_compared(
    cycle: str,
    actuators: Iterable[str | None],
    controller: str | None = None,
    vehicle: str | None = None,
    settings: Iterable[str] = (),
) -> tuple[list[Inputs], dict[str, Inputs]]:
    """The inputs of `cycle` with each of `actuators`, and by role (REFERENCE, LOCKED) those they are measured against,
    which may be among them; on the bench, which has no roll, none.

    Settings of the actuator are for those that have something to set: not for a plain bar beside an active one, nor for
    what is only measured against. Raises InputError, also where an actuator is there twice.
    """
    actuators, settings = list(actuators), list(settings)
    others = [text for text in settings if _part(override(text)) != "actuator"]
    runs = [read_inputs(cycle, name, controller, vehicle, others) for name in actuators]
    if len(others) < len(settings):
        active = [is_active(system_for(each.actuator.value)) for each in runs]
        runs = [
            read_inputs(cycle, name, controller, vehicle, settings) if is_active or not any(active) else run
            for name, run, is_active in zip(actuators, runs, active, strict=True)
        ]
    _check_inputs_taken(runs)
    for remark in dict.fromkeys(remark for run in runs for remark in run.remarks):
        warnings.warn(remark, stacklevel=2)
    by_path = {each.actuator.path.resolve(): each for each in runs}
    if len(by_path) < len(runs):
        raise InputError(f"actuators {', '.join(each.actuator.name for each in runs)}: each can be there only once")

    driven = runs[0].cycle
    wanted = {} if driven.value.rig == "bench" else {REFERENCE: driven.value.reference, LOCKED: LOCKED}
    plain = [text for text in settings if override(text).keys[0] != "actuator"]
    references = {}
    for role, name in wanted.items():
        path = library.find("actuator", name, _folder(role, driven, map(override, settings)))
        if path.resolve() not in by_path:
            by_path[path.resolve()] = read_inputs(cycle, str(path), controller, vehicle, plain)
        references[role] = by_path[path.resolve()]
    return runs, references


def _inputs_of_its_actuator(driven: Input, overrides: list[Override]) -> Mapping[str, Any]:
    """What the cycle's own actuator takes besides commands, for one that takes none to be held against."""
    try:
        own, _ = _read_actuator(driven.value.actuator, [], _folder("actuator", driven, overrides))
    except InputError:  # told where it is to run
        return {}
    return system_for(own.value).INPUTS


def _check_inputs_taken(runs: list[Inputs]) -> None:
    """Refuse inputs of a cycle that nobody has read."""
    inputs = runs[0].cycle.value.inputs
    if (
        inputs
        and not isinstance(inputs, Parameters)
        and not any(isinstance(run.cycle.value.inputs, Parameters) for run in runs)
    ):
        raise InputError("inputs: none of the run's actuators takes any")


def _unheard(setting: Override, driven: Input, system: ModuleType) -> str:
    """Why nothing in the run listens to a setting; empty where something does."""
    if _part(setting) == "controller" and not is_active(system):
        return f"a bar that is {system.NAME} obeys no controller"
    if setting.keys == ("reference",) and driven.value.rig == "bench":
        return "on the bench nothing is compared"
    return ""


def _read_actuator(name: str, own: list[Override], beside: Path | None) -> tuple[Input, Input | None]:
    """An actuator's file, and the Python file of a user's own system; its kind is not set, for the run bears the file's
    name.
    """
    for each in own:
        if each.keys == ("kind",):
            raise InputError(f"{each.text}: the kind is the file's; name another actuator instead")
    if Path(name).suffix != ".py":
        return read(actuator_schema(), name, "actuator", own, beside), None
    code = (beside or Path()) / name
    if not code.is_file():
        raise InputError(f"no actuator '{code}'; an actuator is a shipped name, a YAML file or a Python file")
    system = own_system(code)
    if not code.with_suffix(".yaml").is_file():
        raise InputError(f"{code}: has no {code.stem}.yaml beside it, with kind: {system.NAME} and its parameters")
    return read(system.File, code.with_suffix(".yaml"), "actuator", own), _code(code)


def _read_controller(name: str, own: list[Override], beside: Path | None) -> tuple[Input, Input | None]:
    """A controller's file and its law, if any; a Python file is a law that stands in the shipped cascade."""
    is_law = Path(name).suffix == ".py"
    controller = read(Controller, CASCADE if is_law else name, "controller", own, None if is_law else beside)
    setting = next((each for each in own if each.keys == ("law",)), None)
    if is_law and setting:
        raise InputError(f"{setting.text}: the controller '{name}' is a law itself; name one of them")
    written = name if is_law else controller.value.law
    if not written:
        return controller, None
    path = (beside or Path() if is_law else Path() if setting else controller.path.parent) / written
    if path.suffix != ".py" or not path.is_file():
        kind = "controller" if is_law else "law"
        allowed = "a shipped name, a YAML file or a Python file" if is_law else "a Python file, *.py"
        raise InputError(f"no {kind} '{path}'; a {kind} is {allowed}")
    replaced = [each for each in own if each.keys[0] == "reference" and each.keys[1:2] != ("accelerometer",)]
    if replaced:
        takes = f"the law '{path}' takes the place of the target, its fade, its trim and the front's share"
        raise InputError(*(f"{each.text}: {takes}" for each in replaced))
    return controller, _code(path)


def _code(path: Path) -> Input:
    """A user's Python file, as it was used."""
    return Input(None, path.stem, path, hashlib.sha256(path.read_bytes()).hexdigest())


def _part(setting: Override) -> str | None:
    """The file besides the cycle that a setting reaches into, if any."""
    return setting.keys[0] if setting.keys[0] in PARTS and len(setting.keys) > 1 else None


def _folder(key: str, cycle: Input, overrides: Iterable[Override]) -> Path | None:
    """Where a path at `key` of the cycle starts: at the cycle's folder, or None where a setting put it there."""
    return None if any(each.keys == (key,) for each in overrides) else cycle.path.parent


def _check_named_once(chosen: dict[str, str | None], overrides: list[Override]) -> None:
    """Refuse a setting that names a part which is chosen already."""
    twice = [each for each in overrides if len(each.keys) == 1 and chosen.get(each.keys[0]) is not None]
    if twice:
        raise InputError(
            *(
                f"{each.text}: the {each.keys[0]} is also named as '{chosen[each.keys[0]]}'; name one of them"
                for each in twice
            )
        )


def _check_rig(vehicle: str, rig: str) -> None:
    """Refuse a shipped vehicle of another rig with one line, not with one for each of its keys."""
    shipped = library.shipped("vehicle")
    if vehicle in shipped and shipped[vehicle].parent.name != rig:
        fitting = ", ".join(name for name, path in shipped.items() if path.parent.name == rig)
        raise InputError(
            f"vehicle '{vehicle}' is of another rig than the cycle's, {rig}; allowed: {fitting}, or a file"
        )
