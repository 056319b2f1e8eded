"""What holds for every system there is: rest, mirror symmetry, closed books, convergence, restores, its twin."""

from functools import cache
from importlib import import_module
from types import ModuleType

import mujoco
import numpy as np
import pytest
import shipped
from mujoco.batch import Batch
from shipped import drive_on
from twins import twins_apart

from ars_mujoco.actuators import registry
from ars_mujoco.actuators.registry import system_for
from ars_mujoco.actuators.system import NAMES, completed, is_active
from ars_mujoco.bridge.callback import installed
from ars_mujoco.bridge.world import RUNNING, view
from ars_mujoco.metrics.energy import energy_audit_error
from ars_mujoco.metrics.metric import Run
from ars_mujoco.rigs.rig import rig
from ars_mujoco.rigs.setup import prepare
from ars_mujoco.schema import library
from ars_mujoco.schema.errors import InputError
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs

CAR, BENCH = "roll_plane_step", "bench_step_1deg"
FILES = sorted(library.shipped("actuator"))
TIMES = ("controller.unit.sample_time=1 ms", "duration=0.9 s")
# what takes energy out of a motion, by its name
RESISTING = {"leakage": "m^3/s/Pa", "viscous_friction": "Nms/rad", "resistance": "ohm", "damping": "Nms/rad"}


@cache
def system_of(name: str):
    return system_for(read_inputs(CAR, name).actuator.value)


ACTIVE = [name for name in FILES if is_active(system_of(name))]
SYSTEMS = list({system_of(name): name for name in reversed(FILES)}.values())  # a file of each


def asked(name: str, size: float) -> tuple[str, tuple[str, ...]]:
    """(cycle, settings) that move a bar: an active one by its command and by its ends, another on the roll plane."""
    if name in ACTIVE:
        command = f"manoeuvre.command={{knots: [[0.1 s, 0 deg], [0.4 s, {size} deg]]}}"
        return BENCH, (command, f"manoeuvre.ends={{knots: [[0.5 s, 0 mm], [0.7 s, {-size} mm]]}}", *TIMES)
    force = f"manoeuvre.acceleration={{knots: [[0.1 s, 0 m/s^2], [0.4 s, {size} m/s^2]]}}"
    return CAR, (force, "duration=0.9 s")


@cache
def run(name: str, size: float = 6.0, *settings: str):
    cycle, own = asked(name, size)
    return shipped.recording(cycle, name, *own, *settings)


def in_the_middle(name: str):
    cycle, settings = asked(name, 6.0)
    simulation = shipped.simulation(cycle, name, *settings)
    return simulation, shipped.driven(simulation, 0.6)


def test_every_system_has_a_file():
    assert {registry.module_of(read_inputs(CAR, name).actuator.value) for name in FILES} == set(
        registry.systems().values()
    )


@pytest.mark.parametrize("name", FILES)
def test_at_rest_it_stays_at_rest(name):
    assert np.abs(run(name, 0.0)["front.bar.torque"]).max() < 1e-3  # Nm; the roll plane's own rest is no better


@pytest.mark.parametrize("name", FILES)
def test_a_mirrored_run_is_the_mirror_image(name):
    torque = run(name)["front.bar.torque"]
    assert np.abs(torque).max() > 0.0 or name == "none"
    assert run(name, -6.0)["front.bar.torque"] == pytest.approx(-torque, abs=1e-6 * np.abs(torque).max() + 1e-9)


@pytest.mark.parametrize("name", [name for name in FILES if name != "none"])
def test_its_books_close(name):
    assert energy_audit_error(Run(run(name), (0.0, 0.9))).value < 1e-3


@pytest.mark.parametrize("name", ACTIVE)
def test_what_resists_more_gives_nothing_more_back(name):
    def recovered(recording):
        drawn = [each for each, channel in recording.channels.items() if channel.role == "drawn"]
        return sum(np.maximum(-np.diff(recording[each]), 0.0).sum() for each in drawn)

    file = read_inputs(CAR, name).actuator.value.model_dump(mode="json")
    settings = [f"actuator.{path}={3 * value!r} {unit}" for path, value, unit in _resisting(file)]
    assert settings
    assert recovered(run(name, 6.0, *settings)) <= 1.02 * recovered(run(name)) + 0.1


def _resisting(block: dict, path: str = ""):
    """(path, value, unit) of all that resists in both axles, in SI; not of what a control loop damps with."""
    for key, value in block.items():
        here = f"{path}.{key}" if path else key
        if isinstance(value, dict) and (path or key in ("front", "rear")):
            yield from _resisting(value, here)
        elif key in RESISTING and isinstance(value, float) and not path.endswith(("servo_valve", "control_cylinder")):
            yield here, value, RESISTING[key]


