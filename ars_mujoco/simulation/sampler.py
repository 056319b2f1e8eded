"""Sampler: steps the simulation and takes its samples, the channels at every step and the poses at every frame."""

from dataclasses import replace

import mujoco
import numpy as np

from ars_mujoco.bridge.control import control_of
from ars_mujoco.bridge.engine_warnings import withheld
from ars_mujoco.bridge.native_loop import Record, advance
from ars_mujoco.recording.recording import Recording

FRAME = 0.01  # s between two recorded poses


class Sampler:
    """Advances `data` chunk by chunk; `empty` gives the channels and bodies that are sampled, `law` is a running one.

    A sample belongs to the time at which its step begins, so the last sample of a run is taken without a step.
    """

    def __init__(self, rig, model: mujoco.MjModel, data: mujoco.MjData, empty: Recording, law=None):
        self.model, self.data, self.empty = model, data, empty
        self.control = control_of(rig, model, data, law)
        self.stride = max(round(FRAME / model.opt.timestep), 1)  # steps a frame
        # where userdata holds the channels, and behind them what a law gave
        self.law, self.slots = law, np.append(rig.slots, law.slots(rig)) if law else rig.slots
        self.taken = 0  # samples so far

    def steps(self, count: int) -> Recording:
        """The samples of the next `count` steps; fewer where the world's status stopped the run."""
        return self._sampled(count, last=False)

    def last(self) -> Recording:
        """The sample of the time that the last step has led to."""
        return self._sampled(1, last=True)

    def _sampled(self, count: int, last: bool) -> Recording:
        times, values, poses = self._room(count)
        record = Record(times, values, poses, self.slots, self.stride)
        with withheld():
            made = advance(self.model, self.data, self.control, record, self.taken, last)
        if self.law:
            self.law.remark(values[:made, len(self.empty.channels) :])
            values = np.ascontiguousarray(values[:, : len(self.empty.channels)])
        return self._chunk(times[:made], values[:made], poses)

    def _room(self, count: int):
        """Arrays for `count` samples: times, values, and the poses of the frames among them."""
        frames = len(range(-self.taken % self.stride, count, self.stride))
        return np.empty(count), np.empty((count, len(self.slots))), np.empty((frames, self.model.nbody, 7))

    def _chunk(self, times, values, poses) -> Recording:
        framed = times[-self.taken % self.stride :: self.stride]
        self.taken += len(times)
        return replace(self.empty, time=times, values=values, pose_time=framed, poses=poses[: len(framed)])
