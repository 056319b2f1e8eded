"""The models: what ships is what the files say, and its kinematics are those of its parameters."""

import math
import re

import mujoco
import numpy as np
import pytest
import yaml
from scipy.optimize import brentq

from ars_mujoco.schema import library
from ars_mujoco.vehicle.model import build, specify

RIGS = ("sedan", "roll_plane", "bench")
CORNERS = ("fl", "fr", "rl", "rr")


def shipped(rig: str, name: str):
    return library.folder("mjcf") / rig / name


@pytest.mark.parametrize("rig", RIGS)
def test_the_xml_as_shipped_is_the_model_its_own_file_builds(rig, request):
    built = build(request.getfixturevalue(rig))
    xml = mujoco.MjModel.from_xml_path(str(shipped(rig, f"{rig}.xml")))
    for name in dir(built):
        values = getattr(built, name)
        if isinstance(values, np.ndarray) and np.issubdtype(values.dtype, np.number):
            np.testing.assert_allclose(getattr(xml, name), values, rtol=1e-6, atol=1e-8, err_msg=name)


@pytest.mark.parametrize("rig", RIGS)
def test_the_readme_names_every_value_of_the_file(rig):
    rows = re.findall(r"^\| ([\w.]+) \| (.+?) \| [TDJ] \|", shipped(rig, "README.md").read_text(), re.MULTILINE)
    stated = {name: yaml.safe_load(value) for name, value in rows}
    # where the README gives no value for the rear it has the front's
    stated = {name.replace("front.", "rear."): value for name, value in stated.items()} | stated
    assert stated == flat(yaml.safe_load(shipped(rig, f"{rig}.yaml").read_text()))


def flat(tree, prefix="") -> dict:
    found = {}
    for key, value in tree.items():
        found |= flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value}
    return found


@pytest.mark.parametrize("rig", RIGS)
def test_the_scene_shows_the_model_on_a_road_without_contacts(rig):
    model = mujoco.MjModel.from_xml_path(str(shipped(rig, "scene.xml")))
    assert model.geom("road").id >= 0
    assert not (model.geom_contype | model.geom_conaffinity).any()


def test_the_sedan_has_twenty_degrees_of_freedom_and_four_link_rows(sedan_model):
    assert (sedan_model.nv, sedan_model.neq) == (20, 4)


def test_the_model_weighs_what_the_file_says(sedan, sedan_model):
    # the bars' halves add 0.04 kg
    assert sedan_model.body_mass.sum() == pytest.approx(sedan.mass, abs=0.05)


@pytest.mark.parametrize("corner", CORNERS)
@pytest.mark.parametrize(("camber_gain", "roll_centre_height"), [(None, None), (0.6, 0.15)])
def test_camber_gain_and_roll_centre_are_read_back_from_the_travel(corner, camber_gain, roll_centre_height, sedan):
    name = "front" if corner[0] == "f" else "rear"
    axle = getattr(sedan, name)
    camber_gain, roll_centre_height = camber_gain or axle.camber_gain, roll_centre_height or axle.roll_centre_height
    changed = axle.model_copy(update={"camber_gain": camber_gain, "roll_centre_height": roll_centre_height})
    model = build(sedan.model_copy(update={name: changed}))
    data, side = mujoco.MjData(model), 1 if corner[1] == "l" else -1

    def patch(travel):
        """y and z (m) of the point of the carrier that touches the road at rest, and the camber (rad)."""
        data.joint(f"{corner}_travel").qpos = travel
        mujoco.mj_kinematics(model, data)
        wheel, turn = data.body(f"{corner}_wheel"), data.body(f"{corner}_carrier").xmat.reshape(3, 3)
        down = turn @ [0, 0, -sedan.wheel_centre_height[name]]
        return *(wheel.xpos + down)[1:], side * wheel.xmat[7]

    rest, jounce = np.array(patch(-0.02 * camber_gain)), np.array(patch(0.02 * camber_gain))
    across, up, camber = jounce - rest  # over 40 mm of travel
    assert up == pytest.approx(0.04, rel=1e-3)
    assert camber / up == pytest.approx(camber_gain, rel=1e-3)
    # the patch moves square to the line through instant centre and roll centre
    assert side * across / up * changed.track / 2 == pytest.approx(roll_centre_height, rel=1e-2)


@pytest.mark.parametrize("corner", CORNERS)
@pytest.mark.parametrize("travel", [-0.05, -0.02, 0.02, 0.05])
def test_the_link_travels_half_as_far_as_the_wheel(corner, travel, sedan, sedan_model):
    model, data = sedan_model, mujoco.MjData(sedan_model)
    axle, side = ("front", "rear")[corner[0] == "r"], {"l": "left", "r": "right"}[corner[1]]
    bar, link = f"{axle}_bar_{side}", f"{axle}_link_{side}"
    length = model.tendon_length0[model.tendon(link).id]

    def stretch(angle):
        data.joint(bar).qpos = angle
        mujoco.mj_fwdPosition(model, data)
        return data.tendon(link).length[0] - length

    mujoco.mj_kinematics(model, data)
    height = data.body(f"{corner}_wheel").xpos[2]
    data.joint(f"{corner}_travel").qpos = travel
    angle = brentq(stretch, -0.5, 0.5)
    rise = data.body(f"{corner}_wheel").xpos[2] - height
    assert np.sign(angle) == np.sign(travel)
    assert 0.47 < sedan.front.bar.arm * math.sin(angle) / rise < 0.50


def test_the_caster_puts_the_steer_axis_ahead_of_the_contact_patch(sedan, sedan_model):
    data = mujoco.MjData(sedan_model)
    mujoco.mj_kinematics(sedan_model, data)
    joint, wheel = data.joint("fl_steer"), data.body("fl_wheel").xpos
    on_the_road = joint.xanchor - joint.xaxis * joint.xanchor[2] / joint.xaxis[2]
    assert on_the_road[0] - wheel[0] == pytest.approx(0.032, abs=0.001)
    assert joint.xaxis[2] > 0  # positive steers left


def test_a_positive_spin_rolls_forward(sedan_model):
    data = mujoco.MjData(sedan_model)
    mujoco.mj_kinematics(sedan_model, data)
    np.testing.assert_allclose(data.joint("rl_spin").xaxis, [0, 1, 0], atol=1e-12)


def test_another_car_needs_no_other_xml(sedan):
    longer = sedan.model_copy(update={"wheelbase": 3.1, "front": sedan.front.model_copy(update={"track": 1.66})})
    data = mujoco.MjData(model := build(longer))
    mujoco.mj_kinematics(model, data)
    np.testing.assert_allclose(data.body("fl_wheel").xpos[:2], [1.372, 0.83])
    assert data.body("fl_wheel").xpos[0] - data.body("rl_wheel").xpos[0] == pytest.approx(3.1)


def test_an_end_of_the_bench_turns_its_half(bench):
    model = build(bench)
    data = mujoco.MjData(model)
    data.mocap_pos[model.body("left_end").mocapid[0], 2] += 0.03
    for _ in range(500):
        mujoco.mj_step(model, data)
    twist = data.joint("front_bar_left").qpos[0] - data.joint("front_bar_right").qpos[0]
    # the halves show the twist of two arms, which is the one-arm form while one end rests
    assert twist == pytest.approx(math.asin(0.03 / bench.arm), rel=0.01)


def test_what_is_no_vehicle_has_no_model():
    with pytest.raises(TypeError, match="no model for a str"):
        specify("sedan")
