"""Compensators: what pressure feedback (Fig. 12) and a second-order compensator (Fig. 13) can do for two actuators.

Pressure feedback damps the hydraulic poles by a flow that goes against the pressure. The flow comes through the pump
control, and how far that lags behind at the hydraulic frequency decides what it does: it damps up to 90 deg, and from
there to 270 deg it does the opposite. On the stabilizer the lag is 228 deg; on a robot's joint, with the same pump
control and slower hydraulics, it is 18 deg. A sign turned round would suit the stabilizer's lag and damps its motor
while that moves; but dry friction holds the motor at every turn, and there it drives the pressure up. So a feedback
counts by the lesser damping of the two, moving and held.

What bandwidth pressure feedback gives the stabilizer has another reason: its bar's spring makes the pressure follow the
angle, and the high-pass of an angle is a lead. Without the spring the gain is gone.

The second-order compensator cancels the hydraulic poles in the command's way. It damps nothing: they are still there,
and answer to a load as before.

Both are sought over their settings, for the most damping (the bar-angle loop open) and for the most bandwidth (closed,
with 6 dB and 45 deg where its loop is cut at the stroke command, through which every feedback goes), with a continuous
unit and with units that sample and are late.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import control
import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DARK, DASHES, MIDDLE_GREY, SHADES, label, legend_beside
from ars_mujoco.analysis.linearization import actuator, plant, pump_control
from ars_mujoco.analysis.loop import Loop, loop_of
from ars_mujoco.analysis.margins import SAMPLE_TIMES, WANTED, bandwidth, sampled
from ars_mujoco.analysis.parameter_box import PLANT, grid
from ars_mujoco.hydraulics.pump import ideal_flow
from ars_mujoco.studies.inputs import read_inputs

ROBOT = "robot_step"  # the cycle of the other actuator
DELAYS = (0.0, 10e-3)  # s
TIMINGS = ((0.0, 0.0), *((sample, delay) for delay in DELAYS for sample in SAMPLE_TIMES))  # s
SIGNS = {"as_drawn": 1.0, "reversed": -1.0}  # of the pressure feedback
GAINS = np.geomspace(0.01, 30.0, 48)  # of pressure feedback, over what would make the damping 1 with an ideal pump
CORNERS = np.geomspace(0.1, 6.0, 12)  # of pressure feedback, over the hydraulic frequency
NEW_DAMPINGS = np.geomspace(0.1, 3.0, 30)  # of the second-order compensator
RATIOS = np.geomspace(0.2, 10.0, 25)  # of the pump control's -3 dB point to the hydraulic frequency
POINTS = 1000  # of frequency
SLOWEST, FASTEST = 5e-3, 3.0  # of them, over the hydraulic frequency; half the sampling ends them too
LOOP_GAINS, HALVINGS = (1e-3, 1e4), 20  # 1/rad, where a loop gain is sought, and how often this is halved
SLOW_HYDRAULICS = 2.34e-13  # m^3/Pa, capacitance of the high-pressure side alone: 450 rad/s with the bar
AT_REST = 1e-3  # rad/s; a slower pole is the angle's own, at 0 where no spring holds the shaft
ACTUATORS = {  # what a table calls them, and what the paper says of pressure feedback on them
    "this": ("this actuator", "futile"),
    "robot": ("robot's joint", "improved damping"),
}
SHOWN = ((0.0, 0.0), (1e-3, 0.0), (1e-3, 10e-3))  # timings in the table
WAYS = {"without": MIDDLE_GREY, "pressure_feedback": DARK, "compensator": ACCENT}  # to a bandwidth
UNITS = {"frequency": "rad/s", "damping": "1", "lag": "deg", "gain": "1/Pa", "corner": "rad/s", "bandwidth": "Hz",
         "loop_gain": "1/rad", "new_damping": "1", "sample_time": "s", "delay": "s", "ratio": "1"}  # fmt: skip


def pressure_feedback(gain: float, corner: float, sample_time: float = 0.0) -> control.TransferFunction:
    """From pressure (Pa) to what is taken off the stroke command (1); digital where there is a sample time (s)."""
    return gain * _digital(control.tf([1.0, 0.0], [1.0, corner]), corner, sample_time)


def pole_compensator(
    frequency: float, damping: float, new_damping: float, sample_time: float = 0.0
) -> control.TransferFunction:
    """The second-order compensator of the stroke command (1); digital where there is a sample time (s)."""
    zeros, poles = ([1.0, 2.0 * each * frequency, frequency**2] for each in (damping, new_damping))
    return _digital(control.tf(zeros, poles), frequency, sample_time)


def behind_unit(
    loop: Loop, sample_time: float = 0.0, delay: float = 0.0, dry_friction: bool = False
) -> control.StateSpace:
    """From the unit's stroke command (1) to angle (rad) and pressure (Pa); times in s, continuous where they are 0.

    With dry friction the motor is as good as held.
    """
    system = actuator(loop, dry_friction)
    return sampled(system, sample_time, delay) if sample_time else system


def moving_and_held(loop: Loop, sample_time: float = 0.0, delay: float = 0.0) -> list[control.StateSpace]:
    """`behind_unit` without and with dry friction."""
    return [behind_unit(loop, sample_time, delay, dry_friction) for dry_friction in (False, True)]


def fed_back(system: control.StateSpace, feedback: control.TransferFunction) -> control.StateSpace:
    """`system`, from the stroke command to angle and pressure, with pressure feedback around it."""
    return control.feedback(system, control.ss(feedback) * np.array([[0.0, 1.0]]))


def hydraulic_pair(loop: Loop) -> tuple[float, float]:
    """(natural frequency rad/s, damping) of the hydraulic poles, with the bar's spring."""
    pole = max(plant(loop).poles(), key=np.imag)
    return float(abs(pole)), float(-pole.real / abs(pole))


