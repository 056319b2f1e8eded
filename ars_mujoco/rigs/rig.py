"""Rig: a car or the bench with one system between its bars: its world, its channels and its callback, made for the two.

The native entry is written once, below. Each pair has a copy with globals of its own, so that it is compiled and cached
apart: what another system needs is neither compiled, carried nor recorded.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType

import numpy as np

from ars_mujoco.actuators import bar_plots, bars
from ars_mujoco.actuators.registry import system_named
from ars_mujoco.actuators.system import NOTHING, completed, is_active
from ars_mujoco.bridge.mjdata import SIGNATURE, fields, record_at, tables_address, world_address
from ars_mujoco.bridge.world import layout_version, world_dtype
from ars_mujoco.control import control_unit
from ars_mujoco.control.control_unit import COMMAND_LINE, ControlUnit
from ars_mujoco.control.sensors import SENSORS
from ars_mujoco.excitation import knots
from ars_mujoco.excitation.knots import SIGNAL
from ars_mujoco.kernels.kernel import NativeCallback, once
from ars_mujoco.rigs.plots import RigPlots
from ars_mujoco.schema.channels import Channel, channels
from ars_mujoco.schema.events import Condition
from ars_mujoco.schema.parameters import Parameters, record_dtype
from ars_mujoco.schema.plots import Tab


@dataclass(frozen=True)
class Frame:
    """A rig without a system: its records' fields, its channels, and its kernels `step`, `sense` and `act`.

    The kernels take (world, mj, tables, system); a rig whose commands come from its cycle has no `sense` and no `act`.
    """

    name: str
    parameters: list[tuple]
    state: list[tuple]
    output: type[Parameters]
    bars: type[Parameters]  # channels of the bars that it has
    step: Callable
    sense: Callable | None = None
    act: Callable | None = None
    addresses: Callable | None = None  # model -> numbers of things in it, by name
    plots: RigPlots = RigPlots()
    events: tuple[Condition, ...] = ()
    tables: Sequence[tuple] = (("nothing", "f8"),)  # what is only read, and lies in the model


def rig(name: str, system: ModuleType) -> "Rig":
    """The rig `name` with `system`, a module under the contract of `actuators.system`; made once."""
    with once.lock:
        return _rig(name, system)


@cache
def _rig(name: str, system: ModuleType) -> "Rig":
    return Rig(import_module(f"ars_mujoco.rigs.{name}").FRAME, completed(system))


class Rig:
    """A Frame with a system in it.

    CALLBACK, SENSE and ACT are its entries, C functions of mjModel and mjData at addresses; their interpreted twins are
    `step`, `sense` and `act`.
    """

    def __init__(self, frame: Frame, system: ModuleType):
        self.frame, self.system, self.NAME = frame, system, frame.name
        self.addresses = frame.addresses
        comes_late = is_active(system) and not system.IN_UNIT
        system.arrive = control_unit.arrive_late if comes_late else control_unit.arrive_now
        system.read_inputs = knots.read_all if system.INPUTS else knots.read_none
        self._blocks = {"rig": frame.output, "bars": frame.bars, "system": system.Output}
        count = len(system.INPUTS)
        self.WORLD = world_dtype(
            np.dtype(
                [
                    *frame.parameters,
                    ("unit", record_dtype(ControlUnit)),
                    ("bars", bars.STIFFNESS),
                    ("inputs", SIGNAL, count) if count else ("inputs", NOTHING),
                    ("system", system.PARAMETERS),
                ]
            ),
            np.dtype(
                [
                    *frame.state,
                    ("bars", bars.STATE),
                    ("delay", COMMAND_LINE if comes_late else NOTHING),
                    ("system", system.STATE),
                ]
            ),
            np.dtype([(name, record_dtype(block)) for name, block in self._blocks.items()]),
            np.dtype([("sensors", SENSORS), ("inputs", "f8", max(count, 1)), ("work", system.WORK)]),
        )
        self.TABLES = np.dtype(list(frame.tables))
        self.SIZE, self.VERSION = self.WORLD.itemsize // 8, layout_version(self.WORLD)
        self.TABLES_SIZE = self.TABLES.itemsize // 8
        self.world_at, self.tables_at = record_at(self.WORLD), record_at(self.TABLES)
        # compiled when their addresses are asked for; made here, as two threads must not each make one
        self.CALLBACK, self.SENSE, self.ACT = (
            NativeCallback(SIGNATURE, self._native(kernel)) for kernel in ("step", "sense", "act")
        )

    def __reduce__(self):
        return _rig_of, (self.NAME, self.system.__name__, self.system.__file__)

    @cached_property
    def channels(self) -> dict[str, Channel]:
        """Every recorded signal by name, in the order of the record."""
        return {each.name: each for each in self._all_channels() if self._is_recorded(each)}

    @cached_property
    def slots(self) -> np.ndarray:
        """(nchannel,) where userdata holds them."""
        first = self.WORLD.fields["out"][1] // 8
        return np.array([first + i for i, each in enumerate(self._all_channels()) if self._is_recorded(each)])

    @property
    def tabs(self) -> tuple[Tab, ...]:
        """What a recording shows: of the rig, of its bars and of the system."""
        return self.frame.plots.around(bar_plots.PLOTS, self.system.PLOTS)

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The moments that are worth a line."""
        return (*self.frame.events, *self.system.EVENTS)

    def _all_channels(self) -> list[Channel]:
        return [each for block in self._blocks.values() for each in channels(block)]

    def _is_recorded(self, channel: Channel) -> bool:
        """Whether the rig has the axle that a channel is of."""
        return not channel.name.startswith("rear.") or "rear" in self.frame.bars.model_fields

    def step(self, world, mj, tables) -> None:
        """One call of the callback with the shipped controller."""
        self.frame.step(world, mj, tables, self.system)

    def sense(self, world, mj, tables) -> None:
        """Bring the world to MuJoCo's time and read the sensors."""
        self.frame.sense(world, mj, tables, self.system)

    def act(self, world, mj, tables) -> None:
        """Write the forces of this step into MuJoCo, by the commands in the world."""
        self.frame.act(world, mj, tables, self.system)

    def _native(self, kernel: str) -> FunctionType:
        """A copy of `_entry` with this pair's globals, under a name of its own."""
        own = {
            "KERNEL": getattr(self.frame, kernel), "WORLD_AT": self.world_at, "TABLES_AT": self.tables_at,
            "SIZE": self.SIZE, "TABLES_SIZE": self.TABLES_SIZE, "VERSION": self.VERSION, "SYSTEM": self.system,
        }  # fmt: skip
        name = f"{self.NAME}__{self.system.__name__.replace('.', '_')}__{kernel}"
        made = FunctionType(_entry.__code__, {**_entry.__globals__, **own}, name)
        made.__qualname__ = name
        return made


def _rig_of(name: str, system: str, file: str) -> Rig:
    """The rig of that name in another process."""
    return rig(name, system_named(system, Path(file)))


def _entry(model, data):
    # the names in capitals are the globals of the pair that this is copied for
    address = world_address(model, data, SIZE, VERSION)  # noqa: F821
    if address != 0:
        tables = TABLES_AT(tables_address(model, SIZE, TABLES_SIZE))  # noqa: F821
        KERNEL(WORLD_AT(address), fields(data), tables, SYSTEM)  # noqa: F821
