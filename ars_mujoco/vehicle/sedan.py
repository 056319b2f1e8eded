"""The sedan's file: every parameter of the car, with its unit and limits. Values and sources: mjcf/sedan/sedan.yaml.

Lengths are in the design pose, the car at rest on a level road; x forward from the sprung centre of gravity, y left,
z up from the road.
"""

import math

from pydantic import ValidationInfo, field_validator, model_validator

from ars_mujoco.schema.parameters import Parameters, number, quantity
from ars_mujoco.tires.tire import Tire

GRAVITY = 9.81  # m/s^2, as in the models


class Sprung(Parameters):
    """The body with all it carries."""

    mass: float = quantity("kg", gt=0)
    roll_inertia: float = quantity("kg*m^2", gt=0)  # these three about the sprung centre of gravity
    pitch_inertia: float = quantity("kg*m^2", gt=0)
    yaw_inertia: float = quantity("kg*m^2", gt=0)
    cg_height: float = quantity("m", gt=0)

    @model_validator(mode="after")
    def _is_a_possible_body(self):
        inertias = {name: getattr(self, f"{name}_inertia") for name in ("roll", "pitch", "yaw")}
        name, largest = max(inertias.items(), key=lambda each: each[1])
        others = sum(inertias.values()) - largest
        if largest > others:
            raise ValueError(
                f"{name}_inertia of {largest:g} kg*m^2 is more than the other two together, {others:g} kg*m^2: "
                "no body has that"
            )
        return self


class Bar(Parameters):
    """Stabilizer bar of one axle, its arms pointing rearward and its drop links in the plane of the axle."""

    arm: float = quantity("m", ge=0.04)  # a shorter one turns too far as its drop link travels by that much
    stiffness: float = quantity("Nm/rad", gt=0)  # torsion of the split bar, both halves in series
    passive_stiffness: float = quantity("Nm/rad", ge=0)  # torsion of the conventional bar in its place
    link_ratio: float = number(gt=0, lt=1)  # travel of the drop link over travel of the wheel
    link_length: float = quantity("m", ge=0.02)  # a shorter one tilts too far as the arm's end swings
    height: float = quantity("m", gt=0)  # of the bar's axis above the road


class Axle(Parameters):
    """One axle; rates and masses are per wheel."""

    track: float = quantity("m", gt=0)
    roll_centre_height: float = quantity("m")
    # camber change over wheel travel, top inwards in jounce; more would be a swing arm that folds under the car
    camber_gain: float = quantity("rad/m", gt=0, le=3)
    wheel_rate: float = quantity("N/m", gt=0)
    damping: float = quantity("Ns/m", ge=0)
    unsprung_mass: float = quantity("kg", gt=0)  # the wheel included
    wheel_mass: float = quantity("kg", gt=0)  # the part that spins
    spin_inertia: float = quantity("kg*m^2", gt=0)
    bar: Bar
    tire: Tire

    @field_validator("wheel_mass")
    @classmethod
    def _is_a_part(cls, wheel_mass, info: ValidationInfo):
        unsprung = info.data.get("unsprung_mass", math.inf)
        if wheel_mass >= unsprung:
            raise ValueError(f"must be less than the unsprung_mass it is a part of, {unsprung:g} kg")
        return wheel_mass

    @property
    def swing_arm(self) -> float:
        """Horizontal length (m) of the equivalent swing arm, instant centre to contact patch."""
        return 1.0 / self.camber_gain

    @property
    def instant_centre_height(self) -> float:
        """Height (m) of the instant centre, on the line from the contact patch through the roll centre."""
        return self.swing_arm * self.roll_centre_height / (self.track / 2)


class Steering(Parameters):
    """Front steering: the compliance between the commanded and the real angle of a wheel, and the steer axis."""

    stiffness: float = quantity("Nm/rad", gt=0)  # per wheel, about the steer axis
    damping: float = quantity("Nms/rad", ge=0)
    caster: float = quantity("rad", ge=0, lt=math.pi / 4)  # rearward lean of the steer axis, through the wheel centre
    knuckle_mass: float = quantity("kg", gt=0)  # steered, without the wheel


class SensorPlace(Parameters):
    """Where the lateral accelerometer sits on the centre line."""

    ahead: float = quantity("m")  # of the sprung centre of gravity
    height: float = quantity("m", ge=0)


class Sedan(Parameters):
    """A car with two axles, steered in front."""

    sprung: Sprung
    wheelbase: float = quantity("m", gt=0)
    cg_to_front_axle: float = quantity("m", gt=0)  # of the sprung mass
    front: Axle
    rear: Axle
    steering: Steering
    accelerometer: SensorPlace

    @field_validator("cg_to_front_axle")
    @classmethod
    def _lies_between_the_axles(cls, ahead, info: ValidationInfo):
        wheelbase = info.data.get("wheelbase", math.inf)
        if ahead >= wheelbase:
            raise ValueError(f"must be less than the wheelbase, {wheelbase:g} m: the car would tip over")
        return ahead

    @field_validator("steering")
    @classmethod
    def _leaves_the_carrier_a_mass(cls, steering, info: ValidationInfo):
        front = info.data.get("front")
        if front and front.wheel_mass + steering.knuckle_mass >= front.unsprung_mass:
            raise ValueError(
                f"knuckle_mass and front.wheel_mass, {front.wheel_mass + steering.knuckle_mass:g} kg together, "
                f"must be less than front.unsprung_mass, {front.unsprung_mass:g} kg"
            )
        return steering

    @model_validator(mode="after")
    def _stands_on_its_tires(self):
        for name, axle in self.axles.items():
            if self.wheel_centre_height[name] <= 0.0:
                raise ValueError(
                    f"{name}.tire.stiffness of {axle.tire.stiffness:g} N/m is too little: the wheel's load of "
                    f"{self.wheel_load[name]:.0f} N presses the tire in by more than its radius, {axle.tire.radius:g} m"
                )
        return self

    @property
    def axles(self) -> dict[str, Axle]:
        """The two axles by name."""
        return {"front": self.front, "rear": self.rear}

    @property
    def mass(self) -> float:
        """Mass (kg) of the whole car."""
        return self.sprung.mass + 2 * (self.front.unsprung_mass + self.rear.unsprung_mass)

    @property
    def axle_position(self) -> dict[str, float]:
        """x (m) of each axle from the sprung centre of gravity."""
        return {"front": self.cg_to_front_axle, "rear": self.cg_to_front_axle - self.wheelbase}

    @property
    def wheel_load(self) -> dict[str, float]:
        """Static load (N) of a wheel of each axle."""
        ahead = self.cg_to_front_axle / self.wheelbase
        share = {"front": 1 - ahead, "rear": ahead}
        return {
            name: GRAVITY * (axle.unsprung_mass + share[name] * self.sprung.mass / 2)
            for name, axle in self.axles.items()
        }

    @property
    def wheel_centre_height(self) -> dict[str, float]:
        """Height (m) of the wheel centres of each axle at rest."""
        return {
            name: axle.tire.radius - self.wheel_load[name] / axle.tire.stiffness for name, axle in self.axles.items()
        }
