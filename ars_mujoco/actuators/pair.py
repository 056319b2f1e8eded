"""Pair: a system whose axles share nothing, from one axle's part; and the part of those that are equations alone.

    PARAMETERS, STATE, Output, advance, sense, is_beyond, fill, start = pair(equations(Servo, State, Energy, rates))

`equations` makes a part of ordinary differential equations: integrator, number of substeps, records and channels follow
from `rates`. The first of its states is the angle (rad) between the bar's halves.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pydantic import create_model

from ars_mujoco.actuators.system import BarOutput, Car, Torsion, Twist
from ars_mujoco.control.control_unit import NOTHING_ASKED
from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import share, store
from ars_mujoco.kernels.substeps import derivatives, fewest_substeps, scales, slopes
from ars_mujoco.schema.channels import stored
from ars_mujoco.schema.parameters import Parameters, record_dtype
from ars_mujoco.schema.parameters import fill as fill_block

FAR = 1.6  # rad between the halves of a bar; nothing turns it by more than a quarter
FAR_FROM_REST = 1e3  # of what is little of each state: there, too, the substeps are looked at
IDLE = (NOTHING_ASKED, Twist(0.0, 0.0, 0.0))


@dataclass(frozen=True)
class Part:
    """One axle of a system: its records, its channels, and its functions.

    advance(p, now, later, out, command, twist, step) -> torque    kernel; see `actuators.system`
    sense(p, now) -> (angle, torque)                               kernel
    is_beyond(p, now) -> bool                                      kernel
    fill(record, file, torsion, step), start(record, state)        host functions
    """

    parameters: np.dtype
    state: np.dtype
    output: type[Parameters]
    advance: Callable
    sense: Callable
    is_beyond: Callable
    fill: Callable
    start: Callable


class System(NamedTuple):
    """The names of the contract that a pair gives."""

    PARAMETERS: np.dtype
    STATE: np.dtype
    Output: type[Parameters]
    advance: Callable
    sense: Callable
    is_beyond: Callable
    fill: Callable
    start: Callable


def pair(part: Part) -> System:
    """The system of `part` at both axles; a bar that is not there has a part that stands still."""
    advance_axle, sense_axle, is_beyond_axle = part.advance, part.sense, part.is_beyond

    @kernel
    def advance(p, now, later, out, work, command, twists, moment):
        front = advance_axle(p.front, now.front, later.front, out.front, command.front, twists.front, moment.step)
        rear = 0.0
        if p.has_rear == 1.0:
            rear = advance_axle(p.rear, now.rear, later.rear, out.rear, command.rear, twists.rear, moment.step)
        return front, rear

    @kernel
    def sense(p, now, sensors):
        sensors.front_angle, sensors.front_torque = sense_axle(p.front, now.front)
        sensors.rear_angle, sensors.rear_torque = sense_axle(p.rear, now.rear)

    @kernel
    def is_beyond(p, state):
        return is_beyond_axle(p.front, state.front) or is_beyond_axle(p.rear, state.rear)

    def fill(record, file, car: Car, step: float) -> None:
        part.fill(record.front, file.front, car.front, step)
        record.has_rear = car.rear is not None
        part.fill(record.rear, file.rear, car.rear or car.front, step)

    def start(record, state) -> None:
        part.start(record.front, state.front)
        part.start(record.rear, state.rear)

    output = create_model("Output", __base__=Parameters, front=(part.output, ...), rear=(part.output, ...))
    parameters = np.dtype([("front", part.parameters), ("rear", part.parameters), ("has_rear", "f8")])
    states = np.dtype([("front", part.state), ("rear", part.state)])
    return System(parameters, states, output, advance, sense, is_beyond, fill, start)


class BarEnergy(Parameters):
    bar: float = stored("stored in the bar's torsion")


def equations(file: type[Parameters], state: type[Parameters], energy: type[Parameters], rates: Callable) -> Part:
    """The part whose parameters are the fields of `file`, its states and powers those of `state` and `energy`.

    `rates(p, demand, t, state)` is as in `kernels.integration`: `p` has the record of `file` as `part` and the bar's
    torsion as `stiffness` (Nm/rad); `demand` is (BarCommand, Twist); its one torque is that of the bar.
    """
    step_through, evaluate = integrated(rates), derivatives(rates)
    angle = next(iter(state.model_fields))
    energies = create_model("EnergyOutput", __base__=(energy, BarEnergy))
    output = create_model(
        "AxleOutput", __base__=Parameters, bar=(BarOutput, ...), actuator=(state, ...), energy=(energies, ...)
    )

    @kernel
    def advance(p, now, later, out, command, twist, step):
        turned = now.state[angle]
        out.bar.angle, out.bar.command = turned, command.angle[0]
        out.energy.bar = 0.5 * p.stiffness * (turned - twist.angle) ** 2
        share(out.actuator, now.state)
        share(out.energy, now.energy)
        (torque,) = step_through(p, now, later, (command, twist), step, int(p.substeps))
        return torque

    @kernel
    def sense(p, now):
        return now.state[angle], 0.0

    @kernel
    def is_beyond(p, now):
        return abs(now.state[angle]) > FAR

    def fill(record, values, torsion: Torsion, step: float) -> None:
        fill_block(record.part, values)
        record.stiffness = torsion.stiffness
        rest, nudges = np.zeros(1, record_dtype(state)).view(np.recarray)[0], scales(state)
        moving = rest.copy()
        store(moving, tuple(FAR_FROM_REST * nudges))
        looks = [slopes(evaluate, record, IDLE, each, nudges) for each in (rest, moving)]
        record.substeps = fewest_substeps(looks, step)

    def start(record, initial) -> None:
        """All states are zero at rest."""

    parameters = np.dtype([("part", record_dtype(file)), ("stiffness", "f8"), ("substeps", "f8")])
    states = np.dtype([("state", record_dtype(state)), ("energy", record_dtype(energy))])
    return Part(parameters, states, output, advance, sense, is_beyond, fill, start)
