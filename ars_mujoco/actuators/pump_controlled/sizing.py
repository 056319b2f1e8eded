"""Sizing of the pump-controlled bar (paper section 4.2.3): vane motor from the torque, pump from the rate."""

import math
from typing import Any

from ars_mujoco.actuators.sizing import Dimension, Requirement, Sizing
from ars_mujoco.hydraulics.displacement import motor_displacement, pump_flow


def size(file: Any, required: Requirement) -> list[Dimension]:
    """Dimensions of one file.front."""
    torque, rate, speed, pressure = required
    motor, pump = file.front.motor, file.front.pump
    displacement = motor_displacement(motor, torque, rate, pressure)
    flow = pump_flow(displacement, rate, pump.leakage + motor.leakage, pressure)
    shaft = flow / speed * pressure + pump.torque_loss.at(1.0, speed, pressure)
    return [
        Dimension("motor.displacement", displacement, "cm^3/rev", "(M + r_C + r_v w) / dp", motor.displacement),
        Dimension("flow", flow, "L/min", "D_M w + k_Li dp", pump.displacement * pump.speed),
        Dimension("pump.displacement", flow / speed, "cm^3/rev", "Q / n", pump.displacement),
        Dimension("shaft torque", shaft, "Nm", "D_p dp + M_S(1, n, dp), at full stroke"),
        Dimension("shaft power", shaft * speed, "W", "M n"),
    ]


# Table 1 and section 4.2.3
SIZING = Sizing(Requirement(1400.0, math.radians(57.5), 3000.0 * math.pi / 30.0, 180e5), size)
