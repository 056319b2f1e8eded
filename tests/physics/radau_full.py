"""An independent solution of the detailed plant: scipy's Radau, sharing no line with the package.

Any stage of the pump control drives either circuit, on the bench (bar ends held) and in continuous time:

    stage    full         eqs. 1 to 10: valve, both chambers of the cylinder, its piston
             reduced      eq. 16: valve, the chambers' pressure difference, piston
             third_order  eqs. 18 to 20: valve, stroke
    circuit  full         two lines of `lumps` lumps, check and relief valves, gallery, bypass, fail-safe valve
             reduced      the verification set's (`radau`): one pressure difference over the series capacitance

Pressures are absolute. Port A's side drives the motor to positive phi. Flows in the lines count from pump to motor.

    A pump --Q_A1-- ... --Q_AN--[fail-safe]-- A motor        nodes A0 .. AN: V_L/2N at the ends, V_L/N between
      |   checks, reliefs: gallery                |  bypass
    B pump --Q_B1-- ... --Q_BN--[fail-safe]-- B motor        nodes B0 .. BN

The energies are the circuit's and the motor's; the pump control has its own supply and is left out of them.
"""

from dataclasses import dataclass
from functools import cache
from math import copysign, exp, log, pi, sqrt, tanh

import numpy as np
from radau import BAR, STEP_1_DEG, Command, VerificationSet
from scipy.integrate import OdeSolution, solve_ivp

RTOL = 1e-8


@dataclass(frozen=True)
class DetailedPlant(VerificationSet):
    """Parameters beside those of the verification set, SI; speeds stay in revolutions a second."""

    # oil
    K: float = 1.4e9  # Pa, bulk modulus of the liquid
    air: float = 0.005  # undissolved air at p_0, share of the volume
    p_0: float = 1 * BAR  # Pa
    density: float = 840.0  # kg/m^3
    viscosity: float = 23e-6  # m^2/s, kinematic
    p_t: float = 1 * BAR  # Pa, tank

    # pump control
    A: float = 1.54e-4  # m^2
    x_max: float = 5e-3  # m
    V_dead: float = 4e-7  # m^3
    m: float = 0.15  # kg
    p_S: float = 26 * BAR  # Pa
    B: float = 5.7e-4  # (m^5/kg)^(1/2)
    y_max: float = 0.3e-3  # m
    d_0: float = 1 * BAR  # Pa, below which an orifice's square root is rounded
    c_sp: float = 1e4  # N/m
    F_0: float = 110.0  # N at dp_0
    dp_0: float = 180 * BAR  # Pa
    f_C: float = 13.0  # N
    f_s: float = 0.0  # N
    tau_s: float = 0.0  # s/m
    f_v: float = 30.0  # Ns/m
    v_s: float = 1e-3  # m/s
    k_Li: float = 1e-13  # m^3/s/Pa
    k_ext: float = 1e-14  # m^3/s/Pa
    k_u: float = 2e-13  # m^3/s/Pa
    k_st: float = 5e7  # N/m
    d_st: float = 1500.0  # Ns/m

    # circuit
    lumps: int = 1  # of each line
    line_diameter: float = 0.010  # m
    b_w: float = 0.0  # 1/Pa, compliance of the lines' walls
    k_x: float = 1e-14  # m^3/s/Pa, a side's leakage to the tank
    V_g: float = 2e-4  # m^3, gallery
    V_c: float = 0.5e-6  # m^3/rev, charge pump
    p_set: float = 20 * BAR  # Pa, charge relief
    G_cr: float = 4e-10  # m^3/s/Pa
    G_c: float = 1.67e-9  # m^3/s/Pa, check valves
    p_crack: float = 0.2 * BAR  # Pa
    K_b: float = 1e-3 / (10 * BAR) ** 0.5  # m^3/s/Pa^(1/2), bypass: 60 L/min at 10 bar
    K_f: float = 1e-3 / (2 * BAR) ** 0.5  # m^3/s/Pa^(1/2), fail-safe valve: 60 L/min at 2 bar
    q_0: float = 1e-6  # m^3/s, below which the fail-safe valve's drop is linear
    shut: float = 0.05  # opening below which the fail-safe valve is shut
    tau_shut: float = 60e-6  # s, decay of the flow behind it

    # motor
    c_stop: float = 2e5  # Nm/rad, beyond phi_n

    @property
    def k_p(self) -> float:
        """Pump's leakage [m^3/s/Pa]."""
        return self.pump_leakage_share * self.k

    @property
    def k_m(self) -> float:
        """Motor's leakage [m^3/s/Pa]."""
        return (1 - self.pump_leakage_share) * self.k

    @property
    def line_area(self) -> float:
        """Cross-section of a line [m^2]."""
        return pi * self.line_diameter**2 / 4

    @property
    def line_length(self) -> float:
        """Length of a line [m]."""
        return self.V_L / self.line_area

    @property
    def inertance(self) -> float:
        """Inertance of one lump [Pa s^2/m^3]."""
        return self.density * self.line_length / (self.lumps * self.line_area)


