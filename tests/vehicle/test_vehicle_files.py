"""The vehicles' files: a car that cannot be is refused where it is written, with what would be possible."""

import pytest

from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.vehicle.model import build

CYCLE = {"sedan": "s_curve_120kmh", "roll_plane": "roll_plane_step"}


def problem(rig: str, *settings: str) -> str:
    with pytest.raises(InputError) as error:
        read_inputs(CYCLE[rig], settings=[f"vehicle.{each}" for each in settings])
    (line,) = error.value.problems
    return line


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("sprung.roll_inertia=6000 kg*m^2", "sprung: roll_inertia of 6000 kg*m^2 is more than the other two together"),
        ("sprung.yaw_inertia=3000 kg*m^2", "sprung: yaw_inertia of 3000 kg*m^2 is more than"),
        ("cg_to_front_axle=2.8 m", "cg_to_front_axle: '2.8 m': must be less than the wheelbase, 2.8 m"),
        ("wheelbase=1 m", "cg_to_front_axle: '1.372 m': must be less than the wheelbase, 1 m"),
        ("rear.wheel_mass=42 kg", "rear.wheel_mass: '42 kg': must be less than the unsprung_mass it is a part of"),
        ("front.unsprung_mass=34 kg", "steering: knuckle_mass and front.wheel_mass, 34 kg together, must be less"),
        ("front.tire.stiffness=225 N/m", "front.tire.stiffness of 225 N/m is too little"),
        ("front.camber_gain=10 rad/m", "front.camber_gain: '10 rad/m': must be at most 3 rad/m"),
        ("front.bar.arm=5 mm", "front.bar.arm: '5 mm': must be at least 40 mm"),
        ("front.bar.link_length=1 mm", "front.bar.link_length: '1 mm': must be at least 20 mm"),
    ],
)
def test_a_sedan_that_cannot_be_is_refused(setting, expected):
    assert f": {expected}" in problem("sedan", setting)


@pytest.mark.parametrize("setting", ["front.arm=5 mm", "front.link_length=1 mm"])
def test_a_roll_plane_whose_bar_cannot_follow_is_refused(setting):
    assert "must be at least" in problem("roll_plane", setting)


@pytest.mark.parametrize("inertia", [100, 520, 6000])
def test_the_roll_plane_has_any_roll_inertia(inertia, roll_plane):
    body = build(roll_plane.model_copy(update={"roll_inertia": inertia})).body("body")
    assert body.inertia[0] == pytest.approx(inertia)
    assert body.iquat == pytest.approx([1, 0, 0, 0])  # its first axis is that of the roll


@pytest.mark.parametrize(
    "settings",
    [
        ["front.bar.arm=40 mm", "front.bar.link_length=20 mm"],
        ["front.camber_gain=3 rad/m", "rear.camber_gain=3 rad/m"],
        ["front.camber_gain=0.3 rad/m", "rear.camber_gain=0.3 rad/m"],
    ],
)
def test_what_is_just_allowed_has_a_model(settings):
    inputs = read_inputs(CYCLE["sedan"], settings=[f"vehicle.{each}" for each in settings])
    assert build(inputs.vehicle.value).nv == 20
