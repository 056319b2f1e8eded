"""Registry: the systems that are shipped, a line each, and those that users bring as Python files of their own."""

import importlib.util
import sys
from functools import cache, reduce
from hashlib import sha256
from importlib import import_module
from operator import or_
from pathlib import Path
from types import ModuleType
from typing import Annotated, Any, get_args, get_origin

from pydantic import Field, TypeAdapter

from ars_mujoco.actuators.system import check_data, system_of
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters

SYSTEMS = (
    "torsion_bar",
    "pump_controlled",
    "electromechanical",
    "electro_hydrostatic",
    "valve_controlled",
)

_own: list[ModuleType] = []  # brought by users, in this process


@cache
def systems() -> dict[str, ModuleType]:
    """The shipped systems by name."""
    return {name: import_module(f"ars_mujoco.actuators.{name}.system") for name in SYSTEMS}


@cache
def actuator_schema() -> Any:
    """The union of all that a shipped system's file can hold, told apart by its `kind`."""
    return Annotated[reduce(or_, [each.File for each in systems().values()]), Field(discriminator="kind")]


def bare(kind: str) -> Parameters:
    """The file of a kind that has no parameters, as "locked"."""
    return TypeAdapter(actuator_schema()).validate_python({"kind": kind})


def own_system(path: Path) -> ModuleType:
    """The system in a user's Python file, loaded once a process for each content.

    Raises InputError where the file cannot be run or lacks a name of the contract.
    """
    return _own_system(path.resolve(), path.read_bytes())


def system_for(file: Parameters) -> ModuleType:
    """The module that runs `file`, an instance of a system's File."""
    return system_of(module_of(file), file)


def module_of(file: Parameters) -> ModuleType:
    """The system whose File `file` is an instance of."""
    everything = [*systems().values(), *_own]
    return next(each for each in everything if isinstance(file, tuple(_classes(each.File))))


@cache
def _own_system(path: Path, content: bytes) -> ModuleType:
    name = f"ars_own_{path.stem}_{sha256(content).hexdigest()[:12]}"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # where pydantic and numba look for what the file defines
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:  # whatever a user's file raises
        raise InputError(f"{path}: {type(error).__name__}: {error}") from None
    check_data(module)
    _own.append(module)
    return module


def _classes(schema: Any) -> list[type]:
    """The classes of a union, however nested and annotated."""
    if isinstance(schema, type):
        return [schema]
    parts = get_args(schema)[:1] if get_origin(schema) is Annotated else get_args(schema)
    return [each for part in parts for each in _classes(part)]
