"""Samples: a recorded input, read from a table of times and values."""

import csv
import hashlib
import re
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import PlainSerializer, PlainValidator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.document import Written
from ars_mujoco.schema.units import split, to_si

MOST = 10_000  # samples: 10 s at 1 kHz, 100 s at 100 Hz

SAMPLES = np.dtype([("count", "f8"), ("times", "f8", MOST), ("values", "f8", MOST)])

HEADER = "two columns, each with its name and unit, such as 'time (s),travel (mm)'"
NAME_AND_UNIT = re.compile(r".*\((.*)\)\s*")


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


def read_samples(name: str, unit: str) -> Samples:
    """The samples of the CSV file `name`, whose second column has the dimension of `unit`; its times rise.

    A relative path starts at the folder of the file it is written in. Raises ValueError with the first line that is
    wrong, and with what is allowed there.
    """
    path = (name.folder if isinstance(name, Written) else Path()) / str(name)
    try:
        content = path.read_bytes()
        lines = content.decode("utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    header, *rows = [(line, cells) for line, cells in enumerate(csv.reader(lines), 1) if cells] or [(1, [])]
    scales = _scales(*header, unit)
    if not 1 <= len(rows) <= MOST:
        raise ValueError(f"holds {len(rows)} samples; allowed: 1 to {MOST}")
    table = np.array([_row(line, cells) for line, cells in rows]) * scales
    for (line, cells), rise in zip(rows[1:], np.diff(table[:, 0]), strict=True):
        if not rise > 0.0:
            raise ValueError(f"line {line}: '{cells[0]}': times must rise from line to line")
    return Samples(str(name), hashlib.sha256(content).hexdigest(), table[:, 0], table[:, 1])


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


def _scales(line: int, header: list[str], unit: str) -> list[float]:
    """Size of the units of the time and the value column, in SI."""
    units = [NAME_AND_UNIT.fullmatch(cell) for cell in header]
    if len(units) != 2 or not all(units):
        raise ValueError(f"line {line}: needs {HEADER}")
    scales = []
    for match, wanted in zip(units, ("s", unit), strict=True):
        try:
            scales.append(to_si(f"1 {match[1]}", wanted))
        except ValueError as error:
            raise ValueError(f"line {line}: '{match[0].strip()}': {error}") from None
    return scales


def _row(line: int, cells: list[str]) -> list[float]:
    """Time and value of a line, in the units of their columns."""
    if len(cells) != 2:
        raise ValueError(f"line {line}: needs a time and a value, not {len(cells)} columns")
    numbers = []
    for cell in cells:
        try:
            number, unit = split(cell)
        except ValueError as error:
            raise ValueError(f"line {line}: '{cell}': {error}") from None
        if unit:
            raise ValueError(f"line {line}: '{cell}': not a bare number; the unit stands in the header")
        numbers.append(number)
    return numbers
