"""Files a user writes: YAML turned into a validated, SI schema, or into one error that lists every problem.

Scalars stay the text they were written as, so that the schema alone gives them meaning ("1e-3", "no" and "12:30" are
not reinterpreted) and an error quotes what stands in the file.
"""

import hashlib
import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml
from pydantic import TypeAdapter, ValidationError

from ars_mujoco.schema import library
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.problem import Keys, dotted, message
from ars_mujoco.schema.quotation import is_unseen, quoted, seen
from ars_mujoco.schema.source import content

SCHEMA_VERSION = 2  # of files and summaries
LARGEST = 1_000_000  # bytes of a file
MOST_VALUES = 50_000  # that a file holds, each counted wherever an alias or a merge repeats it
MOST_PROBLEMS = 30  # that an error lists
LAID_OUT = "\n\t"  # characters that are not seen and belong to texts

PLAIN_TAGS = {"tag:yaml.org,2002:" + kind for kind in ("str", "seq", "map")}


@dataclass(frozen=True)
class Input:
    """A file as it was used: its validated `value`, `name`, `path`, the `sha256` of its bytes, and the overrides, of
    which `idle` found the file as they would have it.
    """

    value: Any
    name: str
    path: Path
    sha256: str
    overrides: tuple[str, ...] = ()
    idle: tuple[str, ...] = ()


class Written(str):
    """A text as it stands in a file, and the `folder` at which a relative path in it starts."""

    folder: Path

    def __new__(cls, text: str, folder: Path) -> "Written":
        written = super().__new__(cls, text)
        written.folder = folder
        return written


@dataclass
class Place:
    """Where a value came from, a line of the file or an override, and the places of what it holds."""

    origin: int | str
    inner: "dict[str | int, Place]" = field(default_factory=dict)

    def of(self, keys: Keys) -> "Place":
        """The place of `keys`, or of the last of them that has one."""
        place = self
        for key in keys:
            if key not in place.inner:
                break
            place = place.inner[key]
        return place


@dataclass(frozen=True)
class Override:
    """A value set on the command line: its `text` as written there, the `keys` it goes to, and the `value` as text."""

    text: str
    keys: tuple[str, ...]
    value: str


def override(text: str) -> Override:
    """The Override of "dotted.key=value". Raises InputError where it is not written like that."""
    dotted, _, value = (part.strip() for part in text.partition("="))
    keys = tuple(dotted.split("."))
    if "=" not in text or not all(keys):
        raise InputError(f"--set {text}: not a setting; written as key=value, such as duration='3 s'")
    return Override(f"--set {text}", keys, value)


def read(
    schema: Any, name_or_path: str | Path, kind: str, overrides: Iterable[Override] = (), beside: Path | None = None
) -> Input:
    """Read the `kind` ("cycle", "actuator", ...) of a name or path as `schema`, a Parameters class or a union of them.

    `overrides` are applied before validation. A relative path starts at the folder `beside`.
    Raises InputError with every problem found, each with its line, key, value and what is allowed.
    """
    path, overrides = library.find(kind, name_or_path, beside), tuple(overrides)
    try:
        found = content(path, LARGEST)
        document = Document(_shown(path), found.decode(), path.parent)
    except UnicodeDecodeError as error:
        raise InputError(f"{_shown(path)}: cannot be read: {error}") from None
    except ValueError as error:
        raise InputError(f"{_shown(path)}: {error}") from None
    if document.tree == {}:
        raise InputError(f"{_shown(path)}: is empty")
    document.take_version()
    before = document.without_overrides(schema) if overrides else None
    for each in overrides:
        document.override(each)
    value, texts = document.validate(schema), tuple(each.text for each in overrides)
    idle = tuple(each.text for each in overrides if before and _held(before, each.keys) == _held(value, each.keys))
    return Input(value, path.stem, path, hashlib.sha256(found).hexdigest(), texts, idle)


