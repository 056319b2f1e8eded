"""Evidence: what the claims are held against, each computed from the running code when it is first asked for."""

from collections.abc import Iterable
from functools import cached_property
from typing import Any

import numpy as np

from ars_mujoco.actuators.pump_controlled.third_order_circuit import rates
from ars_mujoco.analysis import (
    compensators,
    frequency_response,
    hydraulic_poles,
    root_locus,
    stable_region,
    steady_state,
)
from ars_mujoco.analysis.analyze import read_analyzed
from ars_mujoco.analysis.loop import Loop, loop_of
from ars_mujoco.analysis.parameter_box import TABLE_2
from ars_mujoco.kernels.kernel import entry
from ars_mujoco.recording.recording import Recording
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import Inputs, read_inputs
from ars_mujoco.studies.study import simulation_of

FULL = "pump_controlled_full"  # the actuator with lines, oil and a pump control of their own
PAPERS_LOOP = ("actuator.control.loop.gain=60 1/rad", "actuator.control.loop.schedule=0")  # K_p, fixed
S_CURVE, SMALL_STEP, LARGE_STEP = "bench_s_curve", "bench_step_1deg", "bench_step_10deg"


class Evidence:
    """The paper's front actuator on its bench and in a car; `settings` change it, as `--set actuator.KEY=VALUE` does.

    Symbols (SI): D, V_p n as `full_flow`, k and the pump's share of it, C, theta, r_v, c, V_L, phi_n, K_p; records of
    the control cylinder, its valve's edges, and of the full circuit's pipe and fluid.
    """

    def __init__(self, settings: Iterable[str] = ()):
        self.settings = tuple(settings)
        self.inputs = read_analyzed(None, None, list(self.settings))
        self.loop: Loop = loop_of(self.inputs)
        self.runs: dict[tuple[str | None, ...], tuple[Inputs, Recording]] = {}
        circuit = self.loop.circuit
        pump, motor, line = circuit.pump, circuit.motor, circuit.line
        self.D, self.theta, self.r_v, self.phi_n = (
            float(motor[name]) for name in ("displacement", "inertia", "viscous_friction", "stop_angle")
        )
        self.full_flow, self.speed = float(pump.displacement * pump.speed), float(pump.speed)
        self.k = float(pump.leakage + motor.leakage)
        self.C, self.V_L = float(line.capacitance), float(line.volume)
        self.c, self.K_p = self.loop.stiffness, self.loop.gain
        self.pump_share, self.leakages = float(pump.leakage) / self.k, TABLE_2["leakage"]
        self.cylinder, self.edge = circuit.control_cylinder, circuit.metering_edge
        self.full_inputs = read_inputs(S_CURVE, FULL, settings=PAPERS_LOOP)
        self.robot_inputs = read_inputs(compensators.ROBOT)
        self.full_loop = loop_of(self.full_inputs)
        self.pipe, self.fluid = self.full_loop.detail.pipe, self.full_loop.detail.fluid

    def run(self, cycle: str, *settings: str, actuator: str | None = None) -> Recording:
        """The recording of a cycle, run once; with another `actuator` than its own, without the evidence's settings."""
        key = (cycle, actuator, *settings)
        if key not in self.runs:
            own = () if actuator else self.settings
            inputs = read_inputs(cycle, actuator, settings=[*own, *settings])
            self.runs[key] = inputs, simulate(simulation_of(inputs))
        return self.runs[key][1]

    def inputs_of(self, cycle: str) -> Inputs:
        """The inputs of a cycle as it was run without further settings."""
        return self.runs[cycle, None][0]

    def record(self) -> list[dict[str, Any]]:
        """Names, hashes and settings of all that was analysed and run so far."""
        used = [self.inputs, self.full_inputs, self.robot_inputs, *(inputs for inputs, _ in self.runs.values())]
        return [
            {part: {key: each[part][key] for key in ("name", "sha256", "overrides")} for part in each}
            for each in (inputs.record() for inputs in used)
        ]

    def shaft_power(self, stroke: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        """Power (W) that the pump takes at strokes (n,) and pressures (n,) Pa: delivery and torque loss."""
        return np.array([_shaft_power(self.loop.circuit, *each) for each in zip(stroke, pressure, strict=True)])

    @cached_property
    def s_curve(self) -> Recording:
        """The S-curve on the bench."""
        return self.run(S_CURVE)

    @cached_property
    def hydraulic_poles(self) -> dict[str, Any]:
        """Poles over Table 2."""
        return hydraulic_poles.compute(self.loop)

    @cached_property
    def root_locus(self) -> dict[str, Any]:
        """Poles over the gain."""
        return root_locus.compute(self.loop)

    @cached_property
    def frequency_response(self) -> dict[str, Any]:
        """Linear and measured response of the closed loop."""
        return frequency_response.compute(self.loop)

    @cached_property
    def stable_region(self) -> dict[str, Any]:
        """Bounds of the gain over Table 2."""
        return stable_region.compute(self.loop)

    @cached_property
    def steady_state(self) -> dict[str, Any]:
        """Error at rest over leakage, gain and speed."""
        return steady_state.compute(self.loop)

    @cached_property
    def compensators(self) -> dict[str, Any]:
        """What pressure feedback and a second-order compensator do, here and on the robot's joint."""
        return compensators.compute(self.loop)


@entry
def _shaft_power(circuit, stroke, pressure):
    _, powers = rates(circuit, 0.0, (0.0, 0.0, stroke, pressure, 0.0, 0.0), stroke, 0.0)
    return powers[0]
