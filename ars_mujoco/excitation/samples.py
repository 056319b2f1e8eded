"""Samples: a recorded input, read from a table of times and values."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import PlainSerializer, PlainValidator, ValidationError

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.document import Written
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.quotation import quoted
from ars_mujoco.schema.table import Column, Table, read_table

MOST = 10_000  # samples: 10 s at 1 kHz, 100 s at 100 Hz

SAMPLES = np.dtype([("count", "f8"), ("times", "f8", MOST), ("values", "f8", MOST)])

HEADER = "two columns, each with its name and unit, such as 'time (s),travel (mm)'"


class Named(Parameters):
    """A recorded input of a table with other columns, or without units: `recorded: {file: log.csv, column: steer}`."""

    file: str
    column: str
    time: str | None = None  # else the first column
    units: dict[str, str] = {}  # by the column's name, where its header has none


NAMING = "{file: log.csv, column: travel, units: {time: s, travel: mm}}"


@dataclass(frozen=True, eq=False)
class Samples:
    """A recorded input: `file` as it is named, `sha256` of its bytes, `times` (n,) in s and `values` (n,) in SI."""

    file: str
    sha256: str
    times: np.ndarray
    values: np.ndarray

    def fill(self, record) -> None:
        """Write the samples into a SAMPLES record."""
        record.count = len(self.times)
        record.times[: len(self.times)], record.values[: len(self.values)] = self.times, self.values


def SamplesOf(unit: str):  # noqa: N802 (reads as a type)
    """The type of a field that names a CSV file of a quantity of the dimension of `unit`."""
    return Annotated[
        Samples,
        PlainValidator(partial(read_samples, unit=unit)),
        PlainSerializer(lambda samples: {"file": samples.file, "sha256": samples.sha256}),
    ]


def read_samples(named: str | dict, unit: str) -> Samples:
    """The samples of a file that is `named`, or is one with what `Named` has; the values have the dimension of `unit`.

    Times rise. A relative path starts at the folder of the file it is written in. Raises ValueError with the first
    line that is wrong, and with what is allowed there.
    """
    wanted = _wanted(named)
    folder = wanted.file.folder if isinstance(wanted.file, Written) else Path()
    table = read_table(folder / str(wanted.file)).with_units(wanted.units)
    time, value = _columns(table, wanted)
    if not 1 <= len(table.lines) <= MOST:
        raise ValueError(f"holds {len(table.lines)} samples; allowed: 1 to {MOST}")
    times, values = table.si(time, "s"), table.si(value, unit)
    for line, cell, rise in zip(table.lines[1:], time.cells[1:], np.diff(times), strict=True):
        if not rise > 0.0:
            raise ValueError(f"line {line}: {quoted(cell)}: times must rise from line to line")
    return Samples(str(wanted.file), table.sha256, times, values)


@kernel
def sampled(p, t: float) -> float:
    """Value at `t` (s), linear between two SAMPLES, held before the first and after the last."""
    low, high = 0, int(p.count) - 1
    if t <= p.times[low]:
        return p.values[low]
    if t >= p.times[high]:
        return p.values[high]
    while high - low > 1:
        middle = (low + high) // 2
        if p.times[middle] <= t:
            low = middle
        else:
            high = middle
    share = (t - p.times[low]) / (p.times[high] - p.times[low])
    return p.values[low] + share * (p.values[high] - p.values[low])


def _wanted(named: str | dict) -> Named:
    if isinstance(named, str):
        return Named.model_construct(file=named, column="")
    try:
        wanted = Named.model_validate(named)
    except ValidationError:
        raise ValueError("needs a file's name, or a block of file, column, and where needed time and units") from None
    return wanted.model_copy(update={"file": named["file"]})  # with the folder that it knows


def _columns(table: Table, wanted: Named) -> tuple[Column, Column]:
    """The columns of times and of values."""
    if not wanted.column:
        if len(table.columns) != 2 or any(each.unit is None for each in table.columns):
            raise ValueError(f"line {table.header}: needs {HEADER}; of more or others name one: {NAMING}")
        return table.columns
    return table.column(wanted.time) if wanted.time else table.columns[0], table.column(wanted.column)
