"""Drive: what turns the shafts of both pumps (paper section 3): a constant speed, a table, an engine or a machine.

A drive sets the pumps' speed once a physics step and the circuits keep it over the step, so that gain schedule, flow
and losses all see the same; what the pumps then took of the shaft loads the electric motor's rotor over that step.
"""

import numpy as np

from ars_mujoco.excitation.knots import SIGNAL, value
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.machines.engine import GEARBOX, Engine, engine_speed, gear
from ars_mujoco.machines.pump_drive import PumpDrive, electrical_power, turn, wanted_slip
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype

CONSTANT, TABLE, ENGINE, ELECTRIC = 0.0, 1.0, 2.0, 3.0

DRIVE = np.dtype(
    [
        ("kind", "f8"),  # one of the above
        ("speed", SIGNAL),  # rad/s, a table's
        ("engine", record_dtype(Engine)),
        ("gearbox", GEARBOX),
        ("electric", record_dtype(PumpDrive)),
    ]
)


class DriveState(Parameters):
    """State of the drive."""

    gear: float = channel("1", "gear of the engine, 0 the first")
    slip: float = channel("rad/s", "speed of the electric drive without load, less its rotor's")
    idle: float = channel("s", "time since a bar was last commanded")


class DriveOutput(Parameters):
    """What the drive records."""

    speed: float = channel("rad/s", "speed of engine or motor; without them that of the front pump")
    gear: float = channel("1", "gear of the engine, 1 the first")
    power: float = channel("W", "power for all pumps on the shaft; of an electric motor what it takes from its supply")


@kernel
def set_speed(drive, now, later, out, pumps, time: float, road_speed: float) -> None:
    """Set the speed of both `pumps`, Pump records, for the step that begins at `time` (s), at a road speed (m/s).

    `now` and `later` are DriveState records, `out` is a DriveOutput. A CONSTANT drive leaves each pump its own speed.
    """
    front, rear = pumps
    if drive.kind == CONSTANT:
        out.speed = front.speed
        return
    ratio = 1.0
    if drive.kind == ENGINE:
        later.gear = gear(drive.engine, drive.gearbox, now.gear, road_speed)
        out.gear, ratio = later.gear + 1.0, drive.engine.pump_ratio
        out.speed = engine_speed(drive.engine, drive.gearbox, later.gear, road_speed)
    elif drive.kind == ELECTRIC:
        out.speed = drive.electric.speed - now.slip
    else:
        out.speed = value(drive.speed, time)
    front.speed = rear.speed = ratio * out.speed


@kernel
def take_work(drive, now, later, out, work: float, asked: float, step: float) -> None:
    """Let the drive do the `work` (J) that the pumps on its shaft took over the last `step` (s); an electric one wakes
    where a bar is commanded by the angle `asked` (rad).
    """
    out.power = work / step
    if drive.kind == ELECTRIC:
        electric = drive.electric
        later.idle = 0.0 if asked >= electric.wake_angle else now.idle + step
        speed = electric.speed - now.slip
        load = out.power / speed if speed > 0.0 else 0.0  # a pump that stands takes no power
        slip, torque = turn(electric, now.slip, wanted_slip(electric, now.idle), load, step)
        later.slip = min(slip, electric.speed)  # pumps do not turn backwards
        mean_speed = electric.speed - 0.5 * (now.slip + later.slip)
        out.power = electrical_power(electric, torque, mean_speed)