class Document:
    """The tree of a YAML text: blocks, lists and texts, with the place each came from."""

    def __init__(self, name: str, text: str, folder: Path = Path()):
        """Parse `text`, a file's in `folder`; `name` is what errors call it. Raises InputError where it is not YAML."""
        self.name, self.folder = name, folder
        self._problems: list[tuple[int | str, str]] = []  # (origin, message)
        self._places, self._count = Place(1), 0
        try:
            root = yaml.compose(text, Loader=yaml.BaseLoader)
            tree = self._value(root, (), self._places) if root else None
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            raise InputError(f"{name}:{mark.line + 1}: {error.problem or error.context}") from None
        except yaml.YAMLError as error:
            raise InputError(f"{name}: {str(error).splitlines()[0]}") from None
        except RecursionError:
            raise InputError(f"{name}: nested too deeply, or an alias that refers to itself") from None
        self.tree = {} if tree is None else tree

    def take_version(self) -> None:
        """Take out the `schema_version` that a file may state. Raises InputError for one that is not known yet.

        Keys that have moved since an older one are told by the schema (`Parameters.MOVED`).
        """
        stated = self.tree.pop("schema_version", None) if isinstance(self.tree, dict) else None
        if stated is not None and stated not in [str(each + 1) for each in range(SCHEMA_VERSION)]:
            raise InputError(
                f"{self.name}: schema_version: {quoted(stated)}: this release reads 1 to {SCHEMA_VERSION}; "
                "a file of a later one needs that"
            )

    def override(self, setting: Override) -> None:
        """Set one value; blocks missing on the way to it are made, for the schema to judge."""
        *way, last = setting.keys
        block, place = self.tree, self._places
        for key in way:
            if isinstance(block, dict) and not block.get(key):
                block[key], place.inner[key] = {}, Place(setting.text)
            block = block[key] if isinstance(block, dict) else None
            place = place.inner.get(key, place)
        if not isinstance(block, dict):
            self._problems.append((setting.text, f"{dotted(tuple(way))}holds no keys"))
            return
        place.inner[last] = Place(setting.text)
        is_collection = setting.value[:1] in ("[", "{")
        block[last] = Document(setting.text, setting.value).tree if is_collection else setting.value or None

    def without_overrides(self, schema: Any) -> Any:
        """The tree as `schema`, None where it is none yet; before any override."""
        try:
            return TypeAdapter(schema).validate_python(self.tree)
        except ValidationError:
            return None

    def validate(self, schema: Any) -> Any:
        """The tree as `schema`. Raises InputError with every problem, in the order of the lines."""
        schemas: dict[int, type[Parameters]] = {}
        value = None
        try:
            value = TypeAdapter(schema).validate_python(self.tree, context=schemas)
        except ValidationError as error:
            found = [(*self._follow(each), each) for each in map(dict, error.errors(include_url=False))]
            found.sort(key=lambda each: _in_order(self._places.of(each[0]).origin))
            for keys, block, value, each in found[:MOST_PROBLEMS]:
                told = dotted(keys) + message(each, keys, value, schemas.get(id(block)))
                self._problems.append((self._places.of(keys).origin, told))
            self._problems += [(str(self.name), f"and {len(found) - MOST_PROBLEMS} more")] * (
                len(found) > MOST_PROBLEMS
            )
        if self._problems:
            self._problems.sort(key=lambda problem: _in_order(problem[0]))
            raise InputError(*(f"{self._place(origin)}: {message}" for origin, message in self._problems))
        return value

    def _value(self, node: yaml.Node, keys: Keys, place: Place) -> Any:
        line = node.start_mark.line + 1
        self._count += 1
        if self._count > MOST_VALUES:
            raise InputError(f"{self.name}: holds more than {MOST_VALUES} values, those counted that aliases repeat")
        if node.tag not in PLAIN_TAGS:
            self._problems.append((line, f"{dotted(keys)}tag {quoted(node.tag)} is not read"))
        if isinstance(node, yaml.MappingNode):
            return self._block(node, keys, place)
        if isinstance(node, yaml.SequenceNode):
            return [self._item(each, (*keys, index), place) for index, each in enumerate(node.value)]
        self._check_seen(node.value, line, keys)
        return None if node.style is None and node.value in ("", "~", "null") else Written(node.value, self.folder)

    def _item(self, node: yaml.Node, keys: Keys, place: Place) -> Any:
        """A value of a block or a list, whose own place it gets anew."""
        place.inner[keys[-1]] = Place(node.start_mark.line + 1)
        return self._value(node, keys, place.inner[keys[-1]])

    def _block(self, node: yaml.MappingNode, keys: Keys, place: Place) -> dict[str, Any]:
        block: dict[str, Any] = {}
        lines: dict[str, int] = {}
        # what `<<` brings in comes first, for the block's own keys to replace
        for key, value in sorted(node.value, key=lambda pair: pair[0].value != "<<"):
            name, line = str(key.value), key.start_mark.line + 1
            if name == "<<":
                block |= self._merged(value, keys, place)
                continue
            if name in lines:
                self._problems.append((line, f"{dotted((*keys, name))}stands twice; first on line {lines[name]}"))
            self._check_seen(name, line, keys)
            lines[name] = line
            block[name] = self._item(value, (*keys, name), place)
            place.inner[name].origin = line
        return block

    def _merged(self, node: yaml.Node, keys: Keys, place: Place) -> dict[str, Any]:
        """The block that a merge brings in, or the blocks of a list, of which an earlier one counts before a later."""
        blocks = node.value if isinstance(node, yaml.SequenceNode) else [node]
        merged: dict[str, Any] = {}
        for each in reversed(blocks):
            if isinstance(each, yaml.MappingNode):
                self._count += 1  # also where it is empty
                merged |= self._block(each, keys, place)
            else:
                line = each.start_mark.line + 1
                self._problems.append(
                    (line, f"{dotted((*keys, '<<'))}merges a block of keys, or a list of such blocks")
                )
        return merged

    def _check_seen(self, text: str, line: int, keys: Keys) -> None:
        """Note a text that would command the terminal it is shown on."""
        unseen = next((each for each in text if is_unseen(each) and each not in LAID_OUT), None)
        if unseen:
            self._problems.append((line, f"{dotted(keys)}holds the character '{seen(unseen)}', which is no text"))

    def _place(self, origin: int | str) -> str:
        return origin if isinstance(origin, str) else f"{self.name}:{origin}"

    def _follow(self, error: dict[str, Any]) -> tuple[Keys, Any, Any]:
        """The keys of an error, the block they end in and the value there, without pydantic's labels of unions."""
        *way, last = error["loc"] or [""]
        keys: list[str | int] = []
        block = value = self.tree
        for key in (*way, last):
            here = isinstance(value, dict) and key in value or isinstance(value, list) and key in range(len(value))
            if here:
                keys, block, value = [*keys, key], value, value[key]
        if error["type"] == "missing":
            keys, block, value = [*keys, last], value, None
        if error["type"].startswith("union_tag") and isinstance(value, dict):
            kind = error["ctx"]["discriminator"].strip("'")
            keys, block, value = [*keys, kind], value, value.get(kind)
        return tuple(keys), block, value


def _held(value: Any, keys: Iterable[str]) -> Any:
    """What a block holds at `keys`, itself a default too."""
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else getattr(value, key, None)
    return value


def _in_order(origin: int | str) -> tuple[bool, int | str]:
    """Lines first, each in its order."""
    return isinstance(origin, str), origin


def _shown(path: Path) -> str:
    """The path as short as it can be told from the working directory."""
    short = os.path.relpath(path)
    return str(path) if short.startswith("..") else short
