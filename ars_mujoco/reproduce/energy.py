"""Claims about power and energy on the S-curve (section 6, Figs. 15 to 18)."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DARK, DASHES, LIGHT, MIDDLE_GREY, label
from ars_mujoco.recording.recording import Recording
from ars_mujoco.reproduce.claim import (
    Finding,
    Group,
    Kind,
    Number,
    Verdict,
    does_not_follow,
    holds,
    holds_only,
)
from ars_mujoco.reproduce.evidence import FULL, PAPERS_LOOP, S_CURVE, Evidence
from ars_mujoco.reproduce.valve_systems import SYSTEMS, idle_power, shaft_energy

REVERSAL = (14.0, 18.0)  # s, "second 14 to second 18"
HOLDING = (20.0, 24.0)  # s, the steady bend
READJUSTED = 14.0  # s, until which the command changes again and again
AT_REST = (0.1, 0.4)  # s, before the first bend
NOTHING = 0.01  # of the peak
STRONG = 0.7  # correlation
WORTH = 0.05  # of the shaft's work; less than this recovered is hardly any

GROUP = Group("Power and energy on the S-curve (section 6, Figs. 15 to 18)")


@GROUP.claim("Fig. 15", "The drive cycle: readjusted several times for 14 s, reversed within 2 s, then steady.")
def drive_cycle(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    command = np.degrees(run["front.bar.command"])
    slopes = np.sign(np.round(np.diff(command[run.time <= READJUSTED]), 9))
    moving = slopes[slopes != 0.0]
    steady = np.ptp(command[_within(run, HOLDING)])
    return Finding(
        ours=(
            Number("changes of direction in the first 14 s", int((np.diff(moving) != 0.0).sum())),
            Number("command", (float(command.min()), float(command.max())), "deg"),
            Number("change of the command from 20 to 24 s", float(steady), "deg"),
        ),
        verdict=Verdict(Kind.NOT_CHECKABLE, "(the figure is lost)"),
        why="The profile that is run keeps the text's description; all energies below are those of this profile.",
        figure=partial(draw, run),
    )


@GROUP.claim("Fig. 16", "The motor gives output power only while the commanded angle changes.")
def motor_power(evidence: Evidence) -> Finding:
    power = evidence.s_curve["front.motor.output_power"]
    held, peak = np.abs(power[_within(evidence.s_curve, HOLDING)]).max(), np.abs(power).max()
    return Finding(
        ours=(Number("greatest power", float(peak), "W"), Number("greatest while holding -8 deg", float(held), "W")),
        verdict=holds(held < NOTHING * peak, does_not_follow("the running circuit")),
        why="Power is the bar's torque times the motor's rate, and a held bar does not move.",
    )


@GROUP.claim("Fig. 16", "The greatest power depends on the size of the change of the commanded angle.")
def power_and_change(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    changes, products, peaks = np.transpose(_segments(evidence, run))
    by_change, by_product = (float(np.corrcoef(each, peaks)[0, 1]) for each in (changes, products))
    return Finding(
        ours=(
            Number("correlation of the peaks with the change", by_change),
            Number("with c phi_c times the command's rate", by_product),
        ),
        verdict=holds(
            by_change > STRONG and by_change > by_product - 0.05, holds_only("for changes from about the same angle")
        ),
        why="Each of the profile's ramps is a sample. Power is c phi times the rate, so angle and time count as much "
        "as the size of the change.",
    )


@GROUP.claim("Fig. 16, section 6", "From 14 to 18 s the motor's power is negative: the bar drives the motor.")
def bar_drives_motor(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    rows = _within(run, REVERSAL)
    power, time = run["front.motor.output_power"][rows], run.time[rows]
    given, taken = (float(np.trapezoid(np.maximum(sign * power, 0.0), time)) for sign in (-1.0, 1.0))
    share = given / (given + taken) if given + taken > 0.0 else 0.0
    verdict = holds(share > 0.95, holds_only("while the bar unwinds"))
    return Finding(
        ours=(
            Number("the bar gives the motor", given, "J"),
            Number("the motor gives the bar", taken, "J"),
            Number("least power", float(power.min()), "W"),
        ),
        verdict=verdict if given > 0.0 else does_not_follow("the running circuit"),
        why="The bar gives its energy back up to the middle position; from there to the other side it is wound up "
        "again, so the same reversal has both signs.",
    )


@GROUP.claim("Fig. 17", "The pump takes power where the command changes, and also to hold a position.")
def holding_power(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    power = run["front.pump.shaft_power"]
    held, idle = (float(power[_within(run, window)].mean()) for window in (HOLDING, AT_REST))
    return Finding(
        ours=(
            Number("greatest power", float(power.max()), "W"),
            Number("while holding -8 deg", held, "W"),
            Number("at rest, no angle", idle, "W"),
        ),
        verdict=holds(held > idle > 0.0, does_not_follow("the loss model")),
        why="Holding costs what leaks, and the pump's torque loss; the drag is there without any load.",
    )


@GROUP.claim("Fig. 17", "The pump takes more than the motor gives.")
def shaft_and_motor(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    shaft, motor = (float(run[f"front.energy.{name}"][-1]) for name in ("shaft", "motor"))
    return Finding(
        ours=(
            Number("work of the shaft", shaft, "J"),
            Number("work of the motor on the bar", motor, "J"),
            Number("charge and control supply beside it", float(run["front.energy.charge"][-1]), "J"),
        ),
        verdict=holds(shaft > motor, does_not_follow("the energy balance")),
        why="On a bench the bar's ends stand still: what the motor gives stays in the bar as "
        f"{float(run['front.energy.bar'][-1]):.0f} J, and the rest is lost.",
    )


@GROUP.claim("abstract, sections 2, 6 and 7", "The pump runs as a motor and recovers energy at the combustion engine.")
def recovery(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    recovered, shaft = (float(run[f"front.energy.{name}"][-1]) for name in ("recovered", "shaft"))
    returned = float(np.trapezoid(np.maximum(-run["front.motor.output_power"], 0.0), run.time))
    if recovered == 0.0:
        verdict = does_not_follow("the pump's losses")
    else:
        share = 100 * recovered / shaft
        verdict = holds(recovered > WORTH * shaft, holds_only(f"for {share:.2g} % of the shaft's work"))
    return Finding(
        ours=(
            Number("recovered at the shaft", recovered, "J"),
            Number("share of the shaft's work", 100 * recovered / shaft, "%"),
            Number("share of what the bar gives back to the motor", 100 * recovered / returned, "%"),
            Number("least shaft power", float(run["front.pump.shaft_power"].min()), "W"),
        ),
        verdict=verdict,
        why="There is recovery, but the bar's power while it unwinds barely passes the pump's own losses "
        f"({float(run['front.pump.loss_power'].min()):.0f} W and more): of {returned:.0f} J at the motor nearly all "
        "is lost on the way.",
    )


@GROUP.claim("Fig. 18", "The pump's losses depend strongly on the flow rate.")
def loss_and_flow(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    loss = run["front.pump.loss_power"] + run["front.pump.leakage_power"]
    flow, pressure = (
        float(np.corrcoef(loss, np.abs(run[f"front.{name}"]))[0, 1]) for name in ("pump.flow", "motor.pressure")
    )
    return Finding(
        ours=(Number("correlation of the losses with the flow", flow), Number("with the pressure", pressure)),
        verdict=holds(flow > STRONG, does_not_follow("eqs. 21 and 22 with the stated coefficients")),
        why="The paper equates the flow with the motor's angular position. That is the pressure: the flow goes with "
        "the rate. On the S-curve the losses follow the pressure.",
    )


@GROUP.claim("section 2", "There are no throttling losses within the main power lines.")
def throttling(evidence: Evidence) -> Finding:
    run = evidence.run(S_CURVE, *PAPERS_LOOP, actuator=FULL)
    shaft, *lost = (float(run[f"front.energy.{name}"][-1]) for name in ("shaft", "line", "check", "relief"))
    return Finding(
        ours=(
            Number("lost in lines, check and relief valves", sum(lost), "J"),
            Number("share of the shaft's work", 100 * sum(lost) / shaft, "%"),
        ),
        verdict=holds(sum(lost) < NOTHING * shaft, does_not_follow("the full circuit")),
        why="The S-curve with the full circuit: lines of 10 mm with their friction, fail-safe valve, check and relief "
        "valves.",
    )


@GROUP.claim("section 7", "The power is minimized, covering only load-dependent losses.")
def load_dependent(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    idle = float(run["front.pump.shaft_power"][_within(run, AT_REST)].mean())
    share = idle * float(run.time[-1]) / float(run["front.energy.shaft"][-1])
    names = ("pump_torque_loss", "pump_leakage", "motor_leakage", "friction")
    return Finding(
        ours=(
            Number("shaft's power without load", idle, "W"),
            Number("its share of the shaft's work", 100 * share, "%"),
            *(
                Number(f"lost to {name.replace('_', ' ')}", float(run[f"front.energy.{name}"][-1]), "J")
                for name in names
            ),
        ),
        verdict=holds(share < WORTH, does_not_follow("eq. 22 with a term of the speed alone")),
        why=f"A pump that turns drags and churns without any load too: {idle:.0f} W with the stated coefficients.",
    )


@GROUP.claim("sections 2 and 7", "Without throttling the actuator takes less energy than a valve-controlled one.")
def against_valves(evidence: Evidence) -> Finding:
    run = evidence.s_curve
    shaft, charge = (float(run[f"front.energy.{name}"][-1]) for name in ("shaft", "charge"))
    others = {name: shaft_energy(evidence, run, name) for name in SYSTEMS}
    beaten = [name for name, energy in others.items() if shaft + charge < energy]
    idle = float(run["front.pump.shaft_power"][_within(run, AT_REST)].mean())
    at_rest = ", ".join(f"{name} {idle_power(evidence, name):.0f} W" for name in SYSTEMS)
    return Finding(
        ours=tuple(
            Number(f"energy over that of {name}{told}", (shaft + added) / energy)
            for told, added in (("", 0.0), (", with the charge supply", charge))
            for name, energy in others.items()
        ),
        verdict=holds(
            len(beaten) == len(others),
            holds_only(f"against {' and '.join(beaten)}") if beaten else does_not_follow("the stated valve systems"),
        ),
        why="Shaft work over the S-curve, each system with the same motor, leakage and pump losses, 15 bar over its "
        "valves and no charge supply: an open centre passes all of a fixed pump's flow at the load's pressure (Fig. "
        "2); constant pressure (180 bar) and load sensing take only the flow they need. Straight ahead this pump takes "
        f"{idle:.0f} W and its charge and control supply {charge / float(run.time[-1]):.0f} W; {at_rest}. "
        "Throttling is saved; drag and charge are not.",
        figure=partial(draw_energies, others, shaft, charge),
    )


def draw(run: Recording) -> Figure:
    """The S-curve's angle, motor power, shaft power and pump losses, as Figs. 15 to 18 had them."""
    figure = Figure(figsize=(8.0, 8.4), layout="constrained")
    axes = figure.subplots(4, 1, sharex=True)
    thin = slice(None, None, 10)
    time = run.time[thin]
    signals = (
        ("Fig. 15: bar angle", "deg", [("command", run["front.bar.command"]), ("angle", run["front.bar.angle"])]),
        ("Fig. 16: motor output power", "W", [("", run["front.motor.output_power"])]),
        ("Fig. 17: pump power at the engine", "W", [("", run["front.pump.shaft_power"])]),
        (
            "Fig. 18: pump losses", "W",
            [("torque", run["front.pump.loss_power"]), ("leakage", run["front.pump.leakage_power"])],
        ),
    )  # fmt: skip
    for ax, (title, unit, lines) in zip(axes, signals, strict=True):
        for (name, values), dash, color in zip(lines, DASHES, (DARK, ACCENT), strict=False):
            drawn = np.degrees(values) if unit == "deg" else values
            ax.plot(time, drawn[thin], dash, color=color, lw=1.1, label=name)
        ax.axhline(0.0, color=MIDDLE_GREY, lw=0.6)
        ax.axvspan(*REVERSAL, color=LIGHT, alpha=0.25, lw=0)
        label(ax, title, "time (s)" if ax is axes[-1] else "", unit, legend=len(lines) > 1)
    return figure


