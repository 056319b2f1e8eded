"""Reference map: from the lateral accelerometer to the commanded angle and torque of each bar.

The engineer gives a target, roll over lateral acceleration; the statics of the very model that runs turn it into this
table once, at set-up (`ars_mujoco.vehicle.reference_map`). Nothing is tuned by hand: another car gets another table.
"""

import numpy as np

from ars_mujoco.kernels.kernel import kernel

KNOTS = 24  # room in the table

REFERENCE_MAP = np.dtype(
    [
        ("count", "f8"),
        ("sensor", "f8", KNOTS),  # m/s^2
        ("roll", "f8", KNOTS),  # rad
        ("front", "f8", KNOTS),  # angles, rad
        ("rear", "f8", KNOTS),
        ("front_torque", "f8", KNOTS),  # Nm
        ("rear_torque", "f8", KNOTS),
    ]
)


@kernel
def bar_commands(table, reading: float):
    """(front, rear) bar angles and the target roll, rad, and (front, rear) torques, Nm, for a sensor reading (m/s^2).

    Linear between the knots, odd in the reading, and held beyond the last knot.
    """
    size = abs(reading)
    sign = 1.0 if reading >= 0.0 else -1.0
    last = int(table.count) - 1
    if last < 1:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    i = 0
    while i < last - 1 and size > table.sensor[i + 1]:
        i += 1
    share = min((size - table.sensor[i]) / (table.sensor[i + 1] - table.sensor[i]), 1.0) * sign
    return (
        sign * table.front[i] + share * (table.front[i + 1] - table.front[i]),
        sign * table.rear[i] + share * (table.rear[i + 1] - table.rear[i]),
        sign * table.roll[i] + share * (table.roll[i + 1] - table.roll[i]),
        sign * table.front_torque[i] + share * (table.front_torque[i + 1] - table.front_torque[i]),
        sign * table.rear_torque[i] + share * (table.rear_torque[i + 1] - table.rear_torque[i]),
    )
