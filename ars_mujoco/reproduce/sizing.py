"""Claims about the sizes of the components (section 4.2.3, Table 1)."""

import math

import control
import numpy as np

from ars_mujoco.analysis.linearization import pump_control
from ars_mujoco.analysis.loop import RPM
from ars_mujoco.analysis.margins import FASTEST, POINTS, bandwidth
from ars_mujoco.analysis.parameter_box import TABLE_2
from ars_mujoco.reproduce.claim import (
    CONTRADICTS_ITSELF,
    ROUNDING,
    Finding,
    Group,
    Number,
    Verdict,
    agreement,
    apart,
    does_not_follow,
    holds,
    holds_only,
)
from ars_mujoco.reproduce.evidence import LARGE_STEP, Evidence

BAR, LITER_PER_MINUTE, CUBIC_CENTIMETER = 1e5, 1e-3 / 60.0, 1e-6
MAX_PRESSURE, MAX_TORQUE = 180.0 * BAR, 1400.0  # section 4.2.3
MAX_ANGLE, MAX_RATE = 14.46, 57.5  # deg, deg/s, Table 1
VALVE, SERVO_PUMP = (420.0, 65.0), (280.0, 45.0)  # rad/s and Hz, Table 1
SLOWEST = TABLE_2["speed"][0]

GROUP = Group("Sizes of the components (section 4.2.3, Table 1)")


@GROUP.claim("section 4.2.3", "A pressure difference of 180 bar gives the 1400 Nm that the roll stabilization needs.")
def motor_torque(evidence: Evidence) -> Finding:
    torque, pressure = evidence.D * MAX_PRESSURE, MAX_TORQUE / evidence.D
    return Finding(
        paper=(Number("torque at 180 bar", MAX_TORQUE, "Nm"),),
        ours=(Number("torque at 180 bar", torque, "Nm"), Number("pressure for 1400 Nm", pressure / BAR, "bar")),
        verdict=_consistent(MAX_TORQUE, torque),
        why=f"Eq. 27 with Table 1's motor. The torque is {percent(torque / MAX_TORQUE - 1.0)} too much, more than the "
        "torque losses of 2 to 5 % of section 4.2 take off.",
    )


@GROUP.claim("section 4.2.3, Table 1", "At 3000 rpm the pump turns the motor at 57.5 deg/s.")
def motor_rate(evidence: Evidence) -> Finding:
    rate = math.degrees(evidence.full_flow / evidence.D)
    run = evidence.run(LARGE_STEP)
    at_full_stroke = run["front.pump.stroke"] >= 1.0
    reached = np.degrees(run["front.motor.rate"][at_full_stroke].mean()) if at_full_stroke.any() else 0.0
    return Finding(
        paper=(Number("greatest rate", MAX_RATE, "deg/s"),),
        ours=(
            Number("V_p n/D", rate, "deg/s"),
            Number("mean at full stroke in a step of 10 deg", float(reached), "deg/s"),
        ),
        verdict=_consistent(MAX_RATE, rate),
        why=f"57.5 deg/s is {percent(MAX_RATE / rate)} of what Table 1's displacements give, as if a volumetric "
        "efficiency had been taken off without being named; the leakage of Table 2 takes less or more with the load.",
    )


@GROUP.claim("sections 3 and 4.2.3", "The pump is sized for the motor's greatest rate at minimum engine speed: 1.8 cc.")
def pump_displacement(evidence: Evidence) -> Finding:
    per_speed = evidence.full_flow / evidence.speed
    slow = math.degrees(per_speed * SLOWEST / evidence.D)
    needed = math.radians(MAX_RATE) * evidence.D / SLOWEST * 2.0 * math.pi
    return Finding(
        paper=(Number("rate", MAX_RATE, "deg/s"), Number("displacement", 1.8, "cm^3/rev")),
        ours=(
            Number("rate at 1500 rpm", slow, "deg/s"),
            Number("displacement for 57.5 deg/s at 1500 rpm", needed / CUBIC_CENTIMETER, "cm^3/rev"),
        ),
        verdict=holds(slow >= MAX_RATE, CONTRADICTS_ITSELF),
        why="Section 3 names the minimum engine speed, section 4.2.3 takes 3000 rpm. At the 1500 rpm of Table 2, 1.8 "
        f"cc give {percent(slow / MAX_RATE)} of the rate.",
    )


