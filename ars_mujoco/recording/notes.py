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
    """A value for the eye: five digits; a metric {"value", "unit", "reason"} with its unit, or why there is none."""
    if isinstance(value, Mapping):
        if value.get("value") is None:
            return f"none: {value.get('reason', '')}"
        return f"{_figure(value['value'])} {value.get('unit', '')}".strip()
    return f"{value:.5g}" if isinstance(value, float) else str(value)
