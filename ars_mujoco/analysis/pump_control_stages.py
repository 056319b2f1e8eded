"""Pump control stages: the inner loop at each stage of simplification, and whether the servo valve dominates it.

The paper drops the control cylinder's own dynamics (eq. 16) because their frequency, 400 Hz to 12,600 Hz, is far above
the valve's (section 4.1.1). Dry friction is left out as in every linear model, but for one row: within a mm/s of
standstill it damps the piston some 400 times as much, and there the cylinder is seen.
"""

import math
from dataclasses import replace
from typing import Any

import control
import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.actuators.pump_controlled.pump_control import FULL, REDUCED, THIRD_ORDER
from ars_mujoco.analysis.figure import DARK, DASHES, SHADES, label
from ars_mujoco.analysis.linearization import pump_control
from ars_mujoco.analysis.loop import Loop
from ars_mujoco.analysis.margins import bandwidth
from ars_mujoco.analysis.stable_region import critical_gain
from ars_mujoco.hydraulics.control_cylinder import common_capacitance

STAGES = {"third_order": THIRD_ORDER, "reduced": REDUCED, "full": FULL}
FREQUENCY = 45.0  # Hz, about the inner loop's bandwidth
PAPER = (400.0, 12600.0)  # Hz
OMEGA = 2.0 * math.pi * np.geomspace(1.0, 5000.0, 600)  # rad/s
UNITS = {"poles": "rad/s as (real, imaginary)", "bandwidth": "Hz", "phase": "deg", "at_rest": "1", "stable": "1/rad",
         "cylinder": "Hz", "valve": "Hz", "frequency": "Hz", "magnitude": "dB"}  # fmt: skip


def cylinder_frequency(loop: Loop) -> float:
    """Natural frequency (rad/s) of eq. 16: the piston's mass on the oil of its two chambers and the centring spring."""
    circuit, edge = loop.circuit, loop.circuit.metering_edge
    cylinder, middle = circuit.control_cylinder, 0.5 * (edge.supply_pressure + edge.return_pressure)
    capacitance = common_capacitance(cylinder, loop.at_stage(REDUCED).detail.fluid, 0.0, middle)
    return math.sqrt((cylinder.area**2 / capacitance + cylinder.centring_stiffness) / cylinder.mass)


def with_cylinder_frequency(loop: Loop, frequency: float) -> Loop:
    """`loop` with a piston of the mass that gives its cylinder a natural `frequency` (rad/s)."""
    circuit = loop.circuit.copy()
    circuit.control_cylinder.mass *= (cylinder_frequency(loop) / frequency) ** 2
    return replace(loop, circuit=circuit)


def inner_loop(loop: Loop, dry_friction: bool = False) -> dict[str, Any]:
    """Poles of the inner loop, its -3 dB point, its phase at FREQUENCY, and its gain at rest."""
    system = pump_control(loop, dry_friction)
    at_rest = float(control.dcgain(system))
    poles = sorted(system.poles(), key=abs)
    return {
        "poles": [[float(pole.real), float(pole.imag)] for pole in poles if pole.imag >= 0.0],
        "bandwidth": bandwidth(OMEGA, system(1j * OMEGA), at_rest),
        "phase": math.degrees(np.angle(system(2j * math.pi * FREQUENCY))),
        "at_rest": at_rest,
    }


def compute(loop: Loop) -> dict[str, Any]:
    """The inner loop at each stage, and at the full one with dry friction and with a cylinder at either end of the
    paper's range; with the outer loop's K_p at which the actuator then begins to oscillate.
    """
    full = loop.at_stage(FULL)
    rows = {name: loop.at_stage(stage) for name, stage in STAGES.items()}
    ends = {f"{hertz:g}": with_cylinder_frequency(full, 2.0 * math.pi * hertz) for hertz in PAPER}
    return {
        "units": UNITS,
        "paper": {"cylinder": list(PAPER)},
        "cylinder": cylinder_frequency(loop) / (2.0 * math.pi),
        "valve": float(loop.circuit.servo_valve.frequency) / (2.0 * math.pi),
        "stages": {name: inner_loop(each) | {"stable": critical_gain(each)} for name, each in rows.items()},
        "with_dry_friction": inner_loop(full, dry_friction=True),
        "range": {hertz: inner_loop(each) | {"stable": critical_gain(each)} for hertz, each in ends.items()},
        "frequency": (OMEGA / (2.0 * math.pi)).tolist(),
        "response": {name: _told(each) for name, each in rows.items()},
    }


def headline(result: dict[str, Any]) -> list[dict[str, str]]:
    """Rows of the table: the cylinder beside the valve, and the inner loop at each stage."""
    value = f"{result['cylinder']:.0f} Hz, servo valve {result['valve']:.0f} Hz"
    rows = [{"quantity": "control cylinder's natural frequency", "value": value, "paper": "400 to 12600 Hz"}]
    rows += [
        {"quantity": f"inner loop, pump control {name.replace('_', ' ')}", "value": _summary(row)}
        for name, row in result["stages"].items()
    ]
    dry = result["with_dry_friction"]
    rows.append({"quantity": "inner loop, full within a mm/s of dry friction", "value": _summary(dry)})
    rows += [
        {"quantity": f"inner loop, full with a cylinder of {hertz} Hz", "value": _summary(row)}
        for hertz, row in result["range"].items()
    ]
    return rows


def draw(result: dict[str, Any]) -> Figure:
    """Bode diagram of the inner loop at each stage."""
    figure = Figure(figsize=(7.0, 5.4), layout="constrained")
    axes = figure.subplots(2, 1, sharex=True)
    for (name, response), shade, dash in zip(result["response"].items(), SHADES[::2], DASHES, strict=False):
        text = name.replace("_", " ")
        for ax, quantity in zip(axes, ("magnitude", "phase"), strict=True):
            ax.semilogx(result["frequency"], response[quantity], dash, color=shade, lw=1.5, label=text)
    for ax in axes:
        for name in ("valve", "cylinder"):
            ax.axvline(result[name], color=DARK, lw=0.7, ls=":")
            ax.annotate(name, (result[name], 0.02), xycoords=("data", "axes fraction"), fontsize=7, rotation=90)
    axes[0].set_ylim(bottom=-140.0)
    label(axes[0], "Inner loop at each stage of pump control", "", "stroke over command (dB)")
    label(axes[1], "", "frequency (Hz)", "phase (deg)", legend=False)
    return figure


def _told(loop: Loop) -> dict[str, list[float]]:
    response = pump_control(loop)(1j * OMEGA)
    return {
        "magnitude": (20.0 * np.log10(np.abs(response))).tolist(),
        "phase": np.degrees(np.unwrap(np.angle(response))).tolist(),
    }


def _summary(row: dict[str, Any]) -> str:
    told = f"-3 dB at {row['bandwidth']:.1f} Hz, {row['phase']:.1f} deg at {FREQUENCY:g} Hz"
    return f"{told}, K_p stable under {row['stable']:.1f} 1/rad" if "stable" in row else told
