"""Claims about what damps the hydraulic poles: pressure feedback and a second-order compensator (Figs. 12 and 13)."""

import math
from functools import partial
from typing import Any

import numpy as np

from ars_mujoco.analysis import compensators
from ars_mujoco.reproduce.claim import Finding, Group, Number, does_not_follow, holds, holds_only
from ars_mujoco.reproduce.evidence import Evidence

CONTINUOUS = (0.0, 0.0)  # s, sample time and delay
FUTILE = 0.1  # relative; a gain of less is none
IMPROVED = 2.0  # times the damping without

GROUP = Group("Compensation of the hydraulic poles (section 5, Figs. 12 and 13)")


@GROUP.claim("Fig. 12", "Dynamic pressure feedback to damp the hydraulic poles is futile for this actuator.")
def pressure_feedback(evidence: Evidence) -> Finding:
    actuator = evidence.compensators["actuators"]["this"]
    row, corners = _row(actuator["rows"], CONTINUOUS), _row(evidence.compensators["all_corners"], CONTINUOUS)
    damping, drawn, turned = actuator["damping"], row["as_drawn"]["damping"], row["reversed"]["damping"]
    without, fed_back = row["without"]["bandwidth"], row["pressure_feedback"]["bandwidth"]
    return Finding(
        ours=(
            Number("least damping without", damping),
            Number("most with it", drawn),
            Number("most with its sign turned round", turned),
            Number("bandwidth at 6 dB and 45 deg without", without, "Hz"),
            Number("with it", fed_back, "Hz"),
        ),
        verdict=holds(
            drawn < (1.0 + FUTILE) * damping and fed_back < (1.0 + FUTILE) * without,
            does_not_follow("the linear loop with a continuous unit"),
        ),
        why="The best of all gains and corner frequencies, damping counted by the lesser of a motor that moves and one "
        f"that dry friction holds. Through the pump control a stroke lags {row['lag']:.0f} deg at "
        f"{actuator['frequency']:.0f} rad/s, and a flow that comes this late does not damp. The sign turned round "
        "would suit that lag while the motor moves, but drives the pressure up where it is held: over Table 2's "
        f"corners the least damping goes from {corners['without']['damping']:.3f} to "
        f"{corners['reversed']['damping']:.3f}.",
        figure=partial(compensators.draw, evidence.compensators),
    )


@GROUP.claim("Fig. 13", "A second-order compensator is futile for this actuator.")
def second_order_compensator(evidence: Evidence) -> Finding:
    row = _row(evidence.compensators["actuators"]["this"]["rows"], CONTINUOUS)
    without, compensated = row["without"]["bandwidth"], row["compensator"]["bandwidth"]
    return Finding(
        ours=(
            Number("bandwidth at 6 dB and 45 deg without", without, "Hz"),
            Number("with it", compensated, "Hz"),
        ),
        verdict=holds(compensated < (1.0 + FUTILE) * without, does_not_follow("the linear loop")),
        why="The pump control, not the hydraulic poles, limits the gain; cancelling them in the command's way does not "
        "damp them against a load either.",
    )


@GROUP.claim("section 5", "A second-order compensator needs a sufficiently fast microprocessor.")
def sample_time(evidence: Evidence) -> Finding:
    actuator = evidence.compensators["actuators"]["this"]
    longest = math.pi / actuator["frequency"]
    rows = [row for row in actuator["rows"] if row["sample_time"] > 0.0 and row["delay"] == 0.0]
    possible = [row["sample_time"] for row in rows if row["compensator"]]
    return Finding(
        ours=(
            Number("longest sample time that sees the poles", 1e3 * longest, "ms"),
            Number("longest of those looked at that does", 1e3 * max(possible) if possible else None, "ms"),
        ),
        verdict=holds(len(possible) < len(rows), does_not_follow("the sampled loop")),
        why=f"Half the sampling frequency has to lie above {actuator['frequency'] / (2.0 * math.pi):.0f} Hz.",
    )


@GROUP.claim(
    "section 5 (after Grabbel 2003)", "Pressure feedback improves the damping of a slower actuator, a robot's."
)
def robot_joint(evidence: Evidence) -> Finding:
    actuator = evidence.compensators["actuators"]["robot"]
    row = _row(actuator["rows"], CONTINUOUS)
    return Finding(
        ours=(
            Number("hydraulic frequency", actuator["frequency"], "rad/s"),
            Number("least damping without", actuator["damping"]),
            Number("most with pressure feedback", row["as_drawn"]["damping"]),
            Number("bandwidth at 6 dB and 45 deg without", row["without"]["bandwidth"], "Hz"),
            Number("with pressure feedback", row["pressure_feedback"]["bandwidth"], "Hz"),
        ),
        verdict=holds(
            row["as_drawn"]["damping"] > IMPROVED * actuator["damping"], does_not_follow("the robot's joint as stated")
        ),
        why="The shipped joint (Fig. 3) has the same pump control and slower hydraulics of stated sizes: a stroke lags "
        f"only {row['lag']:.0f} deg.",
    )


@GROUP.claim("section 5", "Pressure feedback damps only where the servo pump is much faster than the hydraulic poles.")
def pump_over_hydraulics(evidence: Evidence) -> Finding:
    result = evidence.compensators
    found, ratios = result["over_ratio"]["this"], np.array(result["ratio"])
    drawn, turned = (np.array(found[sign]) > IMPROVED * found["damping"] for sign in ("as_drawn", "reversed"))
    needed = min(ratios[drawn].tolist(), default=None)
    faster = needed is not None and needed > 1.0
    return Finding(
        ours=(
            Number("servo pump over hydraulic poles, here", found["own_ratio"]),
            Number("least ratio at which it doubles the damping", needed),
            Number("most damping at any ratio", max(found["as_drawn"])),
        ),
        verdict=holds(
            faster and not turned[ratios < 1.0].any(),
            holds_only("with the sign as drawn") if faster else does_not_follow("the linear loop"),
        ),
        why="The whole pump control made faster or slower, the best gain and corner frequency for each. As drawn, the "
        "pump control has to be the faster one. With the sign turned round it can damp where the pump control is a "
        "little slower than the hydraulic poles and lags by 180 deg.",
    )


def _row(rows: list[dict[str, Any]], timing: tuple[float, float]) -> dict[str, Any]:
    return next(row for row in rows if (row["sample_time"], row["delay"]) == timing)
