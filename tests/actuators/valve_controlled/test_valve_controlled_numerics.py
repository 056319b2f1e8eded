"""How the equations are solved: order of the substep, an independent solution, closed books."""

from functools import cache

import numpy as np
import pytest
from valve_reference import solution
from valve_runs import AT_750, FLOW, OPEN_INTAKE, STEP, driven, parameters, smooth

from ars_mujoco.actuators.valve_controlled import system
from ars_mujoco.actuators.valve_controlled.block import Setting
from ars_mujoco.actuators.valve_controlled.equations import Demand
from ars_mujoco.kernels.kernel import entry
from ars_mujoco.kernels.records import numbers
from ars_mujoco.schema.channels import channels

SPEED = 3000.0 * np.pi / 30.0
PIECES = (
    (0.0, 0.0, 0.0, 1.0), (0.1, 0.45, 0.5, 1.0), (0.5, 0.2, 0.3, 1.0), (0.7, 0.0, 0.0, 1.0), (0.9, 0.0, 0.0, -1.0),
    (1.0, 0.6, 0.35, -1.0),
)  # fmt: skip


@entry
def through(p, states, demands, count):
    for i in range(len(states) - 1):
        flow, speed, front, rear, side = demands[i]
        demand = Demand(Setting(flow, speed, front, rear, side, 1.0), 0.0, 0.0)
        system.step_through(p, states[i], states[i + 1], demand, STEP, count)


def steps(p, seconds: float, pieces, flow=FLOW, count=None, speed=SPEED) -> np.recarray:
    """States (n,) each physics step under given currents (A) and sides of the direction valve."""
    time = STEP * np.arange(round(seconds / STEP) + 1)
    states = np.zeros(len(time), system.STATE).view(np.recarray)
    system._rest(p, states[0].state, flow)
    starts = np.array([piece[0] for piece in pieces])
    demands = np.array([(flow, speed, *pieces[np.searchsorted(starts, t + 1e-9, side="right") - 1][1:]) for t in time])
    through(p, states, demands, count or int(p.substeps))
    return states


def test_it_agrees_with_an_independent_solution():
    states = steps(parameters(OPEN_INTAKE), 1.4, PIECES)
    time = STEP * np.arange(len(states))
    y, state, energy = solution(PIECES, FLOW, 3000.0, time), states.state, states.energy.supply
    pairs = {
        "front chamber A": (state.front.chamber_a, y[0]), "front chamber B": (state.front.chamber_b, y[1]),
        "front angle": (state.front.angle, y[2]), "front rate": (state.front.rate, y[3]),
        "rear chamber A": (state.rear.chamber_a, y[4]), "rear angle": (state.rear.angle, y[6]),
        "front node": (state.supply.front_pressure, y[8]), "rear node": (state.supply.rear_pressure, y[9]),
        "front opening": (state.supply.front_opening, y[12]), "rear opening": (state.supply.rear_opening, y[15]),
        "shaft": (energy.shaft, y[17]), "front valve": (energy.front_valve, y[18]),
        "rear valve": (energy.rear_valve, y[19]),
    }  # fmt: skip
    errors = {name: np.abs(ours - own).max() / np.abs(own).max() for name, (ours, own) in pairs.items()}
    print({name: f"{error:.1e}" for name, error in errors.items()})
    assert max(errors.values()) < 5e-3
    assert np.abs(y[2]).max() * 5700.0 > 500.0


@cache
def after(count: int) -> np.ndarray:
    """States and energies 10 ms after the currents of held pressures were lowered, in `count` substeps a step: both
    valves move between their stops, nothing reaches a limit.
    """
    p = parameters(OPEN_INTAKE, "front.motor.coulomb_friction=0 Nm", "rear.motor.coulomb_friction=0 Nm")
    start = steps(p, 0.6, ((0.0, 0.5, 0.5, 1.0),), count=200)[-1]
    states = np.zeros(11, system.STATE).view(np.recarray)
    states[0] = start
    states[0].energy = 0.0
    through(p, states, np.tile((FLOW, SPEED, 0.48, 0.485, 1.0), (11, 1)), count)
    return np.array([*numbers(states[-1].state), *numbers(states[-1].energy)])


