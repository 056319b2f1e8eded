"""Catalogue: pumps that an actuator's file takes by name, at their own size or at another by the laws of similarity.

    pump: {like: radial_piston, displacement: 1.8 cm^3/rev, speed: 3000 rpm}

Lengths of a similar machine go as l = (V/V_0)^(1/3). At a pressure, what leaks goes as l^2 and torques as l^3, and its
speeds as 1/l (`hydraulics.loss_polynomial`). What the block states besides `like` stands as it is stated.
"""

from functools import cache
from typing import Any

from ars_mujoco.hydraulics.boundary_friction import BoundaryFriction
from ars_mujoco.hydraulics.loss_polynomial import TorqueLoss
from ars_mujoco.schema import library
from ars_mujoco.schema.document import read
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, quantity
from ars_mujoco.schema.units import to_si


class CataloguePump(Parameters):
    """A displacement machine and its losses, at full stroke those of a fixed one."""

    displacement: float = quantity("m^3/rad", gt=0)  # at full stroke
    leakage: float = quantity("m^3/s/Pa", ge=0)
    torque_loss: TorqueLoss
    boundary_friction: BoundaryFriction

    def sized(self, displacement: float) -> "CataloguePump":
        """The geometrically similar pump of another displacement (m^3/rad)."""
        ratio = displacement / self.displacement
        scaled = {"leakage": self.leakage * ratio ** (2.0 / 3.0), "torque_loss": self.torque_loss.scaled(ratio)}
        friction = self.boundary_friction
        slower = {name: getattr(friction, name) * ratio ** (-1.0 / 3.0) for name in ("decay_speed", "sign_speed")}
        return self.model_copy(
            update={"displacement": displacement, "boundary_friction": friction.model_copy(update=slower), **scaled}
        )


@cache
def catalogue_pump(name: str) -> CataloguePump:
    """A shipped pump. Raises InputError with what there is."""
    return read(CataloguePump, library.shipped_file("pump", name), "pump").value


def like(block: Any, fields: Any) -> Any:
    """`block` of a file with what it leaves to the pump that it is `like`, of its `fields`; another as it is."""
    if not isinstance(block, dict) or "like" not in block:
        return block
    try:
        pump = catalogue_pump(str(block["like"]))
    except InputError as error:
        raise ValueError(f"like: {error}") from None
    if "displacement" in block:
        pump = pump.sized(to_si(block["displacement"], "m^3/rad", gt=0.0))
    own: dict[str, Any] = {"torque_loss": pump.torque_loss, "boundary_friction": pump.boundary_friction}
    own |= {"displacement": f"{pump.displacement!r} m^3/rad", "leakage": f"{pump.leakage!r} m^3/s/Pa"}
    stated = {name: value for name, value in block.items() if name != "like"}
    return {name: value for name, value in own.items() if name in fields} | stated
