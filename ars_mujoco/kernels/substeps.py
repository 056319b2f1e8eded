"""Substeps: how many Runge-Kutta steps a physics step needs, and the linear equations, from the slopes of `rates`."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from ars_mujoco.kernels.kernel import entry
from ars_mujoco.kernels.records import numbers, store
from ars_mujoco.schema.channels import Scale
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters

FEWEST, MOST = 4, 200
MARGIN = 0.92  # of the stable step: a state's own eigenvalue moves a little as the others load it
RESOLVED = 1.0  # rad a substep, of the fastest oscillation


class TooFastError(InputError):
    """Equations whose `fastest` eigenvalue (1/s) is too fast for a step (s)."""

    def __init__(self, fastest: float, step: float):
        self.fastest = fastest
        super().__init__(
            f"the circuit's fastest eigenvalue, {fastest:.2g} 1/s, needs more than {MOST} substeps of {1e3 * step:g} ms"
        )


def fewest_substeps(slopes: Iterable[np.ndarray], step: float) -> int:
    """The fewest substeps of a physics step (s) in which all that decays does decay, and oscillations are resolved.

    `slopes` are matrices (n, n) of the derivatives' slopes by the states (1/s), wherever the equations are stiffest.
    Raises TooFastError where more than MOST are needed.
    """
    eigenvalues = np.concatenate([np.linalg.eigvals(each) for each in slopes])
    decaying = eigenvalues[eigenvalues.real <= 0.0] * step
    for count in range(FEWEST, MOST + 1):
        z = decaying / (MARGIN * count)
        if np.abs(amplification(z)).max() <= 1.0 and np.abs(z.imag).max() <= RESOLVED:
            return count
    fastest = np.abs(eigenvalues).max()
    raise TooFastError(float(fastest), step)


def amplification(z: np.ndarray) -> np.ndarray:
    """Growth of a mode over one classical Runge-Kutta step, z = eigenvalue times step."""
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))


def differences(function: Callable[[np.ndarray], Sequence[float]], at: np.ndarray, nudges: np.ndarray) -> np.ndarray:
    """Slopes (m, n) of a function of n numbers that gives m, by central differences with `nudges` (n,)."""
    columns = [
        np.subtract(function(at + nudge), function(at - nudge)) / (2.0 * nudge.sum()) for nudge in np.diag(nudges)
    ]
    return np.column_stack(columns)


def derivatives(rates: Callable) -> Callable[[Any, Any, Any], tuple[float, ...]]:
    """A function (p, demand, record) of the derivatives of `rates`, the state given as a record; cached."""

    @entry
    def derivatives_at(p, demand, state):
        return rates(p, demand, 0.0, numbers(state))[0]

    return derivatives_at


def scales(state: type[Parameters]) -> np.ndarray:
    """(n,) the small change of each number of a `state` that its fields declare, blocks in it included."""
    found: list[float] = []
    for field in state.model_fields.values():
        if isinstance(field.annotation, type) and issubclass(field.annotation, Parameters):
            found += scales(field.annotation).tolist()
        else:
            found.append(next(item.size for item in field.metadata if isinstance(item, Scale)))
    return np.array(found)


def slopes(rates: Callable, p: Any, demand: Any, state: np.record, nudges: np.ndarray) -> np.ndarray:
    """A (n, n): slopes of the derivatives of `rates` (see `derivatives`) about a state, a record of floats."""
    flat, about = state.copy(), np.array(numbers(state))

    def at(values: np.ndarray) -> Sequence[float]:
        store(flat, tuple(values))
        return rates(p, demand, flat)

    return differences(at, about, nudges)


def linearized(
    rates: Callable, p: Any, demand: Callable[[float], Any], state: np.record, nudges: np.ndarray, command: float
) -> tuple[np.ndarray, np.ndarray]:
    """A (n, n) and B (n, 1) about a state, for `demand(u)` a function of a command; nudged by `command`."""
    ahead, behind = rates(p, demand(command), state), rates(p, demand(-command), state)
    by_command = np.subtract(ahead, behind)[:, None] / (2.0 * command)
    return slopes(rates, p, demand(0.0), state, nudges), by_command
