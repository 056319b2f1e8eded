"""Stiffest: the one value of an actuator's file, or of its bar, that makes its equations too fast for a step."""

from collections.abc import Callable, Iterator
from math import log
from typing import Any

from ars_mujoco.actuators.system import Car
from ars_mujoco.kernels.substeps import TooFastError
from ars_mujoco.schema.errors import ArsError, InputError
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.units import Unit

NUDGE = 0.01  # share of a value
Fill = Callable[[Parameters, Car], None]


def told(error: TooFastError, fill: Fill, file: Parameters, car: Car) -> InputError:
    """`error`, with the value by which the fastest eigenvalue changes most; `fill` raised it from `file` and `car`."""
    # less of a value may bring what is nearly right under the limit; then more of it tells
    growths = _growths(error, fill, file, car, 1.0 - NUDGE) or _growths(error, fill, file, car, 1.0 + NUDGE)
    if not growths:
        return error
    growth, key, value = max(growths, key=lambda each: abs(each[0]))
    return InputError(f"{key}: {value} is too {'large' if growth > 0.0 else 'small'}: {error}")


def _growths(
    error: TooFastError, fill: Fill, file: Parameters, car: Car, factor: float
) -> list[tuple[float, str, str]]:
    """(growth of the fastest eigenvalue with a value, a power of it, the value's key, itself as a text) of each."""
    return [
        (log(faster / error.fastest) / log(factor), key, value)
        for key, value, changed, changed_car in _nudged(file, car, factor)
        if (faster := _fastest(fill, changed, changed_car))
    ]


def _fastest(fill: Fill, file: Parameters, car: Car) -> float | None:
    """The fastest eigenvalue (1/s) where there are still too many substeps."""
    try:
        fill(file, car)
    except TooFastError as error:
        return error.fastest
    except (ArsError, ArithmeticError, ValueError):  # as far as a nudge leads out of what can be
        return None
    return None


def _nudged(file: Parameters, car: Car, factor: float) -> Iterator[tuple[str, str, Parameters, Car]]:
    """(key, value as it is, file, car) with one value times `factor`."""
    for key, value, changed in _each(file, factor):
        yield f"actuator.{key}", value, changed, car
    for axle in ("front", "rear"):
        if torsion := getattr(car, axle):
            stiffer = torsion._replace(stiffness=factor * torsion.stiffness)
            value = f"{torsion.stiffness:g} Nm/rad"
            yield f"vehicle: the {axle} bar's stiffness", value, file, car._replace(**{axle: stiffer})


def _each(block: Parameters, factor: float, way: str = "") -> Iterator[tuple[str, str, Parameters]]:
    for name, field in type(block).model_fields.items():
        value: Any = getattr(block, name)
        unit = next((item.symbol for item in field.metadata if isinstance(item, Unit)), None)
        if isinstance(value, Parameters):
            for key, told, inner in _each(value, factor, f"{way}{name}."):
                yield key, told, block.model_copy(update={name: inner})
        elif unit not in (None, "K") and isinstance(value, float) and value != 0.0:  # a temperature has limits
            told = f"{value:g} {unit}".removesuffix(" 1")
            yield f"{way}{name}", told, block.model_copy(update={name: factor * value})
