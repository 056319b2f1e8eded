"""Oil: compressible with its undissolved air, heavy and viscous, each at its temperature."""

import math

from pydantic import ValidationInfo, field_validator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity

REFERENCE_PRESSURE = 1e5  # Pa, at which the share of air is stated
DENSITY_TEMPERATURE = 288.15  # K, 15 degC, at which catalogues state the density
REFERENCE_TEMPERATURE = 323.15  # K, 50 degC, at which bulk modulus, viscous friction and laminar leakages are stated
EXPANSION = 7e-4  # 1/K  J  of a mineral oil
SOFTENING = 4e-3  # 1/K  J  fall of the bulk modulus


class Oil(Parameters):
    """A hydraulic oil as its data sheet states it, and its temperature."""

    bulk_modulus: float = quantity("Pa", gt=0)  # K, of the liquid alone, at 50 degC
    air: float = number(
        gt=0, lt=1
    )  # a_0, undissolved air at 1 bar, share of volume; without any, pressures could pass zero
    density: float = quantity("kg/m^3", gt=0)  # at 15 degC
    temperature: float = quantity("K", ge=233.15 - 1e-6, le=423.15)  # -40 degC, which is no round number of K
    viscosity_40: float = quantity("m^2/s", ge=2e-6)  # kinematic, at 40 degC
    viscosity_100: float = quantity("m^2/s", ge=2e-6)  # at 100 degC

    @field_validator("viscosity_100")
    @classmethod
    def _thins_with_temperature(cls, viscosity: float, info: ValidationInfo) -> float:
        if viscosity >= info.data.get("viscosity_40", math.inf):
            raise ValueError("must be less than viscosity_40: an oil thins as it warms")
        return viscosity


class Fluid(Parameters):
    """An oil at its temperature: what the kernels read."""

    bulk_modulus: float = quantity("Pa", gt=0)
    air: float = number(gt=0, lt=1)
    density: float = quantity("kg/m^3", gt=0)
    viscosity: float = quantity("m^2/s", gt=0)  # kinematic


def fluid(oil: Oil) -> Fluid:
    """`oil` at its temperature; density and bulk modulus fall linearly with it."""
    return Fluid.model_construct(
        bulk_modulus=oil.bulk_modulus * stiffness_ratio(oil),
        air=oil.air,
        density=oil.density * (1.0 - EXPANSION * (oil.temperature - DENSITY_TEMPERATURE)),
        viscosity=_viscosity(oil, oil.temperature),
    )


def stiffness_ratio(oil: Oil) -> float:
    """Bulk modulus at the oil's temperature over that at 50 degC."""
    return 1.0 - SOFTENING * (oil.temperature - REFERENCE_TEMPERATURE)


def viscosity_ratio(oil: Oil) -> float:
    """Viscosity at the oil's temperature over that at 50 degC: viscous friction goes with it, laminar leakage with its
    inverse.
    """
    return _viscosity(oil, oil.temperature) / _viscosity(oil, REFERENCE_TEMPERATURE)


@kernel
def compressibility(fluid: Fluid, pressure: float) -> float:
    """Relative change of volume with pressure (1/Pa) at an absolute pressure (Pa, gt 0): of the liquid, and of its air
    by Boyle's law. It grows without bound towards zero, so that no pressure falls to it.
    """
    return 1.0 / fluid.bulk_modulus + fluid.air * REFERENCE_PRESSURE / (pressure * pressure)


@kernel
def compressibility_slope(fluid: Fluid, pressure: float) -> float:
    """Derivative of `compressibility` by the pressure (1/Pa^2)."""
    return -2.0 * fluid.air * REFERENCE_PRESSURE / (pressure * pressure * pressure)


@kernel
def energy_density(fluid: Fluid, pressure: float, tank: float) -> float:
    """Energy (J/m^3) stored in compression from `tank` to `pressure` (Pa, absolute): the integral of (q - tank) times
    `compressibility`, what is left of the work done on the oil once it is back in the tank.
    """
    rise = pressure - tank
    air = math.log(pressure / tank) - rise / pressure
    return 0.5 * rise * rise / fluid.bulk_modulus + fluid.air * REFERENCE_PRESSURE * air


def _viscosity(oil: Oil, temperature: float) -> float:
    """Kinematic viscosity (m^2/s) at a temperature (K): a straight line of log log(nu + 0.7 mm^2/s) over the logarithm
    of the temperature, through the two stated points (Walther, ASTM D341).
    """
    at_40, at_100 = _walther(oil.viscosity_40), _walther(oil.viscosity_100)
    way = math.log(temperature / 313.15) / math.log(373.15 / 313.15)
    logarithm = 10.0 ** (at_40 + way * (at_100 - at_40))
    return 1e-6 * (10.0**logarithm - 0.7)


def _walther(viscosity: float) -> float:
    return math.log10(math.log10(1e6 * viscosity + 0.7))
