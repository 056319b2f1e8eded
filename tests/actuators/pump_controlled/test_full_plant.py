"""The full circuit: closed forms of its parts at work together, its rest, and its energy at every instant."""

import math

import numpy as np
import pytest
from detailed import axle, drive, rates

from ars_mujoco.actuators.pump_controlled.full_plant import (
    ANGLE,
    BAR_TORQUE,
    BYPASS,
    BYPASS_LOSS,
    CAPACITANCE,
    CHARGE,
    CHARGE_LOSS,
    CHECK,
    FAIL_SAFE,
    FLOW_A,
    FLOW_B,
    FRICTION,
    GALLERY,
    LINE,
    MOTOR,
    MOTOR_LEAKAGE,
    PUMP_LEAKAGE,
    RATE,
    RELIEF,
    SHAFT,
    STATES,
    TANK_LEAKAGE,
    TORQUE_LOSS,
    A,
    B,
    stored_energies,
)
from ars_mujoco.hydraulics.fail_safe_valve import fail_safe_drop
from ars_mujoco.hydraulics.pipe import inertance, pressure_drop
from ars_mujoco.hydraulics.relief_valve import one_way_relief

BAR = 1e5
D = 5.24e-4 / (2 * math.pi)  # m^3/rad, of the motor
V_L = 3.34 * math.pi * 0.01**2 / 4  # m^3, of one line
LOSSES = [TORQUE_LOSS, PUMP_LEAKAGE, MOTOR_LEAKAGE, RELIEF, FRICTION, LINE, CHECK, BYPASS_LOSS, TANK_LEAKAGE,
          CHARGE_LOSS]  # fmt: skip
LUMPS = (1, 2, 3, 4)
AXLES = {lumps: axle("full", "third_order", f"actuator.front.pipe.lumps={lumps}") for lumps in LUMPS}
EACH = pytest.mark.parametrize("lumps", LUMPS)


def record(lumps=1, **blocks):
    """The Axle record, with blocks of its circuit or detail changed: motor={"leakage": 0.0}."""
    parameters = AXLES[lumps][0].copy()
    for block, changes in blocks.items():
        part = parameters.circuit if block in parameters.circuit.dtype.names else parameters.detail
        for name, value in changes.items():
            part[block][name] = value
    return parameters


def rest(lumps=1):
    return AXLES[lumps][1].detail.plant.copy()


def softness(pressure):
    """Compressibility (1/Pa) of the shipped oil."""
    return 1 / 1.4e9 + 0.005 * BAR / pressure**2


def nodes(lumps):
    """Where the node pressures and the flows in the lines lie."""
    pressures = [side + j for side in (A, B) for j in range(lumps + 1)]
    return pressures, [flow + j for flow in (FLOW_A, FLOW_B) for j in range(lumps)]


def any_state(lumps, random):
    """A random state: pressures from a tenth of a bar on, over the reliefs, beyond the stop, valves anywhere."""
    pressures, flows = nodes(lumps)
    x = np.zeros(STATES)
    x[pressures] = BAR * 10 ** random.uniform(-1, 2.4, len(pressures))
    x[flows] = random.uniform(-3e-4, 3e-4, len(flows))
    x[GALLERY] = BAR * random.uniform(0.5, 25)
    x[ANGLE], x[RATE] = random.uniform(-0.82, 0.82), random.uniform(-3, 3)
    x[BYPASS], x[FAIL_SAFE] = random.uniform(0, 1), random.choice([0.0, random.uniform(0.05, 1)])
    return x


# ---- rest


@EACH
def test_at_rest_nothing_moves_but_the_oil_that_charges_the_circuit(lumps):
    x = rest(lumps)
    derivatives, powers = rates(record(lumps), x)
    pressures, flows = nodes(lumps)
    assert derivatives[[*pressures, GALLERY]] == pytest.approx(0.0, abs=1.0)  # Pa/s
    assert not derivatives[[*flows, ANGLE, RATE, BYPASS, FAIL_SAFE]].any()
    idle = {SHAFT, TORQUE_LOSS, TANK_LEAKAGE, CHECK, CHARGE, CHARGE_LOSS}
    assert set(np.flatnonzero(powers)) == idle


