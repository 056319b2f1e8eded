"""Loop: one axle's actuator on the bench with its outer loop and its control unit, which is what gets analysed.

A full circuit at rest stands on a kink: each check valve is open by the few Pa at which it makes up what leaks to the
tank. A motion of more than that takes one of two courses, and a loop says which of them it is linearized for:

- BOTH_SHUT: both check valves shut, and the two sides are springs in series. So it is in a lasting small oscillation,
  which draws a little oil through the checks at each swing until neither line falls below the gallery any more.
- LOW_SIDE_HELD: the low side stays at the gallery's pressure through its check valve, and the high side is alone. So it
  is in the first swing from rest, and it is what the paper assumes throughout (p_LP = const., eq. 29).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ars_mujoco.actuators.pump_controlled.axle import DetailedAxle, DetailedAxleState
from ars_mujoco.actuators.pump_controlled.bar_angle_loop import outer_gain
from ars_mujoco.actuators.pump_controlled.file import PumpControlled, fill_axle
from ars_mujoco.actuators.pump_controlled.full_circuit import FULL_PLANT, start_detailed
from ars_mujoco.actuators.pump_controlled.pump_control import THIRD_ORDER
from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.hydraulics.oil import fluid
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, fill, record_dtype
from ars_mujoco.studies.inputs import Inputs

RPM = 2.0 * math.pi / 60.0  # rad/s
STEP = 1e-3  # s, that of the bench
BOTH_SHUT, LOW_SIDE_HELD = "both_shut", "low_side_held"


@dataclass(frozen=True)
class Loop:
    """Records of a ReducedCircuit, its Detail and a BarAngleLoop, the bar's torsion `stiffness` (Nm/rad), the control
    unit, and what the check valves of a full circuit do: BOTH_SHUT or LOW_SIDE_HELD.
    """

    circuit: np.record
    stiffness: float
    angle_loop: np.record
    unit: ControlUnit
    detail: np.record
    checks: str = BOTH_SHUT

    @property
    def axle(self) -> np.record:
        """A DetailedAxle record of the circuit, as the detailed circuit's kernels take it."""
        axle = _blank(DetailedAxle)
        axle.circuit, axle.detail, axle.stiffness = self.circuit, self.detail, self.stiffness
        return axle

    def at_rest(self) -> np.record:
        """A DetailedAxleState record of the circuit at rest and charged."""
        state = _blank(DetailedAxleState)
        start_detailed(self.axle, state)
        return state

    @property
    def has_full_circuit(self) -> bool:
        """Whether the plant is the full circuit, not the reduced one."""
        return self.detail.plant == FULL_PLANT

    @property
    def is_detailed(self) -> bool:
        """Whether it is run by `detailed_circuit`, as all but the verification set."""
        return self.has_full_circuit or self.detail.stage != THIRD_ORDER

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
        """The loop with friction that is viscous alone, in the motor (r_C = r_H = 0) and in the control cylinder."""
        circuit = self.circuit.copy()
        for part in (circuit.motor, circuit.control_cylinder):
            part.coulomb_friction = part.static_friction = 0.0
        return replace(self, circuit=circuit)

    def at_stage(self, stage: float) -> "Loop":
        """The loop with its pump control at another stage of simplification; the circuit must state what it needs."""
        detail = self.detail.copy()
        detail.stage = stage
        fill(detail.fluid, fluid(self.circuit.oil))
        return replace(self, detail=detail)

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


def loop_of(inputs: Inputs, axle: str = "front") -> Loop:
    """The loop of a bench run's `inputs`, with the circuit of an axle ("front" or "rear") of its actuator.

    It is the cascade alone: the controller's own compensators, if any, are left out.
    Raises InputError where the actuator has no loop.
    """
    actuator, controller = inputs.actuator.value, inputs.controller.value
    if not isinstance(actuator, PumpControlled):
        raise InputError(f"actuator '{actuator.kind}' has no loop to analyse; allowed: pump_controlled")
    filled, stiffness = _blank(DetailedAxle), inputs.vehicle.value.stiffness
    fill_axle(filled, actuator, axle, stiffness, STEP)
    return Loop(filled.circuit, stiffness, record_of(actuator.control.loop), controller.unit, filled.detail)


def record_of(parameters: Parameters) -> np.record:
    """The record of `parameters` that kernels read."""
    record = _blank(type(parameters))
    fill(record, parameters)
    return record


def _blank(parameters: type[Parameters]) -> np.record:
    return np.zeros(1, record_dtype(parameters)).view(np.recarray)[0]
