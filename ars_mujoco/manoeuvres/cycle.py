"""Cycle: a manoeuvre on a rig as a user writes it: what is driven, for how long, and what is expected of it."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import (
    BeforeValidator,
    Field,
    PlainSerializer,
    PlainValidator,
    ValidationInfo,
    create_model,
    field_validator,
)

from ars_mujoco.excitation.course import Course
from ars_mujoco.excitation.excitation import ExcitationOf
from ars_mujoco.excitation.knots import KnotsOf, signal
from ars_mujoco.excitation.samples import SamplesOf
from ars_mujoco.metrics.expectation import Limit, limits
from ars_mujoco.roads import bump as road
from ars_mujoco.schema.parameters import Parameters, quantity
from ars_mujoco.schema.units import Unit

Rig = Literal["bench", "roll_plane", "sedan"]
SHORTEST, LONGEST = 0.001, 3600.0  # s; one physics step, and what one wants to look at


class LateralAcceleration(Course):
    """The lateral acceleration of a path over time."""

    knots: KnotsOf("m/s^2").model_fields["knots"].annotation | None = None
    recorded: SamplesOf("m/s^2") | None = None  # a table of times and values


class Follow(Parameters):
    """The driver follows a path of the curvature lateral acceleration over speed squared."""

    rig: ClassVar[Rig] = "sedan"
    kind: Literal["follow"]
    lateral_acceleration: LateralAcceleration
    speed: KnotsOf("m/s", gt=0) | None = None  # where it changes; else the cycle's


class Circle(Parameters):
    """The driver follows a circle to the left, its speed rising slowly (ISO 4138, constant radius)."""

    rig: ClassVar[Rig] = "sedan"
    kind: Literal["circle"]
    radius: float = quantity("m", gt=0)
    speed: KnotsOf("m/s", gt=0)


class StepSteer(Parameters):
    """Open loop: the steering angle that gives a lateral acceleration in the steady state, in one ramp (ISO 7401)."""

    rig: ClassVar[Rig] = "sedan"
    kind: Literal["step_steer"]
    lateral_acceleration: float = quantity("m/s^2")
    start: float = quantity("s", ge=0)
    ramp: float = quantity("s", gt=0)

    @field_validator("lateral_acceleration")
    @classmethod
    def _turns(cls, lateral_acceleration):
        if lateral_acceleration == 0.0:
            raise ValueError("must not be 0: positive turns left, negative right")
        return lateral_acceleration


class Straight(Parameters):
    """The driver keeps straight ahead."""

    rig: ClassVar[Rig] = "sedan"
    kind: Literal["straight"]


class BarCommand(Parameters):
    """The bench: the bar's ends are held or moved, its motor is commanded, held or free."""

    rig: ClassVar[Rig] = "bench"
    kind: Literal["bar_command"]
    motor: Literal["commanded", "held", "free"] = "commanded"  # held is locked; free has its ports joined
    command: ExcitationOf("rad") | None = Field(None, validate_default=True)
    ends: ExcitationOf("m") = ExcitationOf("m")(knots=[("0 s", "0 m")])  # left end above the right one, x_l - x_r

    @field_validator("command")
    @classmethod
    def _is_for_a_commanded_motor(cls, command, info: ValidationInfo):
        motor = info.data.get("motor")
        if motor == "commanded" and command is None:
            raise ValueError("a commanded motor needs a command; without one, motor: held or free")
        if motor in ("held", "free") and command is not None:
            raise ValueError(f"a motor that is {motor} takes no command; allowed with motor: commanded")
        return command


class LateralForce(Parameters):
    """The roll plane: a lateral force on the body's centre of gravity, over its mass."""

    rig: ClassVar[Rig] = "roll_plane"
    kind: Literal["lateral_force"]
    acceleration: KnotsOf("m/s^2")


Manoeuvre = Annotated[Follow | Circle | StepSteer | Straight | BarCommand | LateralForce, Field(discriminator="kind")]

RIG_OF = {each.model_fields["kind"].annotation.__args__[0]: each.rig for each in Manoeuvre.__origin__.__args__}


class Bump(road.Bump):
    """A (1 - cos) bump that the wheels of one side roll over; `position` is ahead of the car's start."""

    side: Annotated[float, BeforeValidator(lambda side: _side(side))]
    height: float = quantity("m")
    length: float = quantity("m", gt=0)
    position: float = quantity("m")


class Road(Parameters):
    """The road: flat but for a bump."""

    bump: Bump | None = None


