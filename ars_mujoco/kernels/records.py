"""Records and tuples of numbers: what kernels do with them item by item, written out for their items while compiling.

The functions take tuples and records of any length. Interpreted they are what they say; for numba each is written for
the very types, one expression an item, so that no loop and no index is left in the machine code.
"""

from typing import Any

from numba import types

from ars_mujoco.kernels.kernel import specialized


def along(state: Any, rates: Any, h: float) -> Any:
    """Every number of the tuple `state`, `h` along its rate."""
    return tuple([x + h * rate for x, rate in zip(state, rates, strict=True)])


def zeros(like: Any) -> Any:
    """As many zeros as the tuple `like` has numbers."""
    return tuple([0.0 for _ in like])


def divided(values, by):
    """Every number of the tuple `values`, divided."""
    return tuple([value / by for value in values])


def numbers(record):
    """All numbers of a record, blocks in it included, in their order."""
    flat = []
    for name in record.dtype.names:
        part = record[name]
        flat += numbers(part) if getattr(part, "dtype", None) is not None and part.dtype.names else [float(part)]
    return tuple(flat)


def store(record, values) -> None:
    """Write as many numbers as a record has, blocks in it included."""
    for (block, name), value in zip(_places(record), values, strict=True):
        block[name] = value


def share(target, source) -> None:
    """Write every number of `source` that the record `target` has a field for."""
    for name in target.dtype.names:
        if name in source.dtype.names:
            target[name] = source[name]


def _places(record):
    for name in record.dtype.names:
        part = record[name]
        if getattr(part, "dtype", None) is not None and part.dtype.names:
            yield from _places(part)
        else:
            yield record, name


@specialized(along)
def _along(state, rates, h):
    return _giving("state, rates, h", [f"state[{i}] + h * rates[{i}]" for i in range(len(state))])


@specialized(zeros)
def _zeros(like):
    return _giving("like", ["0.0"] * len(like))


@specialized(divided)
def _divided(values, by):
    return _giving("values, by", [f"values[{i}] / by" for i in range(len(values))])


@specialized(numbers)
def _numbers(record):
    return _giving("record", [f"record.{name}" for name in _names(record)])


@specialized(store)
def _store(record, values):
    return _doing("record, values", [f"record.{name} = values[{i}]" for i, name in enumerate(_names(record))])


@specialized(share)
def _share(target, source):
    both = [name for name in target.fields if name in source.fields]
    return _doing("target, source", [f"target.{name} = source.{name}" for name in both])


def _names(record: types.Record, prefix: str = "") -> list[str]:
    """Dotted names of all numbers of a record type."""
    found = []
    for name, field in record.fields.items():
        inner = field.type
        found += _names(inner, f"{prefix}{name}.") if isinstance(inner, types.Record) else [prefix + name]
    return found


def _giving(arguments: str, items: list[str]):
    """A function of `arguments` that returns the tuple of `items`."""
    return _doing(arguments, [f"return ({''.join(f'{item}, ' for item in items)})"])


def _doing(arguments: str, lines: list[str]):
    """A function of `arguments` that runs `lines`."""
    scope: dict = {}
    exec("\n    ".join([f"def written({arguments}):", "pass", *lines]), scope)
    return scope["written"]
