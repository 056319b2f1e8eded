"""Loss polynomial: flow or torque loss of a displacement machine over stroke, speed and pressure (eqs. 21 to 23).

    loss = norm * sum over i, j, k of k_ijk X^i (n/n_norm)^j (dp/p_norm)^k,  i <= p, j <= q, k <= r

X = V/V_norm is the stroke, for V_norm is the full displacement. (Eqs. 21 and 22 print the powers around the numerators
alone: a slip, for the terms would then have units.) Every variable is a size: |X|, |n| and |dp|, the same in all four
quadrants. A polynomial fitted to measurements can be negative somewhere; there the loss is zero, so that no machine
gives energy.
"""

import re
from typing import Annotated, ClassVar, Self

import numpy as np
from pydantic import AfterValidator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity
from ars_mujoco.schema.units import Unit

HIGHEST = 4  # order in each variable
ROUNDING = 0.01  # of p_norm, over which a flow loss that is there without pressure takes its direction

Share = Annotated[float, Unit("1", ge=0, le=1)]
Speed = Annotated[float, Unit("rad/s", ge=0)]
Pressure = Annotated[float, Unit("Pa", ge=0)]

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
    if not 0.0 < ends[1] >= ends[0]:
        raise ValueError("a range goes from its least to its largest value, which is over zero")
    return ends


class Validity(Parameters):
    """The box in which a polynomial holds: least and largest |X|, |n| and |dp|."""

    stroke: Annotated[tuple[Share, Share], AfterValidator(_check_rising)]
    speed: Annotated[tuple[Speed, Speed], AfterValidator(_check_rising)]
    pressure: Annotated[tuple[Pressure, Pressure], AfterValidator(_check_rising)]


class LossPolynomial(Parameters):
    """A loss over stroke, speed and pressure; a coefficient that is not named is zero."""

    RECORD: ClassVar[np.dtype] = np.dtype(
        [
            ("norm", "f8"),
            ("normal_speed", "f8"),
            ("normal_pressure", "f8"),
            ("order", "f8"),
            ("table", "f8", (HIGHEST + 1,) * 3),
            ("limits", "f8", (3, 2)),
        ]
    )

    normal_speed: float = quantity("rad/s", gt=0)  # n_norm
    normal_pressure: float = quantity("Pa", gt=0)  # p_norm
    coefficients: Annotated[dict[str, Annotated[float, Unit("1")]], AfterValidator(_check_terms)]  # k_ijk
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
    def order(self) -> int:
        """The largest of the orders."""
        return max(self.orders)

    @property
    def table(self) -> np.ndarray:
        """The coefficients (5, 5, 5), by i, j, k; zero above the orders."""
        table = np.zeros((HIGHEST + 1,) * 3)
        for term, value in self.terms.items():
            table[term] = value
        return table

    @property
    def limits(self) -> tuple[tuple[float, float], ...]:
        """Least and largest stroke, speed (rad/s) and pressure (Pa)."""
        return self.validity.stroke, self.validity.speed, self.validity.pressure

    def at(self, stroke: float, speed: float, pressure: float) -> float:
        """The loss in SI at a stroke, a speed (rad/s) and a pressure (Pa), none of them negative."""
        n, p = speed / self.normal_speed, pressure / self.normal_pressure
        return self.norm * max(sum(k * stroke**i * n**j * p**m for (i, j, m), k in self.terms.items()), 0.0)

    def scaled(self, ratio: float) -> Self:
        """The loss of a geometrically similar machine of `ratio` times the displacement.

        Lengths grow by l = ratio^(1/3). At the same pressure and the same speed of the sliding parts, that is at n/l,
        its losses are the same shares of its flow and torque: norms go as V n (l^2) and V dp (l^3), n_norm and the
        range of speeds as 1/l, and the coefficients stay.
        """
        length = ratio ** (1.0 / 3.0)
        validity = self.validity.model_copy(update={"speed": tuple(end / length for end in self.validity.speed)})
        return self.model_copy(
            update={
                "norm": self.norm * length**self.GROWTH,
                "normal_speed": self.normal_speed / length,
                "validity": validity,
            }
        )


class FlowLoss(LossPolynomial):
    """Eq. 21."""

    GROWTH: ClassVar[int] = 2  # power of a length that the norm goes with

    norm: float = quantity("m^3/s", ge=0)  # Q_S,norm


class TorqueLoss(LossPolynomial):
    """Eq. 22."""

    GROWTH: ClassVar[int] = 3

    norm: float = quantity("Nm", ge=0)  # M_S,norm


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
    """How far a point lies outside the range of the polynomial, as a share of the range's end; 0 inside."""
    limits = loss.limits
    return max(
        _beyond(abs(stroke), limits[0, 0], limits[0, 1]),
        _beyond(abs(speed), limits[1, 0], limits[1, 1]),
        _beyond(abs(pressure), limits[2, 0], limits[2, 1]),
    )


@kernel
def _beyond(value, least, largest):
    return max(value - largest, least - value, 0.0) / largest


@kernel
def _parts(loss, x, speed, y):
    # the sum without its powers of the pressure, and the rest; loops of a given length, for the compiler unrolls them
    n = speed / loss.normal_speed
    if loss.order <= 1.0:
        return _horner(loss, 1, x, n, y)
    if loss.order <= 2.0:
        return _horner(loss, 2, x, n, y)
    return _horner(loss, HIGHEST, x, n, y)


@kernel
def _horner(loss, order, x, n, y):
    table = loss.table
    without = through = 0.0
    for i in range(order, -1, -1):
        row_without = row_through = 0.0
        for j in range(order, -1, -1):
            powers = 0.0
            for k in range(order, 0, -1):
                powers = (powers + table[i, j, k]) * y
            row_without, row_through = row_without * n + table[i, j, 0], row_through * n + powers
        without, through = without * x + row_without, through * x + row_through
    return without, through
