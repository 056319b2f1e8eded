"""Equations of both axles and the supply that they share, as `kernels.integration` takes them.

The supply gives either axle less where both ask for much, so that all states stand in one set of equations. Without a
rear bar, as on the bench, the rear stands still and draws nothing.
"""

from collections import namedtuple

import numpy as np

from ars_mujoco.actuators.electro_hydrostatic.axle import CURRENT, POWERS, SPEED, STATES, Axle, asked_of, axle_rates
from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.machines.electric_drive import granted, power_share, running, wish
from ars_mujoco.machines.electric_supply import ElectricSupply, budget, terminal_voltage
from ars_mujoco.machines.shared_supply import joined_rates
from ars_mujoco.schema.parameters import record_dtype

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

# what the loops of an axle ask for (see `asked_of`), the current (A) granted for it, and the Running of its drive
Side = namedtuple("Side", "asked current electric")

# the axles' Sides, the `load` (W) that both put on the supply, and the share that they get of the power they wish for
Balance = namedtuple("Balance", "front rear load share")


@inlined
def balance(p, demand, t, state) -> Balance:
    """What both axles ask of the supply at `t` s in the step, and what it grants; `demand` has the Demand of each."""
    front_demand, rear_demand = demand
    front, rear, store = state[0:STATES], state[STATES:SUPPLY], state[SUPPLY]
    front_electric = running(p.front.drive, front[CURRENT], front[SPEED], store, front_demand.phases)
    rear_electric = running(p.rear.drive, rear[CURRENT], rear[SPEED], store, rear_demand.phases)
    load = front_electric.drawn + p.has_rear * rear_electric.drawn
    voltage = terminal_voltage(p.supply, store, load)
    front_asked, front_wish = _intent(p.front, front_demand, voltage, t, front)
    rear_asked, rear_wish = _intent(p.rear, rear_demand, voltage, t, rear)
    share = power_share(budget(p.supply, store), front_wish.power, p.has_rear * rear_wish.power)
    return Balance(
        Side(front_asked, granted(p.front.drive, front_wish, share, front[SPEED], voltage), front_electric),
        Side(rear_asked, granted(p.rear.drive, rear_wish, share, rear[SPEED], voltage), rear_electric),
        load,
        share,
    )


@inlined
def rates(p, demand, t, state):
    """Derivatives of State, powers (W) in the order of Energy, and both bars' torques (Nm)."""
    return balanced_rates(p, balance(p, demand, t, state), demand, state)


@inlined
def balanced_rates(p, sides, demand, state):
    """The same where their Balance is known already."""
    front = axle_rates(p.front, sides.front, demand[0], state[0:STATES])
    rear = axle_rates(p.rear, sides.rear, demand[1], state[STATES:SUPPLY])
    return joined_rates(p, front, rear, (state[SUPPLY], state[SUPPLY + 1]), sides.load)


@inlined
def _intent(p, demand, voltage, t, state):
    # what an axle's loops ask for, and the Wish that it makes of its drive
    asked = asked_of(p, demand, voltage, t, state)
    return asked, wish(p.drive, asked[0], state[SPEED], voltage, demand.phases)
