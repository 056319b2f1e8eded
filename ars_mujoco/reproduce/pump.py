"""Claims about the pump and its control (section 4.1)."""

import math
from dataclasses import dataclass

import numpy as np

from ars_mujoco.reproduce.claim import (
    Finding,
    Group,
    Number,
    agreement,
    does_not_follow,
    holds,
    holds_only,
)
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.sizing import BAR, LITER_PER_MINUTE

HZ = 2.0 * math.pi  # rad/s
EIGENFREQUENCY = (400.0, 12600.0)  # Hz, section 4.1.1
B_PRINTED = 3.8e-3  # (m^5/kg)^(1/2), below eq. 10


@dataclass(frozen=True)
class ControlCylinder:
    """Stated values of the pump control behind the reduced circuit's integrator; the paper gives none of them (J)."""

    area: float = 1.54e-4  # m^2, A_AC
    stroke: float = 5e-3  # m, x_max
    dead_volume: float = 4e-7  # m^3, V_dead
    mass: float = 0.15  # kg, m_equ
    bulk_modulus: float = 1.4e9  # Pa, K_oil
    supply: float = 25.0 * BAR  # Pa, p_S
    opening: float = 3e-4  # m, the valve's full opening

    @property
    def middle_volume(self) -> float:
        """V_dead + A_AC x_H (m^3), with x_H = x_max."""
        return self.dead_volume + self.area * self.stroke


CYLINDER = ControlCylinder()

GROUP = Group("Pump and pump control (section 4.1)")


@GROUP.claim("section 4.1.1", "The control cylinder's eigenfrequency, 400 Hz to 12.6 kHz, is much above the servo valve's.")
def cylinder_eigenfrequency(evidence: Evidence) -> Finding:
    capacitance = CYLINDER.middle_volume / (2.0 * CYLINDER.bulk_modulus)
    frequency = CYLINDER.area / math.sqrt(capacitance * CYLINDER.mass) / HZ
    valve = float(evidence.loop.circuit.servo_valve.frequency) / HZ
    least, greatest = EIGENFREQUENCY
    return Finding(
        paper=(Number("eigenfrequency", EIGENFREQUENCY, "Hz"),),
        ours=(Number("eigenfrequency", frequency, "Hz"), Number("over the servo valve's", frequency / valve)),
        verdict=holds(least <= frequency <= greatest and frequency > 5.0 * valve, does_not_follow("eqs. 1, 8 and 15")),
        why="A_AC/sqrt(C_H m_equ) of eqs. 1, 8 and 15 with the stated cylinder, whose oil of 1.4 GPa is the spring. The "
        "valve dominates, so the third-order model of eq. 20 is enough for the controller.",
    )


@GROUP.claim("section 4.1.1, eqs. 9 and 10", "The servo valve constant is B = 3.8e-3 (m^5/kg)^(1/2).")
def servo_valve_constant(evidence: Evidence) -> Finding:
    root = CYLINDER.opening * math.sqrt(0.5 * CYLINDER.supply)
    needed = _full_flow(evidence) / root
    return Finding(
        paper=(Number("B", B_PRINTED, "(m^5/kg)^(1/2)"),),
        ours=(
            Number("flow that it means at 0.3 mm and 12.5 bar", B_PRINTED * root / LITER_PER_MINUTE, "L/min"),
            Number("B that the pump's speed of control needs", needed, "(m^5/kg)^(1/2)"),
        ),
        verdict=agreement(B_PRINTED, needed, does_not_follow('"very low flow" (section 3)')),
        why=f"The printed constant gives {B_PRINTED / needed:.1f} times the flow that the stated cylinder takes for "
        f"{float(evidence.loop.circuit.swash_plate.max_rate):.0f} strokes/s, and more than the main pump delivers "
        f"({evidence.full_flow / LITER_PER_MINUTE:.1f} L/min): likely a slip of one power of ten.",
    )


@GROUP.claim("section 3", "The pump control requires very low flow, so a single-stage valve is enough.")
def control_flow(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    travel = np.abs(np.diff(run["front.pump.stroke"])).sum() * CYLINDER.stroke * CYLINDER.area
    mean = travel / (run.time[-1] - run.time[0])
    greatest = np.abs(np.gradient(run["front.pump.stroke"], run.time)).max() * CYLINDER.stroke * CYLINDER.area
    return Finding(
        ours=(
            Number("mean over the S-curve", 1e3 * mean / LITER_PER_MINUTE, "mL/min"),
            Number("greatest on the S-curve", greatest / LITER_PER_MINUTE, "L/min"),
            Number("at full valve opening", _full_flow(evidence) / LITER_PER_MINUTE, "L/min"),
        ),
        verdict=holds(greatest < 0.1 * evidence.full_flow, holds_only("in slow manoeuvres")),
        why=f"Stroke of the running pump times the stated cylinder, beside the main pump's "
        f"{evidence.full_flow / LITER_PER_MINUTE:.1f} L/min. A step, which opens the valve fully, takes "
        f"{_full_flow(evidence) / evidence.full_flow:.1f} times that for some milliseconds.",
    )


def _full_flow(evidence: Evidence) -> float:
    """Flow (m^3/s) that moves the control cylinder as fast as the fully open valve does."""
    return CYLINDER.area * CYLINDER.stroke * float(evidence.loop.circuit.swash_plate.max_rate)
