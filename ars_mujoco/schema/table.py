"""Table: named columns of numbers with units, as spreadsheets and instruments write them.

A CSV file states its own form: the header tells the delimiter, the numbers tell the decimal mark, units stand behind
the names in parentheses or brackets or in a row of their own. What can be read in two ways is refused with both. Until
a header is found nothing of a file is told, for a file that another names may be anybody's.
"""

import csv
import hashlib
import io
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ars_mujoco.schema.decimals import decimal_mark, number
from ars_mujoco.schema.quotation import quoted
from ars_mujoco.schema.source import content, text_of
from ars_mujoco.schema.suggestion import did_you_mean
from ars_mujoco.schema.units import measure, to_si

LARGEST = 50_000_000  # bytes
MOST_CELLS = 5_000_000  # of what is packed
DELIMITERS = ";\t|,"  # in this order where a header has several: a comma may also stand in a name
TITLE = re.compile(r"\s*(.*?)\s*(?:\(([^()]*(?:\([^()]*\)[^()]*)*)\)|\[([^\[\]]*)\])?\s*")  # name (unit) or name [unit]
MOST = 1e100  # of a number in SI: powers of it are still numbers
MOST_TITLES = 20  # that an error lists
WITHOUT = ("", "-", "1")  # how a row of units says that a column has none
FORM = "columns with names and units, such as 'time (s),travel (mm)'"


@dataclass(frozen=True)
class Column:
    """A column: its name and unit as they are written, the unit None where there is none, and its cells as texts."""

    name: str
    unit: str | None
    cells: tuple[str, ...]


@dataclass(frozen=True)
class Table:
    """Columns of a file; `lines` (n,) are those of its rows, `header` is that of the names, `sha256` of its bytes."""

    columns: tuple[Column, ...]
    lines: tuple[int, ...]
    header: int
    decimal: str
    sha256: str

    def named(self, name: str) -> list[Column]:
        """The columns of a name, written with whatever capitals."""
        return [each for each in self.columns if each.name.casefold() == name.casefold()]

    def column(self, name: str) -> Column:
        """The one column of a name; raises ValueError where there is none, or another."""
        found = self.named(name)
        if len(found) == 1:
            return found[0]
        if found:
            raise ValueError(f"line {self.header}: {quoted(name)} stands {len(found)} times")
        near = did_you_mean(name, [each.name for each in self.columns])
        raise ValueError(f"line {self.header}: no column {quoted(name)}{near}")

    def titles(self) -> str:
        """The columns' names, for an error."""
        return ", ".join(quoted(each.name)[1:-1] for each in self.columns[:MOST_TITLES])

    def with_units(self, units: Mapping[str, str]) -> "Table":
        """The table with `units` for columns by name; raises ValueError for a name that is none."""
        given = {id(self.column(name)): unit for name, unit in units.items()}
        return replace(self, columns=tuple(replace(each, unit=given.get(id(each), each.unit)) for each in self.columns))

    def si(self, column: Column, unit: str, **limits: float) -> np.ndarray:
        """The numbers (n,) of a column in the SI unit `unit`, within `limits` as of `to_si`.

        Raises ValueError with the first line that holds none.
        """
        written = column.unit or ""
        try:
            zero, one = (to_si(f"{each} {written}", unit) for each in (0, 1))
        except ValueError as error:
            raise ValueError(f"line {self.header}: {quoted(_title(column))}: {error}") from None
        values = np.empty(len(self.lines))
        for i, (line, cell) in enumerate(zip(self.lines, column.cells, strict=True)):
            try:
                found = number(cell, self.decimal)
                if limits:
                    to_si(f"{found!r} {written}", unit, **limits)
                values[i] = found * one if zero == 0.0 else zero + found * (one - zero)
                if not abs(values[i]) <= MOST:
                    raise ValueError("too large a number")
            except ValueError as error:
                raise ValueError(f"line {line}: {quoted(column.name)[1:-1]}: {quoted(cell)}: {error}") from None
        return values


def read_table(path: Path) -> Table:
    """The table in a CSV or a Parquet file. Raises ValueError with the line that is wrong, and with what is allowed."""
    found = content(path, LARGEST)
    sha256 = hashlib.sha256(found).hexdigest()
    if found.startswith(b"PAR1"):
        return _of_parquet(found, sha256)
    if found.startswith((b"PK\x03\x04", b"\xd0\xcf\x11\xe0")):
        raise ValueError("is a spreadsheet; save it as CSV")
    return _of_text(text_of(found), sha256)