NOMINAL = DetailedPlant()


@dataclass(frozen=True)
class Opening:
    """A valve's opening through knots (s, 0..1) joined by straight lines, constant before and after them."""

    knots: tuple[tuple[float, float], ...]

    def __call__(self, t: float) -> float:
        """The opening at time t."""
        knots = self.knots
        if t <= knots[0][0]:
            return knots[0][1]
        for (t0, o0), (t1, o1) in zip(knots, knots[1:], strict=False):
            if t < t1:
                return o0 + (o1 - o0) * (t - t0) / (t1 - t0)
        return knots[-1][1]

    def passes(self, level: float) -> list[float]:
        """The times at which the opening passes the level inside a line."""
        return [
            t0 + (level - o0) / (o1 - o0) * (t1 - t0)
            for (t0, o0), (t1, o1) in zip(self.knots, self.knots[1:], strict=False)
            if min(o0, o1) < level < max(o0, o1)
        ]


SHUT = Opening(((0.0, 0.0),))
OPEN = Opening(((0.0, 1.0),))

# the states of each part, and the size that its tolerance and its differences refer to
CONTROLS = {
    "full": {"y": 1.0, "y_rate": 100.0, "p_A": 10 * BAR, "p_B": 10 * BAR, "x": 5e-3, "v": 1.0},
    "reduced": {"y": 1.0, "y_rate": 100.0, "dp_c": 10 * BAR, "x": 5e-3, "v": 1.0},
    "third_order": {"y": 1.0, "y_rate": 100.0, "X": 1.0},
}
MOTOR = {"phi": 0.1, "w": 1.0}


def nodes(lumps: int) -> list[str]:
    """Names of the lines' nodes, pump to motor, side A then side B."""
    return [f"{side}{j}" for side in "AB" for j in range(lumps + 1)]


def sizes(lumps: int, stage: str, circuit: str) -> dict[str, float]:
    """Names of the states in their order, with their typical size."""
    if circuit == "reduced":
        return CONTROLS[stage] | {"dp": 100 * BAR} | MOTOR
    flows = [f"Q_{side}{j}" for side in "AB" for j in range(1, lumps + 1)]
    pressures = dict.fromkeys([*nodes(lumps), "gallery"], 100 * BAR)
    return CONTROLS[stage] | pressures | dict.fromkeys(flows, 1e-4) | MOTOR


def rest_state(p: DetailedPlant, stage: str = "full", circuit: str = "full") -> dict[str, float]:
    """The plant at rest, by name, where the charge pump feeds its relief and the sides' leakage to the tank.

    The cylinder's chambers start at (p_S + p_t)/2; their leakage then lowers both alike, by k_ext/(2 k_u + k_ext) of
    it over the tank.
    """
    state = dict.fromkeys(sizes(p.lumps, stage, circuit), 0.0)
    if stage == "full":
        state["p_A"] = state["p_B"] = (p.p_S + p.p_t) / 2
    if circuit == "full":
        # c = k_x (p - p_t) = G_c (p_L - p - p_crack) on both sides, V_c n = 2 c + G_cr (p_L - p_set)
        leak = p.k_x * p.G_c / (p.k_x + p.G_c)
        p_L = (p.V_c * p.n + 2 * leak * (p.p_crack + p.p_t) + p.G_cr * p.p_set) / (2 * leak + p.G_cr)
        side = p_L - p.p_crack - leak / p.G_c * (p_L - p.p_crack - p.p_t)
        state |= dict.fromkeys(nodes(p.lumps), side) | {"gallery": p_L}
    return state


