"""File: what a user writes of a pump-controlled bar, and how it becomes the records that the kernels read."""

import math
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Discriminator, Tag, model_validator

from ars_mujoco.actuators.pump_controlled.bar_angle_loop import BarAngleLoop
from ars_mujoco.actuators.pump_controlled.drive import Constant, Drive, fill_drive, first_speed
from ars_mujoco.actuators.pump_controlled.full_circuit import FULL_PLANT, REDUCED_PLANT, start_detailed
from ars_mujoco.actuators.pump_controlled.full_plant import FullCircuit
from ars_mujoco.actuators.pump_controlled.pole_compensator import PoleCompensator
from ars_mujoco.actuators.pump_controlled.pressure_feedback import PressureFeedback
from ars_mujoco.actuators.pump_controlled.pump_control import FULL, REDUCED, THIRD_ORDER
from ars_mujoco.actuators.pump_controlled.substeps import detailed_substeps, substeps
from ars_mujoco.actuators.pump_controlled.temperature import at_temperature
from ars_mujoco.actuators.pump_controlled.third_order_circuit import Circuit, ReducedCircuit
from ars_mujoco.actuators.system import Car
from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.hydraulics.metering_edge import largest_stroke_rate
from ars_mujoco.hydraulics.oil import fluid
from ars_mujoco.machines.engine import Engine
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, fill

AXLES = ("front", "rear")
STROKE_RATE_TOLERANCE = 0.2  # of the swash plate's stated speed
STAGES = {"third_order": THIRD_ORDER, "reduced": REDUCED, "full": FULL}


class Control(Parameters):
    """The outer loop, which runs in the car's control unit, and its compensators: digital filters, so they need a unit
    that samples, and fast enough for their frequency.
    """

    loop: BarAngleLoop
    pressure_feedback: PressureFeedback | None = None
    compensator: PoleCompensator | None = None


class PumpControlled(Parameters):
    """The pump-controlled active bar, front and rear, each with the reduced circuit."""

    kind: Literal["pump_controlled"]
    circuit: Literal["reduced", "full"] = "reduced"  # `full` is the class below; here for an error to list both
    pump_control: Literal["third_order", "reduced", "full"] = "third_order"  # stage of simplification
    drive: Drive = Constant(kind="constant")
    control: Control
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


class FullPumpControlled(PumpControlled):
    """The same, each with the full circuit."""

    circuit: Literal["full"]
    front: FullCircuit
    rear: FullCircuit


def _check_stroke_rate(axle: str, circuit: Circuit) -> None:
    """Refuse a swash plate whose stated speed, from which its loop takes its gain, is not that of its cylinder."""
    stated = circuit.swash_plate.max_rate
    own = largest_stroke_rate(circuit.metering_edge, circuit.control_cylinder)
    if abs(own - stated) > STROKE_RATE_TOLERANCE * stated:
        raise ValueError(
            f"{axle}.swash_plate.max_rate is {stated:.4g} 1/s, but its metering edges move its cylinder at {own:.4g} "
            f"1/s; allowed: within {100 * STROKE_RATE_TOLERANCE:g} %"
        )


def _circuit(actuator: Any) -> str:
    """Which circuit a file's or an instance's actuator has; what is none of them is judged as the reduced one."""
    named = actuator.get("circuit") if isinstance(actuator, dict) else getattr(actuator, "circuit", None)
    return "full" if named == "full" else "reduced"


File = Annotated[
    Annotated[PumpControlled, Tag("reduced")] | Annotated[FullPumpControlled, Tag("full")], Discriminator(_circuit)
]


def is_full(file: PumpControlled) -> bool:
    """Whether it has the full circuit."""
    return isinstance(file, FullPumpControlled)


def is_third_order(file: PumpControlled) -> bool:
    """Whether circuit and pump control are those of the verification set, six states an axle."""
    return not is_full(file) and file.pump_control == "third_order"


