"""Claims about the roll of the vehicle (sections 1, 5 and 7), on the roll plane of Fig. 1 and on the bench."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DARK, DASHES, MIDDLE_GREY, label
from ars_mujoco.analysis.loop import RPM, loop_of
from ars_mujoco.analysis.margins import margins, sampled_loop
from ars_mujoco.analysis.parameter_box import TABLE_2
from ars_mujoco.metrics.metric import G
from ars_mujoco.reproduce.claim import (
    Finding,
    Group,
    Number,
    agreement,
    does_not_follow,
    holds,
    holds_only,
)
from ars_mujoco.reproduce.evidence import S_CURVE, SMALL_STEP, Evidence
from ars_mujoco.reproduce.sizing import MAX_TORQUE
from ars_mujoco.studies.inputs import read_inputs

CYCLE, CONTROLLER = "roll_plane_step", "level"  # the cycle, and the controller that it names
BANDWIDTH, FACTOR = 12.0, 4.0  # Hz, 1: section 5
SEVERE, MODEST = 8.0, 2.0  # m/s^2, within 80 ms
GAINS = (2.0, 4.0, 7.0, 12.0, 20.0, 32.0, 45.0, 60.0, 90.0)  # 1/rad
CONTINUOUS = ("controller.unit.sample_time=0 s", "controller.unit.delay=0 s",
              "controller.reference.accelerometer.cutoff=100 Hz")  # fmt: skip
HARD = 0.8  # g, of a mid-size car in hard cornering
TRAVEL = 0.03  # m, of one wheel's bump at the bar's end

GROUP = Group("Roll of the vehicle (sections 1, 5 and 7)")


@GROUP.claim(
    "section 5 (after Darling et al. 1992)", "A bandwidth of 12 Hz is necessary for a factor of 4 in severe steps."
)
def roll_and_bandwidth(evidence: Evidence) -> Finding:
    swept = {size: _swept(evidence, size) for size in (SEVERE, MODEST)}
    bandwidths, factors = swept[SEVERE]
    needed = min(bandwidths[factors >= FACTOR].tolist(), default=None)
    locked = _peak(evidence, SEVERE, "passive") / _peak(evidence, SEVERE, "locked")
    return Finding(
        paper=(Number("bandwidth for a factor of 4", BANDWIDTH, "Hz"),),
        ours=(
            Number("least of the swept bandwidths with a factor of 4", needed, "Hz"),
            Number("factor at 12 Hz", float(np.interp(BANDWIDTH, bandwidths, factors))),
            Number("factor of the bar with its motor locked", locked),
        ),
        verdict=agreement(BANDWIDTH, needed, does_not_follow("the roll plane")) if needed
        else does_not_follow("the pump's flow"),
        why="A lateral force that rises to 8 m/s^2 times the mass within 80 ms, against passive bars; the gain is "
        "swept, the control unit continuous. The bar's own stiffness does much of it, and the body rolls slowly, at "
        "about 1.4 Hz: a bandwidth of 12 Hz is enough for a factor of 4 here, but not necessary.",
        figure=partial(draw, swept, locked),
    )  # fmt: skip


@GROUP.claim("abstract, sections 2 and 7", "The pump's dynamics are sufficient for this application.")
def pump_dynamics(evidence: Evidence) -> Finding:
    factors = {}
    for speed in TABLE_2["speed"]:
        pump = tuple(f"actuator.{axle}.pump.speed={speed} rad/s" for axle in ("front", "rear"))
        factors[speed] = _factor(evidence, SEVERE, *pump)
    own, fast = _factor(evidence, SEVERE), _factor(evidence, SEVERE, *_faster(evidence, 10.0))
    slow = factors[TABLE_2["speed"][0]]
    return Finding(
        paper=(Number("factor wanted", FACTOR),),
        ours=(
            Number("factor in the severe step", own),
            Number("with servo valve and swash plate ten times as fast", fast),
            *(Number(f"factor at {speed / RPM:.0f} rpm", factor) for speed, factor in factors.items()),
        ),
        verdict=holds(
            min(own, slow) >= FACTOR,
            holds_only("at nominal speed") if own >= FACTOR else does_not_follow("this pump on the roll plane"),
        ),
        why=f"The shipped controller with its 10 ms of delay. A pump control ten times as fast changes the factor by "
        f"{100 * (fast / own - 1):+.0f} %: what limits a large step is the pump's flow, not its dynamics.",
    )


@GROUP.claim("section 4.2.3", "A mid-size vehicle requires at most 1400 Nm of its front bar.")
def torque_required(evidence: Evidence) -> Finding:
    evidence.run(CYCLE)
    car = evidence.inputs_of(CYCLE).vehicle.value
    lever = car.front.link_distance / car.front.arm  # a bar's torque as roll moment
    limit = MAX_TORQUE * lever / (car.mass * (car.cg_height - car.roll_axis_height)) / G
    return Finding(
        paper=(Number("torque", MAX_TORQUE, "Nm"),),
        ours=(Number("lateral acceleration that it holds level, front bar alone", limit, "g"),),
        verdict=holds(limit > HARD, does_not_follow("the roll plane's car")),
        why=f"Moment of the body about its roll axis ({car.mass:.0f} kg, "
        f"{car.cg_height - car.roll_axis_height:.3f} m above it) against the bar's at its links. Tires that roll the "
        "axles, which this car does not have, take the bar's angle sooner than its torque.",
    )


@GROUP.claim("section 1", "The bar can be decoupled, so that one wheel's motion is not copied to the other.")
def copying(evidence: Evidence) -> Finding:
    ends = f"manoeuvre.ends={{join: smooth, knots: [[0 s, 0 m], [0.1 s, {TRAVEL} m]]}}"
    run = evidence.run(SMALL_STEP, "manoeuvre.command.knots=[[0 s, 0 deg]]", ends)
    torque = float(np.abs(run["front.bar.torque"]).max())
    held = float(evidence.c * np.abs(run["front.bar.twist"]).max())
    return Finding(
        ours=(
            Number("bar torque with one end raised by 30 mm, commanded angle 0", torque, "Nm"),
            Number("with the motor locked", held, "Nm"),
        ),
        verdict=holds(torque < 0.1 * held, does_not_follow("the position control of section 5")),
        why="Position control at the middle holds the bar's halves together: it couples the wheels as a solid bar of "
        "the same stiffness would. Decoupling takes control of the torque, or a bypass across the motor.",
    )


def draw(swept: dict[float, tuple[np.ndarray, np.ndarray]], locked: float) -> Figure:
    """Roll reduction factor over the loop's bandwidth, a line for each size of step."""
    figure = Figure(figsize=(8.0, 3.6), layout="constrained")
    ax = figure.subplots()
    for (size, (bandwidths, factors)), dash in zip(swept.items(), DASHES, strict=False):
        ax.semilogx(bandwidths, factors, dash, color=DARK, marker="o", ms=3, label=f"step to {size:g} m/s^2")
    ax.axhline(locked, color=MIDDLE_GREY, lw=0.9, ls=DASHES[2], label="motor locked, 8 m/s^2")
    ax.plot(BANDWIDTH, FACTOR, "s", color=ACCENT, label="the paper's 12 Hz for a factor of 4")
    ax.set_ylim(bottom=0.0)
    label(ax, "Roll plane: what bandwidth does", "bandwidth of the bar-angle loop (Hz)", "roll reduction factor (1)")
    return figure


