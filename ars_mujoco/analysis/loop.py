"""Loop: one axle's actuator on the bench with its outer loop and its control unit, which is what gets analysed."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ars_mujoco.actuators.actuator import PumpControlled
from ars_mujoco.control.bar_angle_loop import outer_gain
from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.errors import InputError
from ars_mujoco.inputs import Inputs
from ars_mujoco.parameters import Parameters, fill, record_dtype

RPM = 2.0 * math.pi / 60.0  # rad/s


@dataclass(frozen=True)
class Loop:
    """Records of a ReducedCircuit and a BarAngleLoop, the bar's torsion `stiffness` (Nm/rad), and the control unit."""

    circuit: np.record
    stiffness: float
    angle_loop: np.record
    unit: ControlUnit

    @property
    def gain(self) -> float:
        """K_p (1/rad) at the pump's speed."""
        return outer_gain(self.angle_loop, self.circuit.pump.speed)

    def scheduled(self, schedule: float) -> "Loop":
        """The loop with another schedule: 1 for K_p ~ 1/n, 0 for a fixed K_p."""
        angle_loop = self.angle_loop.copy()
        angle_loop.schedule = schedule
        return replace(self, angle_loop=angle_loop)

    def without_dry_friction(self) -> "Loop":
        """The loop with r_C = r_H = 0, so that friction is viscous alone."""
        circuit = self.circuit.copy()
        circuit.motor.coulomb_friction = circuit.motor.static_friction = 0.0
        return replace(self, circuit=circuit)

    def at(self, point: Mapping[str, float]) -> "Loop":
        """The loop at a point of Table 2's box: new values (SI) by the names of `parameter_box.TABLE_2`.

        The leakage of the whole circuit, k_Li, is split between pump and motor as it was (evenly where there was none).
        """
        circuit = self.circuit.copy()
        for name, value in point.items():
            match name:
                case "leakage":
                    whole = circuit.pump.leakage + circuit.motor.leakage
                    share = circuit.pump.leakage / whole if whole > 0.0 else 0.5
                    circuit.pump.leakage, circuit.motor.leakage = share * value, (1.0 - share) * value
                case "capacitance":
                    circuit.line.capacitance = value
                case "inertia" | "viscous_friction":
                    circuit.motor[name] = value
                case "speed":
                    circuit.pump.speed = value
                case _:
                    raise KeyError(name)
        return replace(self, circuit=circuit)


def loop_of(inputs: Inputs) -> Loop:
    """The front axle's loop of a bench run's `inputs`. Raises InputError where the actuator has no loop."""
    actuator, controller = inputs.actuator.value, inputs.controller.value
    if not isinstance(actuator, PumpControlled):
        raise InputError(f"actuator '{actuator.kind}' has no loop to analyse; allowed: pump_controlled")
    return Loop(record_of(actuator.front), inputs.vehicle.value.stiffness, record_of(controller.loop), controller.unit)


def record_of(parameters: Parameters) -> np.record:
    """The record of `parameters` that kernels read."""
    record = np.zeros(1, record_dtype(type(parameters))).view(np.recarray)[0]
    fill(record, parameters)
    return record
