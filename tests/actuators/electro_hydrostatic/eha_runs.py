"""Runs of the electro-hydrostatic bar on the bench, driven once however many tests look at them."""

import math
import tempfile
from functools import cache
from pathlib import Path

import numpy as np
from shipped import recording

from ars_mujoco.recording.recording import Recording
from ars_mujoco.schema.channels import ROLES

STIFFNESS = 5700.0  # Nm/rad, c of the bench's bar
D = 5.24e-4 / math.tau  # m^3/rad, of the motor
D_P = 1.8e-6 / math.tau  # m^3/rad, of the pump
RATIO = D / D_P
C_H = 6e-14  # m^3/Pa
RPM = math.pi / 30.0

HELD = "{join: step, knots: [[0 s, 0 mm]]}"
NO_LEAKAGE = ("front.pump.leakage=0 m^3/s/Pa", "front.motor.leakage=0 m^3/s/Pa")
NO_FRICTION = (
    "front.pump.torque_loss.norm=0 Nm",
    "front.motor.coulomb_friction=0 Nm",
    "front.drive.machine.iron=0 Nms/rad",
    "front.drive.machine.hysteresis=0 Nm",
    "front.drive.machine.friction=0 Nm",
)
WORN = ("front.pump.leakage=1.125e-12 m^3/s/Pa", "front.motor.leakage=8.75e-13 m^3/s/Pa")  # five times new
FAIL_SAFE = ("front.fail_safe_valve={flow: 9 L/min, pressure: 2 bar, time: 20 ms}",)
BYPASS = ("front.bypass_valve={flow: 9 L/min, pressure: 2 bar, time: 20 ms}",)


@cache
def bench_run(command: str, duration: float, *settings: str, ends: str = HELD, inputs: str = "{}") -> Recording:
    """The recording of `duration` s under a commanded angle, moved ends and inputs (blocks of a cycle), with settings
    of the actuator.
    """
    cycle = f"""
title: A run of a test
description: The bar under a command, with its ends moved.
rig: bench
duration: {duration} s
manoeuvre: {{kind: bar_command, command: {command}, ends: {ends}}}
inputs: {inputs}
"""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cycle.yaml"
        path.write_text(cycle)
        return recording(str(path), "electro_hydrostatic", *(f"actuator.{each}" for each in settings))


def step_to(torque: float) -> str:
    """A command that steps to the angle at which the held bar gives a torque (Nm)."""
    return f"{{join: step, knots: [[0 s, {torque / STIFFNESS} rad]]}}"


def ramp_to(torque: float, seconds: float = 0.5) -> str:
    """The same, smoothly."""
    return f"{{join: smooth, knots: [[0 s, 0 rad], [{seconds} s, {torque / STIFFNESS} rad]]}}"


def switch(name: str, before: float, after: float, at: float) -> str:
    """An input that changes at a time (s)."""
    return f"{{front_{name}: {{join: step, knots: [[0 s, {before}], [{at} s, {after}]]}}}}"


def after(run: Recording, time: float) -> np.ndarray:
    """Rows of a run from a time (s) on."""
    return run.time >= time - 1e-9


def time_constant(time: np.ndarray, values: np.ndarray) -> float:
    """That of an exponential decay to zero (s), by a straight line through the logarithms."""
    return -1.0 / np.polyfit(time, np.log(np.abs(values)), 1)[0]


def books(run: Recording, block: str) -> tuple[float, float]:
    """(energy that the books of a block miss over a run, energy that went over its borders either way), J."""
    sums, crossed = dict.fromkeys(ROLES, 0.0), 0.0
    for name, each in run.channels.items():
        if each.role and name.startswith(f"{block}."):
            sums[each.role] += run[name][-1] - run[name][0]
            if each.role in ("drawn", "done", "delivered"):
                crossed += np.abs(np.diff(run[name])).sum()
    return sums["drawn"] - sums["lost"] - sums["stored"] - sums["done"] - sums["delivered"], crossed
