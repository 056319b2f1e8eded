"""Runs of the valve-controlled system by itself: both bars under commanded torques, their ends held or moved."""

import math
from functools import cache

import numpy as np

from ars_mujoco.actuators.system import Car, Command, Moment, Torsion, Twist, Twists
from ars_mujoco.actuators.valve_controlled import system
from ars_mujoco.control.control_unit import BarCommand, ControlUnit
from ars_mujoco.kernels.kernel import entry
from ars_mujoco.schema.parameters import record_dtype
from ars_mujoco.studies.inputs import read_inputs

STIFFNESS = 5700.0  # Nm/rad, c of both bars
D = 5.24e-4 / math.tau  # m^3/rad
THETA = 0.175  # kg m^2
LEAKAGE = 1.75e-13  # m^3/s/Pa, of a motor
FLOW = 9.0e-3 / 60.0  # m^3/s
RPM = math.pi / 30.0
STEP = 1e-3  # s
OUTPUT = record_dtype(system.Output)
FAST = 30.0  # m/s
OPEN_INTAKE = "pump.intake.least_share=1"
AT_750 = "drive.speed=750 rpm"


class Run:
    """States and outputs (n,) of a run, as structured arrays, and the torques (n,) of both bars."""

    def __init__(self, p, states, outputs, torques):
        self.p, self.states, self.outputs = p, states.view(np.recarray), outputs.view(np.recarray)
        self.time = STEP * np.arange(len(outputs))
        self.front, self.rear = torques.T

    @property
    def supply(self):
        return self.outputs.supply

    def reaches(self, torque: np.ndarray, level: float) -> float:
        """The time (s) at which a torque first reaches a level, between samples."""
        return float(np.interp(level, np.maximum.accumulate(torque), self.time))


@cache
def parameters(*settings: str, has_road: bool = False) -> np.record:
    """The record of the shipped file with settings as the command line takes them, less "actuator."."""
    own = tuple(f"actuator.{each}" for each in settings)
    file = read_inputs("bench_step_1deg", "valve_controlled", settings=own).actuator.value
    car = Car(
        Torsion(STIFFNESS, 0.0), Torsion(STIFFNESS, 0.0), ControlUnit(sample_time="0 s", delay="0 s"), {}, has_road
    )
    p = np.zeros(1, system.PARAMETERS).view(np.recarray)[0]
    system.fill(p, file, car, STEP)
    return p


def driven(front, rear, seconds: float, *settings: str, **given) -> Run:
    """A run under torques (Nm), each a number or a function of the time (s).

    `given` may have the `twist` (rad) of both bars, the opening allowed to the fail-safe valve (`fail_safe`) and the
    `road_speed` (m/s).
    """
    p = parameters(*settings, has_road="road_speed" in given)
    time = STEP * np.arange(round(seconds / STEP) + 1)
    given = {"twist": 0.0, "fail_safe": 1.0, "road_speed": FAST, **given}
    asked = [front, rear, given["twist"], given["fail_safe"], given["road_speed"]]
    asked = np.column_stack([_over(time, each) for each in asked])
    states, outputs = np.zeros(len(time) + 1, system.STATE), np.zeros(len(time), OUTPUT)
    system.start(p, states.view(np.recarray)[0])
    torques = np.zeros((len(time), 2))
    march(p, states, outputs, asked, torques)
    return Run(p, states, outputs, torques)


@entry
def march(p, states, outputs, asked, torques):
    nothing = (0.0, 0.0, 0.0)
    for i in range(len(outputs)):
        front, rear, twist, fail_safe, speed = asked[i]
        inputs = np.full(1, fail_safe)
        command = Command(BarCommand(nothing, front), BarCommand(nothing, rear), inputs)
        held = Twist(twist, 0.0, twist)
        moment = Moment(i * STEP, STEP, speed, 0.0)
        torques[i, 0], torques[i, 1] = system.advance(
            p, states[i], states[i + 1], outputs[i], 0.0, command, Twists(held, held), moment
        )


def smooth(time, *knots):
    """A torque through (time s, torque Nm) knots, joined by quintic pieces."""
    for (start, before), (end, after) in zip(knots, knots[1:], strict=False):
        if time < end:
            s = max(time - start, 0.0) / (end - start)
            return before + (after - before) * s**3 * (10.0 - 15.0 * s + 6.0 * s * s)
    return knots[-1][1]


def _over(time, value):
    return np.array([value(t) for t in time]) if callable(value) else np.full(len(time), value)
