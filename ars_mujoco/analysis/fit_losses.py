"""Fit losses: the loss polynomials of a pump (paper eqs. 21 to 24) from measured points, by least squares.

Columns of measured points, their signs and their reader stand in `measurements`.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ars_mujoco.analysis.figure import ACCENT, DARK, label, save
from ars_mujoco.analysis.measurements import UNITS, Measurements, read_measurements
from ars_mujoco.hydraulics.loss_polynomial import HIGHEST, FlowLoss, LossPolynomial, TorqueLoss, Validity
from ars_mujoco.recording.folder import write_whole
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.quotation import quoted
from ars_mujoco.schema.units import measure, to_si

SCHEMA_VERSION = 1
NAME = "fit_losses"

WORST_CONDITION = 1e10  # of the scaled least squares, beyond which the points do not tell the coefficients apart
GRID = 21  # points along each side of the range, where the polynomial is looked at for negative losses

Orders = tuple[int, int, int]  # p, q, r of stroke, speed and pressure


@dataclass(frozen=True)
class Fit:
    """A loss polynomial and how it fits `measured` losses (n,); residuals (n,) are measured less fitted.

    `errors` are the coefficients' standard errors by name, None where there are no more points than coefficients;
    `condition` is that of the least squares with columns of equal size; `least` is the smallest loss in the range,
    negative where the polynomial would give energy (the simulation takes zero there).
    """

    loss: LossPolynomial
    measured: np.ndarray
    residuals: np.ndarray
    errors: dict[str, float] | None
    condition: float
    least: float

    @property
    def r_squared(self) -> float | None:
        """Share of the measured losses' variance that is explained; None where they are all the same."""
        variance = np.sum((self.measured - self.measured.mean()) ** 2)
        return float(1.0 - np.sum(self.residuals**2) / variance) if variance > 0.0 else None


def fit(points: Measurements, orders: Orders) -> tuple[Fit, Fit]:
    """The polynomials of flow and torque loss, of these orders.

    Normal values are the full displacement and the largest speed and pressure, the range is that of the points. Raises
    InputError where the points do not determine (p+1)(q+1)(r+1) coefficients (eq. 23).
    """
    sizes = {"stroke": np.abs(points.stroke), "speed": points.speed, "pressure": np.abs(points.pressure)}
    _check_enough(sizes, orders)
    normal = {name: 1.0 if name == "stroke" else float(values.max()) for name, values in sizes.items()}
    validity = Validity.model_construct(
        **{name: _range(values, 1.0 if name == "stroke" else np.inf) for name, values in sizes.items()}
    )
    x, n, y = (values / normal[name] for name, values in sizes.items())
    design = np.column_stack([x**i * n**j * y**k for i, j, k in _terms(orders)])
    shared = {"normal_speed": normal["speed"], "normal_pressure": normal["pressure"], "validity": validity}
    flow = {"norm": points.displacement * normal["speed"]} | shared
    torque = {"norm": points.displacement * normal["pressure"]} | shared
    return (
        _least_squares(FlowLoss, flow, orders, design, points.flow_loss),
        _least_squares(TorqueLoss, torque, orders, design, points.torque_loss),
    )


def _range(values: np.ndarray, most: float) -> tuple[float, float]:
    """Least and largest of `values`, neither over `most`."""
    return min(float(values.min()), most), min(float(values.max()), most)


def _terms(orders: Orders) -> list[Orders]:
    return list(product(*(range(order + 1) for order in orders)))


def _check_enough(sizes: Mapping[str, np.ndarray], orders: Orders) -> None:
    told, problems = " ".join(map(str, orders)), []
    if not all(0 <= order <= HIGHEST for order in orders):
        raise InputError(f"--orders {told}: each is 0 to {HIGHEST}")
    for (name, values), order in zip(sizes.items(), orders, strict=True):
        levels = len(np.unique(values))
        if not values.max() > 0.0:
            problems.append(f"{name}: is zero at every point")
        elif levels <= order:
            problems.append(f"{name}: order {order} needs at least {order + 1} different values, not {levels}")
    count, needed = len(sizes["speed"]), len(_terms(orders))
    if count < needed:
        problems.append(f"--orders {told}: {needed} coefficients need at least as many points, not {count}")
    if problems:
        raise InputError(*problems)


