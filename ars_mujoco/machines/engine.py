"""Engine: the speed of a combustion engine behind a gearbox, from the road speed and the gear (paper section 3).

A shift and a clutch take no time: the engine turns as fast as the wheels ask in its gear, but never below idle, where
the clutch slips, nor above its greatest speed.
"""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import ConfigDict, ValidationInfo, field_validator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity
from ars_mujoco.schema.units import Unit

GEARS = 10  # that a gearbox may have
GEARBOX = np.dtype([("count", "f8"), ("ratios", "f8", GEARS)])


class Engine(Parameters):
    """Engine, gearbox and the pumps' drive; the defaults are a mid-size sedan's, all of them judgement.

    The rolling radius is that of the shipped sedan. In fifth gear, direct, 100 km/h are 2864 rpm.
    """

    model_config = ConfigDict(validate_default=True)

    kind: Literal["engine"]
    idle_speed: float = quantity("rad/s", gt=0, default="800 rpm")
    max_speed: float = quantity("rad/s", gt=0, default="6500 rpm")
    downshift_speed: float = quantity(
        "rad/s", gt=0, default="1500 rpm"
    )  # engine speed below which the gear changes down
    upshift_speed: float = quantity("rad/s", gt=0, default="2800 rpm")  # and above which it changes up
    # engine over propeller shaft, first gear first
    ratios: tuple[Annotated[float, Unit("1", gt=0)], ...] = (4.23, 2.52, 1.66, 1.22, 1.0)
    final_drive: float = number(gt=0, default=3.38)  # propeller shaft over wheels
    rolling_radius: float = quantity("m", gt=0, default="0.313 m")
    pump_ratio: float = number(gt=0, default=1.0)  # pumps over engine; a belt drive's, 1 for pumps on the engine itself

    @field_validator("max_speed")
    @classmethod
    def _above_idle(cls, max_speed: float, info: ValidationInfo) -> float:
        idle_speed = info.data.get("idle_speed", 0.0)
        if max_speed <= idle_speed:
            raise ValueError(f"max_speed must be above idle_speed, which is {idle_speed:.4g} rad/s")
        return max_speed

    @field_validator("downshift_speed", "upshift_speed")
    @classmethod
    def _is_reached(cls, speed: Any, info: ValidationInfo) -> Any:
        idle, most = info.data.get("idle_speed", 0.0), info.data.get("max_speed", speed)
        if not idle <= speed <= most:
            raise ValueError(
                f"{info.field_name} must lie between idle_speed and max_speed, {idle:.4g} and {most:.4g} rad/s"
            )
        return speed

    @field_validator("ratios")
    @classmethod
    def _shift_without_hunting(cls, ratios: Any, info: ValidationInfo) -> Any:
        if not 1 <= len(ratios) <= GEARS:
            raise ValueError(f"ratios takes 1 to {GEARS} gears, not {len(ratios)}")
        up, down = info.data.get("upshift_speed"), info.data.get("downshift_speed")
        for gear, (lower, upper) in enumerate(zip(ratios, ratios[1:], strict=False), 1):
            if upper >= lower:
                raise ValueError("ratios must fall from gear to gear")
            if up and down and up * upper / lower <= down:
                raise ValueError(
                    f"upshift_speed must be more than {lower / upper:.3g} times downshift_speed: from gear {gear} "
                    "the engine would change up and straight down again"
                )
        return ratios


@kernel
def gear(engine: Engine, gearbox: Any, last: float, road_speed: float) -> float:
    """Gear, 0 the first, that follows `last` at a road speed (m/s); between the two shift speeds it stays."""
    shaft, chosen = _propeller_shaft(engine, road_speed), int(last)
    while chosen < int(gearbox.count) - 1 and gearbox.ratios[chosen] * shaft > engine.upshift_speed:
        chosen += 1
    while chosen > 0 and gearbox.ratios[chosen] * shaft < engine.downshift_speed:
        chosen -= 1
    return float(chosen)


@kernel
def engine_speed(engine: Engine, gearbox: Any, chosen: float, road_speed: float) -> float:
    """Engine speed (rad/s) in a gear at a road speed (m/s): idle where the car stands."""
    coupled = gearbox.ratios[int(chosen)] * _propeller_shaft(engine, road_speed)
    return min(max(coupled, engine.idle_speed), engine.max_speed)


@kernel
def _propeller_shaft(engine: Engine, road_speed: float) -> float:
    return engine.final_drive * abs(road_speed) / engine.rolling_radius
