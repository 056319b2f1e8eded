"""The command `ars size`: what a system's parts must be for what is required of its bar."""

from typing import Annotated, Any

import typer

from ars_mujoco.cli.console import print_json, print_table
from ars_mujoco.cli.options import Json
from ars_mujoco.schema.errors import InputError

UNITS = {"torque": "Nm", "rate": "rad/s", "speed": "rad/s", "pressure": "Pa"}
SHOWN = {"torque": "Nm", "rate": "deg/s", "speed": "rpm", "pressure": "bar"}


def size(
    actuator: Annotated[str, typer.Argument(metavar="ACTUATOR", help="Name or path; friction and leakage are its.")],
    torque: Annotated[
        str | None, typer.Option(help="At the bar, as '1400 Nm'; else what its file was made for.")
    ] = None,
    rate: Annotated[str | None, typer.Option(help="Between the bar's halves, as '57.5 deg/s'.")] = None,
    speed: Annotated[str | None, typer.Option(help="Of pump or machine at that rate, as '3000 rpm'.")] = None,
    pressure: Annotated[str | None, typer.Option(help="Over the motor at that torque, as '180 bar'.")] = None,
    as_json: Json = False,
) -> None:
    """Size an axle's motor, pump, gear and machine, each by its formula, beside what the actuator's file has."""
    from ars_mujoco.actuators.registry import actuator_schema, module_of
    from ars_mujoco.actuators.sizing import stated
    from ars_mujoco.schema.document import read
    from ars_mujoco.schema.units import measure

    file = read(actuator_schema(), actuator, "actuator", [], None).value
    sizing = getattr(module_of(file), "SIZING", None)
    if sizing is None:
        raise InputError(f"actuator '{actuator}': its kind, {file.kind}, has nothing to size")
    texts = {"torque": torque, "rate": rate, "speed": speed, "pressure": pressure}
    given = {name: _in_si(name, text) for name, text in texts.items()}
    required = stated(sizing.requirement, **given)
    rows = [_row(each) for each in sizing.size(file, required)]
    requirement = {name: value for name, value in required._asdict().items() if value is not None}
    if as_json:
        print_json({"requirement": requirement, "dimensions": rows})
        return
    words = ", ".join(
        f"{name} {value / measure(SHOWN[name])[0]:.4g} {SHOWN[name]}" for name, value in requirement.items()
    )
    print_table(f"{actuator}, an axle of {words}", [_shown(row) for row in rows])


def _in_si(name: str, text: str | None) -> float | None:
    from ars_mujoco.schema.units import to_si

    try:
        return None if text is None else to_si(text, UNITS[name], gt=0.0)
    except ValueError as error:
        raise InputError(f"--{name}: {error}") from None


def _row(dimension: Any) -> dict[str, Any]:
    from ars_mujoco.schema.units import measure

    factor = measure(dimension.unit)[0]
    has = dimension.in_file
    return {
        "part": dimension.name,
        "required": dimension.value / factor,
        "in the file": None if has is None else has / factor,
        "unit": dimension.unit,
        "more than required": None if has is None else has / dimension.value - 1.0,
        "formula": dimension.formula,
    }


def _shown(row: dict[str, Any]) -> dict[str, str]:
    more = row["more than required"]
    figures = {key: "" if row[key] is None else f"{row[key]:.4g}" for key in ("required", "in the file")}
    return {**row, **figures, "more than required": "" if more is None else f"{100.0 * more:+.1f} %"}
