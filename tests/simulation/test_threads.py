"""Simulations side by side in one process: each gives, to the last bit, what it gives alone."""

from concurrent.futures import ThreadPoolExecutor
from threading import Event

import mujoco
import numpy as np
import pytest
import shipped
from shipped import drive_on

from ars_mujoco.bridge.callback import installed
from ars_mujoco.schema.errors import ArsError
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

COMPILED = """
def command(sensors, memory):
    memory[0] += sensors.lateral_acceleration * sensors.step
    return 0.012 * sensors.lateral_acceleration + 0.004 * memory[0], 0.008 * sensors.lateral_acceleration
"""
OF_ITS_OWN = """
class Integrator:
    sum = 0.0

    def __call__(self, sensors, memory):
        self.sum += sensors.lateral_acceleration * sensors.step
        return 0.012 * sensors.lateral_acceleration + 0.004 * self.sum, 0.008 * sensors.lateral_acceleration

command = Integrator()
"""
DRAWN = """
import random

def command(sensors, memory):
    str(sensors)
    return 0.01 * random.random(), 0.0
"""
WAYS = [("bench_s_curve", None, None), ("step_steer_iso7401", None, None), ("step_steer_iso7401", "passive", None)]
LAWS = [("roll_plane_step", None, law) for law in (COMPILED, OF_ITS_OWN, OF_ITS_OWN, DRAWN, DRAWN)]

pytestmark = pytest.mark.filterwarnings("ignore:.*does not compile")


def prepared(folder, number, cycle, actuator, law):
    path = folder / f"law{number}.py"
    if law:
        path.write_text(law)
    inputs = read_inputs(cycle, actuator, str(path) if law else None, settings=[f"duration={0.6 + 0.2 * number} s"])
    return simulation_of(inputs)


@pytest.mark.parametrize("runs", [[*WAYS, WAYS[1]], LAWS], ids=["shipped", "laws"])
def test_simulations_in_threads_give_what_they_give_alone(runs, tmp_path):
    simulations = [prepared(tmp_path, number, *run) for number, run in enumerate(runs)]
    alone = [simulate(each) for each in simulations]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(simulate, simulations))
    for ours, theirs in zip(together, alone, strict=True):
        np.testing.assert_array_equal(ours.values, theirs.values)
        np.testing.assert_array_equal(ours.poses, theirs.poses)
    assert mujoco.get_mjcb_control() is None


def test_one_simulation_can_run_twice_at_once():
    simulation, alone = shipped.simulation("step_steer_iso7401"), shipped.recording("step_steer_iso7401")
    with ThreadPoolExecutor(2) as pool:
        for recording in pool.map(simulate, [simulation, simulation]):
            np.testing.assert_array_equal(recording.values, alone.values)


def test_cars_that_are_set_up_in_threads_are_the_same():
    def set_up(actuator):
        return simulation_of(read_inputs("step_steer_iso7401", actuator)).model

    actuators = ["passive", None, "passive", None]
    alone = [set_up(each) for each in actuators[:2]] * 2
    with ThreadPoolExecutor(4) as pool:
        for model, once in zip(pool.map(set_up, actuators), alone, strict=True):
            np.testing.assert_array_equal(model.numeric_data, once.numeric_data)
            np.testing.assert_array_equal(model.key_qvel, once.key_qvel)


def test_a_run_goes_on_beside_a_thread_that_steps_for_itself():
    car, own = shipped.simulation("step_steer_iso7401"), shipped.simulation("step_steer_iso7401", "passive")
    end = drive_on(own, own.start(), 500)
    with ThreadPoolExecutor(2) as pool:
        running, stepping = pool.submit(simulate, car), pool.submit(drive_on, own, own.start(), 500)
        np.testing.assert_array_equal(stepping.result(), end)
        np.testing.assert_array_equal(running.result().values, shipped.recording("step_steer_iso7401").values)


def test_threads_that_step_for_themselves_wait_for_each_other():
    simulation, first_is_in, order = shipped.simulation("step_steer_iso7401"), Event(), []

    def second():
        first_is_in.wait()
        with installed(simulation.rig, simulation.model, simulation.start()):
            order.append("second")

    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(second)
        with installed(simulation.rig, simulation.model, simulation.start()):
            first_is_in.set()
            with pytest.raises(TimeoutError):
                waiting.result(timeout=0.2)
            order.append("first")
        waiting.result()
    assert order == ["first", "second"]


def test_a_callback_that_was_taken_away_from_an_own_loop_is_an_error_at_its_end():
    simulation = shipped.simulation("step_steer_iso7401")
    with (
        pytest.raises(ArsError, match="mjcb_control was replaced while a rig was installed"),
        installed(simulation.rig, simulation.model, simulation.start()),
    ):
        mujoco.set_mjcb_control(None)


def test_random_numbers_begin_alike_in_every_run_and_leave_those_of_the_program_alone(tmp_path):
    simulation = prepared(tmp_path, 0, *LAWS[-1])
    np.random.seed(1)
    first = simulate(simulation)
    after = np.random.random()
    np.random.seed(1)
    assert np.random.random() == after
    command = first["front.bar.command"]
    assert np.ptp(command) > 0.009
    np.testing.assert_array_equal(simulate(simulation)["front.bar.command"], command)


def test_so_do_those_of_a_compiled_law(tmp_path):
    drawn = "import numpy as np\n\ndef command(sensors, memory):\n    return 0.01 * np.random.random(), 0.0\n"
    simulation = prepared(tmp_path, 0, "roll_plane_step", None, drawn)
    assert simulation.law.is_native
    command = simulate(simulation)["front.bar.command"]
    assert np.ptp(command) > 0.009
    np.testing.assert_array_equal(simulate(simulation)["front.bar.command"], command)
