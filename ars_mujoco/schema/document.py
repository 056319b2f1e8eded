"""Files a user writes: YAML turned into a validated, SI schema, or into one error that lists every problem.

Scalars stay the text they were written as, so that the schema alone gives them meaning ("1e-3", "no" and "12:30" are
not reinterpreted) and an error quotes what stands in the file.
"""

import hashlib
import os
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from pydantic import TypeAdapter, ValidationError

from ars_mujoco.schema import library
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.suggestion import did_you_mean
from ars_mujoco.schema.units import Unit, allowed

Keys = tuple[str | int, ...]  # the way from a file's root to one of its values

PLAIN_TAGS = {"tag:yaml.org,2002:" + kind for kind in ("str", "seq", "map")}

NEEDS = {
    "model_type": "needs a block of keys",
    "model_attributes_type": "needs a block of keys",
    "dict_type": "needs a block of keys",
    "list_type": "needs a list",
    "tuple_type": "needs a list",
    "string_type": "needs a text",
}


@dataclass(frozen=True)
class Input:
    """A file as it was used: its validated `value`, `name`, `path`, the `sha256` of its bytes, and the overrides."""

    value: Any
    name: str
    path: Path
    sha256: str
    overrides: tuple[str, ...] = ()


class Written(str):
    """A text as it stands in a file, and the `folder` at which a relative path in it starts."""

    folder: Path

    def __new__(cls, text: str, folder: Path) -> "Written":
        written = super().__new__(cls, text)
        written.folder = folder
        return written


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
        content = path.read_bytes()
        document = Document(_shown(path), content.decode(), path.parent)
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{_shown(path)}: cannot be read: {error}") from None
    if document.tree == {}:
        raise InputError(f"{_shown(path)}: is empty")
    for each in overrides:
        document.override(each)
    texts = tuple(each.text for each in overrides)
    return Input(document.validate(schema), path.stem, path, hashlib.sha256(content).hexdigest(), texts)


class Document:
    """The tree of a YAML text: blocks, lists and texts, with the place each came from."""

    def __init__(self, name: str, text: str, folder: Path = Path()):
        """Parse `text`, a file's in `folder`; `name` is what errors call it. Raises InputError where it is not YAML."""
        self.name, self.folder = name, folder
        self._problems: list[tuple[int | str, str]] = []  # (origin, message)
        self._origins: dict[Keys, int | str] = {(): 1}  # a line of the file, or an override
        try:
            root = yaml.compose(text, Loader=yaml.BaseLoader)
            tree = self._value(root, ()) if root else None
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            raise InputError(f"{name}:{mark.line + 1}: {error.problem or error.context}") from None
        except yaml.YAMLError as error:
            raise InputError(f"{name}: {str(error).splitlines()[0]}") from None
        except RecursionError:
            raise InputError(f"{name}: nested too deeply, or an alias that refers to itself") from None
        self.tree = {} if tree is None else tree

    def override(self, setting: Override) -> None:
        """Set one value; blocks missing on the way to it are made, for the schema to judge."""
        *way, last = keys = setting.keys
        block = self.tree
        for depth, key in enumerate(way, 1):
            if isinstance(block, dict) and not block.get(key):
                block[key] = {}
                self._origins[keys[:depth]] = setting.text
            block = block[key] if isinstance(block, dict) else None
        if not isinstance(block, dict):
            self._problems.append((setting.text, f"{_dotted(tuple(way))}holds no keys"))
            return
        self._forget(keys)
        self._origins[keys] = setting.text
        is_collection = setting.value[:1] in ("[", "{")
        block[last] = Document(setting.text, setting.value).tree if is_collection else setting.value or None

    def validate(self, schema: Any) -> Any:
        """The tree as `schema`. Raises InputError with every problem, in the order of the lines."""
        schemas: dict[int, type[Parameters]] = {}
        value = None
        try:
            value = TypeAdapter(schema).validate_python(self.tree, context=schemas)
        except ValidationError as error:
            self._problems += [self._problem(dict(each), schemas) for each in error.errors(include_url=False)]
        if self._problems:
            lines_first = sorted(self._problems, key=lambda problem: (isinstance(problem[0], str), problem[0]))
            raise InputError(*(f"{self._place(origin)}: {message}" for origin, message in lines_first))
        return value

    def _value(self, node: yaml.Node, keys: Keys) -> Any:
        line = node.start_mark.line + 1
        self._origins.setdefault(keys, line)
        if node.tag not in PLAIN_TAGS:
            self._problems.append((line, f"{_dotted(keys)}tag '{node.tag}' is not read"))
        if isinstance(node, yaml.MappingNode):
            return self._block(node, keys)
        if isinstance(node, yaml.SequenceNode):
            return [self._value(each, (*keys, index)) for index, each in enumerate(node.value)]
        return None if node.style is None and node.value in ("", "~", "null") else Written(node.value, self.folder)

    def _block(self, node: yaml.MappingNode, keys: Keys) -> dict[str, Any]:
        block: dict[str, Any] = {}
        lines: dict[str, int] = {}
        # what `<<` brings in comes first, for the block's own keys to replace
        for key, value in sorted(node.value, key=lambda pair: pair[0].value != "<<"):
            name, line = str(key.value), key.start_mark.line + 1
            if name == "<<" and isinstance(value, yaml.MappingNode):
                block |= self._block(value, keys)
                continue
            if name in lines:
                self._problems.append((line, f"{_dotted((*keys, name))}stands twice; first on line {lines[name]}"))
            self._forget((*keys, name))
            lines[name] = self._origins[*keys, name] = line
            block[name] = self._value(value, (*keys, name))
        return block

    def _forget(self, keys: Keys) -> None:
        """Drop the origins of a value that is replaced."""
        self._origins = {each: origin for each, origin in self._origins.items() if each[: len(keys)] != keys}

    def _place(self, origin: int | str) -> str:
        return origin if isinstance(origin, str) else f"{self.name}:{origin}"

    def _problem(self, error: dict[str, Any], schemas: dict[int, type[Parameters]]) -> tuple[int | str, str]:
        """One of pydantic's errors as an origin and a message."""
        keys, block, value = self._follow(error)
        origin = next(self._origins[keys[:n]] for n in range(len(keys), -1, -1) if keys[:n] in self._origins)
        return origin, _dotted(keys) + _message(error, keys, value, schemas.get(id(block)))

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


