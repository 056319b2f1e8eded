"""Parameters: declared once, with symbol, unit, limits and meaning on one line, read from files that carry units.

A subclass of `Parameters` is at once the schema of a YAML block, the documentation of its fields, and the layout of
the record that the compiled kernels read (`record_dtype`), so that no value is named twice.
"""

from functools import partial
from typing import Annotated, Any, ClassVar, get_args

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

    RECORD: ClassVar[np.dtype | None] = None  # of a block whose record is not its fields, but what these attributes are

    @model_validator(mode="before")
    @classmethod
    def _note_schema(cls, block: Any, info: ValidationInfo) -> Any:
        if info.context is not None:
            info.context[id(block)] = cls
        return block


def record_dtype(model: type[Parameters]) -> np.dtype:
    """The numpy record of `model`: a float64 for each float field, nested blocks as nested records, in field order.

    Blocks that may be absent have their room too; a block with a RECORD of its own has that.
    """
    if model.RECORD:
        return model.RECORD
    kept = {name: _kept(field.annotation) for name, field in model.model_fields.items()}
    return np.dtype(
        [(name, np.float64 if each is float else record_dtype(each)) for name, each in kept.items() if each]
    )


def fill(record: Any, parameters: Parameters) -> None:
    """Write `parameters` into a numpy record of `record_dtype(type(parameters))`; an absent block is all zeros."""
    for name in record.dtype.names:
        value = getattr(parameters, name)
        if isinstance(value, Parameters):
            fill(record[name], value)
        else:
            record[name] = 0.0 if value is None else value


def _kept(annotation: Any) -> type | None:
    """What a record keeps of a field: a float or a block, the latter also where it may be absent; else None."""
    options = [each for each in get_args(annotation) or [annotation] if each is not type(None)]
    (only,) = options if len(options) == 1 else (None,)
    return only if only is float or isinstance(only, type) and issubclass(only, Parameters) else None
