"""Claims about the linear plant: its state space and its poles over the uncertain parameters (Tables 2 and 3)."""

from functools import partial

import numpy as np

from ars_mujoco.analysis import hydraulic_poles
from ars_mujoco.analysis.hydraulic_poles import PAPER, pole_pair
from ars_mujoco.analysis.linearization import hydraulic_matrix, open_loop, plant
from ars_mujoco.analysis.loop import RPM
from ars_mujoco.analysis.margins import margins
from ars_mujoco.analysis.parameter_box import PLANT, TABLE_2, grid
from ars_mujoco.reproduce.claim import (
    CONTRADICTS_ITSELF,
    Finding,
    Group,
    Number,
    agreement,
    apart,
    does_not_follow,
    holds,
)
from ars_mujoco.reproduce.evidence import Evidence

EQUAL = 1e-6  # relative; central differences of a linear function
SUB_BOX = {"capacitance": (4e-14, 6e-14), "viscous_friction": (13.1, 26.5)}  # of Table 2, nearest to Table 3

GROUP = Group("Linear plant (section 4.2.2, Tables 2 and 3)")


@GROUP.claim("eqs. 43 and 44", "The plant's state space, in pressure and rate, has these matrices A and B.")
def state_space(evidence: Evidence) -> Finding:
    D, C, theta = evidence.D, evidence.C, evidence.theta
    A = np.array([[-evidence.k / C, -D / C], [D / theta, -evidence.r_v / theta]])
    found = hydraulic_matrix(evidence.loop)
    by_flow = plant(evidence.loop).B[0, 0]
    difference = max(apart(A, found), apart(1.0 / C, by_flow))
    return Finding(
        ours=(Number("greatest relative difference of A and B", difference),),
        verdict=holds(difference < EQUAL, does_not_follow("the running equations")),
        why="Central differences of the running circuit without dry friction; B for the pump's flow, V_p n x/x_max.",
    )


@GROUP.claim("Table 3", "The hydraulic poles' natural frequency ranges from 686 to 1320 rad/s.")
def frequency_range(evidence: Evidence) -> Finding:
    return _range(evidence, "frequency", "rad/s", partial(hydraulic_poles.draw, evidence.hydraulic_poles))


@GROUP.claim("Table 3", "The hydraulic poles' damping ranges from 0.037 to 0.139.")
def damping_range(evidence: Evidence) -> Finding:
    return _range(evidence, "damping", "1")


@GROUP.claim(
    "section 5", "Engine speed and motor torque losses have the greatest influence on the plant dynamics (Table 3)."
)
def engine_speed(evidence: Evidence) -> Finding:
    ends = {name: [pole_pair(evidence.loop.at({name: value})) for value in values] for name, values in TABLE_2.items()}
    moved = {name: [b / a - 1.0 for a, b in zip(*pairs, strict=True)] for name, pairs in ends.items()}
    slow, *_, fast = evidence.stable_region["over_each"]["speed"]
    told = "; ".join(f"{name.replace('_', ' ')} {100 * w:+.0f} and {100 * d:+.0f} %" for name, (w, d) in moved.items())
    return Finding(
        ours=(
            Number("frequency from 1500 to 6000 rpm", 100 * moved["speed"][0], "%"),
            Number("damping from 1500 to 6000 rpm", 100 * moved["speed"][1], "%"),
            Number("damping from least to greatest r_v", 100 * moved["viscous_friction"][1], "%"),
            Number("gain at which the closed loop oscillates, 6000 to 1500 rpm", (fast, slow), "1/rad"),
        ),
        verdict=holds(abs(moved["speed"][0]) > EQUAL, does_not_follow("eq. 43, whose poles the speed cannot move")),
        why="The speed is only in the matrix B: it scales the loop's gain, and so the closed loop, but not the open "
        "loop's poles, of which Table 3 is. What "
        f"each parameter does to frequency and damping, from least to greatest: {told}.",
    )


@GROUP.claim("section 5", "Increasing the engine speed increases the response time of the uncontrolled plant.")
def response_time(evidence: Evidence) -> Finding:
    slow, fast = (evidence.loop.at({"speed": speed}) for speed in TABLE_2["speed"])
    bandwidths = tuple(margins(open_loop(each))["bandwidth"] for each in (slow, fast))
    flows = tuple(np.degrees(evidence.full_flow / evidence.speed / evidence.D * n) for n in TABLE_2["speed"])
    return Finding(
        ours=(
            Number("motor rate at full stroke, 1500 and 6000 rpm", tuple(map(float, flows)), "deg/s"),
            *(
                Number(f"closed loop's bandwidth, {speed / RPM:.0f} rpm", each, "Hz")
                for speed, each in zip(TABLE_2["speed"], bandwidths, strict=True)
            ),
        ),
        verdict=holds(flows[1] < flows[0], CONTRADICTS_ITSELF),
        why=f"More speed is more flow a stroke: the same step takes {flows[0] / flows[1]:.2f} of the time at "
        f"{TABLE_2['speed'][1] / RPM:.0f} rpm. The speed of response increases, not its time.",
    )


def _range(evidence: Evidence, name: str, unit: str, figure=None) -> Finding:
    result, paper = evidence.hydraulic_poles, tuple(PAPER[name])
    full, single = (tuple(map(float, result[way][name])) for way in ("full_box", "one_at_a_time"))
    column = list(PAPER).index(name)
    near = [pole_pair(evidence.loop.at(point))[column] for point in _sub_box()]
    part = float(min(near)), float(max(near))
    return Finding(
        paper=(Number(name, paper, unit),),
        ours=(
            Number("full box", full, unit),
            Number("one parameter at a time", single, unit),
            Number("C_H <= 6e-14 and r_v >= 13.1", part, unit),
        ),
        verdict=agreement(paper, full, does_not_follow("Table 2")),
        why=f"The full box misses Table 3 by {100 * apart(paper, full):.0f} %, one parameter at a time by "
        f"{100 * apart(paper, single):.0f} %; a part of the box, found by trial, comes within "
        f"{100 * apart(paper, part):.1f} %.",
        figure=figure,
    )


def _sub_box():
    return (
        {name: min(max(value, SUB_BOX[name][0]), SUB_BOX[name][1]) if name in SUB_BOX else value
         for name, value in point.items()}
        for point in grid(PLANT)
    )  # fmt: skip
