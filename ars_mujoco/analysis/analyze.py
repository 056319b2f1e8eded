"""Analyze: every analysis of one loop, each written as numbers (JSON) and figure (PNG, SVG) into a folder."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ars_mujoco.analysis import (
    compensators,
    frequency_response,
    hydraulic_poles,
    margins,
    root_locus,
    stable_region,
    steady_state,
)
from ars_mujoco.analysis.figure import save
from ars_mujoco.analysis.loop import loop_of
from ars_mujoco.errors import InputError
from ars_mujoco.inputs import Inputs, read_inputs
from ars_mujoco.recording.folder import write_whole

SCHEMA_VERSION = 1
CYCLE = "bench_s_curve"  # names the bench and the controller that an analysis is of, unless others are given
ANALYSES = {
    module.__name__.rpartition(".")[2]: module
    for module in (
        hydraulic_poles,
        root_locus,
        margins,
        frequency_response,
        stable_region,
        steady_state,
        compensators,
    )
}

Progress = Callable[[str, float], None]  # (name of the analysis, share of it done)


def read_analyzed(actuator: str | None, controller: str | None, settings: list[str]) -> Inputs:
    """The inputs of an analysis. Raises InputError, also for a setting of the cycle, which no analysis drives."""
    inputs = read_inputs(CYCLE, actuator, controller, settings=settings)
    if inputs.cycle.overrides:
        allowed = "an analysis drives no cycle; allowed: actuator.KEY, controller.KEY or vehicle.KEY"
        raise InputError(*(f"{text}: {allowed}" for text in inputs.cycle.overrides))
    return inputs


def analyze(inputs: Inputs, folder: Path, progress: Progress) -> dict[str, dict[str, Any]]:
    """Write NAME.json, NAME.png and NAME.svg of each analysis into `folder`; returns the results by name."""
    loop, results = loop_of(inputs), {}
    folder.mkdir(parents=True, exist_ok=True)
    for name, module in ANALYSES.items():
        progress(name, 0.0)
        results[name] = result = {"schema_version": SCHEMA_VERSION, "inputs": _named(inputs), **module.compute(loop)}
        text = json.dumps(result, allow_nan=False) + "\n"
        write_whole(folder / f"{name}.json", lambda part, text=text: part.write_text(text))
        save(module.draw(result), folder, name)
        progress(name, 1.0)
    return results


def headlines(results: dict[str, dict[str, Any]]) -> list[dict[str, str]]:
    """Rows of a short table of `results`: quantity, value, and what the paper says."""
    return [{"paper": ""} | row for name, module in ANALYSES.items() for row in module.headline(results[name])]


def _named(inputs: Inputs) -> dict[str, Any]:
    """Names, hashes and settings of what was analysed."""
    record = inputs.record()
    return {
        kind: {key: record[kind][key] for key in ("name", "sha256", "overrides")} for kind in record if kind != "cycle"
    }