# each line of `expect:` is read with its metric's name at hand, because the metric decides the unit
Limits = Annotated[
    tuple[Limit, ...],
    PlainValidator(lambda line: limits(*line)),
    PlainSerializer(lambda held: [f"{each.relation} {each.bound:g}" for each in held]),
]
Expectations = Annotated[
    dict[str, Limits],
    BeforeValidator(
        lambda lines: {name: (name, text) for name, text in lines.items()} if isinstance(lines, dict) else lines
    ),
]


class Cycle(Parameters):
    """A cycle's file. Actuator, controller and vehicle are names or paths; the command line may replace them."""

    MOVED: ClassVar[dict[str, str]] = {"valves": "inputs"}

    title: str
    description: str
    rig: Rig
    duration: float = quantity("s", ge=SHORTEST, le=LONGEST)
    manoeuvre: Manoeuvre
    speed: float | None = quantity("m/s", gt=0, default=None, validate_default=True)  # initial and held; of the sedan
    road: Road = Road()
    inputs: Any = {}  # what the actuator takes besides its commands, over time: see `with_inputs`
    vehicle: str = Field("", validate_default=True)  # else the rig's own
    actuator: str = Field("", validate_default=True)  # else verification on the bench, pump_controlled elsewhere
    controller: str = Field("", validate_default=True)  # else verification on the bench, cascade elsewhere
    reference: str = "passive"  # the actuator whose roll the roll reduction factor is taken against
    window: tuple[Annotated[float, Unit("s", ge=0)], Annotated[float, Unit("s", gt=0)]] | None = (
        None  # of the metrics; else the whole cycle
    )
    expect: Expectations = {}  # metric -> its limits, held by `ars check`

    @field_validator("manoeuvre")
    @classmethod
    def _fits_the_rig(cls, manoeuvre, info: ValidationInfo):
        rig = info.data.get("rig", manoeuvre.rig)
        if manoeuvre.rig != rig:
            fitting = ", ".join(kind for kind, of in RIG_OF.items() if of == rig)
            raise ValueError(
                f"'{manoeuvre.kind}' is a manoeuvre of the rig {manoeuvre.rig}, not {rig}; allowed: {fitting}"
            )
        return manoeuvre

    @field_validator("speed")
    @classmethod
    def _stated_once(cls, speed, info: ValidationInfo):
        manoeuvre = info.data.get("manoeuvre")
        if manoeuvre is None:
            return speed
        if manoeuvre.rig != "sedan" and speed is not None:
            raise ValueError(f"the rig {manoeuvre.rig} has no speed")
        if manoeuvre.rig == "sedan" and (speed is None) == (getattr(manoeuvre, "speed", None) is None):
            raise ValueError("a sedan's speed is stated once, here or in the manoeuvre")
        return speed

    @field_validator("vehicle")
    @classmethod
    def _default_vehicle(cls, vehicle, info: ValidationInfo):
        return vehicle or info.data.get("rig", "")

    @field_validator("actuator")
    @classmethod
    def _default_actuator(cls, actuator, info: ValidationInfo):
        return actuator or ("verification" if info.data.get("rig") == "bench" else "pump_controlled")

    @field_validator("controller")
    @classmethod
    def _default_controller(cls, controller, info: ValidationInfo):
        return controller or ("verification" if info.data.get("rig") == "bench" else "cascade")

    @field_validator("road")
    @classmethod
    def _has_wheels_on_it(cls, road, info: ValidationInfo):
        if road.bump and info.data.get("rig", "sedan") != "sedan":
            raise ValueError(f"the rig {info.data['rig']} has no road")
        return road

    @field_validator("window")
    @classmethod
    def _lies_within(cls, window, info: ValidationInfo):
        if window and not window[0] < window[1] <= info.data.get("duration", window[1]):
            raise ValueError("needs a start before its end, both within the duration")
        return window

    def speed_signal(self) -> np.record:
        """The SIGNAL record of the sedan's speed in m/s."""
        changing = getattr(self.manoeuvre, "speed", None)
        return changing.signal() if changing else signal([0.0], [self.speed])


def with_inputs(inputs: Mapping[str, Any]) -> type[Cycle]:
    """The Cycle of an actuator that takes `inputs`: by name their unit, rest, least and most value; each is Knots."""
    fields: dict[str, Any] = {}
    for name, (unit, rest, least, most) in inputs.items():
        knots = KnotsOf(unit, ge=least, le=most)
        fields[name] = (knots, knots.model_construct(knots=((0.0, rest),)))
    block = create_model("Inputs", __base__=Parameters, **fields)
    return create_model("Cycle", __base__=Cycle, inputs=(block, block()))


def _side(side: object) -> float:
    sides = {"left": 1.0, "right": -1.0}
    if not isinstance(side, str):
        raise ValueError("needs a text; allowed: left, right")
    if side not in sides:
        raise ValueError("unknown; allowed: left, right")
    return sides[side]