def test_at_rest_the_charge_relief_sets_the_gallery_and_the_check_valves_a_little_less_the_lines():
    x, supplied = rest(), 0.5e-6 * 50
    leak = 1e-14 * (x[A] - BAR)
    assert x[GALLERY] == pytest.approx(20 * BAR + (supplied - 2 * leak) / 4e-10)
    assert x[GALLERY] - x[A] == pytest.approx(0.2 * BAR + leak / 8.33e-10)
    assert x[A] == x[B]


def test_a_bench_that_nobody_moves_stays_charged_and_at_rest():
    recording = drive("bench_step_1deg", "full", "full", "manoeuvre.command.knots=[[0 s, 0 deg]]")
    assert np.abs(recording["front.bar.angle"]).max() == 0.0
    for name in ("motor.pressure_a", "motor.pressure_b", "pump.pressure_a", "pump.pressure_b", "charge.pressure"):
        assert recording[f"front.{name}"] == pytest.approx(recording[f"front.{name}"][0], abs=1e-3 * BAR), name


# ---- closed forms


@EACH
def test_oil_pumped_into_a_trapped_volume_raises_its_pressure_by_flow_over_volume_and_compressibility(lumps):
    """V b(p) p' = Q at the pump's node, V_L/2N; the opposite node loses as much."""
    sealed = record(lumps, pump={"leakage": 0.0}, relief_valve={"conductance": 0.0}, check_valve={"conductance": 0.0})
    sealed.detail.tank_leakage = 0.0
    x = rest(lumps)
    x[[A, B]] = 50 * BAR, 30 * BAR
    derivatives, _ = rates(sealed, x, stroke=0.1)
    volume, flow = V_L / (2 * lumps), 0.1 * 1.8e-6 * 50
    assert derivatives[A] == pytest.approx(flow / (volume * softness(50 * BAR)))
    assert derivatives[B] == pytest.approx(-flow / (volume * softness(30 * BAR)))


@pytest.mark.parametrize("angle", [0.0, 0.5, -0.7])
def test_a_motor_turned_by_hand_compresses_the_chamber_it_shrinks(angle):
    x = rest()
    x[ANGLE], x[RATE] = angle, 0.1
    derivatives, _ = rates(record(), x, twist=angle)
    for node, side in ((A + 1, 1), (B + 1, -1)):
        volume = V_L / 2 + D * (math.pi / 4 + side * angle)
        assert derivatives[node] == pytest.approx(-side * D * 0.1 / (volume * softness(x[node])))


def test_the_walls_of_a_hose_take_oil_too_but_not_those_of_the_chamber():
    x = rest()
    x[RATE] = 0.1
    steel, _ = rates(record(), x)
    hose, _ = rates(record(pipe={"wall_compliance": 1e-9}), x)
    line, chamber = V_L / 2, D * math.pi / 4
    b = softness(x[A])
    assert steel[A + 1] / hose[A + 1] == pytest.approx((line * (b + 1e-9) + chamber * b) / ((line + chamber) * b))


@EACH
def test_a_step_of_pressure_speeds_the_oil_up_by_pressure_over_inertance(lumps):
    parameters, x = record(lumps), rest(lumps)
    x[A] += 3 * BAR
    derivatives, _ = rates(parameters, x)
    whole = inertance(parameters.detail.pipe, parameters.detail.fluid)
    assert derivatives[FLOW_A] == pytest.approx(3 * BAR * lumps / whole)
    assert not derivatives[FLOW_A + 1 : FLOW_A + lumps].any()