def compressibility(p: DetailedPlant, pressure: float) -> float:
    """Of oil with isothermal bubbles [1/Pa]."""
    return 1 / p.K + p.air * p.p_0 / pressure**2


def energy_density(p: DetailedPlant, pressure: float) -> float:
    """Work to compress a unit volume from the tank's pressure, against it [J/m^3]: int (q - p_t) b(q) dq."""
    liquid = (pressure - p.p_t) ** 2 / (2 * p.K)
    return liquid + p.air * p.p_0 * (log(pressure / p.p_t) + p.p_t / pressure - 1)


def rounded_root(drop: float, rounding: float) -> float:
    """sqrt(|drop|) sign(drop), linear well below the rounding [Pa^(1/2)]."""
    return drop / (drop**2 + rounding**2) ** 0.25


def _sat(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)


def _valve(p: DetailedPlant, y: float, y_rate: float, X_c: float, X: float) -> list[float]:
    u = _sat(p.K_in / p.X_rate_max * (X_c - X), 1.0)
    return [y_rate, 2 * p.d_sv * p.w_sv * (_sat(p.w_sv / (2 * p.d_sv) * (u - y), p.y_rate_max) - y_rate)]


def _piston(p: DetailedPlant, x: float, v: float, dp_c: float, dp: float) -> list[float]:
    friction = (p.f_C + p.f_s * exp(-p.tau_s * abs(v))) * tanh(v / p.v_s) + p.f_v * v
    beyond = x - _sat(x, p.x_max)
    pushing = p.k_st * abs(beyond) + p.d_st * copysign(1.0, beyond) * v  # a stop pushes, it does not pull
    stop = copysign(max(pushing, 0.0), beyond) if beyond else 0.0
    swash_plate = p.F_0 * dp / p.dp_0
    return [v, (p.A * dp_c - friction - swash_plate - p.c_sp * x - stop) / p.m]


def _full_control(p: DetailedPlant, state: list[float], X_c: float, dp: float) -> list[float]:
    y, y_rate, p_A, p_B, x, v = state
    high, low = (p.p_S, p.p_t) if y >= 0 else (p.p_t, p.p_S)
    spool = p.B * p.y_max * abs(y)
    into_A = spool * rounded_root(high - p_A, p.d_0) + p.k_u * (p.p_S - 2 * p_A + p.p_t)
    into_B = spool * rounded_root(low - p_B, p.d_0) + p.k_u * (p.p_S - 2 * p_B + p.p_t)
    inner = p.k_Li * (p_A - p_B)
    V_A, V_B = (p.V_dead + p.A * (p.x_max + each) for each in (x, -x))
    return [
        *_valve(p, y, y_rate, X_c, x / p.x_max),
        (into_A - p.A * v - p.k_ext * (p_A - p.p_t) - inner) / (V_A * compressibility(p, p_A)),
        (into_B + p.A * v - p.k_ext * (p_B - p.p_t) + inner) / (V_B * compressibility(p, p_B)),
        *_piston(p, x, v, p_A - p_B, dp),
    ]


