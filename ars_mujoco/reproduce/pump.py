"""Claims about the pump and its control (section 4.1)."""

import math
from itertools import product

import numpy as np

from ars_mujoco.hydraulics.control_cylinder import common_capacitance
from ars_mujoco.hydraulics.metering_edge import common_flow
from ars_mujoco.hydraulics.servo_valve import spool_acceleration
from ars_mujoco.kernels.kernel import entry
from ars_mujoco.reproduce.claim import (
    REPRODUCED,
    Finding,
    Group,
    Number,
    agreement,
    does_not_follow,
    holds,
    holds_only,
)
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.sizing import LITER_PER_MINUTE, MAX_PRESSURE, percent

HZ = 2.0 * math.pi  # rad/s
EIGENFREQUENCY = (400.0, 12600.0)  # Hz, section 4.1.1
B_PRINTED = 3.8e-3  # (m^5/kg)^(1/2), below eq. 10
DOMINATES = 5.0  # times faster is much faster
ORDERS = 4  # of the loss polynomial, up to which its terms are counted
SLIGHT = 0.05  # a share of the flow under which it does not depend on the load significantly

GROUP = Group("Pump and pump control (section 4.1)")


@GROUP.claim(
    "section 4.1.1", "The control cylinder's eigenfrequency is 400 Hz to 12.6 kHz, much above the servo valve's."
)
def cylinder_eigenfrequency(evidence: Evidence) -> Finding:
    cylinder, edge = evidence.cylinder, evidence.edge
    middle = 0.5 * (edge.supply_pressure + edge.return_pressure)
    capacitance = common_capacitance(cylinder, evidence.fluid, 0.0, middle)
    frequency = float(cylinder.area / math.sqrt(capacitance * cylinder.mass)) / HZ
    valve = float(evidence.loop.circuit.servo_valve.frequency) / HZ
    least, greatest = EIGENFREQUENCY
    return Finding(
        paper=(Number("eigenfrequency", EIGENFREQUENCY, "Hz"),),
        ours=(Number("eigenfrequency", frequency, "Hz"), Number("over the servo valve's", frequency / valve)),
        verdict=holds(
            least <= frequency <= greatest and frequency > DOMINATES * valve, does_not_follow("eqs. 1, 8 and 15")
        ),
        why="A_AC/sqrt(C_H m_equ) of eqs. 1, 8 and 15 with the values of the full pump control, its oil's air "
        "included. The valve dominates, so the third-order model of eq. 20 is enough for the controller.",
    )


@GROUP.claim("section 4.1.1, eqs. 9 and 10", "The servo valve constant is B = 3.8e-3 (m^5/kg)^(1/2).")
def servo_valve_constant(evidence: Evidence) -> Finding:
    edge, rate = evidence.edge, float(evidence.loop.circuit.swash_plate.max_rate)
    flow, _, _ = common_flow(edge, 1.0, 0.0)
    printed = float(flow / edge.constant) * B_PRINTED
    needed = float(edge.constant / flow) * _cylinder_flow(evidence, rate)
    return Finding(
        paper=(Number("B", B_PRINTED, "(m^5/kg)^(1/2)"),),
        ours=(
            Number("B that the pump control's speed needs", needed, "(m^5/kg)^(1/2)"),
            Number("flow of the printed B, valve open, no load", printed / LITER_PER_MINUTE, "L/min"),
        ),
        verdict=agreement(B_PRINTED, needed, does_not_follow('"very low flow" (section 3)')),
        why=f"The printed constant gives {B_PRINTED / needed:.1f} times the flow that the cylinder takes for "
        f"{rate:.0f} strokes/s, and {printed / evidence.full_flow:.0f} times that of the main pump: likely a slip of "
        "one power of ten.",
    )


