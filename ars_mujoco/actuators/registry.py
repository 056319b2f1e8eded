"""Registry: the systems that are shipped, a line each, and the schema of every actuator that a file can name."""

from functools import cache, reduce
from importlib import import_module
from operator import or_
from types import ModuleType
from typing import Annotated, Any, get_args, get_origin

from pydantic import Field

from ars_mujoco.actuators.system import system_of
from ars_mujoco.schema.parameters import Parameters

SYSTEMS = (
    "torsion_bar",
    "pump_controlled",
)


@cache
def systems() -> dict[str, ModuleType]:
    """The shipped systems by name."""
    return {name: import_module(f"ars_mujoco.actuators.{name}.system") for name in SYSTEMS}


@cache
def actuator_schema() -> Any:
    """The union of all that a file can hold, told apart by its `kind`."""
    return Annotated[reduce(or_, [each.File for each in systems().values()]), Field(discriminator="kind")]


def system_for(file: Parameters) -> ModuleType:
    """The module that runs `file`, an instance of what `actuator_schema` allows."""
    return system_of(module_of(file), file)


def module_of(file: Parameters) -> ModuleType:
    """The system whose file `file` is."""
    return next(each for each in systems().values() if isinstance(file, tuple(_classes(each.File))))


def _classes(schema: Any) -> list[type]:
    """The classes of a union, however nested and annotated."""
    if isinstance(schema, type):
        return [schema]
    parts = get_args(schema)[:1] if get_origin(schema) is Annotated else get_args(schema)
    return [each for part in parts for each in _classes(part)]
