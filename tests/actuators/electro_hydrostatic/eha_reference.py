"""An independent solution of one axle's equations: its own numbers, its own code, an implicit solver of high accuracy.

Nothing of the package is used. Line and chamber are one volume a side (no fail-safe valve), the supply is stiff. The
current alone limits the machine's torque; where its voltage would not do, one along its magnets weakens the field.
"""

import numpy as np
from scipy.integrate import solve_ivp

V_P, V_M = 1.8e-6, 5.24e-4  # m^3/rev
D_P, D_M = V_P / (2 * np.pi), V_M / (2 * np.pi)
SIDE = 1.2e-13  # m^3/Pa, twice 6e-14
K_P, K_M = 2.25e-13, 1.75e-13
J, THETA, C_BAR = 4.0e-4, 0.175, 5700.0
GAS, REST, N = 25e-6, 5e5, 1.4
CRACK, CHECK = 0.2e5, 8.33e-10
RELIEF, RELIEF_SLOPE = 190e5, 8.33e-11
K_T, I_MAX, R, L, FLUX, POLES = 0.12, 75.0, 0.030, 150e-6, 0.020, 4
U = 0.95 * 48.0 / np.sqrt(3.0)
OMEGA_I, OMEGA_N, T_I, T_P, K = 1885.0, 157.0, 0.2, 2e-3, 40.0
N_MAX = 330.0
SCALES = np.array([1e5, 1e5, 1e5, 10.0, 0.01, 0.1, 1e5, 0.1, 1.0, 1.0, 1.0, 1.0])


def pump_loss(n, dp):
    rpm = abs(n) * 30.0 / np.pi
    share = 0.030 + 0.020 * rpm / 3000.0 + 0.050 * abs(dp) / 180e5 + 0.05 * np.exp(-rpm / 100.0)
    return 5.157 * share * np.tanh(n / 5.0)


def weakening(n, q):
    """Current i_d (A) with which a phase's voltage is not over U: R^2 + X^2, 2 X E and the rest of |u|^2 = U^2."""
    x, e = POLES * n * L, POLES * n * FLUX
    a, b, c = R**2 + x**2, 2.0 * x * e, (R**2 + x**2) * q**2 + e**2 + 2.0 * R * q * e - U**2
    return 0.0 if c <= 0.0 else (-b + np.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)


def solution(command, seconds, times, pieces=()):
    """(12, n) states at `times` (s): p_a, p_b, gas pressure, pump speed, angle, rate, sensed dp, integral, current, and
    the energies drawn, leaked and lost to friction in the motor (J).

    `command` is an angle (rad) over time; `pieces` are times (s) at which it has a corner.
    """

    def rate(t, y):
        a, b, gas, n, phi, w, sensed, integral, current = y[:9]
        dp = a - b
        leak = (K_P + K_M) * dp
        check_a, check_b = CHECK * max(gas - a - CRACK, 0.0), CHECK * max(gas - b - CRACK, 0.0)
        spill_a, spill_b = RELIEF_SLOPE * max(a - gas - RELIEF, 0.0), RELIEF_SLOPE * max(b - gas - RELIEF, 0.0)
        swept = D_P * n - D_M * w - leak
        volume = GAS * (REST / gas) ** (1.0 / N)
        wanted = (K * (command(t) - phi) * D_M + (K_P + K_M) * sensed) / D_P
        behind = min(max(wanted, -N_MAX), N_MAX) - n
        torque = OMEGA_N * J * behind + integral + D_P * sensed
        limited = min(max(torque, -K_T * I_MAX), K_T * I_MAX)
        drag = 4e-4 * n + 0.03 * np.tanh(n / 5.0)
        friction = 35.0 * np.tanh(w / 0.01) + 16.5 * w
        size = np.hypot(current, weakening(n, current))
        drawn = K_T * current * n + 1.5 * R * size**2 + 6.0 + 0.012 * 24.0 * size
        return [
            (swept + check_a - spill_a) / SIDE,
            (-swept + check_b - spill_b) / SIDE,
            N * gas / volume * (spill_a + spill_b - check_a - check_b),
            (K_T * current - drag - D_P * dp - pump_loss(n, dp)) / J,
            w,
            (D_M * dp - C_BAR * phi - friction) / THETA,
            (dp - sensed) / T_P,
            (OMEGA_N * J * behind - (torque - limited)) / T_I,
            OMEGA_I * (limited / K_T - current),
            drawn,
            leak * dp,
            friction * w,
        ]

    times = np.minimum(times, seconds)
    state, found = np.array([REST, REST, REST, *[0.0] * 9]), []
    ends = [*pieces, seconds]
    for start, end in zip([0.0, *pieces], ends, strict=True):
        inside = times[(times >= start) & ((times < end) | (end == seconds))]
        run = solve_ivp(
            rate, (start, end), state, "Radau", np.unique([*inside, end]), rtol=1e-8, atol=1e-8 * SCALES, max_step=0.01
        )
        found.append(run.y[:, : len(inside)])
        state = run.y[:, -1]
    return np.hstack(found)
