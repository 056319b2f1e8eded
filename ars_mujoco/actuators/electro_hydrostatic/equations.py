"""Equations of both axles and the supply that they share, as `kernels.integration` takes them.

The supply gives either axle less where both ask for much, so that all states stand in one set of equations. Without a
rear bar, as on the bench, the rear stands still and draws nothing.
"""

from collections import namedtuple

import numpy as np

from ars_mujoco.actuators.electro_hydrostatic.axle import POWERS, STATES, Axle, asked_of, axle_rates
from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.kernels.records import along, zeros
from ars_mujoco.machines.electric_drive import granted, power_share, running, wish
from ars_mujoco.machines.electric_supply import ElectricSupply, budget, supply_rates, terminal_voltage
from ars_mujoco.schema.parameters import record_dtype

SPEED, CURRENT = 7, 12  # of AxleState
SUPPLY, SUPPLY_POWERS = 2 * STATES, 2 * POWERS  # where the supply's begin, after front and rear

PARAMETERS = np.dtype(
    [
        ("front", record_dtype(Axle)),
        ("rear", record_dtype(Axle)),
        ("supply", record_dtype(ElectricSupply)),
        ("has_rear", "f8"),  # 0 on the bench
        ("substeps", "f8"),
    ]
)

# what holds of an axle over a step: its BarCommand, its bar's twist (rad), the openings asked of its valves (bypass,
# fail-safe), and the state of its machine's phases
Demand = namedtuple("Demand", "command twist openings phases")


@inlined
def rates(p, demand, t, state):
    """Derivatives of State, powers (W) in the order of Energy, and both bars' torques (Nm); `demand` is the Demand of
    front and of rear.
    """
    front_demand, rear_demand = demand
    front, rear, store = state[0:STATES], state[STATES:SUPPLY], state[SUPPLY]
    front_electric, rear_electric = (
        electric(p.front, front_demand, store, front),
        electric(p.rear, rear_demand, store, rear),
    )
    load = front_electric.drawn + p.has_rear * rear_electric.drawn
    voltage = terminal_voltage(p.supply, store, load)

    front_asked, front_wish = intent(p.front, front_demand, voltage, t, front)
    rear_asked, rear_wish = intent(p.rear, rear_demand, voltage, t, rear)
    share = power_share(budget(p.supply, store), front_wish.power, p.has_rear * rear_wish.power)
    front_current = granted(p.front.drive, front_wish, share, front[SPEED], voltage)
    rear_current = granted(p.rear.drive, rear_wish, share, rear[SPEED], voltage)

    front_rates, front_powers, front_torque = axle_rates(
        p.front, front_asked, front_current, front_electric, front_demand.twist, front_demand.openings, front
    )
    rear_rates, rear_powers, rear_torque = axle_rates(
        p.rear, rear_asked, rear_current, rear_electric, rear_demand.twist, rear_demand.openings, rear
    )
    rear_rates = along(zeros(rear_rates), rear_rates, p.has_rear)
    rear_powers = along(zeros(rear_powers), rear_powers, p.has_rear)
    store_rate, converter_rate, supply_powers = supply_rates(p.supply, store, state[SUPPLY + 1], load)
    return (
        (*front_rates, *rear_rates, store_rate, converter_rate),
        (*front_powers, *rear_powers, *supply_powers),
        (front_torque, p.has_rear * rear_torque),
    )


@inlined
def electric(p, demand, store, state):
    """The Running of an axle's drive, at the store's voltage (V)."""
    return running(p.drive, state[CURRENT], state[SPEED], store, demand.phases)


@inlined
def intent(p, demand, voltage, t, state):
    """What an axle's loops ask for (see `asked_of`), and the Wish that it makes of its drive."""
    asked = asked_of(p, demand.command, demand.twist, demand.openings, voltage, t, state)
    return asked, wish(p.drive, asked[0], state[SPEED], voltage, demand.phases)
