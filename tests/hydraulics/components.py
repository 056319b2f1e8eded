"""The parts of the full circuit with round numbers, each as a file would state it, and records of them."""

from records import filled

from ars_mujoco.hydraulics.oil import Fluid, Oil, fluid
from ars_mujoco.hydraulics.pipe import Pipe

OIL = {
    "bulk_modulus": "1.4e9 Pa",
    "air": "0.5 %",
    "density": "860 kg/m^3",
    "temperature": "50 degC",
    "viscosity_40": "32 mm^2/s",
    "viscosity_100": "5.5 mm^2/s",
}
PIPE = {"length": "2 m", "diameter": "10 mm", "wall_compliance": "0 1/Pa", "lumps": "2"}


def oil(**changes: str) -> Oil:
    return Oil(**OIL | changes)


def record_of(oil: Oil):
    """The record of its Fluid."""
    parameters: Fluid = fluid(oil)
    return filled(parameters)


def pipe(**changes: str):
    return filled(Pipe(**PIPE | changes))