@GROUP.claim("section 4.1.1", "The servo valve's dynamics vary with the commanded step size.")
def valve_step_size(evidence: Evidence) -> Finding:
    small, large = (1e3 * _rise_time(evidence.loop.circuit.servo_valve, size) for size in (0.1, 1.0))
    return Finding(
        ours=(Number("0 to 90 % of a step of 10 %", small, "ms"), Number("of a full step", large, "ms")),
        verdict=holds(large > (1.0 + SLIGHT) * small, does_not_follow("the valve of Fig. 7")),
        why="Below its speed limit the spool is linear, and steps of all sizes take the same time; beyond it, a larger "
        "step takes longer.",
    )


@GROUP.claim("section 3", "The pump control requires very low flow, so a single-stage valve is enough.")
def control_flow(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    rate = np.abs(np.gradient(run["front.pump.stroke"], run.time))
    mean, greatest = (_cylinder_flow(evidence, float(each)) for each in (rate.mean(), rate.max()))
    opened = _cylinder_flow(evidence, float(evidence.loop.circuit.swash_plate.max_rate))
    return Finding(
        ours=(
            Number("mean over the S-curve", 1e3 * mean / LITER_PER_MINUTE, "mL/min"),
            Number("greatest on the S-curve", 1e3 * greatest / LITER_PER_MINUTE, "mL/min"),
            Number("at full valve opening", opened / LITER_PER_MINUTE, "L/min"),
        ),
        verdict=holds(greatest < SLIGHT * evidence.full_flow, holds_only("in slow manoeuvres")),
        why="The running pump's stroke moves its control cylinder; the main pump delivers "
        f"{evidence.full_flow / LITER_PER_MINUTE:.1f} L/min. A step opens the valve fully and takes "
        f"{opened / evidence.full_flow:.1f} times that, for some milliseconds.",
    )


@GROUP.claim("section 4.2", "The flow does not depend significantly on the load pressure, only on the swash plate.")
def flow_and_load(evidence: Evidence) -> Finding:
    nominal, greatest = (float(evidence.loop.at({"leakage": k}).circuit.pump.leakage) for k in evidence.leakages)
    shares = tuple(leakage * MAX_PRESSURE / evidence.full_flow for leakage in (nominal, greatest))
    verdicts = {2: REPRODUCED, 1: holds_only("with the least leakage of Table 2")}
    return Finding(
        ours=(Number("flow lost in the pump at 180 bar, Table 2's least and greatest k", _percents(shares), "%"),),
        verdict=verdicts.get(sum(share < SLIGHT for share in shares), does_not_follow("Table 2")),
        why=f"{percent(evidence.pump_share)} of k_Li is the pump's; the losses of the motor come on top.",
    )


@GROUP.claim("eq. 23", "A loss polynomial of the orders p, q and r has (p + 1)(q + 1)(r + 1) coefficients.")
def coefficients(evidence: Evidence) -> Finding:
    orders = list(product(range(ORDERS + 1), repeat=3))
    counted = [len(list(product(*(range(n + 1) for n in each)))) for each in orders]
    right = sum(n == math.prod(order + 1 for order in each) for n, each in zip(counted, orders, strict=True))
    return Finding(
        ours=(Number("orders counted", len(orders)), Number("with that number of terms", right)),
        verdict=holds(right == len(orders), does_not_follow("eqs. 21 and 22")),
        why="The sums of eqs. 21 and 22 counted term by term.",
    )


def _cylinder_flow(evidence: Evidence, rate: float) -> float:
    """Flow (m^3/s) that the control cylinder takes at a stroke rate (1/s)."""
    return float(evidence.cylinder.area * evidence.cylinder.travel) * rate


def _percents(shares: tuple[float, float]) -> tuple[float, float]:
    return 100.0 * shares[0], 100.0 * shares[1]


@entry
def _rise_time(valve, size):
    """Time (s) that the spool takes from rest to 90 % of a commanded stroke `size`."""
    stroke, rate, step, count = 0.0, 0.0, 1e-6, 0
    while stroke < 0.9 * size:
        rate += step * spool_acceleration(valve, stroke, rate, size)
        stroke += step * rate
        count += 1
    return count * step
