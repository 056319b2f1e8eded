"""The shipped full circuit's loops, and the matrix of its linear plant with one lump a line, written by hand."""

import math
from dataclasses import replace

import numpy as np

from ars_mujoco.analysis.loop import LOW_SIDE_HELD, Loop, loop_of
from ars_mujoco.studies.inputs import read_inputs

FIXED = ("actuator.control.loop.gain=60 1/rad", "actuator.control.loop.schedule=0")  # the verification set's loop
INPUTS = read_inputs("bench_s_curve", "pump_controlled_full", settings=FIXED)
FRONT, REAR = (loop_of(INPUTS, axle) for axle in ("front", "rear"))


def held(loop: Loop) -> Loop:
    """The loop with its low side, B, held by the gallery through its check valve."""
    return replace(loop, checks=LOW_SIDE_HELD)


def softness(loop: Loop, pressure: float) -> float:
    """Compressibility of the oil with its air (1/Pa)."""
    fluid = loop.detail.fluid
    return 1.0 / fluid.bulk_modulus + fluid.air * 1e5 / pressure**2


def stiffening(loop: Loop, pressure: float) -> float:
    """Relative fall of the compressibility with pressure (1/Pa): where a pressure drifts, so does its own rate."""
    return 2.0 * loop.detail.fluid.air * 1e5 / pressure**3 / softness(loop, pressure)


def charged(loop: Loop) -> tuple[float, float]:
    """Pressures (Pa) of lines and gallery at rest, without the few Pa that the leakage to the tank takes."""
    charge, check = loop.detail.charge_pump, loop.detail.check_valve
    gallery = charge.relief_pressure + charge.displacement * loop.circuit.pump.speed / charge.relief_conductance
    return gallery - check.opening_pressure, gallery


def resistance(loop: Loop) -> float:
    """Pressure over a small flow (Pa s/m^3) in one line: laminar friction and the open fail-safe valve."""
    pipe, fluid, valve = loop.detail.pipe, loop.detail.fluid, loop.detail.fail_safe_valve
    laminar = 128.0 * fluid.viscosity * fluid.density * pipe.length / (math.pi * pipe.diameter**4)
    return laminar + 0.05 * valve.pressure / valve.flow


def plant_matrix(loop: Loop) -> np.ndarray:
    """(9, 9) of the states pressure_a0, a1, b0, b1, flow_a, flow_b, gallery, angle, rate (eqs. 25 to 39)."""
    motor, pump, detail = loop.circuit.motor, loop.circuit.pump, loop.detail
    pipe, fluid, D = detail.pipe, detail.fluid, motor.displacement
    line, gallery = charged(loop)
    area = 0.25 * math.pi * pipe.diameter**2
    half, soft = 0.5 * pipe.length * area, softness(loop, line)
    C_0 = half * (soft + pipe.wall_compliance)
    C_1 = C_0 + D * motor.stop_angle * soft
    C_g = detail.charge_pump.gallery_volume * softness(loop, gallery)
    inertance, R = fluid.density * pipe.length / area, resistance(loop)
    k_p, k_m, k_x = pump.leakage, motor.leakage, detail.tank_leakage
    G = detail.check_valve.conductance if loop.checks == LOW_SIDE_HELD else 0.0
    G_r = detail.charge_pump.relief_conductance
    # a line whose check valve is shut leaks to the tank
    drift = stiffening(loop, line) * k_x * (line - loop.circuit.metering_edge.return_pressure) / C_0
    a_drift, b_drift = drift, 0.0 if G else drift
    theta, r, c = motor.inertia, motor.viscous_friction, loop.stiffness
    return np.array(
        [
            [-(k_p + k_x) / C_0 - a_drift, 0, k_p / C_0, 0, -1 / C_0, 0, 0, 0, 0],
            [0, -k_m / C_1, 0, k_m / C_1, 1 / C_1, 0, 0, 0, -D / C_1],
            [k_p / C_0, 0, -(k_p + k_x + G) / C_0 - b_drift, 0, 0, -1 / C_0, G / C_0, 0, 0],
            [0, k_m / C_1, 0, -k_m / C_1, 0, 1 / C_1, 0, 0, D / C_1],
            [1 / inertance, -1 / inertance, 0, 0, -R / inertance, 0, 0, 0, 0],
            [0, 0, 1 / inertance, -1 / inertance, 0, -R / inertance, 0, 0, 0],
            [0, 0, G / C_g, 0, 0, 0, -(G + G_r) / C_g, 0, 0],
            [0, 0, 0, 0, 0, 0, 0, 0, 1],
            [0, D / theta, 0, -D / theta, 0, 0, 0, -c / theta, -r / theta],
        ]
    )


def cylinder_matrix(loop: Loop) -> np.ndarray:
    """(6, 6) of the states spool, spool_rate, stroke, p_A, p_B, piston_rate of the full pump control (eqs. 1 to 18)."""
    circuit = loop.circuit
    valve, edge, cylinder = circuit.servo_valve, circuit.metering_edge, circuit.control_cylinder
    w, d, area, travel, m = valve.frequency, valve.damping, cylinder.area, cylinder.travel, cylinder.mass
    drop = 0.5 * (edge.supply_pressure - edge.return_pressure)
    middle, volume = edge.return_pressure + drop, cylinder.dead_volume + area * travel
    C = volume * softness(loop, middle)
    falls = cylinder.external_leakage * drop / C  # Pa/s, of both chambers: what leaks out of them is not made up
    opened = edge.constant * edge.stroke * drop / (drop**2 + edge.laminar_pressure**2) ** 0.25
    across, out = cylinder.internal_leakage, cylinder.external_leakage + cylinder.internal_leakage + 2 * edge.leakage
    drift, shift = stiffening(loop, middle) * falls, falls * area * travel / volume
    K = circuit.swash_plate_loop.gain / circuit.swash_plate.max_rate
    return np.array(
        [
            [0, 1, 0, 0, 0, 0],
            [-(w**2), -2 * d * w, -(w**2) * K, 0, 0, 0],
            [0, 0, 0, 0, 0, 1 / travel],
            [opened / C, 0, shift, -out / C - drift, across / C, -area / C],
            [-opened / C, 0, -shift, across / C, -out / C - drift, area / C],
            [0, 0, -cylinder.centring_stiffness * travel / m, area / m, -area / m, -cylinder.viscous_friction / m],
        ]
    )
