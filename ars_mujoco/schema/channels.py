"""Channels: every recorded signal, with its dotted name, SI unit and meaning, declared once.

A class of channels is at once the layout of the record that the kernels write each step and the list that recordings,
tables and `ars list channels` show: the field `angle` of `bar` in the block `front` is the channel `front.bar.angle`.

An energy carries a role, so that a recording says itself how its books are kept. They close for every block (`front`,
`rear`, and what both share, such as `supply`) on its own, each energy counted in J since the start:

    drawn = lost + change of stored + done on the car + delivered to other blocks

What a block delivers is drawn by those that it feeds, so that over the car drawn less delivered comes from outside.
"""

from dataclasses import dataclass
from typing import Any

from pydantic import Field

from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.units import Unit

ROLES = ("drawn", "lost", "stored", "done", "delivered", "counted")


@dataclass(frozen=True)
class Channel:
    """One recorded signal: `name` dotted, `unit` SI, `description` in a few words, `role` of ROLES where an energy."""

    name: str
    unit: str
    description: str
    role: str | None = None


@dataclass(frozen=True)
class Role:
    """The role of an energy, in the metadata of its field."""

    name: str


@dataclass(frozen=True)
class Scale:
    """How much of a state is little, in its SI unit, in the metadata of its field: finite differences nudge by it."""

    size: float


def channel(unit: str, description: str, *, scale: float | None = None) -> Any:
    """A recorded field: its SI unit, and what it is in a few words; `scale` (SI) of a state is a small change of it."""
    field = Field(description=description)
    field.metadata.append(Unit(unit))
    if scale is not None:
        field.metadata.append(Scale(scale))
    return field


def drawn(description: str) -> Any:
    """An energy (J) that a block draws from what feeds it, less what it gives back."""
    return _energy("drawn", description)


def lost(description: str) -> Any:
    """An energy (J) that a block has lost, mostly as heat."""
    return _energy("lost", description)


def stored(description: str) -> Any:
    """An energy (J) that is now stored in the block."""
    return _energy("stored", description)


def done(description: str) -> Any:
    """An energy (J) that went to the car as work."""
    return _energy("done", description)


def delivered(description: str) -> Any:
    """An energy (J) that a block hands to those that it feeds, less what they give back; they count it as drawn."""
    return _energy("delivered", description)


def counted(description: str) -> Any:
    """An energy (J) that is counted for its own sake and stands in no balance."""
    return _energy("counted", description)


def channels(block: type[Parameters], prefix: str = "") -> list[Channel]:
    """The channels of `block` in the order of its record: nested blocks become dotted names."""
    found = []
    for name, field in block.model_fields.items():
        if isinstance(field.annotation, type) and issubclass(field.annotation, Parameters):
            found += channels(field.annotation, f"{prefix}{name}.")
        else:
            unit = next(item.symbol for item in field.metadata if isinstance(item, Unit))
            role = next((item.name for item in field.metadata if isinstance(item, Role)), None)
            found.append(Channel(prefix + name, unit, field.description or "", role))
    return found


def _energy(role: str, description: str) -> Any:
    field = channel("J", description)
    field.metadata.append(Role(role))
    return field
