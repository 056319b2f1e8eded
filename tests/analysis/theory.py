"""The verification set's loop, and the paper's own polynomials of it."""

import numpy as np

from ars_mujoco.analysis.loop import Loop, loop_of
from ars_mujoco.analysis.parameter_box import TABLE_2, grid
from ars_mujoco.studies.inputs import read_inputs

LOOP = loop_of(read_inputs("bench_s_curve"))
CORNERS = [LOOP.at(point) for point in grid(tuple(TABLE_2))]


def leakage(loop: Loop) -> float:
    """k_Li, m^3/s/Pa."""
    return loop.circuit.pump.leakage + loop.circuit.motor.leakage


def full_flow(loop: Loop) -> float:
    """V_p n, m^3/s."""
    return loop.circuit.pump.displacement * loop.circuit.pump.speed


def plant_polynomial(loop: Loop) -> np.ndarray:
    """Denominator of angle over flow, whose numerator is D: eq. 43 with the angle and the bar's spring."""
    motor, C, k = loop.circuit.motor, loop.circuit.line.capacitance, leakage(loop)
    theta, r, D, c = motor.inertia, motor.viscous_friction, motor.displacement, loop.stiffness
    return np.array([C * theta, C * r + k * theta, C * c + k * r + D * D, k * c])


def pump_polynomial(loop: Loop) -> np.ndarray:
    """Denominator of stroke over its command, whose numerator is K_in w_sv^2: eqs. 18 to 20 with the inner loop."""
    valve, gain = loop.circuit.servo_valve, loop.circuit.swash_plate_loop.gain
    return np.array([1.0, 2.0 * valve.damping * valve.frequency, valve.frequency**2, gain * valve.frequency**2])


def cascade_polynomial(loop: Loop, gain: float) -> np.ndarray:
    """Characteristic polynomial of the closed cascade."""
    pump = pump_polynomial(loop)
    forward = gain * pump[-1] * full_flow(loop) * loop.circuit.motor.displacement
    return np.polyadd(np.polymul(pump, plant_polynomial(loop)), [forward])


def same_poles(found: np.ndarray, polynomial: np.ndarray, rel: float = 1e-6) -> bool:
    """Whether poles are the roots of a polynomial, each to `rel` of its size."""
    roots = np.sort_complex(np.roots(polynomial))
    return bool(np.all(np.abs(np.sort_complex(found) - roots) <= rel * np.abs(roots)))
