"""Users' units become SI once, and what is not a quantity of the asked dimension is refused in one clear line."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.schema.units import SPELLINGS, measure, to_si

SAME = {
    "cm^3/rev": ("cm3/rev", "cm³/rev", "cc/rev", "ccm/U", "cm^3/r", "cm3/U"),
    "rpm": ("1/min", "U/min", "min^-1", "min-1", "min⁻¹", "/min", "RPM", "rev/min", "r/min"),
    "L/min": ("l/min", "lpm", "LPM"),
    "Nm": ("N·m", "N*m", "N m", "N-m", "N.m"),
    "lbf*ft": ("lbf-ft", "ft-lbf", "ft-lb", "lb-ft", "ft·lb", "lb ft"),
    "lbf*in": ("in-lbf", "in-lb", "lb·in"),
    "gpm": ("GPM", "gal/min"),
    "psi": ("PSI", "lbf/in^2", "lbf/in²"),
    "degC": ("°C",),
    "degF": ("°F",),
    "kg*m^2": ("kg m^2", "kg·m²", "kg m2"),
    "us": ("µs", "μs"),
}

finite = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e12, max_value=1e12)


@pytest.mark.parametrize(
    ("written", "unit", "expected"),
    [
        ("1.8 cm^3/rev", "m^3/rad", 1.8e-6 / (2 * math.pi)),
        ("3000 rpm", "rad/s", 100 * math.pi),
        ("180 bar", "Pa", 18e6),
        ("120 km/h", "m/s", 100 / 3),
        ("57.5 deg/s", "rad/s", math.radians(57.5)),
        ("0.3 g", "m/s^2", 0.3 * 9.80665),
        ("6 deg/g", "rad*s^2/m", math.radians(6) / 9.80665),
        ("1450 kg", "kg", 1450.0),
        ("5.157 Nm", "N*m", 5.157),
        ("1.4 kNm", "N*m", 1400.0),
        ("16.5 Nms/rad", "N*m*s/rad", 16.5),
        ("1750 Ns/m", "N*s/m", 1750.0),
        ("20.5 kN/m", "N/m", 20500.0),
        ("60 L/min", "m^3/s", 1e-3),
        ("10 ms", "s", 0.01),
        ("420 rad/s", "rad/s", 420.0),
        ("2e5 Nm/rad", "N*m/rad", 2e5),
        ("4e-13 m^3/s/Pa", "m^3/s/Pa", 4e-13),
        ("-.5 m", "m", -0.5),
        ("120km/h", "m/s", 100 / 3),
        ("50 degC", "K", 323.15),
        ("32 mm^2/s", "m^2/s", 32e-6),
        ("48 V", "W/A", 48.0),
        ("2.5 mohm", "V/A", 2.5e-3),
        ("80 uH", "V*s/A", 80e-6),
        ("5 mF", "A*s/V", 5e-3),
        ("9 Wb", "V*s", 9.0),
        ("0.05 Nm/A", "Nm/A", 0.05),
        ("0.05 V*s/rad", "V*s/rad", 0.05),
        ("2e-5 W*s^2/rad^2", "W/(rad/s)^2", 2e-5),
        ("2600 psi", "Pa", 2600 * 0.45359237 * 9.80665 / 0.0254**2),
        ("5 gpm", "m^3/s", 5 * 231 * 0.0254**3 / 60),
        ("1 gal", "m^3", 3.785411784e-3),
        ("0.11 in^3/rev", "m^3/rad", 0.11 * 0.0254**3 / (2 * math.pi)),
        ("12 lbf*in", "Nm", 12 * 0.45359237 * 9.80665 * 0.0254),
        ("3500 lb", "kg", 3500 * 0.45359237),
        ("1.6 t", "kg", 1600.0),
        ("60 mph", "m/s", 26.8224),
        ("46 cSt", "m^2/s", 46e-6),
        ("122 degF", "K", 323.15),
        ("0.1 %", "1", 0.001),
        ("1e-3", "1", 0.001),
        (0.6, "1", 0.6),
    ],
)
def test_what_engineers_write_becomes_si(written, unit, expected):
    assert to_si(written, unit) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(("unit", "spelling"), [(unit, each) for unit, others in SAME.items() for each in others])
def test_a_unit_means_the_same_however_it_is_written(unit, spelling):
    base = next(name for name in (*SPELLINGS, "s", "kg*m^2") if measure(name)[1] == measure(unit)[1])
    assert to_si(f"3 {spelling}", base) == pytest.approx(to_si(f"3 {unit}", base), rel=1e-14)


@given(number=finite, unit=st.sampled_from(SPELLINGS))
def test_a_quantity_in_its_own_unit_is_its_number(number, unit):
    assert to_si(f"{number!r} {unit}", unit) == number


@given(number=finite, unit=st.sampled_from(SPELLINGS), other=st.sampled_from(SPELLINGS))
def test_a_conversion_there_and_back_returns_the_number(number, unit, other):
    if measure(unit)[1] != measure(other)[1]:
        with pytest.raises(ValueError, match=r"wrong unit; allowed: |needs a unit: "):
            to_si(f"{number!r} {unit if unit != '1' else ''}", other)
        return
    there = to_si(f"{number!r} {unit}", other)
    assert to_si(f"{there!r} {other}", unit) == pytest.approx(number, rel=1e-14)


@pytest.mark.parametrize(
    ("written", "unit", "message"),
    [
        ("1.8 cm^3", "m^3/rad", "wrong unit; allowed: cm^3/rev, cm^3/rad or m^3/rad"),
        ("60 Hz", "rad/s", "wrong unit; allowed: rad/s, deg/s or rpm"),
        ("42 g", "kg", "wrong unit; allowed: kg, t or lb"),
        ("5 m/s", "m", "wrong unit; allowed: m, cm, mm, km, in or ft"),
        ("50", "K", "needs a unit: K, degC or degF"),
        ("50 deg", "K", "wrong unit; allowed: K, degC or degF"),
        ("3 deg", "1", "wrong unit; allowed: a bare number or %"),
        ("3", "m", "needs a unit: m, cm, mm, km, in or ft"),
        ("3 A", "V", "wrong unit; allowed: V or mV"),
        (3, "m/s", "needs a unit: m/s, km/h or mph"),
        ("3000 rqm", "rad/s", "unknown unit 'rqm'; did you mean 'rpm'?"),
        ("1 s**9**9**9", "s", "'s**9**9**9' is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'"),
        ("1 ((m^9)^9)^9", "m", "'((m^9)^9)^9' is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'"),
        ("1 m^99999999", "m", "'m^99999999' is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'"),
        (
            f"1 {'m*' * 50_000}m",
            "m",
            f"'{'m*' * 20}... (100001 characters)' is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'",
        ),
        ("120 kmh", "m/s", "unknown unit 'kmh'; did you mean 'km/h'?"),
        ("3 xyz", "m", "unknown unit 'xyz'"),
        ("3 m/", "m", "'m/' is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'"),
        ("nan m", "m", "not a finite number"),
        ("inf m", "m", "not a finite number"),
        ("1e999 m", "m", "not a finite number"),
        (math.nan, "1", "not a finite number"),
        (True, "1", "not a finite number"),
        ("", "m", "not a finite number"),
    ],
)
def test_a_refusal_says_what_is_allowed(written, unit, message):
    with pytest.raises(ValueError) as refusal:
        to_si(written, unit)
    assert str(refusal.value) == message


@pytest.mark.parametrize(
    ("written", "limits", "message"),
    [
        ("400 bar", {"le": 3e7}, "must be at most 300 bar"),
        ("-1 bar", {"ge": 0}, "must be at least 0 bar"),
        ("0 Pa", {"gt": 0}, "must be greater than 0 Pa"),
        ("4 MPa", {"lt": 4e6}, "must be less than 4 MPa"),
    ],
)
def test_a_limit_is_told_in_the_users_unit(written, limits, message):
    with pytest.raises(ValueError, match=message):
        to_si(written, "Pa", **limits)


@pytest.mark.parametrize(("written", "limit"), [("200 degC", "150 degC"), ("500 K", "423.15 K")])
def test_a_limit_of_a_temperature_is_told_on_the_users_scale(written, limit):
    with pytest.raises(ValueError, match=f"must be at most {limit}"):
        to_si(written, "K", le=423.15)
