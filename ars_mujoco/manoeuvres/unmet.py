"""Unmet: what a cycle asks for and its run never meets: before its start, after its end, beyond its way."""

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from ars_mujoco.excitation.excitation import Excitation
from ars_mujoco.excitation.knots import Knots
from ars_mujoco.excitation.knots import value as knots_at
from ars_mujoco.excitation.samples import Samples
from ars_mujoco.manoeuvres.cycle import Cycle, StepSteer
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters

FEW, LATE = 0.5, 0.05  # shares of a run: covering less of it, or beginning later, a recorded input is told
STEPS = 1000  # of the way driven


def check_met(cycle: Cycle) -> None:
    """Raise InputError where a recorded input lies wholly before or after the run."""
    problems = []
    for key, samples in _within(cycle, Samples):
        first, last = samples.times[[0, -1]]
        if first >= cycle.duration or last < 0.0:
            problems.append(
                f"{key}: '{samples.file}' covers {first:.12g} s to {last:.12g} s, nothing of the run from 0 s to "
                f"{cycle.duration:g} s: its times count from another start, or in another unit"
            )
    if problems:
        raise InputError(*problems)


def remarks(cycle: Cycle, vehicle: Parameters) -> list[str]:
    """A line for everything else that the run meets only in part, or never."""
    found = [_of_samples(key, samples, cycle) for key, samples in _within(cycle, Samples)]
    for key, first, last in _changes(cycle):
        if first >= cycle.duration:
            found.append(f"{key}: begins at {first:g} s, and the run ends at {cycle.duration:g} s")
        elif last > cycle.duration:
            found.append(f"{key}: goes on to {last:g} s, and the run ends at {cycle.duration:g} s")
    if cycle.road.bump:
        found.append(_of_bump(cycle, vehicle.axle_position.values()))
    return [each for each in found if each]


def _of_samples(key: str, samples: Samples, cycle: Cycle) -> str:
    """What of the run a recorded input leaves to its first or its last value; empty where that is little."""
    first, last = samples.times[[0, -1]]
    covered = min(last, cycle.duration) - max(first, 0.0)
    if len(samples.times) == 1 or covered >= FEW * cycle.duration and first <= LATE * cycle.duration:
        return ""
    return (
        f"{key}: '{samples.file}' covers {covered:.3g} s of the run's {cycle.duration:g} s; "
        "its first and its last value are held outside"
    )


def _changes(cycle: Cycle) -> Iterator[tuple[str, float, float]]:
    """(key, start s, end s) of what is asked for over time and does not stay; an oscillation may have no end."""
    for key, asked in _within(cycle, Knots):
        wave = isinstance(asked, Excitation) and (asked.sine or asked.sweep)
        if wave:
            start, end = wave.oscillation()[3:5]
            yield f"{key}.{'sine' if asked.sine else 'sweep'}", start, end if np.isfinite(end) else start
        pairs = list(zip(asked.knots or (), (asked.knots or ())[1:], strict=False))
        changing = [(before[0], after[0]) for before, after in pairs if before[1] != after[1]]
        if changing:
            yield f"{key}.knots", changing[0][asked.join == "step"], changing[-1][1]
    if isinstance(cycle.manoeuvre, StepSteer):
        yield "manoeuvre", cycle.manoeuvre.start, cycle.manoeuvre.start + cycle.manoeuvre.ramp


def _of_bump(cycle: Cycle, axles: Iterable[float]) -> str:
    """Whether the wheels, whose `axles` start at these x (m), come to the bump; empty where all do."""
    bump, speed = cycle.road.bump, cycle.speed_signal()
    times, width = np.linspace(0.0, cycle.duration, STEPS, retstep=True)
    driven = float(np.sum([knots_at(speed, time) for time in times[:-1] + 0.5 * width])) * width
    first, last = min(axles), max(axles)
    if bump.position >= last + driven:
        return f"road.bump: begins {bump.position:g} m ahead, and the front wheels come to {last + driven:.4g} m"
    if bump.position + bump.length <= first:
        end = bump.position + bump.length
        return f"road.bump: ends at {end:g} m, behind the rear wheels, which start at {first:.3g} m"
    if bump.position >= first + driven:
        return f"road.bump: begins {bump.position:g} m ahead, and the rear wheels come to {first + driven:.4g} m only"
    return ""


def _within(block: Any, kind: type, key: str = "") -> Iterator[tuple[str, Any]]:
    """Everything of a kind in a block, with its dotted key."""
    for name in type(block).model_fields if isinstance(block, Parameters) else ():
        value, own = getattr(block, name), f"{key}.{name}".lstrip(".")
        if isinstance(value, kind):
            yield own, value
        yield from _within(value, kind, own)
