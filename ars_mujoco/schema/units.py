"""The one place that turns users' units into SI: "1.8 cm^3/rev" becomes 2.865e-7 (m^3/rad).

Angle is a dimension of its own here, so that a displacement a revolution cannot pass for one a radian, nor 60 Hz for
60 rad/s; but where a speed of rotation is asked for, 1/min counts revolutions, as on every data sheet. A lone g is
standard gravity, never gram. Temperatures in degC and degF are points of the scale, not differences. Gallons are those
of the United States, t is the metric ton.
"""

import math
import re
import tokenize
from functools import cache
from typing import Any

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from ars_mujoco.schema.quotation import quoted
from ars_mujoco.schema.suggestion import did_you_mean

DEFINITIONS = """
mega- = 1e6 = M-
kilo- = 1e3 = k-
centi- = 1e-2 = c-
milli- = 1e-3 = m-
micro- = 1e-6 = u- = µ-
meter = [length] = m
second = [time] = s
kilogram = [mass] = kg
radian = [angle] = rad
degree = pi / 180 * radian = deg = °
revolution = 2 * pi * radian = rev = U = r
minute = 60 * second = min
hour = 3600 * second = h
hertz = 1 / second = Hz
revolution_per_minute = revolution / minute = rpm = RPM
gravity = 9.80665 * meter / second ** 2 = g
liter = 1e-3 * meter ** 3 = L = l
newton = kilogram * meter / second ** 2 = N
newton_meter = newton * meter = Nm
newton_second = newton * second = Ns
newton_meter_second = newton * meter * second = Nms
pascal = newton / meter ** 2 = Pa
bar = 1e5 * pascal = bar
joule = newton * meter = J
watt = joule / second = W
kelvin = [temperature] = K
ampere = [current] = A
volt = watt / ampere = V
ohm = volt / ampere = ohm = Ω
henry = volt * second / ampere = H
farad = ampere * second / volt = F
weber = volt * second = Wb
degree_celsius = kelvin; offset: 273.15 = degC = degreeC
degree_fahrenheit = 5 / 9 * kelvin; offset: 255.3722222222222 = degF = degreeF
percent = 0.01 = %
inch = 0.0254 * meter = in
foot = 12 * inch = ft
mile_per_hour = 0.44704 * meter / second = mph
pound = 0.45359237 * kilogram = lb
ton = 1000 * kilogram = t
pound_force = 9.80665 * pound * meter / second ** 2 = lbf
pound_per_square_inch = pound_force / inch ** 2 = psi = PSI
gallon = 231 * inch ** 3 = gal
gallon_per_minute = gallon / minute = gpm = GPM
liter_per_minute = liter / minute = lpm = LPM
cubic_centimeter = 1e-6 * meter ** 3 = cc = ccm
centistokes = 1e-6 * meter ** 2 / second = cSt
""".replace("pi", repr(math.pi))

# the same in ways that a registry cannot read: superscripts, other dots and dashes, exponents without a sign
LOOKS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻·×⋅μ", "0123456789-***µ")
POWERS = re.compile(r"(?<=[\w)])(?=[⁻⁰¹²³⁴⁵⁶⁷⁸⁹])(?<![⁻⁰¹²³⁴⁵⁶⁷⁸⁹])|(?<=[A-Za-z])(?=-?\d)")
DASHES = re.compile(r"(?<=[A-Za-z])[-.](?=[A-Za-z])")  # ft-lbf, N.m
FOOT_POUND = re.compile(r"(ft|in)[* ]lbs?|lbs?[* ](ft|in)")  # a torque, whose pound is a force
EACH_MINUTE = ("1/min", "min^-1", "/min")  # revolutions a minute, where a speed of rotation is asked for

# names joined by * / or a space, each with one digit for an exponent, and parentheses that hold no others: what is
# longer or deeper is not worth what a registry would spend on it
FACTOR = r"(?:1|°|%|°?[^\W\d]+)(?:(?:\^|\*\*)-?\d(?:\.\d)?)?"
PRODUCT = rf"{FACTOR}(?:[*/ ]{FACTOR})*"
GROUP = rf"(?:{PRODUCT}|\({PRODUCT}\)(?:(?:\^|\*\*)-?\d(?:\.\d)?)?)"
WRITTEN = re.compile(rf"{GROUP}(?:[*/ ]{GROUP})*")
LONGEST = 60  # characters

# what an error offers: the spellings engineers use, of whichever dimension was asked for
SPELLINGS = (
    "m cm mm km in ft s ms min h kg t lb rad deg rev 1/rad 1/deg 1/m 1/s Hz rad/s deg/s rpm m/s km/h mph m/s^2 g "
    "rad/m deg/m deg/g N kN lbf N/m kN/m N/mm Ns/m kNs/m Nm kNm lbf*ft lbf*in J kJ Nm/rad Nm/deg kNm/rad Nms/rad "
    "Nms/deg kg*m^2 rad/s^2 Pa kPa MPa bar psi cm^3 L m^3 gal cm^3/rev cm^3/rad m^3/rad L/min m^3/s gpm m^3/s/Pa "
    "m^3/Pa W kW 1 % kg/m^3 m^2/s mm^2/s cSt 1/Pa 1/bar K degC degF A mA V mV ohm mohm H mH uH F mF uF V*s V*s/rad "
    "Nm/A W*s^2/rad^2"
).split()

NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")

LIMITS = {
    "gt": ("greater than", float.__gt__),
    "ge": ("at least", float.__ge__),
    "lt": ("less than", float.__lt__),
    "le": ("at most", float.__le__),
}


class Unit:
    """The SI unit of a field, "1" for a dimensionless one, and the limits (gt, ge, lt, le, in SI) of what a file says.

    In the metadata of a field it reads what a user wrote by `to_si`; an optional field may stay None.
    """

    def __init__(self, symbol: str, **limits: float):
        self.symbol, self.limits = symbol, limits

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        inner = handler(source)
        is_optional = inner["type"] == "nullable"

        def read(value: object) -> float | None:
            return None if value is None and is_optional else to_si(value, self.symbol, **self.limits)

        return core_schema.no_info_before_validator_function(read, inner)


def to_si(value: object, unit: str, **limits: float) -> float:
    """`value` (a text with a unit, or a bare number where `unit` is "1") in the SI unit `unit`.

    `limits` are gt, ge, lt, le in SI. Raises ValueError with what is allowed where there is no finite number, the unit
    is missing, unknown or of another dimension, or a limit is passed; the limit is told in the user's own unit.
    """
    number, written = split(value)
    if not written and unit != "1":
        raise ValueError(f"needs a unit: {allowed(unit)}")
    own_factor, own_dimension = measure(unit)
    if plain(written) in EACH_MINUTE and own_dimension == measure("rpm")[1]:
        written = "rpm"
    factor, dimension = measure(written or "1")
    if dimension != own_dimension:
        raise ValueError(f"wrong unit; allowed: {allowed(unit)}")
    offset = zero(written or "1") - zero(unit)
    result = number * (factor / own_factor) + offset / own_factor
    for name, limit in limits.items():
        words, holds = LIMITS[name]
        if not holds(result, float(limit)):
            raise ValueError(f"must be {words} {(limit * own_factor - offset) / factor:g} {written}".rstrip())
    return result


def split(value: object) -> tuple[float, str]:
    """The number and the unit of what a user wrote: "180 bar" is (180.0, "bar"). Raises ValueError."""
    match = NUMBER_AND_UNIT.fullmatch("" if isinstance(value, bool) else str(value))
    if not match or not math.isfinite(float(match[1])):
        raise ValueError("not a finite number")
    return float(match[1]), match[2]


def plain(unit: str) -> str:
    """`unit` as the registry reads it. Raises ValueError where it is longer than any."""
    if len(unit) > LONGEST:
        raise ValueError(f"{quoted(unit)} is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'")
    text = POWERS.sub("^", " ".join(unit.split()).replace("−", "-")).translate(LOOKS)
    text = re.sub(r" ?([*/^()]) ?", r"\1", DASHES.sub("*", text))
    if match := FOOT_POUND.fullmatch(text):
        return f"lbf*{match[1] or match[2]}"
    return text


@cache
def measure(unit: str) -> tuple[float, object]:
    """The size of `unit` in base units, and its dimension. Raises ValueError naming the nearest unit."""
    import pint

    text = plain(unit)
    if text and not WRITTEN.fullmatch(text):
        raise ValueError(f"{quoted(unit)} is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'")
    try:
        factor, base = registry().get_base_units(registry().parse_units("" if text == "1" else text))
    except pint.UndefinedUnitError as error:
        name = error.unit_names if isinstance(error.unit_names, str) else error.unit_names[0]
        names = [*SPELLINGS, *registry()]
        raise ValueError(
            f"unknown unit {quoted(name)}{did_you_mean(unit, names) or did_you_mean(name, names)}"
        ) from None
    except (AssertionError, ArithmeticError, TypeError, ValueError, pint.PintError, tokenize.TokenError):
        raise ValueError(f"{quoted(unit)} is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'") from None
    return float(factor), registry().get_dimensionality(base)


@cache
def zero(unit: str) -> float:
    """Where the scale of `unit` begins, in base units: 273.15 (K) for degC, 0 for units that are plain factors."""
    return float(registry().Quantity(0.0, "" if unit == "1" else plain(unit)).to_base_units().magnitude)


def allowed(unit: str) -> str:
    """The units of the dimension of `unit` that an error offers: "m, cm, mm or km"."""
    if unit == "1":
        return "a bare number or %"
    dimension = measure(unit)[1]
    same = [name for name in SPELLINGS if measure(name)[1] == dimension] or [unit]
    return " or ".join(filter(None, [", ".join(same[:-1]), same[-1]]))


@cache
def registry() -> Any:
    """Pint's registry with the units above and no others; made on first use, because it takes a quarter second."""
    import pint

    ureg: Any = pint.UnitRegistry(None)
    ureg.load_definitions(DEFINITIONS.strip().splitlines())
    return ureg
