"""The page of a recording that says what was run and what came out, as markdown."""

from collections.abc import Mapping
from typing import Any

from ars_mujoco.recording.recording import Recording


def notes(run: Recording) -> str:
    """Title, metrics and inputs of `run` as markdown tables."""
    parts = [f"# {run.title}"]
    if run.metrics:
        parts += [
            "## Metrics",
            _table(("metric", "value"), [(name, _figure(value)) for name, value in run.metrics.items()]),
        ]
    if run.inputs:
        parts += ["## Inputs", _table(("input", "value"), list(_flat(run.inputs)))]
    return "\n\n".join(parts) + "\n"


def _table(head: tuple[str, str], rows: list[tuple[str, str]]) -> str:
    lines = [f"| {head[0]} | {head[1]} |", "|---|---|", *(f"| {name} | {value} |" for name, value in rows)]
    return "\n".join(lines)


def _flat(inputs: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """Nested `inputs` as (dotted name, text)."""
    rows = []
    for name, value in inputs.items():
        if isinstance(value, Mapping):
            rows += _flat(value, f"{prefix}{name}.")
        else:
            rows.append((prefix + name, _figure(value)))
    return rows


def _figure(value: Any) -> str:
    """A value for the eye: numbers with five digits, a metric (a mapping) with all there is to say of it."""
    if isinstance(value, Mapping):
        return _metric(value)
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _metric(metric: Mapping[str, Any]) -> str:
    """A metric {"value", "unit"}, perhaps "at_least", "note", "table"; without a value the "reason" says why."""
    if metric.get("value") is None and not metric.get("table"):
        return f"none: {metric.get('reason', 'not given')}"
    unit = metric.get("unit", "").removeprefix("1")
    figure = "" if metric.get("value") is None else f"{_figure(metric['value'])} {unit}".strip()
    bound = ">= " if metric.get("at_least") else ""
    note = f" ({metric['note']})" if metric.get("note") else ""
    rows = [", ".join(f"{name} {_figure(cell)}" for name, cell in row.items()) for row in metric.get("table", ())]
    return bound + figure + note + "".join(f"<br>{row}" for row in rows)
