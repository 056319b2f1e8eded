"""Sizing of the electro-hydrostatic bar: as the paper's motor and pump, and the machine that turns the pump."""

import math
from typing import Any

from ars_mujoco.actuators.sizing import Dimension, Requirement, Sizing
from ars_mujoco.hydraulics.displacement import motor_displacement, pump_flow


def size(file: Any, required: Requirement) -> list[Dimension]:
    """Dimensions of one file.front."""
    torque, rate, speed, pressure = required
    motor, pump, peak = file.front.motor, file.front.pump, file.front.drive.machine.peak_torque
    displacement = motor_displacement(motor, torque, rate, pressure)
    flow = pump_flow(displacement, rate, pump.leakage + motor.leakage, pressure)
    shaft = flow / speed * pressure + pump.torque_loss.at(1.0, speed, pressure)
    return [
        Dimension("motor.displacement", displacement, "cm^3/rev", "(M + r_C + r_v w) / dp", motor.displacement),
        Dimension("flow", flow, "L/min", "D_M w + k_Li dp"),
        Dimension("pump.displacement", flow / speed, "cm^3/rev", "Q / n", pump.displacement),
        Dimension("machine torque", shaft, "Nm", "D_p dp + M_S(n, dp); what is left speeds the rotor up", peak),
        Dimension("machine power", shaft * speed, "W", "M n"),
    ]


# the paper's bar, so that the two compare
SIZING = Sizing(Requirement(1400.0, math.radians(57.5), 3000.0 * math.pi / 30.0, 180e5), size)
