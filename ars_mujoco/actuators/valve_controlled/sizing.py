"""Sizing of the valve-controlled bars: vane motors as in the paper, one pump that turns the front's at idle."""

import math
from typing import Any

from ars_mujoco.actuators.sizing import Dimension, Requirement, Sizing
from ars_mujoco.hydraulics.displacement import motor_displacement, pump_flow


def size(file: Any, required: Requirement) -> list[Dimension]:
    """Dimensions of the front axle and of the pump that it shares."""
    torque, rate, speed, pressure = required
    motor, pump = file.front.motor, file.pump
    displacement = motor_displacement(motor, torque, rate, pressure)
    moved = pump_flow(displacement, rate, motor.leakage, pressure)
    flow = moved + pump.leakage * pressure
    shaft = flow / speed * pressure + pump.torque_loss.at(1.0, speed, pressure)
    size_of_pump = flow / (pump.efficiency * speed)
    return [
        Dimension("motor.displacement", displacement, "cm^3/rev", "(M + r_C + r_v w) / dp", motor.displacement),
        Dimension("flow of one axle", flow, "L/min", "D_M w + (k_M + k_P) dp"),
        Dimension("pump.displacement", size_of_pump, "cm^3/rev", "Q / (eta n), at idle", pump.displacement),
        Dimension("flow of both axles", 2.0 * moved, "L/min", "2 (D_M w + k_M dp)", pump.flow_limit),
        Dimension("shaft torque", shaft, "Nm", "Q dp / n + M_S(n, dp)"),
        Dimension("shaft power", shaft * speed, "W", "M n"),
    ]


# the paper's bar, at the published speed at which the pump gives 5.5 L/min
SIZING = Sizing(Requirement(1400.0, math.radians(57.5), 750.0 * math.pi / 30.0, 180e5), size)
