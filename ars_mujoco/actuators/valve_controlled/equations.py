"""Equations of both axles and the valve block that they share, as `kernels.integration` takes them.

Without a rear bar, as on the bench, the rear motor is not there and the rear node takes the front's oil alone.
"""

from collections import namedtuple

import numpy as np

from ars_mujoco.actuators.valve_controlled.axle import (
    NOTHING_BEFORE,
    Axle,
    AxleEnergy,
    AxleState,
    Exchange,
    axle_rates,
    ports,
)
from ars_mujoco.actuators.valve_controlled.block import (
    FAIL_SAFE,
    FRONT_NODE,
    REAR_NODE_PLACE,
    SPOOL,
    Block,
    BlockEnergy,
    BlockState,
    Electrics,
    block_rates,
    fail_safe_way,
)
from ars_mujoco.actuators.valve_controlled.unit import Control
from ars_mujoco.hydraulics.pressure_valve import between_stops
from ars_mujoco.hydraulics.radial_piston_pump import RadialPistonPump
from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.kernels.records import along, zeros
from ars_mujoco.machines.belt_drive import BELT_DRIVE
from ars_mujoco.schema.parameters import Parameters, record_dtype

AXLE = np.dtype([("axle", record_dtype(Axle)), ("stiffness", "f8")])  # torsion of both halves in series, Nm/rad
PARAMETERS = np.dtype(
    [
        ("front", AXLE),
        ("rear", AXLE),
        ("pump", record_dtype(RadialPistonPump)),
        ("block", record_dtype(Block)),
        ("electrics", record_dtype(Electrics)),
        ("control", record_dtype(Control)),
        ("drive", BELT_DRIVE),
        ("has_rear", "f8"),  # 0 on the bench
        ("has_road", "f8"),  # 0 where there is no road speed
        ("substeps", "f8"),
    ]
)


class State(Parameters):
    """All states, in the order of `rates`."""

    front: AxleState
    rear: AxleState
    supply: BlockState


class Energy(Parameters):
    """All energies, in the order of the powers of `rates`."""

    front: AxleEnergy
    rear: AxleEnergy
    supply: BlockEnergy


REAR, BLOCK = len(AxleState.model_fields), 2 * len(AxleState.model_fields)  # where their states begin
FRONT_OPENING = BLOCK + list(BlockState.model_fields).index("front_opening")
REAR_OPENING = BLOCK + list(BlockState.model_fields).index("rear_opening")
AFTER_FRONT, AFTER_REAR = FRONT_OPENING + 1, REAR_OPENING + 1
POWERS, BLOCK_POWERS = len(AxleEnergy.model_fields), 2 * len(AxleEnergy.model_fields)

# what holds over a step: the block's Setting, and the twists (rad) of both bars
Demand = namedtuple("Demand", "setting front_twist rear_twist")


@inlined
def rates(p, demand, t, state):
    """Derivatives of State, powers (W) in the order of Energy, and both bars' torques (Nm)."""
    block, outlet, direction = state[BLOCK:], p.block.return_pressure, p.block.direction_valve
    front_ways = ports(direction, block[SPOOL], fail_safe_way(p.block, block[FAIL_SAFE]))
    rear_ways = ports(direction, block[SPOOL], NOTHING_BEFORE)
    front_pressures, rear_pressures = (block[FRONT_NODE], outlet), (block[REAR_NODE_PLACE], outlet)
    front, front_powers, front_torque, front_oil = axle_rates(
        p.front, front_pressures, demand.front_twist, front_ways, state[0:REAR]
    )
    rear, rear_powers, rear_torque, rear_oil = axle_rates(
        p.rear, rear_pressures, demand.rear_twist, rear_ways, state[REAR:BLOCK]
    )
    rear, rear_powers = along(zeros(rear), rear, p.has_rear), along(zeros(rear_powers), rear_powers, p.has_rear)
    rear_oil = Exchange(p.has_rear * rear_oil.taken, p.has_rear * rear_oil.returned)
    drawn = front_powers[0], rear_powers[0]
    supply, supply_powers = block_rates(p, demand.setting, front_oil, rear_oil, drawn, block)
    return (
        (*front, *rear, *supply),
        (*front_powers, *rear_powers, *supply_powers),
        (front_torque, p.has_rear * rear_torque),
    )


@inlined
def settled(p, state):
    """The state after a substep, the spools of the pressure valves between their stops."""
    return (
        *state[:FRONT_OPENING],
        between_stops(state[FRONT_OPENING]),
        *state[AFTER_FRONT:REAR_OPENING],
        between_stops(state[REAR_OPENING]),
        *state[AFTER_REAR:],
    )
