"""Mutations: what goes wrong in files, by hand, by machine or on purpose, made at random from whole ones.

Those of quantities keep a file's form and move its numbers; those of a tree know the structure of YAML and break what a
schema reads; those of a text break the structure itself. All draw from the `random.Random` that they are given, so that
a seed gives the same file for ever.
"""

import csv
import io
from random import Random
from typing import Any

import yaml

Way = tuple[str | int, ...]

UNITS = "m mm s ms kg N Nm Nm/rad rad deg rpm bar Pa m^3/rad cm^3/rev L/min m/s km/h m/s^2 g K degC psi V A % 1/bar"
NUMBERS = "nan inf -inf 0 -0 -1 1e308 -1e308 1e-308 1e-12 1e6 1e12 1e999 0x10 1_000 1,5 12:30 yes \u0663".split()
HOSTILE = (
    "", "~", "null", "[]", "{}", "..", "a: b", "\0", "é", "a\nb\rc", "<b>bold</b>", "%s%n{0}", "\x1b[31mred\x1b[0m",
    "/dev/zero", "/dev/stdin", "../../../etc/passwd", "no such file", "passive", "pump_controlled", "none", "left",
    "1 s**9**9**9", "1 m^99999999", "1 (((((m", "1 1e999", "1 __import__('os')",
    "1 " + "m*" * 500, "9" * 5000 + " m", "x" * 100_000,
)  # fmt: skip
MARKS = "\t\0\x1b\x85\ufeff:[]{},&*!|>'\"%@`#-"
BOMB = [
    "a: &a [x,x,x,x,x,x,x,x]",
    *(f"{name}: &{name} [{','.join([f'*{inner}'] * 8)}]" for inner, name in zip("abcdefg", "bcdefgh", strict=True)),
]


def moved_quantities(tree: Any, random: Random) -> Any:
    """A copy of `tree` (blocks, lists and texts) with one to four of its numbers larger, smaller or turned round."""
    tree = _plain(tree)
    ways = [way for way in _ways(tree) if way and _number(_at(tree, way)) is not None]
    for way in random.sample(ways, min(random.choice((1, 1, 2, 4)), len(ways))):
        text = _at(tree, way)
        unit = text.partition(" ")[2]
        factor = (
            random.choice((-1.0, 0.0, 0.5, 0.9, 1.1, 2.0)) if random.random() < 0.5 else 10 ** random.gauss(0.0, 2.0)
        )
        _at(tree, way[:-1])[way[-1]] = f"{factor * _number(text):.6g} {unit}".strip()
    return tree


def mutated_tree(tree: Any, random: Random) -> Any:
    """A copy of `tree` with one to three things wrong."""
    tree = _plain(tree)
    for _ in range(random.choice((1, 1, 1, 2, 3))):
        ways = [way for way in _ways(tree) if way]
        if ways:
            _mutate(tree, random.choice(ways), random)
    return tree


def mutated_text(text: str, random: Random) -> str:
    """`text` with one thing wrong in its lines or characters."""
    lines = text.splitlines() or [""]
    at = random.randrange(len(lines))
    cut = random.randrange(len(lines[at]) + 1)
    match random.randrange(11):
        case 0:
            del lines[at]
        case 1:
            lines.insert(at, lines[random.randrange(len(lines))])
        case 2:
            lines[at] = " " * random.randrange(1, 5) + lines[at]
        case 3:
            lines[at] = lines[at].lstrip()
        case 4:
            lines[at] = lines[at][:cut]
        case 5:
            lines[at] = lines[at][:cut] + random.choice(MARKS) + lines[at][cut:]
        case 6:
            lines[at:at] = BOMB
        case 7:
            lines[at:at] = [f"k{i}: {i} m" for i in range(random.choice((10, 1000)))]
        case 8:
            lines.append("last: " + "[" * random.choice((10, 3000)))
        case 9:
            lines[at:at] = ["m: &m {<<: *m}", "n: {<<: [*m, *m]}"]
        case 10:
            lines = lines[:at]
    return "\n".join(lines) + "\n"


def mutated_table(text: str, random: Random) -> bytes:
    """A CSV file with one or two things wrong."""
    rows = list(csv.reader(io.StringIO(text)))
    form = {"separator": ",", "decimal": ".", "encoding": "utf-8", "end": "\n"}
    for _ in range(random.choice((1, 1, 2))):
        if random.random() < 0.25:
            form |= random.choice(FORMS)
        else:
            rows = _mutated_rows(rows, random)
    separator, decimal = form["separator"], form["decimal"]
    lines = [separator.join(_cell(cell, separator, decimal) for cell in row) for row in rows]
    return (form["end"].join(lines) + form["end"]).encode(form["encoding"], "replace")


