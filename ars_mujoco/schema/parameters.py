"""Parameters: declared once, with symbol, unit, limits and meaning on one line, read from files that carry units.

A subclass of `Parameters` is at once the schema of a YAML block, the documentation of its fields, and the layout of
the record that the compiled kernels read (`record_dtype`), so that no value is named twice.
"""

from collections.abc import Callable
from typing import Any, ClassVar, get_args

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PlainSerializer,
    ValidationInfo,
    create_model,
    model_validator,
)
from pydantic_core import PydanticUndefined

from ars_mujoco.schema.suggestion import did_you_mean
from ars_mujoco.schema.units import Unit


def quantity(unit: str, *, default: Any = PydanticUndefined, validate_default: bool = False, **limits: float) -> Any:
    """A field in `unit` (SI inside); `limits` are gt, ge, lt, le in SI. NaN and infinity are refused.

    `default` is SI; with `validate_default` the schema's own validators judge it too.
    """
    field = Field(default, validate_default=validate_default or None)
    field.metadata.append(Unit(unit, **limits))
    return field


def number(*, default: Any = PydanticUndefined, **limits: float) -> Any:
    """A dimensionless field: a bare number in the file, or a percentage."""
    field = Field(default)
    field.metadata.append(Unit("1", **limits))
    return field


def choice(*names: str, default: Any = PydanticUndefined) -> Any:
    """A field that is one of `names` in the file, and the place of that name, a float, in the record."""

    def place(value: object) -> float:
        if value not in names:
            raise ValueError(f"unknown{did_you_mean(str(value), names)}; allowed: {', '.join(names)}")
        return float(names.index(value))

    field = Field(default)
    field.metadata += [BeforeValidator(place), PlainSerializer(lambda value: names[int(value)], when_used="json")]
    return field


def _blank(made_by: Callable[[], type]) -> Any:
    made: Any = made_by()
    return made.__new__(made)


class Parameters(BaseModel):
    """A block of parameters: unknown keys are errors, values are SI, instances do not change.

    Validated with a dict as context, each block notes there under its id which schema read it, so that an error about
    an unknown key can list the valid ones.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    RECORD: ClassVar[np.dtype | None] = None  # of a block whose record is not its fields, but what these attributes are
    MOVED: ClassVar[dict[str, str]] = {}  # keys of older files, and where each went
    MADE_BY: ClassVar[Callable[[], type] | None] = None  # of a class that stands in no module: what makes it again

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Pickled as any object, but by what makes its class where that stands in no module."""
        reduced = super().__reduce_ex__(protocol)
        made_by = vars(type(self)).get("MADE_BY")
        return (_blank, (made_by,), *reduced[2:]) if made_by else reduced

    @model_validator(mode="before")
    @classmethod
    def _note_schema(cls, block: Any, info: ValidationInfo) -> Any:
        if info.context is not None:
            info.context[id(block)] = cls
        return block


def derived(base: type[Parameters], name: str, made_by: Callable[[], type], **fields: Any) -> Any:
    """A class `name` of `base` with other `fields`, as create_model takes them; `made_by` can be pickled and makes it
    again.
    """
    made = create_model(name, __base__=base, **fields)
    made.MADE_BY = made_by
    return made


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
