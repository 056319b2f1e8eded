"""System: the contract between a car and what stands between the halves of its stabilizer bars.

    command, twists ─> advance ─> torques of both bars over the coming step
                          └─────> states, channels, energies

A system is of the car: both axles, and whatever they share. It is a module with the names below, in a folder
`actuators/<name>/` or in a user's own file. A rig hands the module on as a value; numba takes a module for a constant,
so that `system.advance` is resolved while compiling and costs what a direct call does. Nothing outside reads any other
name.

Data:

    NAME                     how results and errors call it
    File                     what a user writes: a Parameters class, or a union of them, each with its `kind`
    PARAMETERS, STATE, WORK  numpy records, its blocks of the world; WORK is room that is not kept; NOTHING where empty
    Output                   its channels: blocks `front` and `rear`, and what both share; energies carry a role
    PLOTS, EVENTS            which channels stand together, and moments worth a line, as plain data
    FOLLOWS                  what of a command it obeys: "angle", "torque", or "nothing" as a passive part
    IN_UNIT                  whether its own loop runs in the car's control unit; else it gets commands that arrive late
    INPUTS                   what a cycle may command besides, by name
    BEYOND                   what to say of a run in which `is_beyond` came true
    SIZING                   how its parts follow from what a car requires, see `actuators.sizing` (optional)

Kernels (compiled; floats and records alone):

    advance(p, now, later, out, work, command, twists, moment) -> (front, rear)
        Both axles over the coming step: writes `later` and `out`, returns the bars' mean torques (Nm).
    sense(p, now, sensors)   writes angle (rad) and torque (Nm) of each bar as the system's own sensors have them
    is_beyond(p, state)      whether a state has left all that is physical

Host functions:

    fill(record, file, car, step)   writes PARAMETERS; `car` is a Car, the physics step is in s
    start(record, state)            writes STATE at rest
    variant(file) -> module         the module that runs this very file, where a kind has several layouts (optional)
    released(file) -> file          the same with its motor free to turn, for the bench (optional)
    held_at(file) -> {axle: angle}  the angle (rad) of each bar that a command beyond it is held at (optional)
"""

from collections import namedtuple
from collections.abc import Iterable
from dataclasses import dataclass
from types import ModuleType
from typing import NamedTuple

import numpy as np

from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters

NOTHING = np.dtype([("nothing", "f8")])  # numpy and numba have no empty record

# BarCommands of both bars, as `control.control_unit` has them
Command = namedtuple("Command", "front rear inputs")  # `inputs` has a number for each of INPUTS, in their order

# of a bar, left arm's angle less the right's: `angle` rad and `rate` rad/s now, `held` rad over the step
Twist = namedtuple("Twist", "angle rate held")
Twists = namedtuple("Twists", "front rear")

# time s at which the step begins, its length s, road speed m/s, and the car's control unit, a ControlUnit record
Moment = namedtuple("Moment", "time step road_speed unit")


class BarOutput(Parameters):
    """What every system that turns a bar's halves records of it, as `bar`."""

    angle: float = channel("rad", "angle between the bar's halves")
    command: float = channel("rad", "commanded angle; of a commanded torque the one at which the bar gives it")


class Torsion(NamedTuple):
    """Torsion (Nm/rad) of one axle's bar: the split one, both halves in series, and the conventional one."""

    stiffness: float
    passive_stiffness: float


class Car(NamedTuple):
    """What a system is told of the car it is built into; `inputs` are the SIGNAL records of its INPUTS, by name."""

    front: Torsion
    rear: Torsion | None  # None on the bench, which has one bar
    unit: ControlUnit
    inputs: dict[str, np.record]
    has_road: bool


class Input(NamedTuple):
    """Something that a cycle may command: its SI unit, its value without a command, the least and the largest one."""

    unit: str
    rest: float
    least: float
    most: float


@dataclass(frozen=True)
class Beyond:
    """What has happened where `is_beyond` came true, and the channels of which the largest is at fault."""

    text: str
    channels: tuple[str, ...] = ()


DATA = ("NAME", "File")  # of every module; the rest may be that of its variants
NAMES = (*DATA, *"PARAMETERS STATE Output FOLLOWS advance sense is_beyond fill start".split())
DEFAULTS = {
    "WORK": NOTHING, "PLOTS": (), "EVENTS": (), "IN_UNIT": False, "INPUTS": {},
    "BEYOND": Beyond("the actuator left what is physical"),
}  # fmt: skip


def check_data(module: ModuleType, names: Iterable[str] = DATA) -> None:
    """Raise InputError where `module` lacks one of `names`."""
    missing = [name for name in names if not hasattr(module, name)]
    if missing:
        raise InputError(f"{module.__file__}: a system needs {', '.join(missing)}")


def completed(module: ModuleType) -> ModuleType:
    """`module` with what it leaves out of the contract; raises InputError where it lacks what has no default."""
    check_data(module, NAMES)
    if module.FOLLOWS not in ("angle", "torque", "nothing"):
        raise InputError(f"{module.__file__}: FOLLOWS is '{module.FOLLOWS}'; allowed: angle, torque, nothing")
    for name, value in DEFAULTS.items():
        if not hasattr(module, name):
            setattr(module, name, value)
    return module


def system_of(module: ModuleType, file: Parameters) -> ModuleType:
    """The module that runs `file`, an instance of the File of `module`."""
    return completed(module.variant(file) if hasattr(module, "variant") else module)


def is_active(module: ModuleType) -> bool:
    """Whether a system obeys commands."""
    return module.FOLLOWS != "nothing"