FORMS = (
    *({"separator": each} for each in (";", "\t", "|", ":", " ")),
    *({"encoding": each} for each in ("utf-8-sig", "utf-16", "cp1252", "utf-32")),
    *({"end": each} for each in ("\r\n", "\r", "\n\n", "\0")),
    {"decimal": ","},
    {"separator": ";", "decimal": ","},
)


def written(tree: Any) -> str:
    """`tree` as YAML."""
    return yaml.safe_dump(tree, sort_keys=False, allow_unicode=True, width=10_000)


def _mutated_rows(rows: list[list[str]], random: Random) -> list[list[str]]:
    """The rows of a table with one thing wrong."""
    rows = [list(row) for row in rows] or [[""]]
    at = random.randrange(len(rows))
    row = rows[at] = rows[at] or [""]
    column = random.randrange(len(row))
    match random.randrange(12):
        case 0 | 1:
            row[column] = random.choice((*NUMBERS, *HOSTILE))
        case 2:
            rows.insert(at, [])
        case 3:
            row += ["1"] * random.choice((1, 2, 1000))
        case 4:
            row.pop()
        case 5:
            column = random.randrange(len(rows[0] or [""]))
            unit = random.choice((*UNITS.split(), *HOSTILE))
            rows[0] = [f"{title.split('(')[0]}({unit})" if i == column else title for i, title in enumerate(rows[0])]
        case 6:
            rows[1:] = rows[:0:-1]
        case 7:
            scale, offset = random.choice((1e-6, 1e-3, 1e3, 1e9)), random.choice((0.0, 150.0, 1.7e9))
            rows[1:] = [[_shifted(row[0], scale, offset), *row[1:]] if row else row for row in rows[1:]]
        case 8:
            rows[at] = ["x" * 200_000]
        case 9:
            rows = rows[: random.randrange(3)]
        case 10:
            rows.insert(1, [random.choice(("s", "(mm)", "[rpm]", "")) for _ in rows[0]])
        case 11:
            rows.insert(at, random.choice((["# measured", "on", "Monday"], ["sep=;"])))
    return rows


def _mutate(tree: Any, way: Way, random: Random) -> None:
    """Break what lies at the end of `way`."""
    block, last = _at(tree, way[:-1]), way[-1]
    value = block[last]
    match random.randrange(12):
        case 0:
            del block[last]
        case 1 if isinstance(block, dict):
            block[_misspelt(str(last), random)] = block.pop(last)
        case 2:
            block[last] = [value]
        case 3:
            block[last] = {random.choice(("a", "knots", "kind", "<<")): value}
        case 4:
            block[last] = random.choice((None, [], {}, "", [[[[]]]], {"": None}))
        case 5 if isinstance(value, list) and value:
            block[last] = value * random.choice((0, 2, 50))
        case 6:
            block[last] = _plain(_at(tree, random.choice(_ways(tree))))
        case 7 | 8 | 9:
            block[last] = _wrong_quantity(str(value), random)
        case _:
            block[last] = random.choice(HOSTILE)


def _wrong_quantity(text: str, random: Random) -> str:
    """A quantity with another number or unit."""
    number, _, unit = text.partition(" ")
    changed = (
        f"{random.choice(NUMBERS)} {unit}", f"{number} {random.choice(UNITS.split())}", number, unit,
        f"{number} {_misspelt(unit, random)}",
    )  # fmt: skip
    return random.choice(changed).strip()


def _misspelt(name: str, random: Random) -> str:
    at = random.randrange(len(name) + 1)
    less, more = name[:at] + name[at + 1 :], name[:at] + "x" + name[at:]
    return random.choice((less, more, name.upper(), name * 1000, name + "\x1b[2J"))


def _number(value: Any) -> float | None:
    """The number that a text begins with."""
    try:
        return float(value.partition(" ")[0]) if isinstance(value, str) else None
    except ValueError:
        return None


def _ways(tree: Any, way: Way = ()) -> list[Way]:
    """The way to every value of a tree."""
    inner = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    return [way, *(each for key, value in inner for each in _ways(value, (*way, key)))]


def _at(tree: Any, way: Way) -> Any:
    for key in way:
        tree = tree[key]
    return tree


def _plain(tree: Any) -> Any:
    """A copy of `tree` with plain texts."""
    if isinstance(tree, dict):
        return {str(key): _plain(value) for key, value in tree.items()}
    if isinstance(tree, list):
        return [_plain(value) for value in tree]
    return None if tree is None else str(tree)


def _cell(text: str, separator: str, decimal: str) -> str:
    text = text.replace(".", decimal)
    return '"' + text.replace('"', '""') + '"' if separator in text else text


def _shifted(text: str, scale: float, offset: float) -> str:
    number = _number(text)
    return text if number is None else repr(scale * number + offset)
