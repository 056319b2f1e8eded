"""Reproduce: every claim held against the running code, written as one page and as numbers."""

import hashlib
import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ars_mujoco.recording.folder import check_writable, write_whole
from ars_mujoco.recording.summary import versions
from ars_mujoco.reproduce import (
    compensation,
    control_loop,
    energy,
    lines,
    misprints,
    poles,
    pump,
    roll,
    sizing,
    vane_motor,
)
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.page import PAPER, Section, page

SCHEMA_VERSION = 1
HTML, JSON = "reproduce.html", "reproduce.json"
GROUPS = tuple(
    module.GROUP
    for module in (
        sizing,
        pump,
        vane_motor,
        lines,
        poles,
        control_loop,
        compensation,
        energy,
        roll,
        misprints,
    )
)
ANALYSES = ("hydraulic_poles", "root_locus", "frequency_response", "stable_region", "steady_state", "compensators")
INTRODUCTION = (
    "Each claim of the paper beside what the running code gives for it, the verdict, and why. The paper's numbers are "
    "quoted from the place that is named; ours are computed when this page is made. Its figures are lost, so their "
    "text is what is checked. Where the paper gives no value, the shipped actuator's files state one with its grade."
)

Progress = Callable[[str, float], None]  # (title of the group, share of it done)


def reproduce(evidence: Evidence, folder: Path, progress: Progress) -> dict[str, Any]:
    """Write the page and the numbers into `folder`; returns the numbers. Raises InputError where it is not writable."""
    check_writable(folder)
    sections = []
    for group in GROUPS:
        progress(group.title, 0.0)
        claims = []
        for claim in group.claims(evidence):
            claims.append(claim)
            progress(group.title, len(claims) / len(group.functions))
        sections.append(Section(group.title, claims))
    numbers = record(evidence, sections)
    text = page(sections, INTRODUCTION, list(_told(numbers["inputs"])))
    folder.mkdir(parents=True, exist_ok=True)
    write_whole(folder / HTML, lambda part: part.write_text(text, encoding="utf-8"))
    write_whole(folder / JSON, lambda part: part.write_text(json.dumps(numbers, indent=2, allow_nan=False) + "\n"))
    return numbers


def record(evidence: Evidence, sections: list[Section]) -> dict[str, Any]:
    """All numbers as JSON holds them; `inputs_sha256` is the hash of all inputs as sorted JSON."""
    inputs = evidence.record()
    kinds = Counter(claim.verdict.kind.value for section in sections for claim in section.claims)
    return {
        "schema_version": SCHEMA_VERSION,
        "paper": PAPER,
        "inputs": inputs,
        "inputs_sha256": hashlib.sha256(json.dumps(inputs, sort_keys=True).encode()).hexdigest(),
        "versions": versions(),
        "verdicts": dict(kinds),
        "groups": [
            {"title": section.title, "claims": [claim.record() for claim in section.claims]} for section in sections
        ],
        "analyses": {name: getattr(evidence, name) for name in ANALYSES},
    }


def _told(inputs: list[dict[str, Any]]):
    """A line for each file that was used, and for each run's settings."""
    files = {(part, each["name"]): each["sha256"] for run in inputs for part, each in run.items()}
    yield from (f"{part} {name}: sha256 {digest}" for (part, name), digest in sorted(files.items()))
    yield f"{len(inputs)} sets of inputs were analysed or run; their settings are in {JSON}"
