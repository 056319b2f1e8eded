"""Faults of the circuit and files that cannot be (`reference/systems.md`, 1.7)."""

import pytest
from test_valve_controlled_numerics import steps
from valve_runs import OPEN_INTAKE, driven, parameters, smooth

from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

STALL = "drive={kind: table, speed: {join: step, knots: [[0 s, 3000 rpm], [1 s, 0 rpm]]}}"


def held(*settings, seconds=3.0, **given):
    """A run that holds 800 and 500 Nm from 0.5 s on."""
    return driven(
        lambda t: smooth(t, (0, 0), (0.5, 800)), lambda t: smooth(t, (0, 0), (0.5, 500)), seconds, *settings, **given
    )


def test_as_the_engine_stalls_pressure_decays_and_no_chamber_runs_dry():
    run = held(STALL)
    assert run.supply.front_valve.pressure[-1] < 0.2 * run.supply.front_valve.pressure[999]
    assert run.supply.pump.shaft_power[-1] == 0.0
    for axle in ("front", "rear"):
        motor = run.outputs[axle].motor
        assert min(motor.pressure_a.min(), motor.pressure_b.min()) > -0.5e5


def test_as_the_engine_stalls_the_fail_safe_valve_holds_the_front():
    free, sealed = held(STALL), held(STALL, fail_safe=lambda t: float(t < 1.0))
    assert sealed.front[-1] > 2.0 * free.front[-1]
    # it is shut after 19 ms; until then the pressure valves, open at once, let go a third
    assert sealed.front[1019] == pytest.approx(0.68 * sealed.front[999], rel=0.05)


def test_a_front_valve_that_is_stuck_open_gives_the_front_no_more_than_the_rear():
    run = held("block.front_valve.leakage=1e-9 m^3/s/Pa", seconds=1.5)
    rear = run.supply.rear_valve.pressure[-1]
    assert run.supply.front_valve.pressure[-1] == pytest.approx(rear, abs=2e5)
    assert run.front[-1] < 550.0


def test_full_currents_are_limited_by_the_relief_valve_under_what_the_casing_bears():
    states = steps(parameters(OPEN_INTAKE), 1.0, ((0.0, 0.0, 0.0, 1.0), (0.1, 1.1, 1.1, 1.0)))
    assert 195e5 < states.state.supply.front_pressure.max() < 210e5
    assert states.energy.supply.relief[-1] > 100.0


def test_a_sealed_front_motor_that_is_turned_draws_oil_from_the_reservoir():
    run = held(fail_safe=lambda t: float(t < 1.0), twist=lambda t: 0.5 * max(t - 1.0, 0.0), seconds=1.3)
    motor = run.outputs.front.motor
    assert min(motor.pressure_a.min(), motor.pressure_b.min()) < -0.2e5
    assert run.outputs.front.energy.check[-1] > 0.0


def refused(*settings, cycle="bench_step_1deg"):
    with pytest.raises(InputError) as error:
        simulation_of(read_inputs(cycle, "valve_controlled", settings=[f"actuator.{each}" for each in settings]))
    return str(error.value)


def test_a_rig_without_a_road_has_no_engine():
    assert "which this rig has not; allowed: constant, table" in refused("drive={kind: engine}")


def test_a_sample_time_is_a_whole_multiple_of_the_step():
    assert "control.sample_time: 0.0033 s is not a whole multiple" in refused("control.sample_time=3.3 ms")


def test_a_valve_holds_what_the_unit_may_ask_for():
    text = refused("block.rear_valve.pressure_range=100 bar")
    assert "rear_pressure is 170 bar, which block.rear_valve does not hold; allowed: up to" in text
    assert "100 bar" in text
