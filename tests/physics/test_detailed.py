"""The detailed plant on the bench against its independent reference, and the observed order of its integration."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import shipped
from detailed import ACTUATORS, VARIANTS, drive
from radau import step
from radau_full import NOMINAL, solve

from ars_mujoco.simulation.simulation import simulate

# the reference's nominal plant with the shipped line of 3.34 m, oil at 50 degC, check and fail-safe valves
SHIPPED = replace(
    NOMINAL,
    V_L=3.34 * np.pi * 0.01**2 / 4,
    density=860 * (1 - 7e-4 * 35),
    viscosity=14.9420e-6,  # Walther between 19 mm^2/s at 40 and 6 at 100 degC, at 50
    G_c=8.33e-10,
    K_f=20e-3 / 60 / 2e5**0.5,
    q_0=0.05 * 20e-3 / 60,
)
SLOW = partial(pytest.param, marks=pytest.mark.slow)
DEGREES = pytest.mark.parametrize("degrees", [1, 10])


def agrees(circuit, stage, degrees, *settings, **changes):
    """The run is within 0.02 % (angle) and 0.05 % (pressure) of the reference, over its peak, at every sample: what was
    aimed at is 0.5 and 1 %, but so coarse a bound would pass another oil in the reference.
    """
    recording = drive(f"bench_step_{degrees}deg", circuit, stage, *settings)
    plant = replace(SHIPPED if circuit == "full" else NOMINAL, **changes)
    reference, time = solve(plant, stage, circuit, step(degrees)), recording.time
    stroke = np.clip(recording["front.pump.stroke"], -1.0, 1.0)  # what the pump makes of a plate beyond its stop
    phi, dp, X = (
        100 * np.abs(recorded - expected).max() / np.abs(expected).max()
        for recorded, expected in (
            (recording["front.bar.angle"], reference.phi(time)),
            (recording["front.motor.pressure"], reference.dp(time)),
            (stroke, reference.pump_stroke(time)),
        )
    )
    print(f"{circuit}, {stage}, {degrees} deg {settings}: phi {phi:.4f} %, dp {dp:.4f} %, X {X:.4f} %")
    return phi < 0.02 and dp < 0.05 and X < 0.05


@DEGREES
@pytest.mark.parametrize(("circuit", "stage"), VARIANTS)
def test_every_stage_and_circuit_is_that_of_the_reference(circuit, stage, degrees):
    assert agrees(circuit, stage, degrees)


@pytest.mark.parametrize(("lumps", "degrees"), [(2, 10), (3, 1), SLOW(2, 1), SLOW(3, 10)])
def test_so_is_a_line_of_several_lumps(lumps, degrees):
    assert agrees("full", "full", degrees, f"actuator.front.pipe.lumps={lumps}", lumps=lumps)


@pytest.mark.parametrize(
    ("circuit", "rpm", "degrees"),
    [("reduced", 800, 1), ("full", 800, 1), ("full", 6000, 1), SLOW("reduced", 6000, 10), SLOW("full", 6000, 10)],
)
def test_so_is_a_pump_at_idle_and_at_full_speed(circuit, rpm, degrees):
    assert agrees(circuit, "full", degrees, f"actuator.front.pump.speed={rpm} rpm", n=rpm / 60)


PRESSURES = {"charge.pressure": "gallery", "motor.pressure_a": "A1", "motor.pressure_b": "B1", "pump.pressure_a": "A0",
             "pump.pressure_b": "B0"}  # fmt: skip


@pytest.mark.parametrize(("channel", "name"), PRESSURES.items())
def test_every_recorded_pressure_is_within_a_thousandth_of_the_references(channel, name):
    recording = drive("bench_step_10deg")
    expected = solve(SHIPPED, "full", "full", step(10)).state(recording.time)[name]
    assert recording[f"front.{channel}"] == pytest.approx(expected, abs=0.001 * expected.max())


def test_so_is_the_control_cylinders_but_in_the_substeps_in_which_it_jumps():
    recording = drive("bench_step_10deg")
    state = solve(SHIPPED, "full", "full", step(10)).state(recording.time)
    expected = state["p_A"] - state["p_B"]
    apart = np.abs(recording["front.pump.control_pressure"] - expected) / np.abs(expected).max()
    assert np.count_nonzero(apart > 0.005) <= 5  # of 601: as the piston starts, and as it leaves its stop
    assert apart.max() < 0.05


# ---- order

CHANNELS = ("front.bar.angle", "front.motor.rate", "front.motor.pressure", "front.pump.stroke")
COUNTS = (16, 32, 64)  # substeps of 1 ms
FINEST = 512
SMOOTH = (  # nothing saturates, no valve opens, no friction changes its sign in a millimetre a second
    "duration=20 ms",
    "manoeuvre.command={join: smooth, knots: [[0 s, 0 deg], [20 ms, 0.1 deg]]}",
    "actuator.front.motor.coulomb_friction=0 Nm",
    "actuator.front.control_cylinder.coulomb_friction=0 N",
)
NO_CHECKS = ("actuator.front.check_valve.conductance=1e-18 m^3/s/Pa", "actuator.front.tank_leakage=0 m^3/s/Pa")


def orders(circuit, stage, *settings, stroke=0.0):
    """Observed order (2,) of a smooth run from an initial pump stroke, from step to halved step."""
    chosen = (*SMOOTH, *settings, *(NO_CHECKS if circuit == "full" else ()))
    shared = shipped.simulation("bench_step_1deg", ACTUATORS[circuit], f"actuator.pump_control={stage}", *chosen)
    ends = []
    for count in (*COUNTS, FINEST):
        own, world = shipped.own_copy(shared)
        world.parameters.system.front.substeps = count
        world.now.system.front.circuit.stroke = stroke
        recording = simulate(own)
        ends.append([recording[name][-1] for name in CHANNELS])
    errors = np.linalg.norm(np.divide(ends[:-1], ends[-1]) - 1.0, axis=1)
    found = np.log2(errors[:-1] / errors[1:])
    print(f"{circuit}, {stage}: errors {errors}, orders {found}")
    return found


NO_SWASH_FORCE = "actuator.front.control_cylinder.swash_force=0 N"


@pytest.mark.parametrize(("circuit", "stage"), [each for each in VARIANTS if each != ("reduced", "third_order")])
def test_pump_control_and_plant_together_are_of_order_three(circuit, stage):
    assert orders(circuit, stage, NO_SWASH_FORCE) == pytest.approx(3.0, abs=0.1)


@pytest.mark.parametrize("circuit", ACTUATORS)
def test_the_swash_plates_force_takes_the_pressure_of_a_straight_line_and_costs_below_1e_7(circuit):
    """Predicted to second order, it lowers the order in the end; at the shipped substeps it is hardly there."""
    found = orders(circuit, "full")
    assert 2.0 < found[-1] < found[0] < 3.0


@pytest.mark.parametrize("circuit", ACTUATORS)
def test_the_plant_alone_is_of_order_four(circuit):
    held = "actuator.front.servo_valve.frequency=1e-6 rad/s"
    assert orders(circuit, "third_order", held, stroke=0.05) == pytest.approx(4.0, abs=0.1)
