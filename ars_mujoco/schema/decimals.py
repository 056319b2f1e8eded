"""Decimals: numbers as one country writes them and another reads them, told apart by all that a table holds."""

import math
import re
from collections.abc import Iterable

SPACES = " \u00a0\u202f\u2009'’"  # between groups of three digits
MINUS = str.maketrans("−–", "--")
OTHER = {".": ",", ",": "."}  # by decimal mark the one that groups may have
NUMBERS = {
    mark: re.compile(
        rf"[+-]?(?:[1-9]\d{{0,2}}(?:[{group}{SPACES}]\d{{3}})+(?:[{mark}]\d*)?|\d+(?:[{mark}]\d*)?|[{mark}]\d+)"
        r"(?:[eE][+-]?\d+)?"
    )
    for mark, group in OTHER.items()
}
EITHER = re.compile(r"[+-]?[1-9]\d{0,2}[.,]\d{3}")  # 1.500 is one and a half, or fifteen hundred


def decimal_mark(cells: Iterable[tuple[int, str]]) -> str:
    """The decimal mark, "." or ",", of the numbers among `cells` (line, text); "." where they have none.

    Raises ValueError where either mark would do, with both readings.
    """
    possible, doubtful = set(OTHER), None
    for line, cell in cells:
        # a cell that is no number with either mark says nothing here
        possible = {mark for mark in possible if NUMBERS[mark].fullmatch(cell.translate(MINUS))} or possible
        if doubtful is None and EITHER.fullmatch(cell.translate(MINUS)):
            doubtful = line, cell
    if len(possible) == 1:
        return possible.pop()
    if doubtful:
        line, cell = doubtful
        readings = f"{cell.replace(',', '.')} or {re.sub('[.,]', '', cell)}"
        raise ValueError(f"line {line}: '{cell}' is {readings}, and no other number of the table tells which")
    return "."


def number(cell: str, decimal: str) -> float:
    """The number in a cell. Raises ValueError where there is none, or one with a unit."""
    text = cell.translate(MINUS)
    if not NUMBERS[decimal].fullmatch(text):
        has_unit = re.fullmatch(r"[+-]?[\d.,]+\s*[^\d\s.,].*", text) and not re.search(r"\d[eE:]", text)
        raise ValueError("not a bare number; the unit stands in the header" if has_unit else "not a finite number")
    value = float(re.sub(f"[{SPACES}{OTHER[decimal]}]", "", text).replace(decimal, "."))
    if not math.isfinite(value):
        raise ValueError("not a finite number")
    return value
