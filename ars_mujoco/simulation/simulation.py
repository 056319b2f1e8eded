"""The simulation: drive a cycle and return its recording. This is the loop; everything else serves it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from types import ModuleType

import mujoco
import numpy as np

from ars_mujoco.actuators import bar_plots
from ars_mujoco.actuators.pump_controlled import plots as pump_plots
from ars_mujoco.bridge import world as worlds
from ars_mujoco.bridge.callback import installed
from ars_mujoco.control.law import Law
from ars_mujoco.recording.recording import Recording, joined, scene_of
from ars_mujoco.rigs.plots import BENCH, SEDAN, SEDAN_EVENTS
from ars_mujoco.schema.channels import channels
from ars_mujoco.schema.errors import SimulationError
from ars_mujoco.simulation.events import Watch
from ars_mujoco.simulation.sampler import Sampler

CHUNK = 2.0  # s between two looks at the run
LAST_SAMPLES = 5  # that a failed run's error shows

# of a rig that does not say what it shows and tells
TABS = SEDAN.around(bar_plots.PLOTS, pump_plots.PLOTS, BENCH.after)
CONDITIONS = SEDAN_EVENTS + pump_plots.EVENTS


@dataclass(frozen=True)
class Simulation:
    """What `simulate` runs: a rig's module and a model that carries the initial world; keyframe 0 is the start."""

    rig: ModuleType
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
    chunks, watch = [], Watch(getattr(simulation.rig, "conditions", CONDITIONS))
    with installed(simulation.rig, model, data, simulation.law) as in_python:
        sampler = Sampler(simulation.rig, model, data, empty_recording(simulation), in_python)
        while sampler.taken <= steps:
            left = steps - sampler.taken
            chunk = sampler.steps(min(per_chunk, left)) if left else sampler.last()
            chunk.events = watch.events(chunk)
            chunks.append(chunk)
            if on_chunk:
                on_chunk(chunk)
            check(simulation, data, chunk)
    return joined(chunks)


def empty_recording(simulation: Simulation) -> Recording:
    """A recording of `simulation` without samples: its channels, bodies, scene, tabs and inputs."""
    model = simulation.model
    return Recording(
        title=simulation.title,
        channels={channel.name: channel for channel in channels(simulation.rig.Output)},
        bodies=[model.body(i).name for i in range(model.nbody)],
        scene=scene_of(model),
        tabs=getattr(simulation.rig, "tabs", TABS),
        inputs=simulation.inputs,
    )


def check(simulation: Simulation, data: mujoco.MjData, chunk: Recording) -> None:
    """Turn what the callback recorded as wrong into a SimulationError with the last samples of the channel at fault."""
    header = worlds.view(data, simulation.rig.WORLD).header
    if header.status == worlds.RUNNING:
        return
    time, channel = float(header.status_time), _channel_at_fault(header.status, chunk)
    samples = {channel: chunk[channel][-LAST_SAMPLES:].tolist()} if channel in chunk.channels else {}
    told = f"; the last samples of {channel} are {samples[channel]}" if samples else ""
    message = {
        worlds.TIME_JUMP: f"time jumped to {time:g} s: the simulation steps by {header.step:g} s only",
        worlds.NOT_FINITE: f"the run diverged at {time:.3f} s: {channel} is not finite{told}",
        worlds.LAW_FAILED: f"{simulation.law and simulation.law.path}: the controller failed at {time:g} s"
        f"{simulation.law and simulation.law.failure}",
        worlds.OTHER_LAYOUT: "the state that was restored has another layout than this rig's world",
        worlds.BURST: f"the circuit left what is physical at {time:.3f} s: over 1000 bar, or far past its stop{told}",
    }[int(header.status)]
    raise SimulationError(message, time, channel, samples)


def _channel_at_fault(status: float, chunk: Recording) -> str:
    """The first channel that is not finite; for a burst the motor with the most pressure."""
    if status in (worlds.TIME_JUMP, worlds.OTHER_LAYOUT):
        return "time"
    if status == worlds.LAW_FAILED:
        return "front.bar.command"
    names, last = list(chunk.channels), chunk.values[-1]
    bad = ~np.isfinite(last)
    if bad.any():
        return names[int(np.argmax(bad))]
    pressures = [name for name in names if name.endswith("motor.pressure")]
    return max(pressures, key=lambda name: abs(last[names.index(name)]))