def _reduced_control(p: DetailedPlant, state: list[float], X_c: float, dp: float) -> list[float]:
    y, y_rate, dp_c, x, v = state
    Q = p.B * p.y_max * y * rounded_root((p.p_S - p.p_t - (dp_c if y >= 0 else -dp_c)) / 2, p.d_0)
    V_A, V_B = (p.V_dead + p.A * (p.x_max + each) for each in (x, -x))
    C = V_A * V_B / (V_A + V_B) * compressibility(p, (p.p_S + p.p_t) / 2)
    return [
        *_valve(p, y, y_rate, X_c, x / p.x_max),
        (Q - p.A * v - (p.k_Li + p.k_ext / 2 + p.k_u) * dp_c) / C,
        *_piston(p, x, v, dp_c, dp),
    ]


def _third_order_control(p: DetailedPlant, state: list[float], X_c: float, dp: float) -> list[float]:
    y, y_rate, X = state
    return [*_valve(p, y, y_rate, X_c, X), p.X_rate_max * y]


_CONTROL_RATES = {"full": _full_control, "reduced": _reduced_control, "third_order": _third_order_control}


def line_drop(p: DetailedPlant, Q: float) -> float:
    """Pressure drop of one lump's flow [Pa]: laminar (eqs. 36 to 39) to Re 2300, Blasius from 4000, a chord between."""
    Re = 4 * abs(Q) / (pi * p.line_diameter * p.viscosity)
    if Re <= 2300:
        drop = _drop(p, Re, 64)
    elif Re >= 4000:
        drop = _drop(p, Re, 0.3164 * Re**0.75)
    else:
        laminar, turbulent = _drop(p, 2300, 64), _drop(p, 4000, 0.3164 * 4000**0.75)
        drop = laminar + (turbulent - laminar) * (Re - 2300) / (4000 - 2300)
    return copysign(drop, Q)


def _drop(p: DetailedPlant, Re: float, lambda_Re: float) -> float:
    """rho/2 v^2 l/d lambda, with the product lambda Re."""
    v = Re * p.viscosity / p.line_diameter
    return p.density / 2 * v * p.viscosity / p.line_diameter * p.line_length / (p.lumps * p.line_diameter) * lambda_Re


def fail_safe_drop(p: DetailedPlant, Q: float, opening: float) -> float:
    """Pressure drop over the open fail-safe valve [Pa]."""
    return Q * sqrt(Q**2 + p.q_0**2) / (p.K_f * opening) ** 2


def check_flow(p: DetailedPlant, p_L: float, pressure: float) -> float:
    """From the gallery into a side [m^3/s]."""
    return p.G_c * max(p_L - pressure - p.p_crack, 0.0)


def relief_flow(p: DetailedPlant, pressure: float, p_L: float) -> float:
    """From a side into the gallery [m^3/s]."""
    return p.G_rel * max(pressure - p_L - p.dp_rel, 0.0)


def charge_relief_flow(p: DetailedPlant, p_L: float) -> float:
    """From the gallery to the tank [m^3/s]."""
    return p.G_cr * max(p_L - p.p_set, 0.0)


def friction_torque(p: DetailedPlant, w: float) -> float:
    """Of the motor [Nm], eq. 28."""
    return (p.r_C + p.r_H * exp(-p.tau_H * abs(w))) * tanh(w / p.w_s) + p.r_v * w


def volumes(p: DetailedPlant, phi: float) -> tuple[list[float], list[float]]:
    """Of one side's line at its nodes, and of the motor's chambers A and B [m^3]."""
    line = [p.V_L / p.lumps] * (p.lumps + 1)
    line[0] = line[-1] = p.V_L / (2 * p.lumps)
    return line, [p.D * (p.phi_n + phi), p.D * (p.phi_n - phi)]


def split(p: DetailedPlant, circuit: list[float]) -> tuple[list[float], list[float], float, list[float], list[float]]:
    """The full circuit's states as node pressures of A and B, the gallery's, flows of A and B."""
    N = p.lumps
    return circuit[: N + 1], circuit[N + 1 : 2 * N + 2], circuit[2 * N + 2], circuit[2 * N + 3 : -N], circuit[-N:]