@GROUP.claim("Tables 1 and 2", "1.8 cc are enough for 57.5 deg/s, with the leakages of Table 2.")
def leakage_share(evidence: Evidence) -> Finding:
    worst = TABLE_2["leakage"][1] * MAX_PRESSURE
    shares = tuple(worst / (evidence.full_flow * speed / evidence.speed) for speed in (3000 * RPM, SLOWEST))
    left = math.degrees(evidence.full_flow / evidence.D) * (1.0 - shares[0])
    return Finding(
        paper=(Number("rate", MAX_RATE, "deg/s"),),
        ours=(
            Number("share of the flow lost at 180 bar, 3000 rpm", 100 * shares[0], "%"),
            Number("share at 1500 rpm", 100 * shares[1], "%"),
            Number("rate left at 180 bar, 3000 rpm", left, "deg/s"),
        ),
        verdict=holds(left >= MAX_RATE, does_not_follow("Table 2")),
        why=f"The greatest k_Li, {TABLE_2['leakage'][1]:g} m^3/s/Pa, leaks {worst / LITER_PER_MINUTE:.2f} L/min at "
        f"180 bar, while the pump delivers {evidence.full_flow / LITER_PER_MINUTE:.2f} L/min.",
    )


@GROUP.claim("Table 1", "The bar's greatest angle is 14.46 deg.")
def bar_angle(evidence: Evidence) -> Finding:
    angle = math.degrees(MAX_TORQUE / evidence.c)
    return Finding(
        paper=(Number("angle", MAX_ANGLE, "deg"),),
        ours=(
            Number("1400 Nm over 5700 Nm/rad", angle, "deg"),
            Number("180 bar", math.degrees(evidence.D * MAX_PRESSURE / evidence.c), "deg"),
        ),
        verdict=_consistent(MAX_ANGLE, angle),
        why=f"Twisting the bar by 14.46 deg takes {evidence.c * math.radians(MAX_ANGLE):.0f} Nm: neither the 1400 Nm "
        "nor the torque at 180 bar.",
    )


@GROUP.claim("Table 1", "The servo valve's -3 dB point at +-10 % stroke is at 420 rad/s (65 Hz).")
def servo_valve(evidence: Evidence) -> Finding:
    A = pump_control(evidence.loop).A[:2, :2]  # spool and its rate, whose command acts as the spool itself does
    valve = control.ss(A, [[0.0], [-A[1, 0]]], [[1.0, 0.0]], 0.0)
    return _frequency(evidence, VALVE, corner_frequency(valve), amplitude=0.10)


@GROUP.claim("Table 1", "The servo pump's -3 dB point at +-25 % stroke is at 280 rad/s (45 Hz).")
def servo_pump(evidence: Evidence) -> Finding:
    omega = corner_frequency(pump_control(evidence.loop))
    circuit = evidence.loop.circuit
    valve_amplitude = 0.25 * float(circuit.swash_plate_loop.gain / circuit.swash_plate.max_rate)
    return _frequency(evidence, SERVO_PUMP, omega, valve_amplitude)


def _consistent(paper: float, ours: float) -> Verdict:
    """Numbers that the paper prints agree to the digits printed, or they contradict each other."""
    return holds(apart(paper, ours) <= ROUNDING, CONTRADICTS_ITSELF)


def _frequency(evidence: Evidence, paper: tuple[float, float], omega: float, amplitude: float) -> Finding:
    """A -3 dB point; `amplitude` is the valve's command, whose spool speed tells whether a saturation acts."""
    valve = evidence.loop.circuit.servo_valve
    speed, limit = 1.3 * amplitude * float(valve.frequency), float(valve.max_rate)
    linear = speed < limit
    told = f"stays under {speed:.0f} of {limit:.0f} strokes/s, so the linear response is the true one there"
    return Finding(
        paper=(Number("-3 dB", paper[0], "rad/s"), Number("-3 dB", paper[1], "Hz")),
        ours=(Number("-3 dB", omega, "rad/s"), Number("-3 dB", omega / (2.0 * math.pi), "Hz")),
        verdict=agreement(paper[0], omega, does_not_follow("Table 1"))
        if linear
        else holds_only("where the spool's speed is not limited"),
        why=f"Linearized running code; at this amplitude the spool {told if linear else 'reaches its speed limit'}. "
        f"{paper[0]:g} rad/s are {paper[0] / (2.0 * math.pi):.1f} Hz; the paper prints {paper[1]:g}.",
    )


def corner_frequency(system: control.LTI) -> float:
    """-3 dB point (rad/s) of a system."""
    omega = np.geomspace(1.0, FASTEST, POINTS)
    return 2.0 * math.pi * bandwidth(omega, system(1j * omega), float(control.dcgain(system)))


def percent(share: float) -> str:
    """A share as text."""
    return f"{100 * share:.1f} %"
