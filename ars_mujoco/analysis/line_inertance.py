"""Line inertance: what the mass of the lines' oil does to the hydraulic poles and to the gain that is stable.

The paper expects the oil's acceleration forces to "remain negligible" (section 4.2.1). Both lines' oil moves with the
motor, as an inertia of up to I D^2 each; how much of it counts depends on where along the line the oil is compressed.
Without mass, the same oil has the same volume and the same laminar resistance.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DARK, DASHES, MIDDLE_GREY, label, legend_beside
from ars_mujoco.analysis.linearization import actuator, plant
from ars_mujoco.analysis.loop import BOTH_SHUT, LOW_SIDE_HELD, Loop
from ars_mujoco.analysis.margins import FASTEST, WANTED
from ars_mujoco.analysis.running_loop import step_response
from ars_mujoco.analysis.stable_region import boundary
from ars_mujoco.hydraulics.pipe import MOST_LUMPS, inertance

MASSLESS = 1e-3  # of the oil's density; the lines' own oscillations are then thirty times as fast
CHECKS = (BOTH_SHUT, LOW_SIDE_HELD)
LENGTHS = np.linspace(0.5, 8.0, 16)  # m
COMMAND = math.radians(0.05)  # small enough for no saturation
STEP, STEPS = 1e-3, 800  # s, and how many of them the step response has
UNITS = {"frequency": "rad/s", "damping": "1", "stable": "1/rad", "stable_frequency": "rad/s", "gain_margin": "1/rad",
         "phase_margin": "1/rad", "inertia": "kg m^2", "length": "m", "time": "s", "angle": "deg"}  # fmt: skip


def without_oil_mass(loop: Loop) -> Loop:
    """`loop` with oil that weighs nearly nothing and, in laminar flow, resists as before."""
    detail = loop.detail.copy()
    detail.fluid.density *= MASSLESS
    detail.fluid.viscosity /= MASSLESS
    return replace(loop, detail=detail)


def with_pipe(loop: Loop, **values: float) -> Loop:
    """`loop` with other values of its Pipe."""
    detail = loop.detail.copy()
    for name, value in values.items():
        detail.pipe[name] = value
    return replace(loop, detail=detail)


def reflected_inertia(loop: Loop) -> float:
    """Inertia (kg m^2) of both lines' oil if all of it moved with the motor: 2 I D^2."""
    return 2.0 * inertance(loop.detail.pipe, loop.detail.fluid) * loop.circuit.motor.displacement**2


def counted_inertia(loop: Loop) -> float:
    """Of that, the inertia (kg m^2) that counts: a motor with this much more has, without the oil's mass, the hydraulic
    frequency that the loop has with it.
    """
    without, with_mass = hydraulic_pair(without_oil_mass(loop))[0], hydraulic_pair(loop)[0]
    return float(loop.circuit.motor.inertia * ((without / with_mass) ** 2 - 1.0))


def hydraulic_pair(loop: Loop) -> tuple[float, float]:
    """(natural frequency rad/s, damping) of the plant's slowest oscillation, the bar's spring left out as in eq. 43."""
    poles = plant(replace(loop, stiffness=0.0)).poles()
    slowest = min(poles[poles.imag > 0.0], key=abs)
    return float(abs(slowest)), float(-slowest.real / abs(slowest))


def limits(loop: Loop) -> dict[str, float]:
    """The hydraulic pair, and the greatest K_p that is `stable` (with the frequency of its oscillation), keeps 6 dB of
    `gain_margin`, and 45 deg of `phase_margin` at every crossing.
    """
    system = actuator(loop)["angle", "stroke_command"]
    frequency, damping = hydraulic_pair(loop)
    stable, stable_frequency = boundary(system)[0]
    response = system(1j * np.geomspace(1.0, FASTEST, 6000))
    near = np.abs(np.angle(-response)) <= math.radians(WANTED["phase_margin"])
    return {
        "frequency": frequency,
        "damping": damping,
        "stable": stable,
        "stable_frequency": stable_frequency,
        "gain_margin": stable * 10.0 ** (-WANTED["gain_margin"] / 20.0),
        "phase_margin": float(1.0 / np.abs(response[near]).max()),
    }


