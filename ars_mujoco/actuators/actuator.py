"""Actuators: the stabilizers a user can choose, read from a file and turned into the two axles' parameters."""

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, model_validator

from ars_mujoco.actuators.pump_controlled.axle import DETAILED, NO_BAR, PUMP_CONTROLLED, TORSION_BAR
from ars_mujoco.actuators.pump_controlled.drive import Constant, Drive, first_speed
from ars_mujoco.actuators.pump_controlled.full_circuit import FULL_PLANT, REDUCED_PLANT, start_detailed
from ars_mujoco.actuators.pump_controlled.full_plant import FullCircuit
from ars_mujoco.actuators.pump_controlled.pump_control import FULL, REDUCED, THIRD_ORDER
from ars_mujoco.actuators.pump_controlled.substeps import detailed_substeps, substeps
from ars_mujoco.actuators.pump_controlled.temperature import at_temperature
from ars_mujoco.actuators.pump_controlled.third_order_circuit import Circuit, ReducedCircuit
from ars_mujoco.hydraulics.metering_edge import largest_stroke_rate
from ars_mujoco.hydraulics.oil import fluid
from ars_mujoco.schema.parameters import Parameters, fill

AXLES = ("front", "rear")
STROKE_RATE_TOLERANCE = 0.2  # of the swash plate's stated speed


class NoBar(Parameters):
    """No stabilizer bar at all."""

    kind: Literal["none"]


class Passive(Parameters):
    """A conventional bar, with the stiffness the vehicle states for each axle."""

    kind: Literal["passive"]


class Locked(Parameters):
    """The active bar with its motor held: torsion only, with the active bar's stiffness."""

    kind: Literal["locked"]


STAGES = {"third_order": THIRD_ORDER, "reduced": REDUCED, "full": FULL}


class PumpControlled(Parameters):
    """The pump-controlled active bar, front and rear, each with the reduced circuit."""

    kind: Literal["pump_controlled"]
    circuit: Literal["reduced", "full"] = "reduced"  # `full` is the class below; here for an error to list both
    pump_control: Literal["third_order", "reduced", "full"] = "third_order"  # stage of simplification
    drive: Drive = Constant(kind="constant")
    front: ReducedCircuit
    rear: ReducedCircuit

    @model_validator(mode="after")
    def _has_what_its_stage_needs(self) -> "PumpControlled":
        needed = ("oil", "metering_edge", "control_cylinder") if self.pump_control != "third_order" else ()
        missing = [f"{axle}.{key}" for axle in AXLES for key in needed if getattr(getattr(self, axle), key) is None]
        if missing:
            raise ValueError(f"pump_control '{self.pump_control}' needs {', '.join(missing)}")
        if needed:
            for axle in AXLES:
                _check_stroke_rate(axle, getattr(self, axle))
        return self


def _check_stroke_rate(axle: str, circuit: Circuit) -> None:
    """Refuse a swash plate whose stated speed, from which its loop takes its gain, is not that of its cylinder."""
    stated = circuit.swash_plate.max_rate
    own = largest_stroke_rate(circuit.metering_edge, circuit.control_cylinder)
    if abs(own - stated) > STROKE_RATE_TOLERANCE * stated:
        raise ValueError(
            f"{axle}.swash_plate.max_rate is {stated:.4g} 1/s, but its metering edges move its cylinder at {own:.4g} "
            f"1/s; allowed: within {100 * STROKE_RATE_TOLERANCE:g} %"
        )


class FullPumpControlled(PumpControlled):
    """The same, each with the full circuit."""

    circuit: Literal["full"]
    front: FullCircuit
    rear: FullCircuit


def _circuit(actuator: Any) -> str:
    """Which circuit a file's or an instance's actuator has; what is none of them is judged as the reduced one."""
    named = actuator.get("circuit") if isinstance(actuator, dict) else getattr(actuator, "circuit", None)
    return "full" if named == "full" else "reduced"


AnyPumpControlled = Annotated[
    Annotated[PumpControlled, Tag("reduced")] | Annotated[FullPumpControlled, Tag("full")], Discriminator(_circuit)
]
Actuator = Annotated[NoBar | Passive | Locked | AnyPumpControlled, Field(discriminator="kind")]


def fill_axle(
    record,
    actuator: Actuator,
    axle: str,
    stiffness: float,
    passive_stiffness: float,
    step: float,
    bypassed: bool = False,
):
    """Write the parameters of one axle ("front" or "rear") of `actuator` into an `axle.Axle` record.

    `stiffness` and `passive_stiffness` (Nm/rad) are the torsion of the active bar and of the conventional one in its
    place; the physics step (s) is divided into substeps, more of them where the bypass valve will be open.
    """
    match actuator:
        case NoBar():
            record.kind = NO_BAR
        case Passive():
            record.kind, record.stiffness = TORSION_BAR, passive_stiffness
        case Locked():
            record.kind, record.stiffness = TORSION_BAR, stiffness
        case PumpControlled():
            record.stiffness = stiffness
            _fill_circuit(record, actuator, at_temperature(getattr(actuator, axle)))
            pump = record.circuit.pump
            pump.speed = first_speed(actuator.drive, pump.speed)
            if record.kind == DETAILED:
                record.substeps = detailed_substeps(record, step, bypassed)
            else:
                record.substeps = substeps(record.circuit, stiffness, step)


def start_axle(record, state) -> None:
    """Write the state at rest of the axle with these parameters into an `axle.AxleState` record."""
    if record.kind == DETAILED:
        start_detailed(record, state)


def _fill_circuit(record, actuator: PumpControlled, circuit: ReducedCircuit | FullCircuit) -> None:
    for name in Circuit.model_fields:
        if getattr(circuit, name) is not None:
            fill(record.circuit[name], getattr(circuit, name))
    is_full = isinstance(circuit, FullCircuit)
    if not is_full:
        fill(record.circuit.line, circuit.line)
        record.circuit.charge_power = circuit.charge_power
        if actuator.pump_control == "third_order":
            record.kind = PUMP_CONTROLLED
            return
    record.kind, detail = DETAILED, record.detail
    detail.stage, detail.plant = STAGES[actuator.pump_control], FULL_PLANT if is_full else REDUCED_PLANT
    fill(detail.fluid, fluid(circuit.oil))
    if is_full:
        for name in ("pipe", "charge_pump", "check_valve", "bypass_valve", "fail_safe_valve"):
            fill(detail[name], getattr(circuit, name))
        detail.tank_leakage = circuit.tank_leakage