@EACH
@pytest.mark.parametrize("flow", [4e-5, -2e-4, 6e-4])  # laminar, between, turbulent
def test_in_steady_flow_a_line_loses_the_drop_of_its_pipe_and_of_the_fail_safe_valve(lumps, flow):
    parameters, x = record(lumps), rest(lumps)
    detail = parameters.detail
    pipe, valve = pressure_drop(detail.pipe, detail.fluid, flow), fail_safe_drop(detail.fail_safe_valve, 1.0, flow)
    x[FLOW_A : FLOW_A + lumps] = flow
    x[A : A + lumps + 1] = 40 * BAR - pipe * np.arange(lumps + 1) / lumps
    x[A + lumps] -= valve
    derivatives, powers = rates(parameters, x)
    whole = inertance(detail.pipe, detail.fluid)
    assert derivatives[FLOW_A : FLOW_A + lumps] * whole / lumps == pytest.approx(0.0, abs=1e-3)
    assert powers[LINE] == pytest.approx(flow * (pipe + valve))


def ideal(lumps):
    """The axle without any loss."""
    parameters = record(
        lumps, pump={"leakage": 0.0}, motor={"leakage": 0.0, "coulomb_friction": 0.0, "viscous_friction": 0.0},
        fluid={"viscosity": 1e-60}, fail_safe_valve={"flow": 1e9},
    )  # fmt: skip
    parameters.circuit.pump.torque_loss.norm = parameters.detail.tank_leakage = 0.0
    return parameters


@EACH
@pytest.mark.parametrize(("stroke", "load"), [(0.4, 60), (0.4, -60), (-0.4, 60), (-0.4, -60)])
def test_an_ideal_pump_gives_an_ideal_motor_the_power_of_its_shaft(lumps, stroke, load):
    """In steady motion D w = X V_p n and M w = X V_p n dp, in all four quadrants."""
    x, flow = rest(lumps), stroke * 1.8e-6 * 50
    x[A : A + lumps + 1], x[B : B + lumps + 1] = (70 + load / 2) * BAR, (70 - load / 2) * BAR
    x[FLOW_A : FLOW_A + lumps], x[FLOW_B : FLOW_B + lumps] = flow, -flow
    x[RATE] = flow / D
    derivatives, powers = rates(ideal(lumps), x, stroke, twist=-D * load * BAR / 5700)
    assert derivatives[[*nodes(lumps)[0], RATE]] == pytest.approx(0.0, abs=1e-3)
    assert powers[SHAFT] == pytest.approx(flow * load * BAR)
    assert powers[MOTOR] == pytest.approx(powers[SHAFT])
    assert powers[BAR_TORQUE] == pytest.approx(D * load * BAR)
    assert powers[[TORQUE_LOSS, PUMP_LEAKAGE, MOTOR_LEAKAGE, RELIEF, FRICTION, LINE]] == pytest.approx(0.0, abs=1e-9)


def test_a_relief_valve_lets_the_high_side_into_the_gallery():
    x = rest()
    x[A] = x[GALLERY] + 195 * BAR
    still, _ = rates(record(relief_valve={"conductance": 0.0}), x)
    derivatives, powers = rates(record(), x)
    flow = 8.33e-11 * 5 * BAR
    assert one_way_relief(record().circuit.relief_valve, 195 * BAR) == pytest.approx(flow)
    assert (still - derivatives)[A] == pytest.approx(flow / (V_L / 2 * softness(x[A])))
    assert (derivatives - still)[GALLERY] == pytest.approx(flow / (2e-4 * softness(x[GALLERY])))
    assert powers[RELIEF] == pytest.approx(flow * 195 * BAR)


