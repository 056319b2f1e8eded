"""A pump's table is read right in every common spelling, or refused with what is wrong or could be meant."""

import os
from itertools import product

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from ars_mujoco.analysis.measurements import read_measurements
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.units import to_si

NAMES = ("speed", "pressure", "displacement", "flow", "torque")
SI = dict(zip(NAMES, ("rad/s", "Pa", "m^3/rad", "m^3/s", "Nm"), strict=True))
EUROPE = ("1/min", "bar", "cm³/U", "l/min", "N·m")
AMERICA = ("rpm", "psi", "in3/rev", "gpm", "lbf-in")
POINTS = [
    (1500.0, 0.0, 0.0, -0.015, 0.13),
    (1500.0, 150.0, 1.8, 2.55, 4.5922),
    (3000.0, 75.5, 0.9, 2.625, 0.9462),
    (12000.5, 1150.25, 1.8, 5.235, -1234.6222),
]

# delimiter, decimal mark, mark between groups of three digits
LOCALES = {
    "US": (",", ".", ""), "US, groups": (";", ".", ","), "US, tabs": ("\t", ".", ""),
    "German": (";", ",", ""), "German, groups": (";", ",", "."), "German, tabs": ("\t", ",", ""),
    "French": (";", ",", "\u202f"), "Swiss": (";", ".", "'"), "quoted": (",", ",", ""),
}  # fmt: skip


def cell(value, decimal, group, delimiter):
    text = f"{value:,.4f}" if group else f"{value:.4f}"
    text = text.translate({ord(","): group, ord("."): decimal})
    return f'"{text}"' if delimiter in text else text


def titles(units, form, delimiter):
    """The header, and a second line where the units stand there."""
    match form:
        case "parentheses":
            return delimiter.join(f"{name} ({unit})" for name, unit in zip(NAMES, units, strict=True))
        case "brackets":
            return delimiter.join(f"{name.title()} [{unit}]" for name, unit in zip(NAMES, units, strict=True))
        case "quotes":
            return delimiter.join(f'"{name.upper()} ({unit})"' for name, unit in zip(NAMES, units, strict=True))
        case "second row":
            return delimiter.join(NAMES) + "\n" + delimiter.join(f"[{unit}]" for unit in units)
        case "option":
            return delimiter.join(NAMES)


def table(units, form, locale):
    delimiter, decimal, group = LOCALES[locale]
    rows = [delimiter.join(cell(value, decimal, group, delimiter) for value in point) for point in POINTS]
    return "\n".join([titles(units, form, delimiter), *rows]) + "\n"


def in_si(units):
    return {
        name: np.array([to_si(f"{point[i]!r} {units[i]}", SI[name]) for point in POINTS])
        for i, name in enumerate(NAMES)
    }


def assert_read(path, units, given=None):
    read, expected = read_measurements(path, units=given or {}), in_si(units)
    full = expected.pop("displacement")
    assert read.displacement == pytest.approx(full.max(), rel=1e-12)
    assert read.stroke == pytest.approx(full / full.max(), rel=1e-12)
    for name, values in expected.items():
        assert getattr(read, name) == pytest.approx(values, rel=1e-12, abs=1e-18)


FORMS = ("parentheses", "brackets", "quotes", "second row", "option")


@pytest.mark.parametrize(
    ("units", "form", "locale"), list(product((EUROPE, AMERICA), FORMS, LOCALES)), ids=lambda each: str(each)[:12]
)
def test_a_table_is_read_right_in_every_spelling(tmp_path, units, form, locale):
    path = tmp_path / "pump.csv"
    path.write_text(table(units, form, locale), encoding="utf-8")
    assert_read(path, units, dict(zip(NAMES, units, strict=True)) if form == "option" else None)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize("end", ["\r\n", "\n\n", "\r"])
def test_a_table_is_read_in_every_encoding(tmp_path, encoding, end):
    path = tmp_path / "pump.csv"
    text = "sep=;\n" + table(EUROPE, "parentheses", "German").replace("\n", ";\n")
    path.write_bytes(("# from the test bench\n" + text).replace("\n", end).encode(encoding))
    assert_read(path, EUROPE)