def compute(loop: Loop) -> dict[str, Any]:
    """Limits for each course of the check valves: without the oil's mass, with it in 1 to 4 lumps, and over the length
    of the line; and steps of the running circuit with a gain between the limits.
    """
    own, over_length = {}, {}
    for checks in CHECKS:
        held = replace(loop, checks=checks)
        own[checks] = {
            "without": limits(without_oil_mass(held)),
            "with": [{"lumps": n} | limits(with_pipe(held, lumps=n)) for n in range(1, MOST_LUMPS + 1)],
        }
        lines = [with_pipe(held, length=length) for length in LENGTHS.tolist()]
        over_length[checks] = {
            "without": [limits(without_oil_mass(each)) for each in lines],
            "with": [limits(each) for each in lines],
        }
    between = math.sqrt(own[BOTH_SHUT]["without"]["stable"] * own[BOTH_SHUT]["with"][0]["stable"])
    return {
        "units": UNITS,
        "inertia": {
            "oil": reflected_inertia(loop),
            "counted": counted_inertia(loop),
            "motor": float(loop.circuit.motor.inertia),
        },
        "own_length": float(loop.detail.pipe.length),
        "own": own,
        "length": LENGTHS.tolist(),
        "over_length": over_length,
        "steps": {
            "gain": {"value": between, "unit": "1/rad"},
            "time": (STEP * np.arange(1, STEPS + 1)).tolist(),
            "without": _steps(without_oil_mass(loop), between),
            "with": _steps(loop, between),
        },
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: inertia, frequency and stable gain without and with the oil's mass."""
    inertia = result["inertia"]
    value = "{oil:.2f} kg m^2, of which {counted:.2f} count; motor {motor:.3g}".format(**inertia)
    rows = [{"quantity": "inertia of the lines' oil at the motor", "value": value, "paper": "negligible"}]
    for checks in CHECKS:
        without, with_mass = result["own"][checks]["without"], result["own"][checks]["with"][0]
        for name, text in (("frequency", "hydraulic frequency"), ("stable", "stable K_p")):
            told = f"{without[name]:.0f} without the oil's mass, {with_mass[name]:.0f} with it {UNITS[name]}"
            rows.append({"quantity": f"{text}, check valves {checks.replace('_', ' ')}", "value": told})
    return rows


def draw(result: dict[str, Any]) -> Figure:
    """Hydraulic frequency and stable gain over the length of the line, and the steps."""
    figure = Figure(figsize=(14.0, 4.2), layout="constrained")
    frequency, gain, steps = figure.subplots(1, 3)
    for checks, dash in zip(CHECKS, DASHES, strict=False):
        for way, colour in (("without", MIDDLE_GREY), ("with", DARK)):
            text = f"{way} the oil's mass, check valves {checks.replace('_', ' ')}"
            for ax, name in ((frequency, "frequency"), (gain, "stable")):
                values = [row[name] for row in result["over_length"][checks][way]]
                ax.plot(result["length"], values, dash, color=colour, lw=1.3, label=text)
    for ax in (frequency, gain):
        ax.axvline(result["own_length"], color=ACCENT, lw=0.9, ls=":", label="this line")
        ax.set_ylim(bottom=0.0)
    label(frequency, "Hydraulic frequency", "length of the line (m)", "frequency (rad/s)", legend=False)
    label(gain, "Stability boundary", "length of the line (m)", "K_p (1/rad)", legend=False)
    legend_beside(figure, frequency)
    run = result["steps"]
    steps.plot(run["time"], run["with"], color=DARK, lw=0.9, label="with the oil's mass")
    steps.plot(run["time"], run["without"], color=MIDDLE_GREY, lw=1.4, label="without")
    label(steps, f"Step without dry friction, K_p {run['gain']['value']:.0f}", "time (s)", "angle (deg)")
    return figure


def _steps(loop: Loop, gain: float) -> list[float]:
    return np.degrees(step_response(loop.without_dry_friction(), gain, COMMAND, STEP, STEPS)).tolist()