def test_a_check_valve_refills_a_side_that_has_fallen_below_the_gallery():
    x = rest()
    x[B] = 5 * BAR
    derivatives, powers = rates(record(), x)
    flow = 8.33e-10 * (x[GALLERY] - 5.2 * BAR)
    leak = 2.25e-13 * (x[A] - x[B]) - 1e-14 * (x[B] - BAR)
    assert derivatives[B] == pytest.approx((flow + leak) / (V_L / 2 * softness(5 * BAR)))
    assert powers[CHECK] == pytest.approx(flow * (x[GALLERY] - 5 * BAR))


def test_an_open_bypass_passes_60_litres_a_minute_at_10_bar():
    x = rest()
    x[A + 1] = x[B + 1] + 10 * BAR
    shut, _ = rates(record(), x)
    x[BYPASS] = 1.0
    derivatives, powers = rates(record(), x)
    volume = (V_L / 2 + D * math.pi / 4) * softness(x[A + 1])
    assert (shut - derivatives)[A + 1] * volume == pytest.approx(1e-3, rel=3e-3)
    assert powers[BYPASS_LOSS] == pytest.approx(1e-3 * 10 * BAR, rel=3e-3)


# ---- energy and symmetry


@EACH
def test_what_shaft_and_charge_pump_give_is_stored_or_lost_at_every_instant(lumps):
    parameters, random = record(lumps, pipe={"wall_compliance": 3e-10}), np.random.default_rng(lumps)
    for _ in range(200):
        x, stroke, twist = any_state(lumps, random), random.uniform(-1.2, 1.2), random.uniform(-0.5, 0.5)
        derivatives, powers = rates(parameters, x, stroke, twist)
        h = 1e-3 * np.min(np.abs(x[x != 0.0]) / (np.abs(derivatives[x != 0.0]) + 1e-30))
        ahead, behind = (
            np.array(stored_energies(parameters.circuit, parameters.detail, parameters.stiffness,
                                     x + side * h * derivatives, twist))
            for side in (1, -1)
        )  # fmt: skip
        gained = (ahead - behind) / (2 * h)
        given_power = powers[SHAFT] + powers[CHARGE]
        lost = powers[[*LOSSES, CAPACITANCE]].sum()
        size = np.abs(powers).sum() + np.abs(gained).sum()
        assert gained.sum() == pytest.approx(given_power - lost, abs=1e-5 * size)


@EACH
def test_every_loss_but_the_capacitances_costs_at_any_state(lumps):
    parameters, random = record(lumps), np.random.default_rng(lumps)
    for _ in range(300):
        x = any_state(lumps, random)
        x[FAIL_SAFE] = max(x[FAIL_SAFE], 0.05)  # shut, it stops the oil within 60 us, whoever pays
        _, powers = rates(parameters, x, random.uniform(-1.2, 1.2), random.uniform(-0.5, 0.5))
        assert powers[LOSSES].min() >= -1e-9 * np.abs(powers).max()


@EACH
def test_a_mirrored_state_moves_mirrored(lumps):
    parameters, random = record(lumps), np.random.default_rng(lumps)
    for _ in range(100):
        x, stroke, twist = any_state(lumps, random), random.uniform(-1.2, 1.2), random.uniform(-0.5, 0.5)
        derivatives, powers = rates(parameters, x, stroke, twist)
        mirrored, mirrored_powers = rates(parameters, mirror(x), -stroke, -twist)
        assert mirror(mirrored) == pytest.approx(derivatives, rel=1e-12, abs=1e-300)
        powers[BAR_TORQUE] *= -1
        assert mirrored_powers == pytest.approx(powers, rel=1e-9, abs=1e-9 * np.abs(powers).max())


def mirror(x):
    """The state with its sides exchanged."""
    turned = x.copy()
    turned[A:B], turned[B:FLOW_A] = x[B:FLOW_A], x[A:B]
    turned[FLOW_A:FLOW_B], turned[FLOW_B:GALLERY] = x[FLOW_B:GALLERY], x[FLOW_A:FLOW_B]
    turned[ANGLE], turned[RATE] = -x[ANGLE], -x[RATE]
    return turned
