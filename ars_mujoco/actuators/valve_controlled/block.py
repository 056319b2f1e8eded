"""The valve block with its pump, which both axles share: two pressure valves in series.

    pump ─┬─ front node ─[PVV]─┬─ rear node ─[PVH]─> return line ─> reservoir       PVV, PVH: pressure valves
          │      │             │                                                     of front and rear
        relief  direction valve, one spool for both axles; its front ports through the fail-safe valve

    C_V p_V' = Q_p - q_front - Q_PVV - Q_relief - leakages,    C_H p_H' = Q_PVV - q_rear - Q_PVH - leakage

So the front's pressure is never below the rear's, and one flow serves both: what the pump does is set by the front's
pressure alone. All pressures are over the reservoir's; the return line's is constant.
"""

import math
from collections import namedtuple

from ars_mujoco.hydraulics.direction_valve import DirectionValve
from ars_mujoco.hydraulics.fail_safe_valve import FailSafeValve, is_shut
from ars_mujoco.hydraulics.pressure_valve import (
    PressureValve,
    hysteresis_rate,
    opening_wanted,
    setting_pressure,
    valve_flow,
)
from ars_mujoco.hydraulics.radial_piston_pump import shaft_loss
from ars_mujoco.hydraulics.relief_valve import ReliefValve, one_way_relief
from ars_mujoco.hydraulics.valve_opening import opening_rate
from ars_mujoco.kernels.kernel import inlined, kernel
from ars_mujoco.schema.channels import channel, delivered, drawn, lost
from ars_mujoco.schema.parameters import Parameters, choice, number, quantity

REAR_NODE, RETURN = 0.0, 1.0  # what the front's pressure valve works against


class Block(Parameters):
    """Valves of both axles."""

    front_valve: PressureValve
    rear_valve: PressureValve
    front_reference: float = choice("rear_node", "return", default=REAR_NODE)  # what the front valve's pressure is over
    direction_valve: DirectionValve
    fail_safe_valve: FailSafeValve  # at the front's ports; shut without current
    fail_safe_power: float = quantity("W", ge=0)  # of the solenoid that holds it open
    relief_valve: ReliefValve
    return_pressure: float = quantity("Pa", ge=0)  # over the reservoir's
    sensor_lag: float = quantity("s", gt=0)  # of both pressure sensors


class Electrics(Parameters):
    """What feeds coils and unit."""

    generator_efficiency: float = number(gt=0, le=1)
    unit_power: float = quantity("W", ge=0)  # of the control unit, always on


class BlockState(Parameters):
    """State of the valve block."""

    front_pressure: float = channel("Pa", "pressure of the front node over the reservoir's", scale=1e2)
    rear_pressure: float = channel("Pa", "pressure of the rear node over the reservoir's", scale=1e2)
    front_current: float = channel("A", "current of the front pressure valve", scale=1e-4)
    front_turned: float = channel("1", "side of its hysteresis, 1 as the current rises", scale=1e-3)
    front_opening: float = channel("1", "opening of the front pressure valve", scale=1e-4)
    rear_current: float = channel("A", "current of the rear pressure valve", scale=1e-4)
    rear_turned: float = channel("1", "side of its hysteresis, 1 as the current rises", scale=1e-3)
    rear_opening: float = channel("1", "opening of the rear pressure valve", scale=1e-4)
    spool: float = channel("1", "position of the direction valve, 1 gives pressure to chambers A", scale=1e-4)
    fail_safe: float = channel("1", "opening of the fail-safe valve", scale=1e-4)
    front_sensed: float = channel("Pa", "front pressure as its sensor shows it", scale=1e2)
    rear_sensed: float = channel("Pa", "rear pressure as its sensor shows it", scale=1e2)


class BlockEnergy(Parameters):
    """Energies of pump and block since the start, in the order of the powers of `block_rates`."""

    shaft: float = drawn("drawn by the pump's shaft")
    generator: float = drawn("drawn by the generator's shaft for coils and control unit")
    pump: float = lost("lost to the pump's torque loss")
    pump_leakage: float = lost("lost to leakage in the pump")
    relief: float = lost("lost over the relief valve")
    front_valve: float = lost("lost over the front pressure valve")
    rear_valve: float = lost("lost over the rear pressure valve")
    direction_leakage: float = lost("lost to leakage in the direction valve")
    return_line: float = lost("lost in the return line")
    coils: float = lost("lost in the coils of all valves")
    unit: float = lost("drawn by the control unit")
    generation: float = lost("lost in the generator")
    front: float = delivered("delivered to the front axle, less what it gave to the return line")
    rear: float = delivered("delivered to the rear axle, less what it gave to the return line")