def _swept(evidence: Evidence, size: float) -> tuple[np.ndarray, np.ndarray]:
    """Bandwidths (n,) Hz of the linear loop and roll reduction factors (n,) over GAINS."""
    found = []
    for gain in GAINS:
        settings = (f"actuator.control.loop.gain={gain} 1/rad", *CONTINUOUS)
        loop = loop_of(read_inputs(S_CURVE, "pump_controlled", CONTROLLER, settings=[*evidence.settings, *settings]))
        loop_margins = margins(sampled_loop(loop, loop.unit.sample_time, loop.unit.delay))
        found.append((loop_margins["bandwidth"], _factor(evidence, size, *settings)))
    return tuple(np.transpose(found))


def _factor(evidence: Evidence, size: float, *settings: str) -> float:
    return _peak(evidence, size, "passive") / _peak(evidence, size, None, *settings)


def _peak(evidence: Evidence, size: float, actuator: str | None, *settings: str) -> float:
    """Peak roll (rad) of a lateral force step of `size` (m/s^2)."""
    step = f"manoeuvre.acceleration.knots=[[0.5 s, 0 m/s^2], [0.58 s, {size} m/s^2]]"
    return float(np.abs(evidence.run(CYCLE, step, *settings, actuator=actuator)["body.roll"]).max())


def _faster(evidence: Evidence, factor: float) -> tuple[str, ...]:
    """Settings that make servo valve and swash plate of both axles faster by a factor."""
    circuit = evidence.loop.circuit
    values = {
        "servo_valve.frequency": f"{factor * circuit.servo_valve.frequency} rad/s",
        "servo_valve.max_rate": f"{factor * circuit.servo_valve.max_rate} 1/s",
        "swash_plate.max_rate": f"{factor * circuit.swash_plate.max_rate} 1/s",
        "swash_plate_loop.gain": f"{factor * circuit.swash_plate_loop.gain} 1/s",
    }
    return tuple(f"actuator.{axle}.{key}={value}" for axle in ("front", "rear") for key, value in values.items())
