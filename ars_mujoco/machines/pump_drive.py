"""Pump drive: an electric machine that turns both pumps at a speed that it holds, and may rest while nothing is asked.

The state is the slip, the wanted speed less the rotor's, so that zero is a drive that runs without load. Its speed loop
is proportional: a load costs it speed. While no bar has been commanded for a time it may go down to a standby speed, or
stand; a command wakes it, and it runs up with all the torque that its machine has.
"""

import math
from typing import Any, Literal

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.machines.electric_machine import (
    ElectricMachine,
    copper_loss,
    drag,
    field_current,
    torque_constant,
    torque_currents,
)
from ars_mujoco.machines.inverter import Inverter, inverter_loss
from ars_mujoco.schema.parameters import Parameters, number, quantity

RPM = math.pi / 30.0  # rad/s


class PumpMachine(ElectricMachine):
    """The 48 V machine of the electric bars, scaled to 12 Nm up to 3000 rpm; all of it judgement but for what follows.

    Derived: Kt = 0.096 Nm/A, 422 W of copper loss at 12 Nm, 26.1 of 26.3 V at 3000 rpm and full torque.
    """

    pole_pairs: float = number(gt=0, default=4.0)
    flux: float = quantity("V*s", gt=0, default=0.016)
    resistance: float = quantity("ohm", gt=0, default=0.018)
    inductance: float = quantity("H", gt=0, default=85e-6)
    current_limit: float = quantity("A", gt=0, default=125.0)
    field_current_limit: float = quantity("A", ge=0, default=100.0)
    modulation: float = number(gt=0, le=1, default=0.95)
    iron: float = quantity("Nms/rad", ge=0, default=4e-4)
    hysteresis: float = quantity("Nm", ge=0, default=0.01)
    friction: float = quantity("Nm", ge=0, default=0.02)
    sign_speed: float = quantity("rad/s", gt=0, default=1.5)


class PumpInverter(Inverter):
    """Its inverter: judgement."""

    standby_power: float = quantity("W", ge=0, default=6.0)
    loss_share: float = number(ge=0, default=0.012)


class PumpDrive(Parameters):
    """Electric drive on the shaft of both pumps; the defaults are judgement, sized for the shipped pumps.

    Both at 180 bar and full stroke take 11 Nm; 5 % of slip give the greatest torque. A bar commanded by one degree is
    about 0.08 g.
    """

    kind: Literal["electric"]
    speed: float = quantity("rad/s", gt=0, default=3000.0 * RPM)
    speed_gain: float = quantity("Nms/rad", gt=0, default=0.75)  # torque over slip
    inertia: float = quantity("kg*m^2", gt=0, default=0.004)  # of the rotor, the pumps' own included
    voltage: float = quantity("V", gt=0, default=48.0)  # of the supply, stiff
    machine: PumpMachine = PumpMachine()
    inverter: PumpInverter = PumpInverter()
    standby_speed: float = quantity("rad/s", ge=0, default=3000.0 * RPM)  # while nothing is asked; 0: it stops
    wake_angle: float = quantity("rad", gt=0, default=math.radians(1.0))  # of a bar's command that wakes it
    hold: float = quantity("s", ge=0, default=2.0)  # for which it goes on after the last such command


@kernel
def wanted_slip(drive: PumpDrive, idle: float) -> float:
    """Slip (rad/s) of the speed that is wanted where no bar has been commanded for a time (s)."""
    return max(drive.speed - drive.standby_speed, 0.0) if idle >= drive.hold else 0.0


@kernel
def turn(drive: PumpDrive, slip: float, wanted: float, load: float, step: float) -> Any:
    """(slip rad/s after `step` s, mean torque Nm on the shaft over it) under a constant load (Nm).

    J dn/dt = M_drive - M_load, solved exactly; where the mean torque is limited, so is the rotor's acceleration.
    """
    speed = drive.speed - slip
    least, most = torque_currents(drive.machine, speed, drive.voltage)
    constant, braking = torque_constant(drive.machine), drag(drive.machine, speed)
    settled = wanted + load / drive.speed_gain
    unlimited = settled + (slip - settled) * math.exp(-drive.speed_gain / drive.inertia * step)
    torque = load + drive.inertia / step * (slip - unlimited)
    torque = min(max(torque, constant * least - braking), constant * most - braking)
    return slip + step / drive.inertia * (load - torque), torque


@kernel
def electrical_power(drive: PumpDrive, torque: float, speed: float) -> float:
    """Power (W) from the supply for a torque (Nm) on the shaft at a speed (rad/s); negative where it feeds back."""
    whole = torque + drag(drive.machine, speed)
    current = whole / torque_constant(drive.machine)
    field = field_current(drive.machine, current, speed, drive.voltage)
    loss = inverter_loss(drive.inverter, drive.voltage, math.sqrt(current * current + field * field))
    return whole * speed + copper_loss(drive.machine, current, field) + loss