def test_the_substep_is_of_fourth_order():
    exact = after(640)
    size = np.maximum(np.abs(exact), 1e-6 * np.abs(exact).max())
    errors = [np.linalg.norm((after(count) - exact) / size) for count in (16, 24, 36)]
    orders = np.log(np.divide(errors[:-1], errors[1:])) / np.log(1.5)
    print("orders", orders, "errors", errors)
    assert orders == pytest.approx(4.0, abs=0.2)


def test_the_shipped_system_takes_eleven_substeps_a_step():
    assert parameters().substeps == 11.0  # both valves open without flow, the direction valve open: 2.8e4 1/s


def swing(time):
    return smooth(time, (0, 0), (0.3, 900), (0.6, -900), (0.9, -100), (1.2, -1200), (1.4, 0))


RUNS = {
    "swing": lambda: driven(swing, lambda t: 0.67 * swing(t), 1.6),
    "at idle": lambda: driven(swing, lambda t: 0.67 * swing(t), 1.6, AT_750),
    "with moved ends": lambda: driven(600.0, 400.0, 1.5, twist=lambda t: 0.1 * np.sin(20.0 * t)),
    "sealed": lambda: driven(800.0, 500.0, 1.5, fail_safe=lambda t: float(t < 1.0)),
    "over the relief valve": lambda: driven(1500.0, 900.0, 1.0, "block.relief_valve.pressure=120 bar"),
    "drawing from the reservoir": lambda: driven(
        800.0, 500.0, 1.5, fail_safe=lambda t: float(t < 1.0), twist=lambda t: -0.5 * max(t - 1.1, 0.0)
    ),
}
BALANCE = {"drawn": 1.0, "lost": -1.0, "stored": -1.0, "delivered": -1.0}


@pytest.mark.parametrize("name", RUNS)
def test_the_books_of_each_block_close(name):
    run = RUNS[name]()
    for block in ("front", "rear", "supply"):
        sums = np.zeros(len(run.time))
        for each in channels(system.Output.model_fields[block].annotation):
            if each.role in BALANCE:
                values = run.outputs[block]
                for part in each.name.split("."):
                    values = values[part]
                sums += BALANCE[each.role] * values
        # the ends move in steps: what they do to the bar's torsion they do at once
        twist = 0.1 * np.sin(20.0 * run.time) if name == "with moved ends" else 0.0 * run.time
        if name == "drawing from the reservoir":
            twist = -0.5 * np.maximum(run.time - 1.1, 0.0)
        angle = run.outputs[block].bar.angle if block != "supply" else 0.0 * run.time
        torsion = 5700.0 * (angle[1:] - 0.5 * (twist[1:] + twist[:-1])) if block != "supply" else 0.0 * angle[1:]
        work = np.cumsum(torsion * np.diff(twist))
        drawn = run.supply.energy.shaft[-1]
        assert np.abs(sums[1:] - sums[0] - work).max() < 1e-4 * drawn, block


def test_what_the_block_delivers_the_axles_draw():
    run = RUNS["swing"]()
    for axle in ("front", "rear"):
        delivered, drawn = run.supply.energy[axle], run.outputs[axle].energy.oil_supply
        assert delivered == pytest.approx(drawn, abs=1e-9 * np.abs(drawn).max())


def test_every_loss_only_grows():
    for name in ("swing", "sealed", "drawing from the reservoir"):
        run = RUNS[name]()
        for block in ("front", "rear", "supply"):
            for each in channels(system.Output.model_fields[block].annotation):
                if each.role == "lost":
                    values = run.outputs[block]
                    for part in each.name.split("."):
                        values = values[part]
                    assert np.diff(values).min() >= -1e-9, (name, block, each.name)
    assert run.outputs.front.energy.check[-1] > 0.0


def test_the_crankshaft_pays_for_coils_and_unit_through_the_generator():
    energy = RUNS["swing"]().supply.energy
    assert energy.generator[-1] == pytest.approx((energy.coils[-1] + energy.unit[-1]) / 0.67, rel=1e-9)
    assert energy.unit[-1] == pytest.approx(16.0, rel=1e-6)