@pytest.mark.parametrize("name", SYSTEMS)
def test_it_converges_with_the_physics_step(name, monkeypatch):
    cycle, settings = asked(name, 6.0)
    set_up, ends = import_module(f"ars_mujoco.rigs.setup.{'bench' if name in ACTIVE else 'roll_plane'}"), []
    specify = set_up.specify

    def finer(vehicle, step):
        spec = specify(vehicle)
        spec.option.timestep = step
        return spec

    for step in (1e-3, 5e-4, 2.5e-4, 1.25e-4):
        monkeypatch.setattr(set_up, "specify", lambda vehicle, step=step: finer(vehicle, step))
        inputs = read_inputs(cycle, name, settings=(*settings, "controller.unit.delay=1 ms"))
        parts = (inputs.cycle.value, inputs.actuator.value, inputs.controller.value, inputs.vehicle.value)
        run = simulate(prepare(*parts))
        ends.append(run["front.bar.torque"][np.searchsorted(run.time, 0.6 - 1e-9)])
    first, second, third = np.abs(np.subtract(ends[:-1], ends[-1]))
    assert first / second > 1.6  # of first order at least: 7/3 against the finest
    assert second / third > 1.8


@pytest.mark.parametrize("name", SYSTEMS)
def test_its_interpreted_twin_agrees(name, tmp_path, monkeypatch):
    simulation, data = in_the_middle(name)
    assert twins_apart(simulation, data, 10, tmp_path, monkeypatch) < 1e-12


@pytest.mark.parametrize("name", FILES)
def test_a_run_restored_in_its_middle_ends_identical(name):
    simulation, data = in_the_middle(name)
    state = shipped.state_of(simulation.model, data)
    np.testing.assert_array_equal(
        drive_on(simulation, shipped.restored(simulation.model, state), 100), drive_on(simulation, data, 100)
    )


@pytest.mark.parametrize("name", SYSTEMS)
def test_a_row_of_a_batch_is_the_run_alone(name):
    simulation, data = in_the_middle(name)
    state = shipped.state_of(simulation.model, data)
    batch = Batch(simulation.model, nsim=2, nthread=2)
    batch.state[:] = state
    with installed(simulation.rig, simulation.model, simulation.start()):
        for _ in range(50):
            batch.step()
    alone = drive_on(simulation, data, 50)
    for row in range(2):
        np.testing.assert_array_equal(batch.state[row], alone)


@pytest.mark.parametrize("name", FILES)
def test_a_second_call_at_the_same_time_changes_nothing(name):
    simulation, data = in_the_middle(name)
    with installed(simulation.rig, simulation.model, data):
        mujoco.mj_forward(simulation.model, data)
        once = data.userdata.copy()
        mujoco.mj_forward(simulation.model, data)
    np.testing.assert_array_equal(data.userdata, once)


@pytest.mark.parametrize("name", FILES)
def test_its_sensors_read_the_angle_that_it_records(name):
    simulation, data = in_the_middle(name)
    with installed(simulation.rig, simulation.model, data):
        mujoco.mj_forward(simulation.model, data)
    world = view(data, simulation.rig.WORLD)
    assert world.header.status == RUNNING
    if name in ACTIVE:
        sensors = world.scratch.sensors
        simulation.rig.system.sense(world.parameters.system, world.now.system, sensors)
        assert sensors.front_angle == world.out.system.front.bar.angle != 0.0
        assert np.sign(sensors.front_torque) == np.sign(world.out.bars.front.bar.torque)


@pytest.mark.parametrize("name", FILES)
def test_at_rest_it_is_not_beyond_what_is_physical(name):
    simulation = shipped.simulation(asked(name, 6.0)[0], name, *asked(name, 6.0)[1])
    _, world = shipped.own_copy(simulation)
    assert not simulation.rig.system.is_beyond(world.parameters.system, world.now.system)


@pytest.mark.parametrize("name", FILES)
def test_its_channels_say_what_they_are_and_its_plots_show_channels_that_it_has(name):
    pair = rig("sedan", system_of(name))
    for channel in pair.channels.values():
        assert channel.unit and channel.description
    shown = {each for tab in system_of(name).PLOTS for plot in tab.plots for each in plot.channels}
    known = set().union(*(rig("sedan", system_of(each)).channels for each in FILES))
    assert shown <= known
    assert name not in ACTIVE or shown & set(pair.channels)


@pytest.mark.parametrize("missing", NAMES)
def test_a_system_that_lacks_a_name_of_the_contract_is_refused(missing):
    module = ModuleType("half")
    module.__file__ = "half.py"
    vars(module).update({name: None for name in NAMES if name != missing}, FOLLOWS="angle")
    if missing == "FOLLOWS":
        del module.FOLLOWS
    with pytest.raises(InputError, match=f"half.py: a system needs {missing}"):
        completed(module)
