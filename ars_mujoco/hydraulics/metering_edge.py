"""Metering edges: the flow of the zero-overlap servo valve into and out of the control cylinder (paper eqs. 9 to 11).

Positive spool stroke opens supply to chamber A and chamber B to the return line. The paper prints B as 3.8e-3, which
would mean 76 L/min at 0.3 mm and 12.5 bar.
"""

import math
from typing import Any

from pydantic import ValidationInfo, field_validator

from ars_mujoco.hydraulics.orifice import root_slope, rounded_root
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity


class MeteringEdge(Parameters):
    """Edges and ports of the servo valve; pressures are absolute."""

    constant: float = quantity("m^2.5/kg^0.5", gt=0)  # B, with the discharge coefficient in it
    stroke: float = quantity("m", gt=0)  # full stroke of the spool
    laminar_pressure: float = quantity("Pa", gt=0)  # below about this difference the flow is laminar
    supply_pressure: float = quantity("Pa", gt=0)  # p_S
    return_pressure: float = quantity("Pa", gt=0)  # p_R, the tank's too
    leakage: float = quantity("m^3/s/Pa", ge=0)  # of each closed edge: supply to chamber, and chamber to return

    @field_validator("return_pressure")
    @classmethod
    def _below_the_supply(cls, return_pressure: float, info: ValidationInfo) -> float:
        supply = info.data.get("supply_pressure", math.inf)
        if return_pressure >= supply:
            raise ValueError(f"must be less than supply_pressure, which is {1e-5 * supply:.4g} bar")
        return return_pressure


@kernel
def edge_flow_a(edge: MeteringEdge, spool: float, pressure: float) -> Any:
    """Flow (m^3/s) into chamber A at a spool stroke (fraction), and its slopes by stroke and by pressure (eq. 9)."""
    opening = edge.constant * edge.stroke * spool
    if spool >= 0.0:
        difference, side = edge.supply_pressure - pressure, -1.0
    else:
        difference, side = pressure - edge.return_pressure, 1.0
    root = rounded_root(difference, edge.laminar_pressure)
    flow = opening * root + edge.leakage * (edge.supply_pressure + edge.return_pressure - 2.0 * pressure)
    slope = side * opening * root_slope(difference, edge.laminar_pressure) - 2.0 * edge.leakage
    return flow, edge.constant * edge.stroke * root, slope


@kernel
def edge_flow_b(edge: MeteringEdge, spool: float, pressure: float) -> Any:
    """Flow (m^3/s) into chamber B and its slopes: eq. 10, whose sign against eqs. 4 and 13 the printed form loses."""
    flow, by_spool, by_pressure = edge_flow_a(edge, -spool, pressure)
    return flow, -by_spool, by_pressure


@kernel
def common_flow(edge: MeteringEdge, spool: float, load: float) -> Any:
    """Flow (m^3/s) through both edges at a load p_A - p_B (Pa), and its slopes: eq. 11 with the sign(y) it lacks."""
    opening = edge.constant * edge.stroke * spool
    side = 1.0 if spool >= 0.0 else -1.0
    difference = 0.5 * (edge.supply_pressure - edge.return_pressure - side * load)
    root = rounded_root(difference, edge.laminar_pressure)
    slope = -0.5 * side * opening * root_slope(difference, edge.laminar_pressure)
    return opening * root, edge.constant * edge.stroke * root, slope


@kernel
def supply_power(edge: MeteringEdge, spool: float, pressure_a: float, pressure_b: float) -> float:
    """Power (W) that the valve takes from its supply, against the return pressure."""
    pressure = pressure_a if spool >= 0.0 else pressure_b
    root = rounded_root(edge.supply_pressure - pressure, edge.laminar_pressure)
    flow = edge.constant * edge.stroke * abs(spool) * root
    leakage = edge.leakage * (2.0 * edge.supply_pressure - pressure_a - pressure_b)
    return (edge.supply_pressure - edge.return_pressure) * (flow + leakage)


@kernel
def mean_supply_power(edge: MeteringEdge, spool: float) -> float:
    """The same where the chamber pressures are no states: at no load, both halfway between supply and return."""
    middle = 0.5 * (edge.supply_pressure + edge.return_pressure)
    return supply_power(edge, spool, middle, middle)


def largest_stroke_rate(edge: MeteringEdge, cylinder: Any) -> float:
    """Full strokes a second (1/s) of an unloaded ControlCylinder at a fully open valve."""
    drop = 0.5 * (edge.supply_pressure - edge.return_pressure)
    return edge.constant * edge.stroke * math.sqrt(drop) / (cylinder.area * cylinder.travel)