def _full_circuit(
    p: DetailedPlant, state: list[float], X: float, phi: float, w: float, bypass: float, fail_safe: float
) -> list[float]:
    A, B, p_L, Q_A, Q_B = split(p, state)
    displaced = X * p.V_p * p.n - p.k_p * (A[0] - B[0])
    across = p.D * w + p.k_m * (A[-1] - B[-1]) + bypass * p.K_b * rounded_root(A[-1] - B[-1], 1 * BAR)
    line, chambers = volumes(p, phi)
    rates, gallery = [], p.V_c * p.n - charge_relief_flow(p, p_L)
    for pressures, flows, chamber, sign in ((A, Q_A, chambers[0], 1), (B, Q_B, chambers[1], -1)):
        fed = check_flow(p, p_L, pressures[0]) - relief_flow(p, pressures[0], p_L)
        gallery -= fed
        into = [sign * displaced + fed - p.k_x * (pressures[0] - p.p_t), *flows]
        out = [*flows, sign * across]
        for j, pressure in enumerate(pressures):
            b = compressibility(p, pressure)
            C = line[j] * (b + p.b_w) + (chamber * b if j == p.lumps else 0.0)
            rates.append((into[j] - out[j]) / C)
    rates.append(gallery / (p.V_g * compressibility(p, p_L)))
    for pressures, flows in ((A, Q_A), (B, Q_B)):
        for j, Q in enumerate(flows):
            drop = pressures[j] - pressures[j + 1] - line_drop(p, Q)
            if j < p.lumps - 1:
                rates.append(drop / p.inertance)
            elif fail_safe < p.shut:
                rates.append(-Q / p.tau_shut)
            else:
                rates.append((drop - fail_safe_drop(p, Q, fail_safe)) / p.inertance)
    return rates


def _reduced_circuit(
    p: DetailedPlant, state: list[float], X: float, phi: float, w: float, bypass: float, fail_safe: float
) -> list[float]:
    (dp,) = state
    relief = p.G_rel * copysign(max(abs(dp) - p.dp_rel, 0.0), dp)
    C = p.C_0 * (1 - (p.D * phi / p.V_0) ** 2)
    return [(X * p.V_p * p.n - p.k * dp - relief - p.D * w) / C]


_CIRCUIT_RATES = {"full": _full_circuit, "reduced": _reduced_circuit}


def _differences(p: DetailedPlant, circuit: str, state: list[float]) -> tuple[float, float]:
    """Pressure difference at the pump and at the motor [Pa]."""
    if circuit == "reduced":
        return state[0], state[0]
    N = p.lumps
    return state[0] - state[N + 1], state[N] - state[2 * N + 1]


