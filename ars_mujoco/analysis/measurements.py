"""Measurements: the points of a pump from a table, for its losses.

Signs: the flow is positive with the displacement's, the pressure (outlet over inlet) where it resists such flow, and
the torque where it drives the shaft. So one rule holds in all four quadrants: what is missing of the flow has gone from
the high to the low side, and what is left of the torque was paid by the shaft.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.suggestion import did_you_mean
from ars_mujoco.schema.table import Column, Table, read_table

UNITS = {
    "speed": "rad/s", "pressure": "Pa", "displacement": "m^3/rad", "stroke": "1", "flow": "m^3/s", "torque": "Nm",
}  # fmt: skip
LIMITS = {"speed": {"gt": 0.0}}
SCATTER = 0.01  # of the full stroke, by which a measured one may be over it


@dataclass(frozen=True)
class Measurements:
    """Measured points, (n,) each: speed rad/s, pressure Pa, stroke 1, flow m^3/s, torque Nm; `displacement` (m^3/rad)
    is that of the full stroke.
    """

    speed: np.ndarray
    pressure: np.ndarray
    stroke: np.ndarray
    flow: np.ndarray
    torque: np.ndarray
    displacement: float

    @property
    def flow_loss(self) -> np.ndarray:
        """Flow (n,) m^3/s lost from the high to the low side (eq. 24)."""
        missing = self.stroke * self.displacement * self.speed - self.flow
        return np.where(self.pressure >= 0.0, missing, -missing)

    @property
    def torque_loss(self) -> np.ndarray:
        """Torque (n,) Nm beyond the ideal one."""
        return self.torque - self.stroke * self.displacement * self.pressure


def read_measurements(path: Path, displacement: float | None = None, units: Mapping[str, str] = {}) -> Measurements:
    """The points of a table (see `schema.table`) with columns speed, pressure, flow, torque and displacement or stroke.

    Others are ignored. `displacement` (m^3/rad) is that of the full stroke, else the largest in the file; `units` are
    those of columns whose header has none. Raises InputError with every problem found.
    """
    try:
        table = read_table(path).with_units(units)
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None
    values = _values(path, table, _columns(path, table))
    if "stroke" in values:
        if displacement is None:
            raise InputError(f"{path}: a stroke needs the full displacement: --displacement '1.8 cm^3/rev'")
    else:
        sizes = values.pop("displacement")
        displacement = displacement or float(np.abs(sizes).max())
        if displacement == 0.0:
            raise InputError(f"{path}: displacement: is zero at every point")
        values["stroke"] = sizes / displacement
    if (largest := np.abs(values["stroke"]).max()) > 1.0 + SCATTER:
        raise InputError(f"{path}: a stroke of {100 * largest:.4g} % is over the full one")
    return Measurements(**values, displacement=displacement)


def _columns(path: Path, table: Table) -> dict[str, Column]:
    """The column of each quantity."""
    found = {name: table.named(name) for name in UNITS}
    problems = [f"{name}: stands twice" for name, columns in found.items() if len(columns) > 1]
    wanted = [name for name in UNITS if name not in ("displacement", "stroke")]
    if found["displacement"] and found["stroke"]:
        problems.append("displacement and stroke: name one of them")
    elif not found["displacement"] and not found["stroke"]:
        wanted.insert(2, "displacement")
    others = [each.name for each in table.columns if each.name.casefold() not in UNITS]
    problems += [
        f"column '{name} (UNIT)' is missing{did_you_mean(name, others)}; the header has {table.titles()}"
        for name in wanted
        if not found[name]
    ]
    if problems:
        raise InputError(*(f"{path}: line {table.header}: {problem}" for problem in problems))
    return {name: columns[0] for name, columns in found.items() if columns}


def _values(path: Path, table: Table, columns: Mapping[str, Column]) -> dict[str, np.ndarray]:
    """The columns in SI."""
    values, problems = {}, []
    for name, column in columns.items():
        try:
            values[name] = table.si(column, UNITS[name], **LIMITS.get(name, {}))
        except ValueError as error:
            problems.append(f"{path}: {error}")
    if problems:
        raise InputError(*problems)
    if not table.lines:
        raise InputError(f"{path}: holds a header but no points")
    return values