def _message(error: dict[str, Any], keys: Keys, value: Any, schema: type[Parameters] | None) -> str:
    """What is wrong with the value at `keys`, and what is allowed there; `schema` read the block around it."""
    kind, context = error["type"], error.get("ctx", {})
    names = list(schema.model_fields) if schema else []
    written = f"'{value}': " if isinstance(value, str) else ""
    match kind:
        case "extra_forbidden" if moved := schema and schema.MOVED.get(str(keys[-1])):
            return f"has moved: {moved}"
        case "extra_forbidden":
            return f"unknown key{did_you_mean(str(keys[-1]), names)}{_listed(names)}"
        case "missing":
            return f"is missing{_listed_units(schema, keys[-1])}"
        case "literal_error" | "union_tag_invalid":
            valid = re.findall(r"'([^']*)'", context.get("expected") or context["expected_tags"])
            unknown = f"{written}unknown{did_you_mean(value, valid)}" if written else "is empty"
            return unknown + _listed(valid)
        case "union_tag_not_found":
            return written + NEEDS["model_type"] if written else "is missing"
        case _ if value is None:
            return "is empty" + _listed_units(schema, keys[-1])
        case "too_long":
            return f"takes at most {context['max_length']} values"
        case "value_error":
            return written + str(context["error"])
    return written + str(NEEDS.get(kind, error["msg"][:1].lower() + error["msg"][1:]))


def _listed(names: Iterable[str]) -> str:
    return f"; allowed: {', '.join(names)}"


def _listed_units(schema: type[Parameters] | None, key: str | int) -> str:
    field = schema.model_fields.get(str(key)) if schema else None
    units = [allowed(item.symbol) for item in field.metadata if isinstance(item, Unit)] if field else []
    return f"; a value in {units[0]}" if units else ""


def _dotted(keys: Keys) -> str:
    return ".".join(map(str, keys)) + ": " if keys else ""


def _shown(path: Path) -> str:
    """The path as short as it can be told from the working directory."""
    short = os.path.relpath(path)
    return str(path) if short.startswith("..") else short
