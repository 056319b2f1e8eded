"""Library: finds what a user names, shipped things by their name and own files by their path.

`cycles/` and `mjcf/` stand beside the package in a checkout and inside it once installed.
"""

import re
from collections import Counter
from glob import escape
from itertools import takewhile
from pathlib import Path

from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.quotation import MOST_OF_A_PATH, quoted
from ars_mujoco.schema.suggestion import did_you_mean

PACKAGE = Path(__file__).parents[1]

# kind -> (folder, pattern of the shipped files in it); a thing's name is its file's stem
SHIPPED = {
    "cycle": ("cycles", "*.yaml"),
    "actuator": ("actuators", "*/*.yaml"),
    "controller": ("control", "*.yaml"),
    "vehicle": ("mjcf", "*/*.yaml"),
    "pump": ("hydraulics", "pumps/*.yaml"),
}

# where a value comes from: the paper's table, another published figure, derived from them, engineering judgement
GRADES = {"T": "from the paper", "P": "published", "D": "derived", "J": "judged"}
GRADE = re.compile(rf"^[^#\n]*\S[^#\n]*# ([{''.join(GRADES)}])(?:  |$)", re.MULTILINE)  # beside a value


def folder(name: str) -> Path:
    """The folder `name` inside the package, or beside it in a checkout."""
    inside = PACKAGE / name
    return inside if inside.is_dir() else PACKAGE.parent / name


def shipped(kind: str) -> dict[str, Path]:
    """The shipped files of `kind` by name, in alphabetical order."""
    where, pattern = SHIPPED[kind]
    return {path.stem: path for path in sorted(folder(where).glob(pattern), key=lambda path: path.stem)}


def shipped_file(kind: str, name: str) -> Path:
    """The file of a shipped thing. Raises InputError with the nearest and all names."""
    known = shipped(kind)
    if name not in known:
        raise InputError(f"no {kind} '{name}'{did_you_mean(name, known) or ';'} shipped: {', '.join(known)}")
    return known[name]


def description(path: Path) -> str:
    """What a file says of itself: its title, or the first sentence of the comment that it begins with."""
    first, *rest = path.read_text().splitlines() or [""]
    if not first.startswith("#"):
        return first.removeprefix("title:").strip()
    comment = takewhile(lambda line: line.startswith("#"), [first, *rest])
    text = " ".join(line.lstrip("# ") for line in comment)
    return re.split(r"\. (?=[A-Z])", text)[0].rstrip(".")


def grades(path: Path) -> dict[str, int]:
    """How many values of a file are of each grade, which the comment beside a value begins with: `# J  reason`."""
    found = Counter(GRADE.findall(path.read_text()))
    return {grade: found[grade] for grade in GRADES if found[grade]}


def find(kind: str, name_or_path: str | Path, beside: Path | None = None) -> Path:
    """The file of a shipped thing's name, or of a path; a relative path starts at the folder `beside`, if given.

    Raises InputError with the nearest and all shipped names where there is no such thing.
    """
    known, text = shipped(kind), str(name_or_path)
    if text in known:
        return known[text]
    path = (beside or Path()) / name_or_path
    if not _is_file(path):
        near = did_you_mean(text, _files_like(path)) or did_you_mean(path.stem, known)
        named = quoted(text, MOST_OF_A_PATH)
        raise InputError(f"no {kind} {named}{near or ';'} shipped: {', '.join(known)}")
    if not path.stem.strip("."):
        raise InputError(f"{kind} '{text}': results bear a file's name, and this is none without its ending; rename it")
    return path


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name that no file can have
        return False


def _files_like(path: Path) -> list[str]:
    """The files beside `path` with its ending."""
    try:
        beside_it = list(path.parent.glob("*" + escape(path.suffix))) if path.suffix else []
        return [str(path.with_name(each.name)) for each in beside_it if each.is_file()]
    except (OSError, ValueError):  # a folder that no name can have, or may not be looked into
        return []
