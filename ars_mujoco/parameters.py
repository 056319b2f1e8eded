"""Parameters: declared once, with symbol, unit, limits and meaning on one line, read from files that carry units.

A subclass of `Parameters` is at once the schema of a YAML block, the documentation of its fields, and the layout of
the record that the compiled kernels read (`record_dtype`), so that no value is named twice.
"""

from functools import partial
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, PlainSerializer, ValidationInfo, model_validator

from ars_mujoco.suggestion import did_you_mean
from ars_mujoco.units import Unit, to_si


def Quantity(unit: str, **limits: float):  # noqa: N802 (reads as a type)
    """The type of a field in `unit` (SI inside); `limits` are gt, ge, lt, le in SI. NaN and infinity are refused."""
    return Annotated[float, Unit(unit), BeforeValidator(partial(to_si, unit=unit, **limits))]


def Number(**limits: float):  # noqa: N802
    """The type of a dimensionless field: a bare number in the file, or a percentage."""
    return Quantity("1", **limits)


def Choice(*names: str):  # noqa: N802
    """The type of a field that is one of `names` in the file, and the place of that name, a float, in the record."""

    def place(value: object) -> float:
        if value not in names:
            raise ValueError(f"unknown{did_you_mean(str(value), names)}; allowed: {', '.join(names)}")
        return float(names.index(value))

    return Annotated[float, BeforeValidator(place), PlainSerializer(lambda value: names[int(value)], when_used="json")]


class Parameters(BaseModel):
    """A block of parameters: unknown keys are errors, values are SI, instances do not change.

    Validated with a dict as context, each block notes there under its id which schema read it, so that an error about
    an unknown key can list the valid ones.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _note_schema(cls, block: Any, info: ValidationInfo) -> Any:
        if info.context is not None:
            info.context[id(block)] = cls
        return block


def record_dtype(model: type[Parameters]) -> np.dtype:
    """The numpy record of `model`: a float64 for each float field, nested blocks as nested records, in field order."""
    return np.dtype(
        [
            (name, _field_dtype(field.annotation))
            for name, field in model.model_fields.items()
            if _kept(field.annotation)
        ]
    )


def fill(record: Any, parameters: Parameters) -> None:
    """Write `parameters` into a numpy record of `record_dtype(type(parameters))`."""
    for name in record.dtype.names:
        value = getattr(parameters, name)
        if isinstance(value, Parameters):
            fill(record[name], value)
        else:
            record[name] = value


def _kept(annotation: Any) -> bool:
    return annotation is float or isinstance(annotation, type) and issubclass(annotation, Parameters)


def _field_dtype(annotation: Any) -> Any:
    return np.float64 if annotation is float else record_dtype(annotation)