def lag(loop: Loop, sample_time: float = 0.0, delay: float = 0.0) -> float:
    """How far (deg) a stroke lags at the hydraulic frequency: pump control, half a sample of holding, delay."""
    frequency, _ = hydraulic_pair(loop)
    response = pump_control(loop)(1j * np.linspace(0.0, frequency, 200))
    return math.degrees(frequency * (0.5 * sample_time + delay) - float(np.unwrap(np.angle(response))[-1]))


def pace(loop: Loop) -> float:
    """-3 dB point (rad/s) of the pump control."""
    omega = hydraulic_pair(loop)[0] * np.geomspace(RATIOS[0], RATIOS[-1], POINTS)
    return 2.0 * math.pi * bandwidth(omega, pump_control(loop)(1j * omega), 1.0)


def at_ratio(loop: Loop, ratio: float) -> Loop:
    """The loop with all of its pump control faster or slower: -3 dB at `ratio` times the hydraulic frequency."""
    factor = ratio * hydraulic_pair(loop)[0] / pace(loop)
    circuit = loop.circuit.copy()
    for part, name in (
        (circuit.servo_valve, "frequency"),
        (circuit.servo_valve, "max_rate"),
        (circuit.swash_plate, "max_rate"),
        (circuit.swash_plate_loop, "gain"),
    ):
        part[name] *= factor
    return replace(loop, circuit=circuit)


def least_damping(poles: np.ndarray, sample_time: float = 0.0) -> np.ndarray:
    """Least damping ratio among `poles` (..., n), 1 where all are real, negative where one is unstable.

    All of them count: what damps the hydraulic poles only to shake the pump control's is no gain.
    """
    if sample_time:
        poles = np.log(np.maximum(np.abs(poles), 1e-12) * np.exp(1j * np.angle(poles))) / sample_time
    size = np.abs(poles)
    return np.where(size > AT_REST, -np.real(poles) / np.maximum(size, AT_REST), 1.0).min(axis=-1)


