"""Sizing of the electromechanical bar: the gear from the speeds, the machine from the torques."""

import math
from typing import Any

from ars_mujoco.actuators.sizing import Dimension, Requirement, Sizing


def size(file: Any, required: Requirement) -> list[Dimension]:
    """Dimensions of one axle's unit."""
    unit = file.front
    gear, machine, loops = unit.gear, unit.drive.machine, unit.loops
    ratio = required.speed / required.rate
    torque = (required.torque + gear.friction) / (gear.efficiency * ratio)
    current = torque / machine.peak_torque * machine.current_limit
    return [
        Dimension("gear.ratio", ratio, "1", "n / w", gear.ratio),
        Dimension("machine torque", torque, "Nm", "(M + M_0) / (eta i)", machine.peak_torque),
        Dimension("machine current", current, "A", "T / (1.5 p psi)", machine.current_limit),
        Dimension("loops.max_torque", required.torque, "Nm", "M", loops.max_torque),
        Dimension("loops.max_rate", required.rate, "deg/s", "w", loops.max_rate),
    ]


# 1200 Nm of the software; 160 deg/s at 4270 rpm, where the field is weakened and the machine gives less
SIZING = Sizing(Requirement(1200.0, math.radians(160.0), 4270.0 * math.pi / 30.0), size)