@dataclass(frozen=True)
class Plant:
    """What is solved: parameters, a stage of the pump control, a circuit and its valves' openings."""

    parameters: DetailedPlant
    stage: str
    circuit: str
    bypass: Opening
    fail_safe: Opening

    @property
    def sizes(self) -> dict[str, float]:
        """See `sizes`."""
        return sizes(self.parameters.lumps, self.stage, self.circuit)

    def derivative(self, t: float, state: list[float], phi_c: float) -> list[float]:
        """The right-hand side, in the order of `sizes`."""
        p = self.parameters
        control, circuit, (phi, w) = self._parts(state)
        dp_pump, dp_motor = _differences(p, self.circuit, circuit)
        X = self._stroke(control)
        X_c = _sat(p.K_p * (phi_c - phi), 1.0)
        stop = p.c_stop * (phi - _sat(phi, p.phi_n))
        openings = self.bypass(t), self.fail_safe(t)
        return [
            *_CONTROL_RATES[self.stage](p, control, X_c, dp_pump),
            *_CIRCUIT_RATES[self.circuit](p, circuit, _sat(X, 1.0), phi, w, *openings),
            w,
            (p.D * dp_motor - p.c * phi - stop - friction_torque(p, w)) / p.Theta,
        ]

    def jacobian(self, t: float, state: np.ndarray, phi_c: float) -> np.ndarray:
        """Central differences of `derivative`, (states, states)."""
        steps = 1e-6 * np.array(list(self.sizes.values()))
        rates = [[self.derivative(t, s.tolist(), phi_c) for s in state + h * np.diag(steps)] for h in (1, -1)]
        return (np.subtract(*rates) / (2 * steps[:, None])).T

    def powers(self, t: float, state: list[float]) -> dict[str, float]:
        """Powers [W] of the full circuit: `shaft` and `charge` enter, `LOSSES` leave.

        A chamber takes in D w at its pressure, which compresses what it holds; the energy e(p) of the volume D w added
        already compressed comes from nowhere, as in the paper's own C_H: `chambers` counts it as a loss of either sign.
        """
        p = self.parameters
        control, circuit, (phi, w) = self._parts(state)
        A, B, p_L, Q_A, Q_B = split(p, circuit)
        rates = _full_circuit(p, circuit, 0.0, phi, w, self.bypass(t), self.fail_safe(t))
        *_, dQ_A, dQ_B = split(p, rates)
        X, n = _sat(self._stroke(control), 1.0), p.n / p.n_norm
        pump, motor = A[0] - B[0], A[-1] - B[-1]
        load = abs(pump) / p.dp_norm
        torque_loss = p.loss_torque * (0.020 + 0.020 * n + 0.025 * load + 0.030 * abs(X) * load)
        return {
            "shaft": X * p.V_p * p.n * pump + torque_loss * 2 * pi * p.n,
            "charge": p.V_c * p.n * (p_L - p.p_t),
            "pump_torque_loss": torque_loss * 2 * pi * p.n,
            "pump_leakage": p.k_p * pump**2,
            "motor_leakage": p.k_m * motor**2,
            "external_leakage": p.k_x * ((A[0] - p.p_t) ** 2 + (B[0] - p.p_t) ** 2),
            "lines": sum(
                Q[j] * (side[j] - side[j + 1] - p.inertance * dQ[j])
                for side, Q, dQ in ((A, Q_A, dQ_A), (B, Q_B, dQ_B))
                for j in range(p.lumps)
            ),
            "checks": sum(check_flow(p, p_L, side[0]) * (p_L - side[0]) for side in (A, B)),
            "reliefs": sum(relief_flow(p, side[0], p_L) * (side[0] - p_L) for side in (A, B)),
            "charge_relief": charge_relief_flow(p, p_L) * (p_L - p.p_t),
            "bypass": self.bypass(t) * p.K_b * rounded_root(motor, 1 * BAR) * motor,
            "friction": friction_torque(p, w) * w,
            "chambers": -(energy_density(p, A[-1]) - energy_density(p, B[-1])) * p.D * w,
        }

    def stored(self, state: list[float]) -> dict[str, float]:
        """Energies [J] held by the full circuit's oil, walls and moving oil, the gallery, the bar, motor and stop."""
        p = self.parameters
        _, circuit, (phi, w) = self._parts(state)
        A, B, p_L, Q_A, Q_B = split(p, circuit)
        line, chambers = volumes(p, phi)
        at_nodes = [(V, pressure) for side in (A, B) for V, pressure in zip(line, side, strict=True)]
        in_chambers = list(zip(chambers, (A[-1], B[-1]), strict=True))
        return {
            "oil": sum(V * energy_density(p, pressure) for V, pressure in at_nodes + in_chambers),
            "walls": sum(V * p.b_w * (pressure - p.p_t) ** 2 / 2 for V, pressure in at_nodes),
            "gallery": p.V_g * energy_density(p, p_L),
            "flow": sum(p.inertance * Q**2 / 2 for Q in (*Q_A, *Q_B)),
            "bar": p.c * phi**2 / 2,
            "inertia": p.Theta * w**2 / 2,
            "stop": p.c_stop * (phi - _sat(phi, p.phi_n)) ** 2 / 2,
        }

    def _parts(self, state: list[float]) -> tuple[list[float], list[float], list[float]]:
        first = len(CONTROLS[self.stage])
        return state[:first], state[first:-2], state[-2:]

    def _stroke(self, control: list[float]) -> float:
        return control[-1] if self.stage == "third_order" else control[-2] / self.parameters.x_max