def draw_energies(others: dict[str, float], shaft: float, charge: float) -> Figure:
    """Bars of the shaft's work with each system, the charge supply's on top of the actuator's own."""
    figure = Figure(figsize=(8.0, 2.6), layout="constrained")
    ax = figure.subplots()
    names = ["pump controlled", *others]
    bars = ax.barh(names, np.array([shaft, *others.values()]) / 1e3, color=[DARK, *[LIGHT] * len(others)], height=0.6)
    ax.barh(names[:1], charge / 1e3, left=shaft / 1e3, color=MIDDLE_GREY, height=0.6, label="charge and control supply")
    ax.bar_label(bars, labels=["", *(f"{energy / 1e3:.1f} kJ" for energy in others.values())], fontsize=8, padding=3)
    ax.annotate(f"{shaft / 1e3:.1f} + {charge / 1e3:.1f} kJ", ((shaft + charge) / 1e3, 0), xytext=(4, 0),
                textcoords="offset points", fontsize=8, va="center")  # fmt: skip
    ax.invert_yaxis()
    label(ax, "Work of the shaft over the S-curve", "work (kJ)", "")
    return figure


def _within(run: Recording, window: tuple[float, float]) -> np.ndarray:
    return (run.time >= window[0]) & (run.time <= window[1])


def _segments(evidence: Evidence, run: Recording) -> list[tuple[float, float, float]]:
    """(change of the command deg, greatest c phi_c phi_c' W, greatest power W) of each ramp of the drive cycle."""
    command, power = run["front.bar.command"], np.abs(run["front.motor.output_power"])
    product = np.abs(evidence.c * command * np.gradient(command, run.time))
    turns = np.flatnonzero(np.diff(np.sign(np.round(np.gradient(command, run.time), 6)))) + 1
    found = []
    for first, last in zip(turns, turns[1:], strict=False):
        change = abs(command[last] - command[first])
        if change > 1e-3:
            rows = slice(first, last)
            found.append((np.degrees(change), product[rows].max(), power[rows].max()))
    return found
