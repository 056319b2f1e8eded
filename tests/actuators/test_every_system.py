"""What holds for every system there is: rest, mirror symmetry, closed books, convergence, restores, its twin."""

import json
import re
import subprocess
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
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
from ars_mujoco.kernels.kernel import interpreted
from ars_mujoco.metrics.energy import energy_audit_error
from ars_mujoco.metrics.metric import Run
from ars_mujoco.recording.rerun.display import unit_and_factor
from ars_mujoco.rigs.rig import rig
from ars_mujoco.rigs.setup import prepare
from ars_mujoco.schema import library
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.plots import recorded
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


def module_of(name: str):
    return registry.module_of(read_inputs(CAR, name).actuator.value)


ACTIVE = [name for name in FILES if is_active(system_of(name))]
SYSTEMS = list({system_of(name): name for name in reversed(FILES)}.values())  # a file of each
ACTIVE_SYSTEMS = [name for name in SYSTEMS if name in ACTIVE]


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


@cache
def pushed(name: str, acceleration: float):
    """An active system in both axles of the roll plane, that is pushed to the side by so many m/s^2."""
    push = f"manoeuvre.acceleration={{knots: [[0.1 s, 0 m/s^2], [0.4 s, {acceleration} m/s^2]]}}"
    return shipped.recording(CAR, name, push, *TIMES)


def in_the_middle(name: str):
    cycle, settings = asked(name, 6.0)
    simulation = shipped.simulation(cycle, name, *settings)
    return simulation, shipped.driven(simulation, 0.6)


def test_every_system_has_a_file():
    assert {module_of(name) for name in FILES} == set(registry.systems().values())


@pytest.mark.parametrize("name", FILES)
def test_at_rest_it_stays_at_rest(name):
    assert np.abs(run(name, 0.0)["front.bar.torque"]).max() < 1e-9  # Nm


@pytest.mark.parametrize("name", ACTIVE_SYSTEMS)
def test_in_a_car_at_rest_both_its_axles_stay_at_rest(name):
    still = pushed(name, 0.0)
    assert max(np.abs(still[f"{axle}.bar.torque"]).max() for axle in ("front", "rear")) < 1e-9  # Nm


@pytest.mark.parametrize("name", FILES)
def test_a_mirrored_run_is_the_mirror_image(name):
    torque = run(name)["front.bar.torque"]
    assert np.abs(torque).max() > 0.0 or name == "none"
    assert run(name, -6.0)["front.bar.torque"] == pytest.approx(-torque, abs=1e-12 * np.abs(torque).max())


@pytest.mark.parametrize("name", ACTIVE_SYSTEMS)
def test_a_car_pushed_to_the_other_side_is_its_mirror_image_in_both_axles(name):
    for axle in ("front", "rear"):
        torque = pushed(name, 6.0)[f"{axle}.bar.torque"]
        assert np.abs(torque).max() > 100.0
        mirrored = pushed(name, -6.0)[f"{axle}.bar.torque"]
        assert mirrored == pytest.approx(-torque, abs=1e-12 * np.abs(torque).max())


@pytest.mark.parametrize("name", [name for name in FILES if name != "none"])
def test_its_books_close(name):
    """On the bench the work of the bar is exact; on the roll plane it is a sum of trapezoids."""
    assert energy_audit_error(Run(run(name), (0.0, 0.9))).value < (1e-6 if name in ACTIVE else 1e-3)


@pytest.mark.parametrize("name", ACTIVE_SYSTEMS)
def test_in_a_car_its_books_close_in_both_axles_and_what_they_share(name):
    assert energy_audit_error(Run(pushed(name, 6.0), (0.0, 0.9))).value < 1e-3


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


LOADED = """
import json, sys
from importlib import import_module
from pathlib import Path
from ars_mujoco.rigs.rig import rig
pairs = [rig(name, import_module(system)) for name, system in json.loads(sys.argv[1])]
print(json.dumps([pair.CALLBACK.compiled.cache_hits for pair in pairs]))
"""


@cache
def loaded() -> dict[str, int]:
    """By the file of a system how often a second process finds its entry on the disk, once this one has had it."""
    rigs = [shipped.simulation(asked(name, 6.0)[0], name, *asked(name, 6.0)[1]).rig for name in SYSTEMS]
    assert all(each.CALLBACK.address for each in rigs)
    pairs = json.dumps([(each.NAME, each.system.__name__) for each in rigs])
    second = subprocess.run([sys.executable, "-c", LOADED, pairs], capture_output=True, text=True, check=True)
    return dict(zip(SYSTEMS, json.loads(second.stdout), strict=True))


@pytest.mark.skipif(interpreted, reason="nothing is compiled with NUMBA_DISABLE_JIT=1")
@pytest.mark.parametrize("name", SYSTEMS)
def test_a_second_process_does_not_compile_it_again(name):
    assert loaded()[name] == 1


@pytest.mark.parametrize("name", FILES)
def test_its_channels_say_what_they_are(name):
    for channel in rig("sedan", system_of(name)).channels.values():
        assert channel.unit and channel.description


@pytest.mark.parametrize("name", FILES)
def test_its_plots_show_its_own_channels_or_those_of_another_variant(name):
    variants = [each for each in FILES if module_of(each) is module_of(name)]
    known = set().union(*(rig("sedan", system_of(each)).channels for each in variants))
    assert {each for tab in system_of(name).PLOTS for plot in tab.plots for each in plot.channels} <= known


@pytest.mark.parametrize("name", FILES)
def test_its_channels_stand_in_one_plot_of_one_unit_each(name):
    pair = rig("sedan", system_of(name))
    plots = [plot for tab in recorded(pair.tabs, pair.channels) for plot in tab.plots]
    for plot in plots:
        assert len({unit_and_factor(pair.channels[each])[0] for each in plot.channels}) == 1, plot.name
    shown = [each for plot in plots for each in plot.channels]
    assert len(shown) == len(set(shown))
    own = set(pair.channels) - set(rig("sedan", system_of("none")).channels)
    assert name not in ACTIVE or own & set(shown)


@pytest.mark.parametrize("name", FILES)
def test_its_events_and_errors_name_channels_that_it_has(name):
    system = system_of(name)
    assert {*(each.channel for each in system.EVENTS), *system.BEYOND.channels} <= set(rig("sedan", system).channels)


@pytest.mark.parametrize("missing", NAMES)
def test_a_system_that_lacks_a_name_of_the_contract_is_refused(missing):
    module = ModuleType("half")
    module.__file__ = "half.py"
    vars(module).update({name: None for name in NAMES if name != missing}, FOLLOWS="angle")
    if missing == "FOLLOWS":
        del module.FOLLOWS
    with pytest.raises(InputError, match=f"half.py: a system needs {missing}"):
        completed(module)


@pytest.mark.parametrize("module", registry.systems().values(), ids=registry.systems())
def test_its_folder_tells_what_it_is_and_names_tests_that_exist(module):
    folder, root = Path(module.__file__).parent, Path(__file__).parents[2]
    text = (folder / "README.md").read_text()
    assert text.startswith(f"# {folder.name}\n")
    named = re.findall(r"\btest_\w+", text)
    assert named and all(list(root.glob(f"tests/**/{each}.py")) for each in named)
    assert all((folder / each).is_file() for each in re.findall(r"\b\w+\.yaml", text))