STATES = len(BlockState.model_fields)
FRONT_NODE, REAR_NODE_PLACE = 0, 1
SPOOL, FAIL_SAFE = map(list(BlockState.model_fields).index, ("spool", "fail_safe"))

# what holds of the block over a step: the pump's flow (m^3/s) and speed (rad/s), the currents (A) that the unit asks
# for, and where it wants direction valve (-1, 0, 1) and fail-safe valve (0 or 1)
Setting = namedtuple("Setting", "flow speed front_current rear_current side fail_safe")


@kernel
def fail_safe_way(block, opening: float) -> float:
    """Q/sqrt(dp) of one edge of the fail-safe valve."""
    valve = block.fail_safe_valve
    return 0.0 if is_shut(valve, opening) else opening * valve.flow / math.sqrt(valve.pressure)


@inlined
def block_rates(p, setting, front, rear, delivered_powers, state):
    """Derivatives of BlockState and powers (W) as BlockEnergy lists them.

    `front` and `rear` are each axle's Exchange, `delivered_powers` (W) what each draws.
    """
    node_v, node_h, current_v, turned_v, open_v, current_h, turned_h, open_h, spool, opened, seen_v, seen_h = state
    block, outlet, speed = p.block, p.block.return_pressure, setting.speed
    over_v, over_h = node_v - node_h, node_h - outlet
    flow_v, flow_h = valve_flow(block.front_valve, open_v, over_v), valve_flow(block.rear_valve, open_h, over_h)
    relief, pump_leak = one_way_relief(block.relief_valve, node_v), p.pump.leakage * node_v
    spool_leak = block.direction_valve.leakage
    leak_v, leak_h = spool_leak * (node_v - outlet), spool_leak * over_h
    works_on = over_v if block.front_reference == REAR_NODE else node_v - outlet
    front_valve = _valve_rates(
        block.front_valve, setting.front_current, works_on, over_v, (current_v, turned_v, open_v)
    )
    rear_valve = _valve_rates(block.rear_valve, setting.rear_current, over_h, over_h, (current_h, turned_h, open_h))
    derivatives = (
        (setting.flow - pump_leak - relief - front.taken - flow_v - leak_v) / p.front.axle.node_capacitance,
        (flow_v - rear.taken - flow_h - leak_h) / p.rear.axle.node_capacitance,
        *front_valve,
        *rear_valve,
        opening_rate(block.direction_valve, spool, setting.side),
        opening_rate(block.fail_safe_valve, opened, setting.fail_safe),
        (node_v - seen_v) / block.sensor_lag,
        (node_h - seen_h) / block.sensor_lag,
    )
    loss = shaft_loss(p.pump, speed, node_v)
    coils = coil_power(block, setting, current_v, current_h)
    generator = (coils + p.electrics.unit_power) / p.electrics.generator_efficiency
    powers = (
        setting.flow * node_v + loss,
        generator,
        loss,
        pump_leak * node_v,
        relief * node_v,
        flow_v * over_v,
        flow_h * over_h,
        leak_v * (node_v - outlet) + leak_h * over_h,
        outlet * (flow_h + leak_v + leak_h + front.returned + rear.returned),
        coils,
        p.electrics.unit_power,
        generator - coils - p.electrics.unit_power,
        *delivered_powers,
    )
    return derivatives, powers


@kernel
def coil_power(block, setting, front_current: float, rear_current: float) -> float:
    """Power (W) in the coils of all four valves."""
    pressure = (
        block.front_valve.resistance * front_current * front_current
        + block.rear_valve.resistance * rear_current * rear_current
    )
    return pressure + block.direction_valve.power * abs(setting.side) + block.fail_safe_power * setting.fail_safe


@kernel
def block_stored(p, state):
    """Energy (J) stored in the oil of both nodes."""
    front, rear = p.front.axle.node_capacitance, p.rear.axle.node_capacitance
    return 0.5 * (front * state.front_pressure**2 + rear * state.rear_pressure**2)


@kernel
def _valve_rates(valve, current_asked, pressure, difference, state):
    # derivatives of (current, side of the hysteresis, opening)
    current, turned, opening = state
    current_rate = (current_asked - current) / valve.current_lag
    wanted = opening_wanted(valve, pressure, setting_pressure(valve, current, turned), difference)
    return current_rate, hysteresis_rate(valve, turned, current_rate), (wanted - opening) / valve.spool_lag
