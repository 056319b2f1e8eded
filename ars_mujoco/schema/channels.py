"""Channels: every recorded signal, with its dotted name, SI unit and meaning, declared once.

The classes below are at once the layout of the records that the kernels write each step and the list that recordings,
tables and `ars list channels` show: `Axle.bar.angle` under the block `front` is the channel `front.bar.angle`.
"""

from dataclasses import dataclass
from typing import Any

from pydantic import Field

from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.units import Unit


@dataclass(frozen=True)
class Channel:
    """One recorded signal: `name` dotted, `unit` SI, `description` in a few words."""

    name: str
    unit: str
    description: str


def channel(unit: str, description: str) -> Any:
    """A recorded field: its SI unit, and what it is in a few words."""
    field = Field(description=description)
    field.metadata.append(Unit(unit))
    return field


def channels(block: type[Parameters], prefix: str = "") -> list[Channel]:
    """The channels of `block` in the order of its record: nested blocks become dotted names."""
    found = []
    for name, field in block.model_fields.items():
        if isinstance(field.annotation, type) and issubclass(field.annotation, Parameters):
            found += channels(field.annotation, f"{prefix}{name}.")
        else:
            unit = next(item.symbol for item in field.metadata if isinstance(item, Unit))
            found.append(Channel(prefix + name, unit, field.description))
    return found


def drawn(description: str) -> Any:
    """An energy (J) that came from outside, less what was given back."""
    return channel("J", description)


def lost(description: str) -> Any:
    """An energy (J) that became heat."""
    return channel("J", description)


def stored(description: str) -> Any:
    """An energy (J) that is there now."""
    return channel("J", description)


def counted(description: str) -> Any:
    """An energy (J) that another one holds already."""
    return channel("J", description)


def done(description: str) -> Any:
    """An energy (J) that went to the car as work."""
    return channel("J", description)
