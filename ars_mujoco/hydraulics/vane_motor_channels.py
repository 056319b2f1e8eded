"""Channels of a vane motor and of the valves at its chambers, and how they are shown, for every system with one."""

from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.plots import Plot, Tab, axles


class VaneMotorOutput(Parameters):
    """What a vane motor records where only the difference of its pressures is a state."""

    pressure: float = channel("Pa", "pressure difference across the motor")
    rate: float = channel("rad/s", "rate of the motor angle")
    output_power: float = channel("W", "power of the motor on the bar")
    leakage_power: float = channel("W", "lost to leakage in the motor")
    friction_power: float = channel("W", "lost to friction in the motor")


class ChamberedVaneMotorOutput(VaneMotorOutput):
    """The same where both of its chambers are states."""

    pressure_a: float = channel("Pa", "absolute pressure in the chamber that drives to positive angle")
    pressure_b: float = channel("Pa", "absolute pressure in the other chamber")


class ValveOutput(Parameters):
    """Openings of the valves at its chambers."""

    bypass: float = channel("1", "opening of the bypass valve, shut where there is none")
    fail_safe: float = channel("1", "opening of the fail-safe valve, open where there is none")


def circuit_tabs(low_side: str) -> tuple[Tab, ...]:
    """Tabs of both axles and their circuits; `low_side` is the channel of what feeds a circuit's low side."""
    return (
        *(Tab(f"{axle} axle", (Plot("motor pressure", (f"{axle}.motor.pressure",)),)) for axle in ("front", "rear")),
        Tab(
            "circuit",
            (
                _pressures("front", low_side),
                _pressures("rear", low_side),
                Plot("valve openings", axles("valve.bypass", "valve.fail_safe")),
            ),
        ),
    )


def _pressures(axle: str, low_side: str) -> Plot:
    sides = ("motor.pressure_a", "motor.pressure_b", low_side)
    return Plot(f"{axle} pressures", tuple(f"{axle}.{side}" for side in sides))
