"""The one place that turns users' units into SI: "1.8 cm^3/rev" becomes 2.865e-7 (m^3/rad).

Angle is a dimension of its own here, so that a displacement a revolution cannot pass for one a radian, nor 60 Hz for
60 rad/s. A lone g is standard gravity, never gram. Temperatures in degC are points of the scale, not differences.
"""

import math
import re
import tokenize
from functools import cache
from typing import Any

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

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
revolution = 2 * pi * radian = rev
minute = 60 * second = min
hour = 3600 * second = h
hertz = 1 / second = Hz
revolution_per_minute = revolution / minute = rpm
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
degree_celsius = kelvin; offset: 273.15 = degC
percent = 0.01 = %
""".replace("pi", repr(math.pi))

# what an error offers: the spellings engineers use, of whichever dimension was asked for
SPELLINGS = (
    "m cm mm km s ms min h kg rad deg rev 1/rad 1/deg 1/m 1/s Hz rad/s deg/s rpm m/s km/h m/s^2 g rad/m deg/m deg/g "
    "N kN N/m kN/m N/mm Ns/m kNs/m Nm kNm J kJ Nm/rad Nm/deg kNm/rad Nms/rad Nms/deg kg*m^2 rad/s^2 "
    "Pa kPa MPa bar cm^3 L m^3 cm^3/rev cm^3/rad m^3/rad L/min m^3/s m^3/s/Pa m^3/Pa W kW 1 % "
    "kg/m^3 m^2/s mm^2/s 1/Pa 1/bar K degC A mA V mV ohm mohm H mH uH F mF uF V*s V*s/rad Nm/A W*s^2/rad^2"
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
    factor, dimension = measure(written or "1")
    own_factor, own_dimension = measure(unit)
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


@cache
def measure(unit: str) -> tuple[float, object]:
    """The size of `unit` in base units, and its dimension. Raises ValueError naming the nearest unit."""
    import pint

    try:
        factor, base = registry().get_base_units(registry().parse_units("" if unit == "1" else unit))
    except pint.UndefinedUnitError as error:
        name = error.unit_names if isinstance(error.unit_names, str) else error.unit_names[0]
        names = [*SPELLINGS, *registry()]
        raise ValueError(f"unknown unit '{name}'{did_you_mean(unit, names) or did_you_mean(name, names)}") from None
    except (AssertionError, ArithmeticError, TypeError, ValueError, pint.PintError, tokenize.TokenError):
        raise ValueError(f"'{unit}' is not a unit; written like 'kg*m^2' or 'm^3/s/Pa'") from None
    return float(factor), registry().get_dimensionality(base)


@cache
def zero(unit: str) -> float:
    """Where the scale of `unit` begins, in base units: 273.15 (K) for degC, 0 for units that are plain factors."""
    return float(registry().Quantity(0.0, "" if unit == "1" else unit).to_base_units().magnitude)


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
