"""What a recording shows and tells of the pump-controlled bars."""

from ars_mujoco.hydraulics.vane_motor_channels import circuit_tabs
from ars_mujoco.schema.events import Condition
from ars_mujoco.schema.plots import Plot, Tab, axles

FULL_STROKE = 0.999  # of the pump, from where it counts as saturated


PLOTS = (
    *circuit_tabs("charge.pressure"),
    Tab(
        "pump",
        (
            Plot("pump stroke", axles("pump.stroke")),
            Plot("pump flow", axles("pump.flow")),
        ),
    ),
    Tab(
        "energy",
        (
            Plot("power", axles("pump.shaft_power", "motor.output_power")),
            Plot("losses", axles("pump.loss_power", "motor.friction_power", "relief.power")),
            Plot("energy since the start", axles("energy.shaft", "energy.recovered")),
        ),
    ),
    Tab(
        "drive",
        (
            Plot("pump speed", axles("pump.speed")),
            Plot("gear", ("drive.gear",)),
            Plot("power of the drive", ("drive.power",)),
        ),
    ),
)


def _events(axle: str) -> tuple[Condition, ...]:
    stroke, far, relief = f"{axle}.pump.stroke", f"{axle}.pump.extrapolation", f"{axle}.relief.power"
    return (
        Condition(stroke, "at_least", FULL_STROKE, "INFO", f"the {axle} pump is at full stroke", of_size=True),
        Condition(far, "above", 0.0, "WARN", f"the {axle} pump leaves the range of its losses"),
        Condition(relief, "above", 0.0, "WARN", f"the {axle} relief valve opens"),
    )


EVENTS = (*_events("front"), *_events("rear"))
