"""Oil: what its data sheet says is found again, and the energy it stores is the work done on it."""

import math

import numpy as np
import pytest
from components import OIL, oil, record_of
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from ars_mujoco.hydraulics.oil import Oil, compressibility, energy_density, fluid, viscosity_ratio
from ars_mujoco.schema.document import Document
from ars_mujoco.schema.errors import InputError

BAR = 1e5
WARM = record_of(oil())
PRESSURES = st.floats(0.01 * BAR, 400 * BAR)


# ---- temperature


@pytest.mark.parametrize(("temperature", "viscosity"), [("40 degC", 32e-6), ("100 degC", 5.5e-6), ("313.15 K", 32e-6)])
def test_at_the_stated_temperatures_it_has_the_stated_viscosities(temperature, viscosity):
    assert fluid(oil(temperature=temperature)).viscosity == pytest.approx(viscosity, rel=1e-9)


def dynamic_viscosity(celsius, at_40, at_100):
    """Dynamic viscosity (mPa s) of an oil with two kinematic ones (mm^2/s)."""
    warm = fluid(oil(viscosity_40=f"{at_40} mm^2/s", viscosity_100=f"{at_100} mm^2/s", temperature=f"{celsius} degC"))
    return 1e3 * warm.viscosity * warm.density


@pytest.mark.parametrize(
    ("at_30", "at_60", "at_100"),
    [(153, 34.0, 9.1), (250, 50.5, 12.6), (122, 26.3, 7.3), (171, 31.0, 7.5), (165, 30.0, 6.8), (310, 44.2, 9.4)],
)
def test_between_two_temperatures_it_is_as_thick_as_published_heavy_machine_oils(at_30, at_60, at_100):
    """In mPa s at 30, 60 and 100 degC: Stachowiak and Batchelor, Engineering Tribology, Table 2.3."""
    kinematic_100 = at_100 / (1e-3 * fluid(oil(temperature="100 degC")).density)
    kinematic_40 = brentq(lambda nu: dynamic_viscosity(30, nu, kinematic_100) - at_30, 1.1 * kinematic_100, 1e3)
    assert dynamic_viscosity(60, kinematic_40, kinematic_100) == pytest.approx(at_60, rel=0.06)


@given(st.floats(-40.0, 149.0))
def test_warmer_oil_is_thinner_lighter_and_softer(celsius):
    cold, warm = (fluid(oil(temperature=f"{each} degC")) for each in (celsius, celsius + 1.0))
    assert warm.viscosity < cold.viscosity
    assert warm.density < cold.density
    assert warm.bulk_modulus < cold.bulk_modulus


def test_density_is_stated_at_15_and_bulk_modulus_at_50_degrees():
    assert fluid(oil(temperature="15 degC")).density == 860.0
    assert fluid(oil(temperature="25 degC")).density == pytest.approx(860.0 * 0.993)
    assert fluid(oil(temperature="50 degC")).bulk_modulus == 1.4e9
    assert fluid(oil(temperature="75 degC")).bulk_modulus == pytest.approx(0.9 * 1.4e9)


def test_friction_and_leakage_are_scaled_from_50_degrees():
    assert viscosity_ratio(oil()) == 1.0
    at_40 = viscosity_ratio(oil(temperature="40 degC"))
    assert at_40 == pytest.approx(32e-6 / fluid(oil()).viscosity)
    assert at_40 > 1.0 > viscosity_ratio(oil(temperature="90 degC"))


# ---- compression


def test_at_high_pressure_the_liquid_alone_counts():
    assert compressibility(WARM, 400 * BAR) == pytest.approx(1 / 1.4e9, rel=1e-3)


def test_at_1_bar_the_air_makes_it_70_times_as_soft():
    assert compressibility(WARM, BAR) * 1.4e9 == pytest.approx(1 + 0.005 * 1.4e9 / BAR)


def test_a_trapped_volume_takes_the_oil_that_its_liquid_and_its_air_make_room_for():
    """0.3 L filled with 0.9 cm^3/s for 2 s from 1 bar: p/K + a_0 p_0 (1/1 bar - 1/p) is the share of oil added."""
    rise = solve_ivp(
        lambda t, p: 0.9e-6 / (0.3e-3 * compressibility(WARM, p[0])), (0.0, 2.0), [BAR], "LSODA", rtol=1e-10
    ).y[0, -1]
    added = (rise - BAR) / 1.4e9 + 0.005 * BAR * (1 / BAR - 1 / rise)
    assert added == pytest.approx(2 * 0.9e-6 / 0.3e-3, rel=1e-6)


def test_oil_drawn_from_a_trapped_volume_never_empties_it_to_zero():
    drawn = solve_ivp(
        lambda t, p: -1e-6 / (0.3e-3 * compressibility(WARM, p[0])), (0.0, 30.0), [BAR], "LSODA", rtol=1e-10
    ).y[0]
    assert np.all(np.diff(drawn) < 0.0)
    assert drawn[-1] == pytest.approx(BAR / (1 + 30e-6 / 0.3e-3 / 0.005), rel=1e-3)  # Boyle: the air fills what is gone


# ---- energy


@pytest.mark.parametrize("pressure", [0.05 * BAR, 0.5 * BAR, 2 * BAR, 20 * BAR, 200 * BAR])
def test_energy_is_the_work_of_the_pressure_over_the_tanks_on_what_is_pressed_in(pressure):
    work, _ = quad(lambda q: (q - BAR) * compressibility(WARM, q), BAR, pressure, epsrel=1e-12, epsabs=0.0, limit=200)
    assert energy_density(WARM, pressure, BAR) == pytest.approx(work, rel=1e-9)


@given(PRESSURES)
def test_the_slope_of_energy_is_pressure_times_compressibility(pressure):
    h = 1e-4 * pressure
    slope = (energy_density(WARM, pressure + h, BAR) - energy_density(WARM, pressure - h, BAR)) / (2 * h)
    size = compressibility(WARM, pressure) * (pressure + BAR)
    assert slope == pytest.approx((pressure - BAR) * compressibility(WARM, pressure), abs=1e-6 * size)


@given(PRESSURES)
def test_no_energy_is_stored_at_the_tanks_pressure_and_some_at_any_other(pressure):
    assert energy_density(WARM, BAR, BAR) == 0.0
    if not math.isclose(pressure, BAR, rel_tol=1e-6):
        assert energy_density(WARM, pressure, BAR) > 0.0


# ---- files


@pytest.mark.parametrize(
    ("key", "written", "message"),
    [
        ("air", "0", "must be greater than 0"),
        ("temperature", "50", "needs a unit: K, degC or degF"),
        ("temperature", "50 deg", "wrong unit; allowed: K, degC or degF"),
        ("temperature", "-60 degC", "must be at least -40 degC"),
        ("viscosity_100", "40 mm^2/s", "must be less than viscosity_40: an oil thins as it warms"),
        ("viscosity_40", "32", "needs a unit: m^2/s, mm^2/s or cSt"),
    ],
)
def test_an_impossible_oil_is_refused_with_its_line_and_what_is_allowed(key, written, message):
    block = OIL | {key: written}
    document = Document("oil.yaml", "\n".join(f"{name}: {value}" for name, value in block.items()))
    with pytest.raises(InputError) as refusal:
        document.validate(Oil)
    line = list(OIL).index(key) + 1
    assert str(refusal.value) == f"oil.yaml:{line}: {key}: '{written}': {message}"
