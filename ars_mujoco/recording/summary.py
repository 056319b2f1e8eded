"""summary.json: what was run, with which versions, and what came out.

Versions of its schema:
    1  metrics of a run's pumps
    2  metrics of energies by their roles, for any actuator: `drawn_energy`, `lost_energy` and `peak_drawn_power` are
       new; `recovered_energy` is read from what is drawn; `energy_audit_error` is relative to what crossed the borders
       of each block, no longer to the throughput of shafts and motors; a run without pumps has no `shaft_energy`
"""

import hashlib
import json
import math
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ars_mujoco import __version__
from ars_mujoco.recording.recording import Recording
from ars_mujoco.schema.document import SCHEMA_VERSION

PACKAGES = ("mujoco-core", "numba", "numpy", "rerun-sdk", "pyarrow")


def summary(run: Recording) -> dict[str, Any]:
    """The summary of `run`; `inputs_sha256` is the hash of all its inputs as sorted JSON."""
    inputs = _plain(run.inputs)
    return {
        "schema_version": SCHEMA_VERSION,
        "title": run.title,
        "inputs": inputs,
        "inputs_sha256": hashlib.sha256(json.dumps(inputs, sort_keys=True).encode()).hexdigest(),
        "versions": versions(),
        "duration": {"value": float(run.time[-1] - run.time[0]) if len(run.time) else 0.0, "unit": "s"},
        "metrics": _plain(run.metrics),
        "events": [{"time": float(event.time), "level": event.level, "text": event.text} for event in run.events],
    }


def write_summary(path: Path, run: Recording) -> None:
    """Write the summary of `run` as JSON, in the order above."""
    path.write_text(json.dumps(summary(run), indent=2, allow_nan=False) + "\n")


def versions() -> dict[str, str]:
    """Versions of this package, of Python and of what a run depends on."""
    own = {"ars_mujoco": __version__, "python": platform.python_version()}
    return own | {name: version(name) for name in PACKAGES}


def _plain(value: Any) -> Any:
    """`value` with only what JSON knows: numbers of numpy become Python's, what is not finite becomes null."""
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if isinstance(value, str | int | None) else str(value)
