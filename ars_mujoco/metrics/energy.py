"""Energy: what a run draws, gives back and loses, by the roles that its energies carry, whatever the actuator is.

The books close for each block (front, rear, and what both share) on its own; see `schema.channels`. All metrics are of
the whole run, from its first sample to its last.
"""

import numpy as np

from ars_mujoco.metrics.metric import NotMeasurableError, Run, Value, column, metric
from ars_mujoco.schema.channels import Channel

BALANCE = {"drawn": 1.0, "lost": -1.0, "stored": -1.0, "done": -1.0, "delivered": -1.0}  # sums to nothing in a block
CROSSING = ("drawn", "done", "delivered")  # what passes the border of a block
LEAST_CROSSED = 1.0  # J; below it the audit's error is absolute
POWER_SPAN = 0.01  # s over which a drawn power is averaged, as the capacitors of a supply do


@metric("J", "energy drawn from outside, less what was given back there")
def drawn_energy(run: Run) -> float:
    _check_has_energies(run)
    return _total(run, "drawn") - _total(run, "delivered")


@metric("J", "energy that the axles gave back to what feeds them: the falls of what they draw, source by source")
def recovered_energy(run: Run) -> float:
    _check_has_energies(run)
    fed = [block for block in _blocks(run) if not any(each.role == "delivered" for each in block)]
    drawn = [column(run.recording, each.name) for block in fed for each in block if each.role == "drawn"]
    return sum(np.maximum(-np.diff(energy), 0.0).sum() for energy in drawn)


@metric("J", "energy lost")
def lost_energy(run: Run) -> float:
    _check_has_energies(run)
    return _total(run, "lost")


@metric("W", "largest power drawn from outside, as a mean over 10 ms")
def peak_drawn_power(run: Run) -> float:
    _check_has_energies(run)
    time = run.recording.time
    energy = _sum(run, "drawn") - _sum(run, "delivered")
    starts = time[time <= time[-1] - POWER_SPAN] if time.size else time
    if not starts.size:
        raise NotMeasurableError(f"the run is shorter than {POWER_SPAN} s")
    gained = np.interp(starts + POWER_SPAN, time, energy) - np.interp(starts, time, energy)
    return gained.max() / POWER_SPAN


@metric("J", "work drawn by the pumps' shafts, less what they gave back; the charge supply is beside it")
def shaft_energy(run: Run) -> float:
    return sum(_gain(run, name) for name in _pumps(run, "energy.shaft"))


@metric("J", "energy drawn by the charge and control supply, all of it dissipated")
def charge_energy(run: Run) -> float:
    return sum(_gain(run, name) for name in _pumps(run, "energy.charge"))


@metric("W", "largest power drawn by the pumps' shafts together")
def peak_shaft_power(run: Run) -> float:
    return sum(column(run.recording, name) for name in _pumps(run, "pump.shaft_power")).max()


@metric("1", "energy neither lost, stored, done on the car nor delivered, over all that crossed the blocks' borders")
def energy_audit_error(run: Run) -> Value:
    _check_has_energies(run)
    blocks = _blocks(run)
    astray = sum(abs(_astray(run, block)) for block in blocks)
    crossed = sum(_crossed(run, block) for block in blocks)
    if astray == 0.0 and crossed == 0.0:
        raise NotMeasurableError("nothing was drawn and no work was done")
    note = f"absolute, in J: only {crossed:.3g} J crossed a border" if crossed < LEAST_CROSSED else ""
    return Value(float(astray / max(crossed, LEAST_CROSSED)), note=note)


def _check_has_energies(run: Run) -> None:
    if not any(channel.role for channel in run.recording.channels.values()):
        raise NotMeasurableError("the run records no energies")


def _blocks(run: Run) -> list[list[Channel]]:
    """The energies that stand in a balance, block by block: `front.energy.shaft` is of the block `front`."""
    blocks: dict[str, list[Channel]] = {}
    for channel in run.recording.channels.values():
        if channel.role in BALANCE:
            blocks.setdefault(channel.name.split(".")[0], []).append(channel)
    return list(blocks.values())


def _astray(run: Run, block: list[Channel]) -> float:
    """Energy (J) that the balance of a block does not find again."""
    return sum(BALANCE[each.role] * _gain(run, each.name) for each in block)


def _crossed(run: Run, block: list[Channel]) -> float:
    """Energy (J) that passed the border of a block, either way."""
    crossing = [column(run.recording, each.name) for each in block if each.role in CROSSING]
    return sum(np.abs(np.diff(energy)).sum() for energy in crossing)


def _sum(run: Run, role: str) -> np.ndarray:
    """The energies (n,) of a role together [J]."""
    named = [each.name for each in run.recording.channels.values() if each.role == role]
    return sum((column(run.recording, name) for name in named), np.zeros(run.recording.time.size))


def _total(run: Run, role: str) -> float:
    """What the energies of a role gained together [J]."""
    return sum(_gain(run, each.name) for each in run.recording.channels.values() if each.role == role)


def _gain(run: Run, name: str) -> float:
    """What an energy gained from the first sample to the last [J]."""
    energy = column(run.recording, name)
    return energy[-1] - energy[0]


def _pumps(run: Run, ending: str) -> list[str]:
    """The channels of the pumps that end so."""
    found = [name for name in run.recording.channels if name.endswith(f".{ending}")]
    if not found:
        raise NotMeasurableError("the run records no pump")
    return found
