"""The simulation: drive a cycle and return its recording. This is the loop; everything else serves it."""

from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass, field

import mujoco
import numpy as np

from ars_mujoco.bridge import world as worlds
from ars_mujoco.control.law import Law
from ars_mujoco.control.law_run import LawRun
from ars_mujoco.recording.recording import Recording, joined, scene_of
from ars_mujoco.rigs.rig import Rig
from ars_mujoco.schema.errors import SimulationError
from ars_mujoco.simulation.events import Watch
from ars_mujoco.simulation.sampler import Sampler

CHUNK = 2.0  # s between two looks at the run
LAST_SAMPLES = 5  # that a failed run's error shows


@dataclass(frozen=True)
class Simulation:
    """What `simulate` runs: a rig with its system, a model that carries the initial world; it starts at keyframe 0."""

    rig: Rig
    model: mujoco.MjModel
    duration: float  # s
    title: str
    law: Law | None = None  # a user's controller in place of the shipped one
    inputs: dict = field(default_factory=dict)

    def start(self) -> mujoco.MjData:
        """New data at the start of the cycle; the world follows at the first call."""
        data = mujoco.MjData(self.model)
        mujoco.mj_resetDataKeyframe(self.model, data, 0)
        return data


def simulate(simulation: Simulation, on_chunk: Callable[[Recording], None] | None = None) -> Recording:
    """Run `simulation` from its start to its end; `on_chunk` gets every piece as it is finished.

    Raises SimulationError where the run cannot go on; `on_chunk` has then had everything up to there.
    """
    model, data = simulation.model, simulation.start()
    steps, per_chunk = round(simulation.duration / model.opt.timestep), round(CHUNK / model.opt.timestep)
    chunks, watch = [], Watch(simulation.rig.conditions)
    with simulation.law.running() if simulation.law else nullcontext() as law:
        sampler = Sampler(simulation.rig, model, data, empty_recording(simulation), law)
        while sampler.taken <= steps:
            left = steps - sampler.taken
            chunk = sampler.steps(min(per_chunk, left)) if left else sampler.last()
            chunk.events = watch.events(chunk)
            chunks.append(chunk)
            if on_chunk:
                on_chunk(chunk)
            check(simulation, data, chunk, law)
    return joined(chunks)


def empty_recording(simulation: Simulation) -> Recording:
    """A recording of `simulation` without samples: its channels, bodies, scene, tabs and inputs."""
    model = simulation.model
    return Recording(
        title=simulation.title,
        channels=simulation.rig.channels,
        bodies=[model.body(i).name for i in range(model.nbody)],
        scene=scene_of(model),
        tabs=simulation.rig.tabs,
        inputs=simulation.inputs,
    )


def check(simulation: Simulation, data: mujoco.MjData, chunk: Recording, law: LawRun | None = None) -> None:
    """Turn what the callback recorded as wrong into a SimulationError with the last samples of the channel at fault.

    What interrupts the user's `law` while it runs, as the keyboard does, is raised as it is.
    """
    if law and law.interruption:
        raise law.interruption
    world = worlds.view(data, simulation.rig.WORLD)
    header = world.header
    if header.status == worlds.RUNNING:
        return
    time = float(header.status_time)
    channel = _channel_at_fault(header.status, chunk, simulation.rig.system.BEYOND.channels)
    samples = {channel: chunk[channel][-LAST_SAMPLES:].tolist()} if channel in chunk.channels else {}
    told = f"; the last samples of {channel} are {samples[channel]}" if samples else ""
    if law and header.status in worlds.OF_THE_LAW:
        raise SimulationError(law.explained(world), time, channel, samples)
    message = {
        worlds.TIME_JUMP: f"time jumped to {time:g} s: the simulation steps by {header.step:g} s only",
        worlds.NOT_FINITE: f"the run diverged at {time:.3f} s: {channel} is not finite{told}",
        worlds.OTHER_LAYOUT: "the state that was restored has another layout than this rig's world",
        worlds.BURST: f"the actuator left what is physical at {time:.3f} s: {simulation.rig.system.BEYOND.text}{told}",
        worlds.LEFT_BEHIND: f"the step at {time:g} s did not advance the world: its control was not called",
    }[int(header.status)]
    raise SimulationError(message, time, channel, samples)


def _channel_at_fault(status: float, chunk: Recording, suspects: tuple[str, ...]) -> str:
    """The first channel that is not finite; for a system that left what is physical the largest of its `suspects`."""
    if status in (worlds.TIME_JUMP, worlds.OTHER_LAYOUT, worlds.LEFT_BEHIND):
        return "time"
    if status in worlds.OF_THE_LAW:
        return "front.bar.command"
    names, last = list(chunk.channels), chunk.values[-1]
    bad = ~np.isfinite(last)
    if bad.any():
        return names[int(np.argmax(bad))]
    recorded = [name for name in suspects if name in names] or ["time"]
    return max(recorded, key=lambda name: abs(last[names.index(name)]) if name in names else 0.0)