def _least_squares(
    kind: type[LossPolynomial], shared: Mapping[str, Any], orders: Orders, design: np.ndarray, measured: np.ndarray
) -> Fit:
    """Least squares with the columns of `design` (n, m) scaled to the same size."""
    with np.errstate(all="ignore"):  # told below
        relative = measured / shared["norm"]
    if not (np.isfinite(design).all() and np.isfinite(relative).all()):
        raise InputError("the points lie too far apart, or too near to zero, for a fit")
    scale = np.linalg.norm(design, axis=0)
    _, singular, right = np.linalg.svd(design / scale, full_matrices=False)
    condition = singular[0] / singular[-1] if singular[-1] > 0.0 else np.inf
    if condition > WORST_CONDITION:
        raise InputError(
            f"the points do not tell the {len(scale)} coefficients apart (condition number {condition:.1e}): "
            "measure each stroke, speed and pressure with each other, or lower an order"
        )
    scaled, *_ = np.linalg.lstsq(design / scale, relative, rcond=None)
    names = ["k_{}{}{}".format(*term) for term in _terms(orders)]
    residuals = measured - shared["norm"] * (design / scale @ scaled)
    free = len(measured) - len(names)
    errors = None
    if free > 0:
        noise = np.sqrt(np.sum((residuals / shared["norm"]) ** 2) / free)
        spread = np.sqrt(np.sum((right / singular[:, None]) ** 2, axis=0))
        errors = dict(zip(names, (noise * spread / scale).tolist(), strict=True))
    coefficients = dict(zip(names, (scaled / scale).tolist(), strict=True))
    loss = kind.model_construct(**shared, coefficients=coefficients)
    return Fit(loss, measured, residuals, errors, float(condition), _least(loss))


def _least(loss: LossPolynomial) -> float:
    """The polynomial's smallest value on a grid over its range, negative ones as they are."""
    stroke, speed, pressure = (np.linspace(*limits, GRID) for limits in loss.limits)
    sides = stroke, speed / loss.normal_speed, pressure / loss.normal_pressure
    return float(loss.norm * np.polynomial.polynomial.polygrid3d(*sides, loss.table).min())


def fit_losses(
    path: Path,
    orders: Orders,
    folder: Path,
    displacement: str | None = None,
    scale_to: str | None = None,
    units: str | None = None,
) -> dict[str, Any]:
    """Fit both losses to the points in `path`; write losses.yaml, a figure and the numbers into `folder`.

    `displacement` is that of the full stroke and `scale_to` that of a similar pump for which losses.yaml is written,
    both with units; `units` of columns whose header has none are written speed=rpm,pressure=bar. Returns the numbers.
    Raises InputError before anything is written.
    """
    points = read_measurements(path, _displacement("--displacement", displacement), _units(units))
    written_for = _displacement("--scale-to", scale_to) or points.displacement
    try:
        flow, torque = fit(points, orders)
    except InputError as error:
        raise InputError(*(f"{path}: {problem}" for problem in error.problems)) from None
    ratio = written_for / points.displacement
    result = {
        "schema_version": SCHEMA_VERSION,
        "data": str(path),
        "points": len(points.speed),
        "largest_stroke": float(np.abs(points.stroke).max()),
        "orders": list(orders),
        "displacement": {"value": points.displacement, "unit": "m^3/rad"},
        "flow_loss": _numbers(flow, "m^3/s"),
        "torque_loss": _numbers(torque, "Nm"),
        "scaled_to": {
            "displacement": {"value": written_for, "unit": "m^3/rad"},
            "flow_loss": flow.loss.scaled(ratio).model_dump(mode="json"),
            "torque_loss": torque.loss.scaled(ratio).model_dump(mode="json"),
        },
    }
    folder.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result, indent=2, allow_nan=False) + "\n"
    block = _block(path, written_for, flow.loss.scaled(ratio), torque.loss.scaled(ratio))
    write_whole(folder / f"{NAME}.json", lambda part: part.write_text(text))
    write_whole(folder / "losses.yaml", lambda part: part.write_text(block))
    save(draw(points, flow, torque), folder, NAME)
    return result


def _displacement(option: str, text: str | None) -> float | None:
    try:
        return None if text is None else to_si(text, UNITS["displacement"], gt=0.0)
    except ValueError as error:
        raise InputError(f"{option} '{text}': {error}") from None


def _units(text: str | None) -> dict[str, str]:
    pairs = [pair.partition("=") for pair in text.split(",")] if text else []
    if not all(name.strip() and unit.strip() for name, _, unit in pairs):
        raise InputError(f"--units {quoted(text)}: written as column=unit, such as speed=rpm,pressure=bar")
    return {name.strip(): unit.strip() for name, _, unit in pairs}


def _numbers(fit: Fit, unit: str) -> dict[str, Any]:
    return {
        **fit.loss.model_dump(mode="json"),
        "unit": unit,
        "standard_errors": fit.errors,
        "residual_rms": float(np.sqrt(np.mean(fit.residuals**2))),
        "residual_max": float(np.abs(fit.residuals).max()),
        "r_squared": fit.r_squared,
        "condition": fit.condition,
        "least_loss": fit.least,
    }


