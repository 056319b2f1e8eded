"""Electric motor: the pumps' other drive (paper section 3), a rotor whose torque rises with its slip.

The state is the slip, no-load speed less the rotor's, so that zero is a motor that runs without load.
"""

import math
from typing import Any, Literal

from pydantic import ConfigDict

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, number, quantity


class ElectricMotor(Parameters):
    """Motor on the shaft of both pumps; the defaults are judgement, sized for the shipped pumps at the paper's speed.

    Both at 180 bar and full stroke take 11 Nm; 5 % of slip give the greatest torque.
    """

    model_config = ConfigDict(validate_default=True)

    kind: Literal["electric"]
    no_load_speed: float = quantity("rad/s", gt=0, default="3000 rpm")
    slip_stiffness: float = quantity("Nms/rad", gt=0, default="0.75 Nms/rad")  # torque over slip
    torque_limit: float = quantity("Nm", gt=0, default="12 Nm")  # driving and braking
    inertia: float = quantity("kg*m^2", gt=0, default="0.004 kg*m^2")  # of the rotor, the pumps' own included
    efficiency: float = number(gt=0, le=1, default=0.85)  # of motor and inverter, either way


@kernel
def turn(motor: ElectricMotor, slip: float, load: float, step: float) -> Any:
    """(slip rad/s after `step` s, mean torque Nm of the motor over it) under a constant load (Nm).

    J dn/dt = M_motor - M_load, solved exactly; where the mean torque is limited, so is the rotor's acceleration.
    """
    settled = load / motor.slip_stiffness
    unlimited = settled + (slip - settled) * math.exp(-motor.slip_stiffness / motor.inertia * step)
    torque = saturate(load + motor.inertia / step * (slip - unlimited), motor.torque_limit)
    return slip + step / motor.inertia * (load - torque), torque


@kernel
def electrical_power(motor: ElectricMotor, shaft_power: float) -> float:
    """Power (W) taken from the supply for a power at the shaft; negative where the motor feeds back."""
    return shaft_power / motor.efficiency if shaft_power > 0.0 else shaft_power * motor.efficiency
