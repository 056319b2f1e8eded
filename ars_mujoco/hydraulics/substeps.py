"""Substeps: how many Runge-Kutta steps of the circuit a physics step needs, from the eigenvalues of its equations."""

import numpy as np

from ars_mujoco.errors import InputError
from ars_mujoco.hydraulics.reduced_circuit import rates
from ars_mujoco.kernel import entry

FEWEST, MOST = 4, 200
MARGIN = 0.92  # of the stable step: the friction's own eigenvalue moves a little as the bar loads the motor
RESOLVED = 1.0  # rad a substep, of the fastest oscillation
NUDGES = np.array([1e-4, 1e-2, 1e-4, 1e2, 1e-6, 1e-6])  # of the six states, for the slopes


def substeps(circuit, bar_stiffness: float, step: float) -> int:
    """The fewest substeps of a physics step (s) in which all that decays does decay, and oscillations are resolved.

    Looked at where the circuit is stiffest: at rest (the friction's rounding), moving, over the relief valve's pressure
    and past the mechanical stop. Raises InputError where more than MOST are needed.
    """
    motor = circuit.motor
    states = np.zeros((4, 6))
    states[1, 5] = 1.0  # rad/s
    states[2, 3] = 1.1 * circuit.relief_valve.pressure
    states[3, 4] = 1.01 * motor.stop_angle
    eigenvalues = np.concatenate([np.linalg.eigvals(_slopes(circuit, bar_stiffness, state)) for state in states])
    decaying = eigenvalues[eigenvalues.real <= 0.0] * step
    for count in range(FEWEST, MOST + 1):
        z = decaying / (MARGIN * count)
        if np.abs(_amplification(z)).max() <= 1.0 and np.abs(z.imag).max() <= RESOLVED:
            return count
    fastest = np.abs(eigenvalues).max()
    raise InputError(
        f"the circuit's fastest eigenvalue, {fastest:.2g} 1/s, needs more than {MOST} substeps of {1e3 * step:g} ms; "
        "a capacitance, an inertia or a friction speed is too small, or a rate or gain too large"
    )


def _amplification(z: np.ndarray) -> np.ndarray:
    """Growth of a mode over one classical Runge-Kutta step, z = eigenvalue times step."""
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))


def _slopes(circuit, bar_stiffness: float, state: np.ndarray) -> np.ndarray:
    """Derivatives (6, 6) of the states' rates by the states, by central differences."""
    columns = []
    for nudge in np.diag(NUDGES):
        ahead, behind = _rates(circuit, bar_stiffness, state + nudge), _rates(circuit, bar_stiffness, state - nudge)
        columns.append(np.subtract(ahead, behind) / (2.0 * nudge.sum()))
    return np.column_stack(columns)


@entry
def _rates(circuit, bar_stiffness, state):
    six = (state[0], state[1], state[2], state[3], state[4], state[5])
    derivatives, _ = rates(circuit, bar_stiffness, six, 0.0, 0.0)
    return derivatives