def rows(result: Mapping[str, Any]) -> list[dict[str, str]]:
    """A table of both fits; the coefficients, with their standard errors, are shares of the norm."""
    flow, torque = _told(result["flow_loss"], 6e4, "L/min"), _told(result["torque_loss"], 1.0, "Nm")
    return [{"quantity": name, "flow loss": flow[name], "torque loss": torque[name]} for name in flow]


def _told(numbers: Mapping[str, Any], factor: float, unit: str) -> dict[str, str]:
    amounts = {
        "norm": "norm",
        "residual, rms": "residual_rms",
        "residual, largest": "residual_max",
        "least in the range": "least_loss",
    }
    r_squared, errors = numbers["r_squared"], numbers["standard_errors"]
    return {
        **{title: f"{factor * numbers[key]:.4g} {unit}" for title, key in amounts.items()},
        "R^2": "-" if r_squared is None else f"{r_squared:.5f}",
        "condition number": f"{numbers['condition']:.2g}",
        **{
            name: f"{value:.5g}" + (f" +- {errors[name]:.1g}" if errors else "")
            for name, value in numbers["coefficients"].items()
        },
    }


def remarks(result: Mapping[str, Any]) -> list[str]:
    """What has to be said about the fits."""
    count, told = len(_terms(result["orders"])), []
    if result["points"] == count:
        told.append(f"{count} points for {count} coefficients: the fit goes through each, errors say nothing of it")
    if (most := result["largest_stroke"]) > 1.0:
        told.append(f"the largest stroke is {100 * most:.4g} % of the full one: taken for scatter, as it is")
    return told + [
        f"the {name.replace('_', ' ')} is negative somewhere in its range; the simulation takes zero there"
        for name in ("flow_loss", "torque_loss")
        if result[name]["least_loss"] < 0.0
    ]


def _block(path: Path, displacement: float, flow: FlowLoss, torque: TorqueLoss) -> str:
    """The keys of a pump in an actuator's file."""
    lines = [
        f"# Losses fitted to {path.name}: in the block `pump:` of an actuator's file they replace",
        "# displacement, leakage, flow_loss and torque_loss.",
        f"displacement: {_written(displacement, 'cm^3/rev', 'm^3/rad')}",
        "leakage: 0 m^3/s/Pa  # the flow loss holds all of it",
    ]
    for name, loss, unit, si in (("flow_loss", flow, "L/min", "m^3/s"), ("torque_loss", torque, "Nm", "Nm")):
        ranges = {
            "stroke": [f"{end:.10g}" for end in loss.validity.stroke],
            "speed": [_written(end, "rpm", "rad/s") for end in loss.validity.speed],
            "pressure": [_written(end, "bar", "Pa") for end in loss.validity.pressure],
        }
        lines += [
            f"{name}:",
            f"  norm: {_written(loss.norm, unit, si)}",
            f"  normal_speed: {_written(loss.normal_speed, 'rpm', 'rad/s')}",
            f"  normal_pressure: {_written(loss.normal_pressure, 'bar', 'Pa')}",
            "  coefficients:",
            *(f"    {key}: {value:.10g}" for key, value in loss.coefficients.items()),
            "  validity:",
            *(f"    {key}: [{ends[0]}, {ends[1]}]" for key, ends in ranges.items()),
        ]
    return "\n".join(lines) + "\n"


def _written(value: float, unit: str, si: str) -> str:
    return f"{value * measure(si)[0] / measure(unit)[0]:.10g} {unit}"


def draw(points: Measurements, flow: Fit, torque: Fit) -> Figure:
    """Fitted over measured losses, and what is left over the pressure."""
    figure = Figure(figsize=(10.0, 7.0), layout="constrained")
    axes = figure.subplots(2, 2)
    cases = ("Flow loss", flow, 6e4, "L/min"), ("Torque loss", torque, 1.0, "Nm")
    for (over, left), (title, fitted, factor, unit) in zip(axes, cases, strict=True):
        measured, residuals = factor * fitted.measured, factor * fitted.residuals
        ends = [min(measured.min(), 0.0), measured.max()]
        over.plot(ends, ends, color=ACCENT, lw=1.0, label="measured = fitted")
        over.plot(measured, measured - residuals, "o", ms=3.0, color=DARK, label=f"{len(measured)} points")
        label(over, title, f"measured ({unit})", f"fitted ({unit})")
        left.axhline(0.0, color=ACCENT, lw=1.0)
        left.plot(1e-5 * points.pressure, residuals, "o", ms=3.0, color=DARK)
        label(left, "Measured less fitted", "pressure (bar)", f"residual ({unit})", legend=False)
    return figure