LOSSES = (
    "pump_torque_loss", "pump_leakage", "motor_leakage", "external_leakage", "lines", "checks", "reliefs",
    "charge_relief", "bypass", "friction", "chambers",
)  # fmt: skip


@dataclass(frozen=True)
class Solution:
    """A converged run; `time` (m,) s are the solver's own steps."""

    plant: Plant
    rtol: float
    time: np.ndarray
    _dense: OdeSolution

    def state(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """Each state at `time` (n,) s, from the collocation polynomials."""
        return dict(zip(self.plant.sizes, self._dense(time), strict=True))

    def phi(self, time: np.ndarray) -> np.ndarray:
        """The motor's angle [rad]."""
        return self.state(time)["phi"]

    def dp(self, time: np.ndarray) -> np.ndarray:
        """The motor's pressure difference [Pa]."""
        state = self.state(time)
        if self.plant.circuit == "reduced":
            return state["dp"]
        last = self.plant.parameters.lumps
        return state[f"A{last}"] - state[f"B{last}"]

    def pump_stroke(self, time: np.ndarray) -> np.ndarray:
        """The pump's stroke, -1..1."""
        state = self.state(time)
        fraction = state["X"] if "X" in state else state["x"] / self.plant.parameters.x_max
        return np.clip(fraction, -1, 1)

    def pressures(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """The full circuit's absolute pressures [Pa]: nodes A0.., B0.. from pump to motor, and the gallery."""
        state = self.state(time)
        return {name: state[name] for name in (*nodes(self.plant.parameters.lumps), "gallery")}

    def stored(self, time: float) -> float:
        """The stored energy [J], see `Plant.stored`."""
        return sum(self.plant.stored(self._dense(time).tolist()).values())

    def energies(self) -> dict[str, float]:
        """The powers integrated over the run by Radau's own nodes and weights [J]."""
        at = (np.array([4 - sqrt(6), 4 + sqrt(6), 10]) / 10).reshape(1, 3)
        weights = np.array([16 - sqrt(6), 16 + sqrt(6), 4]) / 36
        steps = np.diff(self.time)
        times = (self.time[:-1, None] + steps[:, None] * at).ravel()
        shares = (steps[:, None] * weights).ravel()
        powers = [self.plant.powers(t, state) for t, state in zip(times, self._dense(times).T.tolist(), strict=True)]
        return {name: shares @ [each[name] for each in powers] for name in powers[0]}


@cache
def solve(
    parameters: DetailedPlant = NOMINAL,
    stage: str = "full",
    circuit: str = "full",
    command: Command = STEP_1_DEG,
    bypass: Opening = SHUT,
    fail_safe: Opening = OPEN,
    rtol: float = RTOL,
) -> Solution:
    """Solve from `rest_state` through the command; computed once in a process for each set of arguments."""
    plant = Plant(parameters, stage, circuit, bypass, fail_safe)
    atol = rtol * np.array(list(plant.sizes.values()))
    state = np.array(list(rest_state(parameters, stage, circuit).values()))
    corners = [t for t, _ in bypass.knots + fail_safe.knots] + fail_safe.passes(parameters.shut)
    times, polynomials = [np.zeros(1)], []
    for first, last, angle in command.segments():
        cuts = sorted({first, last, *(t for t in corners if first < t < last)})
        for start, end in zip(cuts, cuts[1:], strict=False):
            run = solve_ivp(
                lambda t, s, angle=angle: plant.derivative(t, s.tolist(), angle(t)),
                (start, end),
                state,
                method="Radau",
                dense_output=True,
                rtol=rtol,
                atol=atol,
                jac=lambda t, s, angle=angle: plant.jacobian(t, s, angle(t)),
            )
            if not run.success:
                raise RuntimeError(f"Radau stopped at t = {run.t[-1]} s: {run.message}")
            times.append(run.t[1:])
            polynomials += run.sol.interpolants
            state = run.y[:, -1]
    time = np.concatenate(times)
    return Solution(plant, rtol, time, OdeSolution(time, polynomials))
