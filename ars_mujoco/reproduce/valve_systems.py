"""Valve-controlled systems, quasi-static: what a pump's shaft would give for the same motion of the same motor.

Each has a pump with the losses of the actuator's own, the same motor and leakage, and valves that take what pressure is
left. Returned flow recovers nothing. Pressures and flows are those that a recorded run shows.

| system | flow of the pump | pressure of the pump |
|---|---|---|
| open centre | all of it, always (the fixed pump of Fig. 2) | the load's, and the valves' margin |
| constant pressure | what motor and leakage take | the greatest that the motor needs |
| load sensing | what motor and leakage take | the load's, and the valves' margin |
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ars_mujoco.recording.recording import Recording
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.sizing import BAR, MAX_PRESSURE

MARGIN = 15.0 * BAR  # Pa, over the valves


@dataclass(frozen=True)
class Demand:
    """What the motor takes at each sample: `flow` (n,) m^3/s from the supply, leakage included, at `pressure` (n,)."""

    flow: np.ndarray
    pressure: np.ndarray


def demand_of(evidence: Evidence, run: Recording) -> Demand:
    """The demand of a bench run."""
    pressure = np.abs(run["front.motor.pressure"])
    motor_leakage = float(evidence.loop.circuit.motor.leakage)
    return Demand(evidence.D * np.abs(run["front.motor.rate"]) + motor_leakage * pressure, pressure)


def open_centre(evidence: Evidence, demand: Demand) -> tuple[np.ndarray, np.ndarray]:
    """Stroke and pressure of a fixed pump that always delivers, at the load's pressure."""
    return np.ones_like(demand.flow), demand.pressure + MARGIN


def constant_pressure(evidence: Evidence, demand: Demand) -> tuple[np.ndarray, np.ndarray]:
    """Stroke and pressure of a variable pump that holds the greatest pressure."""
    return _stroke(evidence, demand, full := np.full_like(demand.flow, MAX_PRESSURE)), full


def load_sensing(evidence: Evidence, demand: Demand) -> tuple[np.ndarray, np.ndarray]:
    """Stroke and pressure of a variable pump that follows the load."""
    pressure = demand.pressure + MARGIN
    return _stroke(evidence, demand, pressure), pressure


SYSTEMS: dict[str, Callable] = {
    "open centre": open_centre,
    "constant pressure": constant_pressure,
    "load sensing": load_sensing,
}


def shaft_energy(evidence: Evidence, run: Recording, system: str) -> float:
    """Work (J) of the shaft over a bench run with one of SYSTEMS in place of the pump-controlled actuator."""
    power = evidence.shaft_power(*SYSTEMS[system](evidence, demand_of(evidence, run)))
    return float(np.trapezoid(power, run.time))


def idle_power(evidence: Evidence, system: str) -> float:
    """Power (W) of the shaft with one of SYSTEMS straight ahead."""
    nothing = Demand(np.zeros(1), np.zeros(1))
    return float(evidence.shaft_power(*SYSTEMS[system](evidence, nothing))[0])


def _stroke(evidence: Evidence, demand: Demand, pressure: np.ndarray) -> np.ndarray:
    pump_leakage = float(evidence.loop.circuit.pump.leakage) * pressure
    return (demand.flow + pump_leakage) / evidence.full_flow