def settings(loop: Loop, sign: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Gains (1/Pa) and corners (rad/s) of pressure feedback to look at; `sign` is 1 for those as drawn, else -1."""
    frequency, _ = hydraulic_pair(loop)
    scale = 2.0 * frequency * loop.circuit.line.capacitance / ideal_flow(loop.circuit.pump, 1.0)
    return sign * scale * np.concatenate([[0.0], GAINS]), frequency * CORNERS


def most_damping(systems: Sequence[control.StateSpace], gains: np.ndarray, corners: np.ndarray) -> dict[str, float]:
    """Pressure feedback with the most `damping` of whichever of `systems` it damps least, its `gain` and `corner`."""
    best = {"damping": -1.0}
    for corner in _filtered(corners, systems[0].dt):
        damping = np.min([_dampings(system, gains, corner) for system in systems], axis=0)
        i = int(np.argmax(damping))
        if damping[i] > best["damping"]:
            best = {"damping": float(damping[i]), "gain": float(gains[i]), "corner": corner}
    return best


def most_bandwidth(loop: Loop, system: control.StateSpace, gains: np.ndarray, corners: np.ndarray) -> dict[str, float]:
    """Pressure feedback with the most `bandwidth` at the wanted margins, its `gain`, `corner` and `loop_gain`."""
    omega, at_rest, best = _frequencies(loop, system.dt), _at_rest(system), {"bandwidth": 0.0}
    angle, pressure = _response(system, omega)[:, 0]
    for corner in _filtered(corners, system.dt):
        high_pass = _response(pressure_feedback(1.0, corner, system.dt), omega)[0, 0]
        inner = gains[:, None] * high_pass * pressure
        for gain, around, K in zip(gains.tolist(), inner, greatest_gain(angle, inner), strict=True):
            reached = _bandwidth(omega, K, angle, around, at_rest)
            if reached > best["bandwidth"]:
                best = {"bandwidth": reached, "gain": gain, "corner": corner, "loop_gain": float(K)}
    return best


def compensated(loop: Loop, system: control.StateSpace) -> dict[str, float]:
    """The second-order compensator on the hydraulic poles with the most `bandwidth` at the wanted margins."""
    omega, at_rest, best = _frequencies(loop, system.dt), _at_rest(system), {"bandwidth": 0.0}
    angle, (frequency, damping) = _response(system, omega)[0, 0], hydraulic_pair(loop)
    for new_damping in NEW_DAMPINGS.tolist():
        filtering = pole_compensator(frequency, damping, new_damping, system.dt)
        through = angle * _response(filtering, omega)[0, 0]
        (K,) = greatest_gain(through, np.zeros((1, 1)))
        reached = _bandwidth(omega, K, through, 0.0, at_rest)
        if reached > best["bandwidth"]:
            best = {"bandwidth": reached, "new_damping": new_damping, "loop_gain": float(K)}
    return best


def greatest_gain(angle: np.ndarray, inner: np.ndarray) -> np.ndarray:
    """K_p (1/rad) up to which the loop K_p `angle` + `inner`, cut at the stroke command, keeps the wanted margins.

    `angle` (m) and the rows of `inner` (n, m) are responses over frequency; 0 where `inner` alone does not keep them.
    A loop that is stable where it is open and never comes to -1 from beyond it is stable where it is closed.
    """
    least, most = (np.full(len(inner), end) for end in LOOP_GAINS)
    for _ in range(HALVINGS):
        middle = np.sqrt(least * most)
        keeps = _keeps_margins(middle[:, None] * angle + inner)
        least, most = np.where(keeps, middle, least), np.where(keeps, most, middle)
    return np.where(least > LOOP_GAINS[0], least, 0.0)


def compute(loop: Loop) -> dict[str, Any]:
    """Both compensators over all timings, on this actuator and on the robot's joint; this one over the corners of
    Table 2; and the damping over the ratio of pump control to hydraulic frequency.
    """
    loops = {"this": loop, "robot": loop_of(read_inputs(ROBOT))}
    with_slow = {**loops, "slow": loop.at({"capacitance": SLOW_HYDRAULICS})}
    return {
        "units": UNITS,
        "actuators": {name: _actuator(each) for name, each in loops.items()},
        "all_corners": [_all_corners(loop, *timing) for timing in TIMINGS if timing[0] <= SAMPLE_TIMES[0]],
        "ratio": RATIOS.tolist(),
        "over_ratio": {name: _over_ratio(each) for name, each in with_slow.items()},
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: what each compensator does for each actuator, continuous and sampled."""
    rows = []
    for name, (title, paper) in ACTUATORS.items():
        found = result["actuators"][name]
        shown = [row for row in found["rows"] if (row["sample_time"], row["delay"]) in SHOWN]
        poles = (
            f"{found['frequency']:.0f} rad/s, damping {found['damping']:.3f}; a stroke lags {shown[0]['lag']:.0f} deg"
        )
        rows.append({"quantity": f"{title}: hydraulic poles", "value": poles})
        for sign in SIGNS:
            value = ", ".join(_damping_told(row, row[sign]) for row in shown)
            quantity = f"{title}: most damping by pressure feedback {sign.replace('_', ' ')}"
            rows.append({"quantity": quantity, "value": value, "paper": paper if SIGNS[sign] > 0.0 else ""})
        for row in shown:
            value = ", ".join(f"{row[way]['bandwidth']:.1f}" for way in WAYS) + " Hz"
            quantity = f"{title}: bandwidth without, with pressure feedback, with compensator; {_timing(row)}"
            rows.append({"quantity": quantity, "value": value})
    for row in result["all_corners"]:
        value = ", ".join(f"{row[name]['damping']:.3f} {name.replace('_', ' ')}" for name in ("without", *SIGNS))
        rows.append({"quantity": f"least damping over all corners, {_timing(row)}", "value": value})
    return rows


def draw(result: dict[str, Any]) -> Figure:
    """Damping over the ratio of pump control to hydraulics, and each actuator's bandwidth over the sample time."""
    figure = Figure(figsize=(12.0, 4.0), layout="constrained")
    ax, *axes = figure.subplots(1, 3)
    for (name, found), shade, dash in zip(result["over_ratio"].items(), SHADES, DASHES, strict=False):
        text = f"{found['frequency']:.0f} rad/s, {found['damping']:.3f} without"
        ax.semilogx(result["ratio"], found["as_drawn"], dash, color=shade, label=text)
        ax.semilogx(result["ratio"], found["reversed"], dash, color=MIDDLE_GREY, lw=0.7)
        if name in ACTUATORS:
            ax.axvline(found["own_ratio"], color=ACCENT, lw=0.8)
            ax.annotate(ACTUATORS[name][0], (found["own_ratio"], 0.36), fontsize=7, rotation=90, ha="right")
    ax.plot([], [], color=MIDDLE_GREY, lw=0.7, label="sign reversed")
    label(ax, "With the best pressure feedback", "pump control over hydraulic frequency", "least damping (1)")
    ax.set_ylim(0.0, 1.0)
    for ax, (name, (title, _)) in zip(axes, ACTUATORS.items(), strict=True):
        rows = result["actuators"][name]["rows"]
        for delay, dash in zip(DELAYS, DASHES, strict=False):
            timed = [row for row in rows if row["delay"] == delay]
            times = [1e3 * row["sample_time"] for row in timed]
            for way, shade in WAYS.items():
                values = [row[way]["bandwidth"] if row[way] else math.nan for row in timed]
                told = f"{way.replace('_', ' ')}, delay {1e3 * delay:g} ms"
                ax.plot(times, values, dash, color=shade, marker="o", ms=3, label=told)
        label(ax, f"{title.capitalize()}, 6 dB and 45 deg", "sample time (ms)", "bandwidth (Hz)", legend=False)
        ax.set_ylim(bottom=0.0)
    legend_beside(figure, ax)
    return figure


def _actuator(loop: Loop) -> dict[str, Any]:
    frequency, damping = hydraulic_pair(loop)
    return {"frequency": frequency, "damping": damping, "rows": [_row(loop, *timing) for timing in TIMINGS]}


def _row(loop: Loop, sample_time: float, delay: float) -> dict[str, Any]:
    """What a timing allows; without dampings and compensator where it samples too slowly for the hydraulic poles."""
    system, both = behind_unit(loop, sample_time, delay), moving_and_held(loop, sample_time, delay)
    is_seen = hydraulic_pair(loop)[0] * sample_time < math.pi
    gains, corners = settings(loop)
    without = most_bandwidth(loop, system, gains[:1], corners[:1])
    return {
        "sample_time": sample_time,
        "delay": delay,
        "lag": lag(loop, sample_time, delay),
        "without": {name: without[name] for name in ("bandwidth", "loop_gain")},
        **{name: most_damping(both, *settings(loop, sign)) if is_seen else None for name, sign in SIGNS.items()},
        "pressure_feedback": most_bandwidth(loop, system, gains[::2], corners),
        "compensator": compensated(loop, system) if is_seen else None,
    }


def _all_corners(loop: Loop, sample_time: float, delay: float) -> dict[str, Any]:
    """The pressure feedback that does most for the least damped corner of Table 2's plant."""
    loops = [loop.at(point) for point in grid(PLANT)]
    systems = [system for each in loops for system in moving_and_held(each, sample_time, delay)]
    found = {name: most_damping(systems, *settings(loop, sign)) for name, sign in SIGNS.items()}
    without = min(hydraulic_pair(each)[1] for each in loops)
    return {"sample_time": sample_time, "delay": delay, "without": {"damping": without}} | found


def _over_ratio(loop: Loop) -> dict[str, Any]:
    paced = [at_ratio(loop, ratio) for ratio in RATIOS.tolist()]
    frequency, damping = hydraulic_pair(loop)
    return {
        "frequency": frequency,
        "damping": damping,
        "own_ratio": pace(loop) / frequency,
        "lag": [lag(each) for each in paced],
        **{
            name: [most_damping(moving_and_held(each), *settings(loop, sign))["damping"] for each in paced]
            for name, sign in SIGNS.items()
        },
    }


def _damping_told(row: dict[str, Any], found: dict[str, float]) -> str:
    gain = f" at {1e5 * found['gain']:.2g} 1/bar" if found["gain"] else " (none)"
    return f"{found['damping']:.3f}{gain} {_timing(row)}"


def _timing(row: dict[str, Any]) -> str:
    if row["sample_time"] == 0.0:
        return "continuous"
    return f"{1e3 * row['sample_time']:g} ms" + (f" and {1e3 * row['delay']:g} ms late" if row["delay"] else "")


def _dampings(system: control.StateSpace, gains: np.ndarray, corner: float) -> np.ndarray:
    """Least damping of `system` with pressure feedback of each of `gains`, whose closed loop is linear in the gain."""
    high_pass, n = control.ss(pressure_feedback(1.0, corner, system.dt)), system.nstates
    A, slope = np.zeros((n + 1, n + 1)), np.zeros((n + 1, n + 1))
    A[:n, :n], A[n:, :n], A[n:, n:] = system.A, high_pass.B @ system.C[1:], high_pass.A
    slope[:n] = -system.B @ np.hstack([high_pass.D @ system.C[1:], high_pass.C])
    return least_damping(np.linalg.eigvals(A + gains[:, None, None] * slope), system.dt)


def _keeps_margins(loops: np.ndarray) -> np.ndarray:
    """Whether each row of open-loop responses (n, m) stays off -1 by the wanted margins, and off all beyond it."""
    size, turn = np.abs(loops), np.angle(-loops)
    crosses = (turn[:, :-1] * turn[:, 1:] <= 0.0) & (np.abs(turn[:, :-1]) < 0.5 * math.pi)
    too_much = crosses & (np.maximum(size[:, :-1], size[:, 1:]) > 10.0 ** (-WANTED["gain_margin"] / 20.0))
    too_late = (np.abs(turn) < math.radians(WANTED["phase_margin"])) & (size > 1.0)
    return ~(too_much.any(axis=1) | too_late.any(axis=1))


def _bandwidth(omega: np.ndarray, K: float, angle: np.ndarray, inner: np.ndarray | float, at_rest: float) -> float:
    """Bandwidth (Hz) of angle over command at K_p `K` (1/rad), 0 where there is none."""
    if K == 0.0:
        return 0.0
    return bandwidth(omega, K * angle / (1.0 + K * angle + inner), 1.0 / (1.0 + 1.0 / (K * at_rest))) or 0.0


def _at_rest(system: control.StateSpace) -> float:
    """Angle over stroke command at rest (rad), infinite where no spring holds the shaft."""
    return float(control.dcgain(system["angle", "stroke_command"]))


def _filtered(corners: np.ndarray, sample_time: float) -> list[float]:
    """Those of `corners` that a digital filter can have."""
    return [corner for corner in corners.tolist() if corner * sample_time < math.pi]


def _digital(system: control.TransferFunction, frequency: float, sample_time: float) -> control.TransferFunction:
    if sample_time == 0.0:
        return system
    return control.sample_system(system, sample_time, "bilinear", prewarp_frequency=frequency)


def _frequencies(loop: Loop, sample_time: float) -> np.ndarray:
    frequency, _ = hydraulic_pair(loop)
    fastest = math.pi / sample_time * (1.0 - 1e-6) if sample_time else math.inf
    return np.geomspace(SLOWEST * frequency, min(FASTEST * frequency, fastest), POINTS)


def _response(system: control.StateSpace | control.TransferFunction, omega: np.ndarray) -> np.ndarray:
    return system(np.exp(1j * omega * system.dt) if system.dt else 1j * omega, squeeze=False)
