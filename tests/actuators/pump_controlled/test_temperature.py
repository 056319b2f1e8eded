"""Temperature: what an oil that is not at 50 degC changes in the parameters, and what it must not."""

import pytest
from detailed import drive
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.actuators.pump_controlled.temperature import THICKER, THINNER, at_temperature
from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.hydraulics.oil import fluid, viscosity_ratio
from ars_mujoco.schema.document import read

FULL = read(actuator_schema(), "pump_controlled_full", "actuator").value.front
VERIFICATION = read(actuator_schema(), "pump_controlled", "actuator").value.front


def warmed(circuit, celsius):
    return circuit.model_copy(update={"oil": circuit.oil.model_copy(update={"temperature": 273.15 + celsius})})


@pytest.mark.parametrize("circuit", [FULL, VERIFICATION])
def test_at_50_degrees_a_circuit_is_as_its_file_states_it(circuit):
    assert at_temperature(circuit) == circuit


def test_a_circuit_without_an_oil_has_no_temperature():
    dry = VERIFICATION.model_copy(update={"oil": None})
    assert at_temperature(dry) is dry


@given(st.floats(-40.0, 120.0))
def test_viscous_friction_goes_with_the_viscosity_and_leakage_with_its_inverse(celsius):
    stated = warmed(FULL, celsius)
    ratio, changed = viscosity_ratio(stated.oil), at_temperature(stated)
    assert (ratio > 1.0) == (celsius < 50.0)
    for names, factor in ((THICKER, ratio), (THINNER, 1.0 / ratio)):
        for block, keys in names.items():
            for key in keys:
                before, after = getattr(getattr(FULL, block), key), getattr(getattr(changed, block), key)
                assert after == pytest.approx(factor * before, rel=1e-12)
    assert changed.tank_leakage == pytest.approx(1e-14 / ratio)


def test_a_stated_capacitance_grows_as_the_oil_softens():
    for celsius in (0.0, 100.0):
        stated = warmed(VERIFICATION, celsius)
        softer = fluid(VERIFICATION.oil).bulk_modulus / fluid(stated.oil).bulk_modulus
        assert at_temperature(stated).line.capacitance == pytest.approx(softer * 6e-14)


def test_nothing_else_changes():
    changed = at_temperature(warmed(FULL, 0.0))
    for name in ("servo_valve", "swash_plate", "swash_plate_loop", "relief_valve", "pipe", "charge_pump", "check_valve",
                 "bypass_valve", "fail_safe_valve"):  # fmt: skip
        assert getattr(changed, name) == getattr(FULL, name)
    for block in ("pump", "motor", "control_cylinder", "metering_edge"):
        touched = {*THICKER.get(block, ()), *THINNER.get(block, ())}
        before, after = getattr(FULL, block), getattr(changed, block)
        assert {key for key in type(before).model_fields if getattr(before, key) != getattr(after, key)} == touched


def test_cold_oil_costs_friction_and_lines_and_saves_leakage():
    cold, warm = (
        drive("bench_step_10deg", "full", "full", f"actuator.front.oil.temperature={celsius} degC")
        for celsius in (0, 80)
    )
    for name, at_least in (("line", 2.0), ("friction", 1.5)):
        assert cold[f"front.energy.{name}"][-1] > at_least * warm[f"front.energy.{name}"][-1], name
    for name in ("pump_leakage", "motor_leakage"):
        assert 4.0 * cold[f"front.energy.{name}"][-1] < warm[f"front.energy.{name}"][-1], name