def test_a_parquet_file_is_read_with_units_in_its_names_or_beside_them(tmp_path):
    columns = dict(zip(NAMES, zip(*POINTS, strict=True), strict=True))
    named = {f"{name} ({unit})": columns[name] for name, unit in zip(NAMES, AMERICA, strict=True)}
    pq.write_table(pa.table(named), tmp_path / "named.parquet")
    assert_read(tmp_path / "named.parquet", AMERICA)
    fields = [pa.field(name, pa.float64(), metadata={"unit": unit}) for name, unit in zip(NAMES, EUROPE, strict=True)]
    pq.write_table(pa.table(columns, schema=pa.schema(fields)), tmp_path / "beside.parquet")
    assert_read(tmp_path / "beside.parquet", EUROPE)


GERMAN = "speed (rpm);pressure (bar);displacement (cm^3/rev);flow (L/min);torque (Nm)\n"
COMMAS = GERMAN.replace(";", ",")


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (COMMAS + "1500,0,0,9,1,335,0,175\n", "line 2 has 8 cells, the header 5; with decimal commas a table needs"),
        (COMMAS + "1500,0,1,1\n", "line 2 has 4 cells, the header 5"),
        (GERMAN + "1.500;0;1;5;1\n", "line 2: '1.500' is 1.500 or 1500, and no other number of the table tells which"),
        (GERMAN + "1500;0;1;1,335;1\n", "line 2: '1,335' is 1.335 or 1335, and no other number"),
        (GERMAN + "1500;0;1;1,5;1.5\n", "line 2: torque: '1.5': not a finite number"),
        (
            GERMAN + "1500 rpm;0;1;1,5;1\n",
            "line 2: speed: '1500 rpm': not a bare number; the unit stands in the header",
        ),
        (COMMAS.replace(",", " "), "line 1: needs columns with names and units, such as"),
        (
            COMMAS.replace("(bar)", "(psig)") + "1,2,3,4,5\n",
            "'pressure (psig)': unknown unit 'psig'; did you mean 'psi'?",
        ),
        (COMMAS.replace("(rpm)", "(Hz)") + "1,2,3,4,5\n", "'speed (Hz)': wrong unit; allowed: rad/s, deg/s or rpm"),
        (COMMAS + "1e308,2,3,4,5\n", "line 2: speed: '1e308': too large a number"),
        (COMMAS + f"{'1' * 200_000},2,3,4,5\n", "line 2: is no line of a table"),
        (COMMAS + '1,2,3,4,"5\n1,2,3,4,5\n', "torque: '51,2,3,4,5': not a finite number"),
        ("PK\x03\x04...", "is a spreadsheet; save it as CSV"),
        ("PAR1...", "cannot be read"),
        ("\0\0\0", "cannot be read: is no text"),
    ],
)
def test_what_cannot_be_read_is_refused_with_the_reason(tmp_path, text, problem):
    path = tmp_path / "pump.csv"
    path.write_text(text)
    with pytest.raises(InputError) as refused:
        read_measurements(path)
    assert problem in str(refused.value)


def test_neither_devices_nor_pipes_are_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    for path in (tmp_path / "pipe.csv", "/dev/zero"):
        with pytest.raises(InputError, match="cannot be read: is a device or a pipe, not a file"):
            read_measurements(path)


def test_one_number_that_only_one_country_writes_so_tells_all_others(tmp_path):
    path = tmp_path / "pump.csv"
    path.write_text(GERMAN + "1.500;0;1;0,5;1\n3.000;0;1;0,5;1\n")
    assert read_measurements(path).speed == pytest.approx([50 * np.pi, 100 * np.pi])
    path.write_text(GERMAN + "1.500;0;1;0.5;1\n3.000;0;1;0.5;1\n")
    assert read_measurements(path).speed == pytest.approx([0.05 * np.pi, 0.1 * np.pi])
