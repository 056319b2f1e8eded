"""Proportional pressure valve: a spool that opens where a pressure is over what its solenoid holds against it.

    current i' = (i_c - i)/tau      coil under a current control
    setting    k (i - i_0)          less or more half the hysteresis, as the current last rose or fell
    opening    tau_s y' = y_s - y   spool, between its stops 0 and 1; y_s = (p - setting)/b(dp)
    flow       Q = y Q_0 sqrt(dp/p_0), laminar where dp is small

b(dp) is the stiffness of spring and flow force in terms of pressure: override r = dp/dQ at the normal pressure p_n, of
which the flow force, which grows with dp, has its share. Without current the setting is below zero: fully open.

The spool is a lag of first order. One of second order at 50 Hz and damping 0.8 closes a loop of s (s^2 + 2 d w s + w^2)
+ w^2/(r C) = 0 over the oil of its node, which is stable only for 1/(r C) < 2 d w: 503 1/s, against some 1670 1/s here.
"""

import math

from ars_mujoco.hydraulics.orifice import rounded_root
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class PressureValve(Parameters):
    """Direct-acting valve with its solenoid."""

    resistance: float = quantity("ohm", ge=0)  # of the coil
    current_lag: float = quantity("s", gt=0)  # tau, of the coil under its current control
    least_current: float = quantity("A", gt=0)  # i_0, at which the setting is zero
    current_limit: float = quantity("A", gt=0)  # at which it is
    pressure_range: float = quantity("Pa", gt=0)  # this
    hysteresis: float = number(ge=0, lt=1)  # width of its loop, of the pressure range
    turning_current: float = quantity("A", gt=0)  # within which the setting turns to the loop's other side
    flow: float = quantity("m^3/s", gt=0)  # Q_0, fully open
    pressure: float = quantity("Pa", gt=0)  # p_0, at that flow
    laminar_pressure: float = quantity("Pa", gt=0)  # below about which it flows laminar
    override: float = quantity("Pa*s/m^3", gt=0)  # r, of the pressure over the flow
    normal_pressure: float = quantity("Pa", gt=0)  # p_n, at which it is that
    flow_force_share: float = number(ge=0, le=1)  # of the override
    spool_lag: float = quantity("s", gt=0)  # tau_s
    leakage: float = quantity("m^3/s/Pa", ge=0)  # of the spool


@kernel
def setting_pressure(valve: PressureValve, current: float, turned: float) -> float:
    """Pressure (Pa) that a current (A) holds; `turned` (-1 to 1) is the side of the loop, 1 as the current rises."""
    slope = valve.pressure_range / (valve.current_limit - valve.least_current)
    return slope * (current - valve.least_current) - 0.5 * valve.hysteresis * valve.pressure_range * turned


@kernel
def current_for(valve: PressureValve, setting: float) -> float:
    """Current (A) that holds a setting (Pa), without hysteresis; within what the coil can."""
    slope = (valve.current_limit - valve.least_current) / valve.pressure_range
    return min(max(valve.least_current + slope * setting, 0.0), valve.current_limit)


@kernel
def hysteresis_rate(valve: PressureValve, turned: float, current_rate: float) -> float:
    """Rate (1/s) of the side of the loop (Dahl): it turns as the current moves, whatever the speed, and then stays."""
    return (current_rate - abs(current_rate) * turned) / valve.turning_current


@kernel
def opening_wanted(valve: PressureValve, pressure: float, setting: float, difference: float) -> float:
    """Opening at which spring and flow force would hold a spool without stops, where `pressure` (Pa) works on it
    against the setting, and oil flows under a pressure difference (Pa). The further it is, the faster the spool moves.
    """
    return (pressure - setting) / (stiffness(valve, difference) * _widest(valve))


@kernel
def between_stops(opening: float) -> float:
    """An opening held between the spool's stops."""
    return min(max(opening, 0.0), 1.0)


@kernel
def valve_flow(valve: PressureValve, opening: float, difference: float) -> float:
    """Flow (m^3/s) through an opening, with the sign of the pressure difference (Pa); leakage included."""
    root = rounded_root(difference, valve.laminar_pressure)
    return between_stops(opening) * _widest(valve) * root + valve.leakage * difference


@kernel
def stiffness(valve: PressureValve, difference: float) -> float:
    """b (Pa^1.5 s/m^3): pressure over the setting by the opening Q/sqrt(dp) that it gives."""
    root, share = math.sqrt(valve.normal_pressure), valve.flow_force_share
    return valve.override * ((1.0 - share) * root + share / root * max(difference, 0.0))


@kernel
def setting_for(valve: PressureValve, pressure: float, difference: float, flow: float) -> float:
    """Setting (Pa) at which the valve holds the `pressure` (Pa) that works on it while a flow (m^3/s) passes under a
    pressure difference (Pa): the override is taken off. Without a difference it is fully open.
    """
    if difference <= 0.0:
        return -valve.pressure_range
    return pressure - stiffness(valve, difference) / math.sqrt(difference) * flow


def open_pressure(valve: PressureValve, flow: float) -> float:
    """Pressure difference (Pa) over the fully open valve that a flow (m^3/s) takes, leakage aside."""
    square = (flow / _widest(valve)) ** 4  # (dp/(dp^2 + p_l^2)^(1/4))^4, a quadratic of dp^2
    return math.sqrt(0.5 * (square + math.sqrt(square * square + 4.0 * square * valve.laminar_pressure**2)))


@kernel
def _widest(valve: PressureValve) -> float:
    # Q/sqrt(dp) of the open valve
    return valve.flow / rounded_root(valve.pressure, valve.laminar_pressure)
