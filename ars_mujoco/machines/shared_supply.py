"""Shared supply: the equations of both axles and of the electric supply that they share, as one set."""

from typing import Any

from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.kernels.records import along, zeros
from ars_mujoco.machines.electric_supply import supply_rates


@inlined
def joined_rates(p: Any, front: Any, rear: Any, supply_state: Any, load: float) -> Any:
    """Derivatives, powers (W) and torques (Nm) of front, rear and supply, in this order, for `kernels.integration`.

    `p` has the record of the `supply`, and `has_rear`: 0 on the bench, whose rear stands still and draws nothing.
    `front` and `rear` are (derivatives, powers, torque) of an axle; `supply_state` is (store V, converter W) under the
    `load` (W) of both.
    """
    (front_rates, front_powers, front_torque), (rear_rates, rear_powers, rear_torque) = front, rear
    rear_rates, rear_powers = (
        along(zeros(rear_rates), rear_rates, p.has_rear),
        along(zeros(rear_powers), rear_powers, p.has_rear),
    )
    store, converter = supply_state
    store_rate, converter_rate, supply_powers = supply_rates(p.supply, store, converter, load)
    return (
        (*front_rates, *rear_rates, store_rate, converter_rate),
        (*front_powers, *rear_powers, *supply_powers),
        (front_torque, p.has_rear * rear_torque),
    )
