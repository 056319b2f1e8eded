"""Analyze: every analysis of one loop, each written as numbers (JSON) and figure (PNG, SVG) into a folder."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ars_mujoco.analysis import (
    compensators,
    frequency_response,
    hydraulic_poles,
    line_inertance,
    margins,
    pump_control_stages,
    root_locus,
    stable_region,
    steady_state,
)
from ars_mujoco.analysis.figure import save
from ars_mujoco.analysis.loop import Loop
from ars_mujoco.recording.folder import write_whole
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import Inputs, read_inputs

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
        pump_control_stages,
        line_inertance,
    )
}
NO_BOX = "Table 2's C_H is no parameter of a full circuit, where it follows from volume and bulk modulus"

Progress = Callable[[str, float], None]  # (name of the analysis, share of it done)


def read_analyzed(actuator: str | None, controller: str | None, settings: list[str]) -> Inputs:
    """The inputs of an analysis. Raises InputError, also for a setting of the cycle, which no analysis drives."""
    inputs = read_inputs(CYCLE, actuator, controller, settings=settings)
    if inputs.cycle.overrides:
        allowed = "an analysis drives no cycle; allowed: actuator.KEY, controller.KEY or vehicle.KEY"
        raise InputError(*(f"{text}: {allowed}" for text in inputs.cycle.overrides))
    return inputs


def left_out(loop: Loop) -> dict[str, str]:
    """The analyses that have no meaning for `loop`, each with the reason."""
    reasons = {}
    if loop.has_full_circuit:
        reasons |= {"hydraulic_poles": NO_BOX, "stable_region": NO_BOX}
    else:
        reasons["line_inertance"] = "needs lines with a mass: circuit full, as in pump_controlled_full"
    if loop.is_detailed:
        reasons["compensators"] = "needs the hydraulic pole pair alone: circuit reduced, pump control third_order"
    if loop.circuit.control_cylinder.mass == 0.0:
        reasons["pump_control_stages"] = "needs the actuator's oil, metering_edge and control_cylinder"
    return reasons


def analyze(loop: Loop, named: dict[str, Any], folder: Path, progress: Progress) -> dict[str, dict[str, Any]]:
    """Write NAME.json, NAME.png and NAME.svg of each analysis that `loop` allows into `folder`; returns the results by
    name. `named` tells in each what was analysed.
    """
    results = {}
    folder.mkdir(parents=True, exist_ok=True)
    for name, module in ANALYSES.items():
        if name in left_out(loop):
            continue
        progress(name, 0.0)
        results[name] = result = {"schema_version": SCHEMA_VERSION, "inputs": named, **module.compute(loop)}
        text = json.dumps(result, allow_nan=False) + "\n"
        write_whole(folder / f"{name}.json", lambda part, text=text: part.write_text(text))
        save(module.draw(result), folder, name)
        progress(name, 1.0)
    return results


def headlines(results: dict[str, dict[str, Any]]) -> list[dict[str, str]]:
    """Rows of a short table of `results`: quantity, value, and what the paper says."""
    return [{"paper": ""} | row for name, result in results.items() for row in ANALYSES[name].headline(result)]


def named(inputs: Inputs, axle: str) -> dict[str, Any]:
    """Names, hashes and settings of what was analysed."""
    record = inputs.record()
    return {"axle": axle} | {
        kind: {key: record[kind][key] for key in ("name", "sha256", "overrides")} for kind in record if kind != "cycle"
    }
