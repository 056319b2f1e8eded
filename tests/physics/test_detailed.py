"""The detailed plant on the bench against its independent reference, and the observed order of its integration."""

from dataclasses import replace

import numpy as np
import pytest
import shipped
from detailed import ACTUATORS, VARIANTS, drive
from radau import step
from radau_full import NOMINAL, solve

from ars_mujoco.simulation import simulate

# the reference's nominal plant with the shipped line of 3.34 m, oil at 50 degC and fail-safe valve of 20 L/min at 2 bar
SHIPPED = replace(
    NOMINAL,
    V_L=3.34 * np.pi * 0.01**2 / 4,
    density=860 * (1 - 7e-4 * 35),
    viscosity=21.5597e-6,
    K_f=20e-3 / 60 / 2e5**0.5,
    q_0=0.05 * 20e-3 / 60,
)
DEGREES = pytest.mark.parametrize("degrees", [1, 10])


def agrees(circuit, stage, degrees, *settings, **changes):
    """The run is within 0.5 % (angle) and 1 % (pressure) of the reference, over its peak, at every sample."""
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
    return phi < 0.5 and dp < 1.0 and X < 0.5


@DEGREES
@pytest.mark.parametrize(("circuit", "stage"), VARIANTS)
def test_every_stage_and_circuit_is_within_half_a_percent_of_the_reference(circuit, stage, degrees):
    assert agrees(circuit, stage, degrees)


@DEGREES
@pytest.mark.parametrize("lumps", [2, 3])
def test_so_is_a_line_of_several_lumps(lumps, degrees):
    assert agrees("full", "full", degrees, f"actuator.front.pipe.lumps={lumps}", lumps=lumps)


@DEGREES
@pytest.mark.parametrize("rpm", [800, 6000])
@pytest.mark.parametrize("circuit", ACTUATORS)
def test_so_is_a_pump_at_idle_and_at_full_speed(circuit, rpm, degrees):
    assert agrees(circuit, "full", degrees, f"actuator.front.pump.speed={rpm} rpm", n=rpm / 60)


@pytest.mark.parametrize("channel", ["charge.pressure", "motor.pressure_a", "motor.pressure_b", "pump.pressure_a",
                                     "pump.pressure_b", "pump.control_pressure"])  # fmt: skip
def test_every_recorded_pressure_is_the_references(channel):
    recording = drive("bench_step_10deg")
    reference = solve(SHIPPED, "full", "full", step(10))
    state = reference.state(recording.time)
    expected = {
        "charge.pressure": state["gallery"],
        "motor.pressure_a": state["A1"],
        "motor.pressure_b": state["B1"],
        "pump.pressure_a": state["A0"],
        "pump.pressure_b": state["B0"],
        "pump.control_pressure": state["p_A"] - state["p_B"],
    }[channel]
    assert recording[f"front.{channel}"] == pytest.approx(expected, abs=0.005 * np.abs(expected).max())


# ---- order

SMOOTH = (
    "duration=20 ms",
    "manoeuvre.command={join: smooth, knots: [[0 s, 0 deg], [20 ms, 0.1 deg]]}",
    "actuator.front.motor.coulomb_friction=0 Nm",
    "actuator.front.control_cylinder.coulomb_friction=0 N",
)
COUNTS = (16, 32, 64, 128)  # substeps of 1 ms


def ends(circuit, stage, counts, *settings):
    """Plant states at the end of a smooth run with each number of substeps."""
    simulation = shipped.simulation(
        "bench_step_1deg", ACTUATORS[circuit], f"actuator.pump_control={stage}", *SMOOTH, *settings
    )
    for count in counts:
        own, world = shipped.own_copy(simulation)
        world.parameters.stabilizers.front.substeps = count
        yield own, count


@pytest.mark.parametrize(("circuit", "stage"), VARIANTS)
def test_order(circuit, stage):
    names = ["front.bar.angle", "front.motor.pressure", "front.motor.rate", "front.pump.stroke"]
    runs = []
    for own, count in ends(circuit, stage, (*COUNTS, 512)):
        r = simulate(own)
        runs.append(np.array([r[n][-1] for n in names]))
    runs = np.array(runs)
    errors = np.abs(runs[:-1] / runs[-1] - 1)
    print(circuit, stage, errors, np.log2(errors[:-1] / errors[1:]))
