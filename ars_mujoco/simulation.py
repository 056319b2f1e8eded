"""The simulation: drive a cycle and return its recording. This is the loop; everything else serves it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from types import ModuleType

import mujoco
import numpy as np

from ars_mujoco import world as worlds
from ars_mujoco.callback import installed
from ars_mujoco.channels import channels
from ars_mujoco.errors import SimulationError
from ars_mujoco.events import Watch
from ars_mujoco.law import Law
from ars_mujoco.native_loop import advance
from ars_mujoco.recording.recording import Recording, joined, scene_of

CHUNK = 2.0  # s between two looks at the run
FRAME = 0.01  # s between two recorded poses
LAST_SAMPLES = 5  # that a failed run's error shows


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
    empty = empty_recording(simulation)
    steps, per_chunk = round(simulation.duration / model.opt.timestep), round(CHUNK / model.opt.timestep)
    chunks, watch = [], Watch()
    with installed(simulation.rig, model, data, simulation.law) as python:
        for first in range(0, steps + 1, per_chunk):
            count = min(per_chunk, steps + 1 - first)
            chunks.append(_chunk(simulation, data, empty, first, count, first + count > steps, python))
            chunks[-1].events = watch.events(chunks[-1])
            if on_chunk:
                on_chunk(chunks[-1])
            _check(simulation, data, chunks[-1])
    return joined(chunks)


def empty_recording(simulation: Simulation) -> Recording:
    """A recording of `simulation` without samples: its channels, bodies, scene and inputs."""
    model = simulation.model
    return Recording(
        title=simulation.title,
        channels={channel.name: channel for channel in channels(simulation.rig.Output)},
        bodies=[model.body(i).name for i in range(model.nbody)],
        scene=scene_of(model),
        inputs=simulation.inputs,
    )


def _chunk(simulation, data: mujoco.MjData, empty: Recording, first: int, count: int, last: bool, python: bool):
    """The samples of `count` steps from step `first` on; the last sample of a run is taken without stepping on."""
    model, stride = simulation.model, round(FRAME / simulation.model.opt.timestep)
    out_slot = simulation.rig.WORLD.fields["out"][1] // 8
    times, values = np.empty(count), np.empty((count, len(empty.channels)))
    poses = np.empty(((first + count - 1) // stride - (first - 1) // stride, model.nbody, 7))
    stepped = advance(model, data, times[: count - last], values, poses, stride, out_slot, first, python)
    if last and stepped == count - 1:
        mujoco.mj_forward(model, data)
        times[-1], values[-1] = data.time, data.userdata[out_slot : out_slot + values.shape[1]]
        if (first + count - 1) % stride == 0:
            poses[-1] = np.hstack([data.xpos, data.xquat])
        stepped = count
    frames = (first + stepped - 1) // stride - (first - 1) // stride
    return Recording(
        empty.title, empty.channels, empty.bodies, empty.scene, empty.inputs,
        time=times[:stepped], values=values[:stepped],
        pose_time=times[(-first) % stride : stepped : stride], poses=poses[:frames],
    )  # fmt: skip


def _check(simulation: Simulation, data: mujoco.MjData, chunk: Recording) -> None:
    """Turn what the callback recorded as wrong into an error."""
    header = worlds.view(data, simulation.rig.WORLD).header
    if header.status == worlds.RUNNING:
        return
    time = float(header.status_time)
    if header.status == worlds.TIME_JUMP:
        raise SimulationError(
            f"time jumped to {time:g} s: the simulation steps by {header.step:g} s only", time, "time"
        )
    if header.status == worlds.LAW_FAILED:
        message = f"{simulation.law.path}: the controller failed at {time:g} s{simulation.law.failure}"
        raise SimulationError(message, time, "front.bar.command")
    bad = ~np.isfinite(chunk.values[-1])
    channel = list(chunk.channels)[int(np.argmax(bad))] if bad.any() else "body.roll"
    samples = {channel: chunk[channel][-LAST_SAMPLES:].tolist()}
    raise SimulationError(
        f"the run diverged at {time:.3f} s: {channel} is not finite; its last samples are {samples[channel]}",
        time, channel, samples,
    )  # fmt: skip
