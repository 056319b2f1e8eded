"""Problem: what is wrong with one value of a file, and what is allowed there, in one line."""

import re
from collections.abc import Iterable
from typing import Any

from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.quotation import MOST, quoted
from ars_mujoco.schema.suggestion import did_you_mean
from ars_mujoco.schema.units import Unit, allowed

Keys = tuple[str | int, ...]  # the way from a file's root to one of its values

NEEDS = {
    "model_type": "needs a block of keys",
    "model_attributes_type": "needs a block of keys",
    "dict_type": "needs a block of keys",
    "list_type": "needs a list",
    "tuple_type": "needs a list",
    "string_type": "needs a text",
}


def message(error: dict[str, Any], keys: Keys, value: Any, schema: type[Parameters] | None) -> str:
    """What is wrong with the value at `keys`, and what is allowed there; `schema` read the block around it."""
    kind, context = error["type"], error.get("ctx", {})
    names = list(schema.model_fields) if schema else []
    # a file that is all one text is none of ours: nothing of it is told
    written = f"{quoted(value)}: " if isinstance(value, str) and keys else ""
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


def dotted(keys: Keys) -> str:
    """The keys as a problem begins with them; nothing for the root."""
    return ".".join(each if len(each) <= MOST else quoted(each) for each in map(str, keys)) + ": " if keys else ""
