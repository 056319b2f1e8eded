"""An independent solution of the verification set: scipy's Radau at rtol 1e-10, sharing no line with the package.

The reduced model of the front axle on the bench (bar ends held, psi = 0), both loops in continuous time:
servo valve stroke y and its rate, swash-plate stroke X, motor pressure dp, motor angle phi and rate w.

    X_c   = sat_1(K_p (phi_c - phi))
    u     = sat_1(K_in / Xdot_max (X_c - X))
    y''   = 2 d w_sv (sat_ydot_max(w_sv / (2 d) (u - y)) - y')
    X'    = Xdot_max y
    C dp' = sat_1(X) V_p n - k dp - Q_rel - D w,  C = C_0 (1 - (D phi / V_0)^2)
    Theta w' = D dp - c phi - M_F

Signs of the losses: the pump's shaft always turns forward, so its torque loss is positive in all four quadrants of
(X, dp) and takes |X| and |dp|; shaft power is negative only where the hydraulic power returned exceeds that loss.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import copysign, exp, pi, tanh
from typing import NamedTuple

import numpy as np
from scipy.integrate import OdeSolution, solve_ivp

RTOL = 1e-10
BAR = 1e5
RPM = 1 / 60  # rev/s


@dataclass(frozen=True)
class VerificationSet:
    """Parameters of the front axle, SI, displacements of the pump a revolution and of the motor a radian."""

    w_sv: float = 420.0  # rad/s
    d_sv: float = 0.5**0.5
    y_rate_max: float = 100.0  # 1/s
    X_rate_max: float = 250.0  # 1/s
    K_in: float = 140.4579128014667  # 1/s
    K_p: float = 60.0  # 1/rad
    n: float = 3000 * RPM  # rev/s
    V_p: float = 1.8e-6  # m^3/rev
    D: float = 5.24e-4 / (2 * pi)  # m^3/rad
    C_0: float = 6e-14  # m^3/Pa
    phi_n: float = pi / 4  # rad
    V_L: float = 2.62e-4  # m^3
    k: float = 4e-13  # m^3/s/Pa
    pump_leakage_share: float = 0.5625
    Theta: float = 0.175  # kg m^2
    c: float = 5700.0  # Nm/rad
    r_v: float = 16.5  # Nms/rad
    r_C: float = 35.0  # Nm
    r_H: float = 0.0  # Nm
    tau_H: float = 20.0  # s/rad
    w_s: float = 0.01  # rad/s
    dp_rel: float = 190 * BAR  # Pa
    G_rel: float = 8.33e-11  # m^3/s/Pa
    loss_torque: float = 5.157  # Nm
    n_norm: float = 3000 * RPM  # rev/s
    dp_norm: float = 180 * BAR  # Pa

    @property
    def V_0(self) -> float:
        """Oil volume of one side with the vane in the middle [m^3]."""
        return self.V_L + self.D * self.phi_n


CORNERS = tuple(VerificationSet(Theta=Theta, C_0=C_0, n=6000 * RPM) for Theta in (0.1, 0.25) for C_0 in (4e-14, 8e-14))


class State(NamedTuple):
    """The six states; floats, or arrays of shape (n,) for n instants."""

    y: float  # valve stroke, 1
    y_rate: float  # 1/s
    X: float  # pump stroke, 1
    dp: float  # Pa
    phi: float  # rad
    w: float  # rad/s


ATOL = RTOL * np.array(State(y=1.0, y_rate=100.0, X=1.0, dp=100 * BAR, phi=0.1, w=1.0))


@dataclass(frozen=True)
class Command:
    """Bar angle phi_c through knots (s, rad), joined by s^3 (10 - 15 s + 6 s^2); Radau restarts at each knot."""

    knots: tuple[tuple[float, float], ...]

    def segments(self) -> list[tuple[float, float, Callable[[float], float]]]:
        """(start, end, phi_c(t)) of each stretch between two knots."""
        return [(t0, t1, _join(t0, a0, t1, a1)) for (t0, a0), (t1, a1) in zip(self.knots, self.knots[1:], strict=False)]


def _join(t0: float, a0: float, t1: float, a1: float) -> Callable[[float], float]:
    def angle(t: float) -> float:
        s = (t - t0) / (t1 - t0)
        return a0 + (a1 - a0) * s**3 * (10 - 15 * s + 6 * s**2)

    return angle


def step(degrees: float, duration: float = 0.6) -> Command:
    """A step of the bar angle at t = 0, from rest."""
    angle = degrees * pi / 180
    return Command(((0.0, angle), (duration, angle)))


_S_CURVE = (
    (0, 0), (0.5, 0), (2, 7), (3, 5), (4.5, 9), (5.5, 6.5), (7, 10.5), (8, 8), (9.5, 11.5), (10.5, 8.5),
    (12, 12), (13, 10), (14, 10), (16, -10), (16.5, -10), (18, -8), (24, -8),
)  # fmt: skip
STEP_1_DEG = step(1)
STEP_10_DEG = step(10)
S_CURVE = Command(tuple((float(t), degrees * pi / 180) for t, degrees in _S_CURVE))


@dataclass(frozen=True)
class Solution:
    """A converged run: `time` (m,) s are the solver's own steps, `energy` (m,) J the integrals of `powers`."""

    parameters: VerificationSet
    time: np.ndarray
    energy: dict[str, np.ndarray]
    _dense: OdeSolution

    def state(self, time: np.ndarray) -> State:
        """The states at `time` (n,) s, from the collocation polynomials."""
        return State(*self._dense(time))

    def power(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """The powers [W] at `time` (n,) s, see `powers`."""
        return powers(self.parameters, self.state(time))

    def stored(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """The stored energies [J] at `time` (n,) s, see `stored`."""
        return stored(self.parameters, self.state(time))


@cache
def solve(parameters: VerificationSet, command: Command) -> Solution:
    """Solve from rest through the command; computed once in a process for each pair of arguments."""
    state = np.zeros(len(State._fields))
    times, polynomials = [np.zeros(1)], []
    for start, end, angle in command.segments():
        run = solve_ivp(
            lambda t, s, angle=angle: derivative(parameters, s.tolist(), angle(t)),
            (start, end),
            state,
            method="Radau",
            dense_output=True,
            rtol=RTOL,
            atol=ATOL,
            jac=lambda t, s, angle=angle: jacobian(parameters, s.tolist(), angle(t)),
        )
        if not run.success:
            raise RuntimeError(f"Radau stopped at t = {run.t[-1]} s: {run.message}")
        times.append(run.t[1:])
        polynomials += run.sol.interpolants
        state = run.y[:, -1]
    time = np.concatenate(times)
    dense = OdeSolution(time, polynomials)
    return Solution(parameters, time, _energies(parameters, time, dense), dense)


def _sat(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)


def _inside(value: float, limit: float) -> float:
    """The derivative of `_sat`."""
    return float(-limit < value < limit)


def derivative(p: VerificationSet, state: list[float], phi_c: float) -> list[float]:
    """The right-hand side, in the order of `State`."""
    y, y_rate, X, dp, phi, w = state
    X_c = _sat(p.K_p * (phi_c - phi), 1.0)
    u = _sat(p.K_in / p.X_rate_max * (X_c - X), 1.0)
    y_acceleration = 2 * p.d_sv * p.w_sv * (_sat(p.w_sv / (2 * p.d_sv) * (u - y), p.y_rate_max) - y_rate)
    C = p.C_0 * (1 - (p.D * phi / p.V_0) ** 2)
    Q_rel = p.G_rel * copysign(max(abs(dp) - p.dp_rel, 0.0), dp)
    M_F = (p.r_C + p.r_H * exp(-p.tau_H * abs(w))) * tanh(w / p.w_s) + p.r_v * w
    return [
        y_rate,
        y_acceleration,
        p.X_rate_max * y,
        (_sat(X, 1.0) * p.V_p * p.n - p.k * dp - Q_rel - p.D * w) / C,
        w,
        (p.D * dp - p.c * phi - M_F) / p.Theta,
    ]


def jacobian(p: VerificationSet, state: list[float], phi_c: float) -> np.ndarray:
    """d derivative / d state, (6, 6); a limited quantity has no derivative."""
    y, _, X, dp, phi, w = state
    outer = p.K_p * (phi_c - phi)
    inner = p.K_in / p.X_rate_max * (_sat(outer, 1.0) - X)
    gain = p.w_sv**2 * _inside(p.w_sv / (2 * p.d_sv) * (_sat(inner, 1.0) - y), p.y_rate_max)
    gain_inner = gain * p.K_in / p.X_rate_max * _inside(inner, 1.0)
    relative = 1 - (p.D * phi / p.V_0) ** 2
    C = p.C_0 * relative
    relief = p.G_rel * float(abs(dp) > p.dp_rel)
    tanh_w, decay = tanh(w / p.w_s), p.r_H * exp(-p.tau_H * abs(w))
    friction = (p.r_C + decay) * (1 - tanh_w**2) / p.w_s - p.tau_H * decay * abs(tanh_w) + p.r_v
    dp_rate = derivative(p, state, phi_c)[State._fields.index("dp")]
    stiffening = 2 * dp_rate * (p.D / p.V_0) ** 2 * phi / relative
    return np.array([
        [0, 1, 0, 0, 0, 0],
        [-gain, -2 * p.d_sv * p.w_sv, -gain_inner, 0, -gain_inner * p.K_p * _inside(outer, 1.0), 0],
        [p.X_rate_max, 0, 0, 0, 0, 0],
        [0, 0, p.V_p * p.n * _inside(X, 1.0) / C, -(p.k + relief) / C, stiffening, -p.D / C],
        [0, 0, 0, 0, 0, 1],
        [0, 0, 0, p.D / p.Theta, -p.c / p.Theta, -friction / p.Theta],
    ])  # fmt: skip


LOSSES = ("pump_torque_loss", "pump_leakage", "motor_leakage", "relief", "friction", "capacitance")


def powers(p: VerificationSet, state: State) -> dict[str, np.ndarray]:
    """Powers [W] of a state: `shaft` into the pump, `motor` onto the bar, losses positive where energy leaves.

    The paper's C_H depends on phi but its pressure equation holds C dp' alone, so dC/dphi w dp^2 / 2 of the stored
    C dp^2 / 2 comes from nowhere: `capacitance` counts that term as a loss of either sign, and the balance closes.
    """
    _, _, X, dp, phi, w = state
    X = np.clip(X, -1, 1)
    n, pressure, stroke = p.n / p.n_norm, np.abs(dp) / p.dp_norm, np.abs(X)
    torque_loss = p.loss_torque * (0.020 + 0.020 * n + 0.025 * pressure + 0.030 * stroke * pressure)
    shaft = X * p.V_p * p.n * dp + torque_loss * 2 * pi * p.n
    motor = p.c * phi * w
    dC_dphi = -2 * p.C_0 * (p.D / p.V_0) ** 2 * phi
    return {
        "shaft": shaft,
        "motor": motor,
        "throughput": np.abs(shaft) + np.abs(motor),
        "recovered": np.maximum(-shaft, 0),
        "pump_torque_loss": torque_loss * 2 * pi * p.n,
        "pump_leakage": p.pump_leakage_share * p.k * dp**2,
        "motor_leakage": (1 - p.pump_leakage_share) * p.k * dp**2,
        "relief": p.G_rel * np.maximum(np.abs(dp) - p.dp_rel, 0) * np.abs(dp),
        "friction": ((p.r_C + p.r_H * np.exp(-p.tau_H * np.abs(w))) * np.tanh(w / p.w_s) + p.r_v * w) * w,
        "capacitance": -dC_dphi * w * dp**2 / 2,
    }


def stored(p: VerificationSet, state: State) -> dict[str, np.ndarray]:
    """Energies [J] held by the oil, the twisted bar and the moving inertia."""
    C = p.C_0 * (1 - (p.D * state.phi / p.V_0) ** 2)
    return {"oil": C * state.dp**2 / 2, "bar": p.c * state.phi**2 / 2, "inertia": p.Theta * state.w**2 / 2}


def _energies(p: VerificationSet, time: np.ndarray, dense: OdeSolution) -> dict[str, np.ndarray]:
    """The powers integrated by Radau's own nodes and weights, as if they were states of the same run [J]."""
    nodes = np.array([(4 - 6**0.5) / 10, (4 + 6**0.5) / 10, 1.0])
    weights = np.array([(16 - 6**0.5) / 36, (16 + 6**0.5) / 36, 1 / 9])
    steps = np.diff(time)
    at_nodes = time[:-1, None] + steps[:, None] * nodes
    return {
        name: np.concatenate([[0.0], np.cumsum(power.reshape(-1, 3) @ weights * steps)])
        for name, power in powers(p, State(*dense(at_nodes.ravel()))).items()
    }