def _of_text(text: str, sha256: str) -> Table:
    delimiter, (first, *rest) = _cells(text)
    header, titles = first
    # a delimiter at the end of every line makes no column
    width = len(titles) - (len(titles) > 1 and not titles[-1].strip())
    columns = [_named(title) for title in titles[:width]]
    rest = _in_width(rest, width, delimiter)
    if rest and all(unit is None for _, unit in columns) and (units := _units(rest[0][1])):
        columns, rest = [(name, unit) for (name, _), unit in zip(columns, units, strict=True)], rest[1:]
    numbers = [(line, cell) for line, row in rest for cell in row]
    has_marks = delimiter != "," or any("," in cell for _, cell in numbers)
    decimal = decimal_mark(numbers) if has_marks else "."
    cells = zip(*(row for _, row in rest), strict=True) if rest else ((),) * width
    named = tuple(Column(name, unit, tuple(each)) for (name, unit), each in zip(columns, cells, strict=True))
    return Table(named, tuple(line for line, _ in rest), header, decimal, sha256)


def _cells(text: str) -> tuple[str, list[tuple[int, list[str]]]]:
    """The delimiter, and the lines that hold anything, each with its number; the first of them is the header."""
    lines = io.StringIO(text, newline=None).read().split("\n")
    start = 0
    while start < len(lines) and (not lines[start].strip() or lines[start].startswith("#")):
        start += 1
    if start == len(lines):
        raise ValueError("is empty")
    stated = re.fullmatch(r"\"?sep=(.)\"?[;,\t]*", lines[start].strip(" "))
    start += bool(stated)
    head = lines[start] if start < len(lines) else ""
    delimiter = stated[1] if stated else next((each for each in DELIMITERS if each in _outside(head)), "")
    if not delimiter:
        raise ValueError(f"line {start + 1}: needs {FORM}, with commas, semicolons, tabs or | between them")
    rows = csv.reader(lines[start:], delimiter=delimiter, skipinitialspace=delimiter != "\t")
    found = []
    try:
        for row in rows:
            if any(map(str.strip, row)):
                found.append((start + rows.line_num, [cell.strip() for cell in row]))  # noqa: PERF401 (an error's line)
    except csv.Error:
        raise ValueError(f"line {start + rows.line_num}: is no line of a table") from None
    return delimiter, found


def _outside(head: str) -> str:
    """A header without what is quoted or stands in parentheses."""
    return re.sub(r"\"[^\"]*\"|\([^()]*\)|\[[^\[\]]*\]", "", head)


def _named(title: str) -> tuple[str, str | None]:
    """Name and unit of a column."""
    match = TITLE.fullmatch(title)
    if not match or not match[1]:
        return title, None
    unit = match[2] if match[2] is not None else match[3]
    return match[1], None if unit is None else unit.strip()


def _title(column: Column) -> str:
    return column.name if column.unit is None else f"{column.name} ({column.unit})"


def _in_width(rows: Iterable[tuple[int, list[str]]], width: int, delimiter: str) -> list[tuple[int, list[str]]]:
    """The rows with as many cells as the header has; empty ones may follow them."""
    fitting = []
    for line, row in rows:
        if len(row) < width or any(row[width:]):
            cells = f"{len(row)} cell" + "s" * (len(row) != 1)
            is_too_wide = len(row) > width and delimiter == ","
            hint = "; with decimal commas a table needs another delimiter" if is_too_wide else ""
            raise ValueError(f"line {line} has {cells}, the header {width}{hint}")
        fitting.append((line, row[:width]))
    return fitting


def _units(row: list[str]) -> list[str] | None:
    """The units of a row that holds nothing else, none for a column without; else None."""
    units = [each.strip("()[] ") for each in row]
    if all(unit in WITHOUT or unit[:1].isdigit() and "/" not in unit for unit in units):
        return None
    try:
        for unit in units:
            measure("1" if unit in WITHOUT else unit)
    except ValueError:
        return None
    return ["" if unit in WITHOUT else unit for unit in units]


def _of_parquet(found: bytes, sha256: str) -> Table:
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        file = pq.ParquetFile(pa.BufferReader(found))
        if file.metadata.num_rows * file.metadata.num_columns > MOST_CELLS:
            raise ValueError(f"is too long: more than {MOST_CELLS} numbers")
        table = file.read()
    except (pa.ArrowException, OSError) as error:
        raise ValueError(f"cannot be read: {error}") from None
    columns = []
    for field, values in zip(table.schema, table.columns, strict=True):
        name, unit = _named(field.name)
        stated = (field.metadata or {}).get(b"unit")
        unit = stated.decode(errors="replace") if unit is None and stated else unit
        columns.append(Column(name, unit, tuple(map(str, values.to_pylist()))))
    return Table(tuple(columns), tuple(range(1, table.num_rows + 1)), 0, ".", sha256)
