"""Loss polynomial: flow or torque loss of a displacement machine over stroke, speed and pressure (eqs. 21 to 23).

    loss = norm * sum over i, j, k of k_ijk X^i (n/n_norm)^j (dp/p_norm)^k,  i <= p, j <= q, k <= r

X = V/V_norm is the stroke, for V_norm is the full displacement. (Eqs. 21 and 22 print the powers around the numerators
alone: a slip, for the terms would then have units.) Every variable is a size: |X|, |n| and |dp|, the same in all four
quadrants. A polynomial fitted to measurements can be negative somewhere; there the loss is zero, so that no machine
gives energy.
"""

import re
from typing import Annotated, ClassVar

import numpy as np
from pydantic import AfterValidator

from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Number, Parameters, Quantity

HIGHEST = 4  # order in each variable
ROUNDING = 0.01  # of p_norm, over which a flow loss that is there without pressure takes its direction

TERM = re.compile(rf"k_([0-{HIGHEST}])([0-{HIGHEST}])([0-{HIGHEST}])")


def _check_terms(coefficients: dict[str, float]) -> dict[str, float]:
    for name in coefficients:
        if not TERM.fullmatch(name):
            raise ValueError(
                f"'{name}' is no coefficient; allowed: k_ijk with the orders i of the stroke, j of the speed and k of "
                f"the pressure, each 0 to {HIGHEST}"
            )
    return coefficients


def _check_rising(ends: tuple[float, float]) -> tuple[float, float]:
    if not ends[0] <= ends[1]:
        raise ValueError("a range goes from its least to its largest value")
    return ends


def _Range(end):  # noqa: N802 (reads as a type)
    return Annotated[tuple[end, end], AfterValidator(_check_rising)]


class Validity(Parameters):
    """The box in which a polynomial holds: least and largest |X|, |n| and |dp|."""

    stroke: _Range(Number(ge=0, le=1))
    speed: _Range(Quantity("rad/s", ge=0))
    pressure: _Range(Quantity("Pa", ge=0))


class LossPolynomial(Parameters):
    """A loss over stroke, speed and pressure; a coefficient that is not named is zero."""

    RECORD: ClassVar[np.dtype] = np.dtype(
        [
            ("norm", "f8"),
            ("normal_speed", "f8"),
            ("normal_pressure", "f8"),
            ("orders", "f8", 3),
            ("table", "f8", (HIGHEST + 1,) * 3),
            ("limits", "f8", (3, 2)),
        ]
    )

    normal_speed: Quantity("rad/s", gt=0)  # n_norm
    normal_pressure: Quantity("Pa", gt=0)  # p_norm
    coefficients: Annotated[dict[str, Number()], AfterValidator(_check_terms)]  # k_ijk
    validity: Validity

    @property
    def terms(self) -> dict[tuple[int, int, int], float]:
        """The coefficients by (i, j, k)."""
        return {tuple(map(int, TERM.fullmatch(name).groups())): value for name, value in self.coefficients.items()}

    @property
    def orders(self) -> tuple[int, int, int]:
        """The orders (p, q, r) of stroke, speed and pressure."""
        return tuple(max(indices) for indices in zip((0, 0, 0), *self.terms, strict=True))

    @property
    def table(self) -> np.ndarray:
        """The coefficients (5, 5, 5), zero above the orders."""
        table = np.zeros((HIGHEST + 1,) * 3)
        for term, value in self.terms.items():
            table[term] = value
        return table

    @property
    def limits(self) -> tuple[tuple[float, float], ...]:
        """Least and largest stroke, speed (rad/s) and pressure (Pa)."""
        return self.validity.stroke, self.validity.speed, self.validity.pressure


class FlowLoss(LossPolynomial):
    """Eq. 21."""

    norm: Quantity("m^3/s", ge=0)  # Q_S,norm


class TorqueLoss(LossPolynomial):
    """Eq. 22."""

    norm: Quantity("Nm", ge=0)  # M_S,norm


@kernel
def even_loss(loss, stroke: float, speed: float, pressure: float) -> float:
    """The loss, >= 0 and the same in all four quadrants: a torque loss (Nm)."""
    without, through = _parts(loss, abs(stroke), abs(speed), 1.0 / loss.normal_pressure * abs(pressure))
    return max(loss.norm * (without + through), 0.0)


@kernel
def odd_loss(loss, stroke: float, speed: float, pressure: float) -> float:
    """The loss with the sign of the pressure: a flow loss (m^3/s), which runs from the high to the low side.

    What a polynomial has without pressure turns with the pressure's sign, which is rounded for that, as a jump could
    not be solved.
    """
    relative = 1.0 / loss.normal_pressure * abs(pressure)
    without, through = _parts(loss, abs(stroke), abs(speed), relative)
    size = max(loss.norm * (min(1.0 / ROUNDING * relative, 1.0) * without + through), 0.0)
    return size if pressure >= 0.0 else -size


@kernel
def beyond(loss, stroke: float, speed: float, pressure: float) -> float:
    """How far a point lies outside the polynomial's range, in widths of the range; 0 inside."""
    limits = loss.limits
    return max(
        _beyond(abs(stroke), limits[0, 0], limits[0, 1]),
        _beyond(abs(speed), limits[1, 0], limits[1, 1]),
        _beyond(abs(pressure), limits[2, 0], limits[2, 1]),
    )


@kernel
def _beyond(value, least, largest):
    return max(value - largest, least - value, 0.0) / max(largest - least, 1e-9 * largest)


@kernel
def _parts(loss, x, speed, y):
    # the sum without its powers of the pressure, and the rest; most polynomials are of first order: no loops for them
    n, table, orders = speed / loss.normal_speed, loss.table, loss.orders
    if max(orders[0], orders[1], orders[2]) <= 1.0:
        return _bilinear(table, x, n, 0), y * _bilinear(table, x, n, 1)
    through = 0.0
    for k in range(int(orders[2]), 0, -1):
        through = y * (through + _plane(table, orders, x, n, k))
    return _plane(table, orders, x, n, 0), through


@kernel
def _bilinear(table, x, n, k):
    return table[0, 0, k] + table[0, 1, k] * n + (table[1, 0, k] + table[1, 1, k] * n) * x


@kernel
def _plane(table, orders, x, n, k):
    # sum over i, j by Horner's scheme
    total = 0.0
    for i in range(int(orders[0]), -1, -1):
        row = 0.0
        for j in range(int(orders[1]), -1, -1):
            row = row * n + table[i, j, k]
        total = total * x + row
    return total