def fill_system(record, file: PumpControlled, car: Car, step: float) -> None:
    """Write drive, control and both axles of `file` into a record of `strokes.parameters`; the physics step is in s.

    Raises InputError where the car or its control unit does not serve what the file asks for.
    """
    if isinstance(file.drive, Engine) and not car.has_road:
        raise InputError(
            "actuator.drive.kind: 'engine' turns with the road speed, which this rig has not; "
            "allowed: constant, table, electric"
        )
    fill_drive(record.drive, file.drive)
    fill(record.loop, file.control.loop)
    for name in ("pressure_feedback", "compensator"):
        filtering = getattr(file.control, name)
        if filtering:
            check_sampled(name, filtering, car.unit)
            fill(record[name], filtering)
    for axle in AXLES:
        torsion, valve = getattr(car, axle), car.inputs.get(f"{axle}_bypass")
        is_bypassed = valve is not None and bool(np.any(valve.values))
        if torsion:
            fill_axle(record[axle], file, axle, torsion.stiffness, step, is_bypassed)


def fill_axle(record, file: PumpControlled, axle: str, stiffness: float, step: float, bypassed: bool = False) -> None:
    """Write the circuit of one axle ("front" or "rear") of `file` into an `axle.Axle` or `axle.DetailedAxle` record.

    `stiffness` (Nm/rad) is the torsion of the bar; the physics step (s) is divided into substeps, more of them where
    the bypass valve will be open.
    """
    record.stiffness = stiffness
    circuit = at_temperature(getattr(file, axle))
    _fill_circuit(record, circuit)
    if not is_third_order(file):
        fill_detail(record.detail, file, circuit)
    pump = record.circuit.pump
    pump.speed = first_speed(file.drive, pump.speed)
    if is_third_order(file):
        record.substeps = substeps(record, step)
    else:
        record.substeps = detailed_substeps(record, step, bypassed)


def start_system(record, state) -> None:
    """Write the state at rest and charged."""
    for axle in AXLES:
        if record[axle].substeps > 0.0:
            start_detailed(record[axle], state[axle])


def released(file: PumpControlled) -> PumpControlled:
    """`file` with the ports of its motors joined: the oil that they displace never meets a pressure, so what they
    displace is nothing to the circuit. The pump idles.
    """
    update: dict[str, Any] = {}
    for axle in AXLES:
        circuit = getattr(file, axle)
        motor = circuit.motor.model_copy(update={"displacement": 0.0})
        update[axle] = circuit.model_copy(update={"motor": motor})
    loop = file.control.loop.model_copy(update={"gain": 0.0})
    return file.model_copy(update=update | {"control": file.control.model_copy(update={"loop": loop})})


def check_sampled(name: str, filtering: PressureFeedback | PoleCompensator, unit: ControlUnit) -> None:
    """Refuse a digital filter in a unit that is continuous, or too slow for it."""
    place = f"actuator.control.{name}"
    if unit.sample_time == 0.0:
        raise InputError(
            f"{place}: a digital filter, but the unit is continuous; allowed: with a controller.unit.sample_time over "
            "0 s"
        )
    frequency = "corner" if isinstance(filtering, PressureFeedback) else "frequency"
    fastest = math.pi / unit.sample_time
    if getattr(filtering, frequency) >= fastest:
        raise InputError(
            f"{place}: {frequency} of {getattr(filtering, frequency):g} rad/s is beyond what a controller.unit."
            f"sample_time of {1e3 * unit.sample_time:g} ms can filter; allowed: less than {fastest:g} rad/s"
        )


def _fill_circuit(record, circuit: ReducedCircuit | FullCircuit) -> None:
    for name in Circuit.model_fields:
        if getattr(circuit, name) is not None:
            fill(record.circuit[name], getattr(circuit, name))
    if isinstance(circuit, ReducedCircuit):
        fill(record.circuit.line, circuit.line)
        record.circuit.charge_power = circuit.charge_power


def fill_detail(detail, file: PumpControlled, circuit: ReducedCircuit | FullCircuit) -> None:
    """Write the stage of pump control, and what a full circuit has besides, into a `full_circuit.Detail` record."""
    detail.stage, detail.plant = STAGES[file.pump_control], FULL_PLANT if is_full(file) else REDUCED_PLANT
    fill(detail.fluid, fluid(circuit.oil))
    if is_full(file):
        for name in ("pipe", "charge_pump", "check_valve", "bypass_valve", "fail_safe_valve"):
            fill(detail[name], getattr(circuit, name))
        detail.tank_leakage = circuit.tank_leakage
