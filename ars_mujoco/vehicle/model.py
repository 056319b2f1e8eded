"""From a vehicle file to a MuJoCo model: the shipped MJCF with every parameter of the file written over it.

The MJCF files are complete models with the shipped values, so each opens alone in a viewer; another car needs only
another vehicle file. `specify` gives the MjSpec, to which a simulation may add before it compiles; `build` compiles.
"""

import math
from functools import singledispatch

import mujoco

from ars_mujoco.schema import library
from ars_mujoco.vehicle.bench import Bench
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import GRAVITY, Axle, Sedan

SIDES = {"left": 1.0, "right": -1.0}  # y of the side


def build(vehicle: Sedan | RollPlane | Bench) -> mujoco.MjModel:
    """The compiled model of `vehicle`."""
    return specify(vehicle).compile()


@singledispatch
def specify(vehicle) -> mujoco.MjSpec:
    """The MjSpec of `vehicle` (a Sedan, a RollPlane or a Bench)."""
    raise TypeError(f"no model for a {type(vehicle).__name__}")


@specify.register
def _sedan(vehicle: Sedan) -> mujoco.MjSpec:
    spec = _load("sedan")
    body, sprung = spec.body("body"), vehicle.sprung
    body.mass, body.ipos = sprung.mass, [0, 0, sprung.cg_height]
    body.inertia = [sprung.roll_inertia, sprung.pitch_inertia, sprung.yaw_inertia]
    spec.site("accelerometer").pos = [vehicle.accelerometer.ahead, 0, vehicle.accelerometer.height]
    for name, axle in vehicle.axles.items():
        for side in SIDES:
            _corner(spec, vehicle, name, axle, side)
            link_y = axle.track / 2 - (1 - axle.bar.link_ratio) * axle.swing_arm
            _bar_half(spec, name, side, axle.bar, vehicle.axle_position[name], link_y)
    return spec


@specify.register
def _roll_plane(vehicle: RollPlane) -> mujoco.MjSpec:
    spec = _load("roll_plane")
    body, joint = spec.body("body"), spec.joint("roll")
    body.mass, body.ipos = vehicle.mass, [0, 0, vehicle.cg_height]
    body.inertia *= vehicle.roll_inertia / body.inertia[0]  # only rolls; in proportion, any value is a possible body's
    joint.pos = [0, 0, vehicle.roll_axis_height]
    joint.stiffness[0], joint.damping[0] = vehicle.roll_stiffness, vehicle.roll_damping
    spec.site("accelerometer").pos = [0, 0, vehicle.accelerometer_height]
    for name, bar in (("front", vehicle.front), ("rear", vehicle.rear)):
        for side, y in SIDES.items():
            foot = [bar.position, y * bar.link_distance / 2, bar.height - bar.link_length]
            spec.site(f"{name}_link_{side}_arm").pos = foot
            spec.geom(f"{name}_link_{side}").fromto = [*foot, foot[0], foot[1], bar.height]
            spec.geom(f"{name}_post_{side}").fromto = [foot[0], foot[1], 0, *foot]
            _bar_half(spec, name, side, bar, bar.position, bar.link_distance / 2)
    return spec


@specify.register
def _bench(vehicle: Bench) -> mujoco.MjSpec:
    spec = _load("bench")
    for side, y in SIDES.items():
        spec.body(f"{side}_end").pos = [0, y * vehicle.width / 2, vehicle.height - vehicle.link_length]
        spec.geom(f"front_link_{side}").fromto = [0, 0, 0, 0, 0, vehicle.link_length]
        _bar_half(spec, "front", side, vehicle, 0, vehicle.width / 2)
    return spec


def _load(rig: str) -> mujoco.MjSpec:
    return mujoco.MjSpec.from_file(str(library.folder("mjcf") / rig / f"{rig}.xml"))


def _corner(spec: mujoco.MjSpec, vehicle: Sedan, axle_name: str, axle: Axle, side: str) -> None:
    """Place and weigh carrier, hub and wheel; positions on the carrier count from its instant centre."""
    corner, y = axle_name[0] + side[0], SIDES[side]
    x, arm, centre = vehicle.axle_position[axle_name], axle.swing_arm, axle.instant_centre_height
    load = vehicle.wheel_load[axle_name]
    wheel = [0, y * arm, vehicle.wheel_centre_height[axle_name] - centre]
    link = [0, y * axle.bar.link_ratio * arm, axle.bar.height - axle.bar.link_length - centre]
    steered = axle_name == "front"

    carrier, travel = spec.body(f"{corner}_carrier"), spec.joint(f"{corner}_travel")
    carrier.pos = [x, y * (axle.track / 2 - arm), centre]
    carrier.ipos = wheel
    carrier.mass = axle.unsprung_mass - axle.wheel_mass - (vehicle.steering.knuckle_mass if steered else 0)
    travel.stiffness[0], travel.damping[0] = axle.wheel_rate * arm**2, axle.damping * arm**2
    travel.springref = -(load - GRAVITY * axle.unsprung_mass) / (axle.wheel_rate * arm)
    spec.site(f"{axle_name}_link_{side}_arm").pos = link
    spec.body(f"{corner}_hub" if steered else f"{corner}_wheel").pos = wheel
    if steered:
        _steering(spec, vehicle, corner)

    spin = axle.spin_inertia
    spec.body(f"{corner}_wheel").mass = axle.wheel_mass
    spec.body(f"{corner}_wheel").inertia = [spin / 2, spin, spin / 2]  # a thin disc
    spec.geom(f"{corner}_tire").size[0] = axle.tire.radius
    spec.geom(f"{corner}_arm").fromto = [*wheel, *link]
    spec.geom(f"{corner}_link").fromto = [*link, link[0], link[1], link[2] + axle.bar.link_length]


def _steering(spec: mujoco.MjSpec, vehicle: Sedan, corner: str) -> None:
    steering, actuator = vehicle.steering, spec.actuator(f"{corner}_steer")
    spec.body(f"{corner}_hub").mass = steering.knuckle_mass
    spec.joint(f"{corner}_steer").axis = [-math.sin(steering.caster), 0, math.cos(steering.caster)]
    actuator.gainprm[0] = steering.stiffness
    actuator.biasprm[1:3] = [-steering.stiffness, -steering.damping]


def _bar_half(spec: mujoco.MjSpec, axle: str, side: str, bar, link_x: float, link_y: float) -> None:
    """Hinge one half `bar.arm` ahead of its drop link at (link_x, link_y), its arm pointing rearward."""
    half, y = f"{axle}_bar_{side}", SIDES[side] * link_y
    spec.body(half).pos = [link_x + bar.arm, 0, bar.height]
    spec.site(f"{axle}_link_{side}_bar").pos = [-bar.arm, y, 0]
    spec.geom(f"{half}_half").fromto = [0, 0, 0, 0, y, 0]
    spec.geom(f"{half}_arm").fromto = [0, y, 0, -bar.arm, y, 0]
