"""Inputs and simulations go through pickles and copies: to other processes, and for who changes his own."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest
import shipped

from ars_mujoco.schema import library
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

LAW = """
class Count:
    samples = 0

    def __call__(self, sensors, memory):
        self.samples += 1
        return 1e-4 * self.samples, 0.0

command = Count()
"""

pytestmark = pytest.mark.filterwarnings("ignore:.*does not compile")


def pickled(each):
    return pickle.loads(pickle.dumps(each))


@pytest.mark.parametrize("copied", [pickled, copy.copy, copy.deepcopy])
@pytest.mark.parametrize("cycle", library.shipped("cycle"))
def test_inputs_say_the_same_after_it(cycle, copied):
    inputs = read_inputs(cycle)
    assert copied(inputs).record() == inputs.record()
    assert copied(inputs).cycle.value.model_dump(mode="json") == inputs.cycle.value.model_dump(mode="json")


@pytest.mark.parametrize("copied", [pickled, copy.deepcopy])
@pytest.mark.parametrize("cycle", ["step_steer_iso7401", "bench_fail_safe"])
def test_a_simulation_gives_the_same_after_it(cycle, copied):
    settings = ("duration=0.6 s",)
    once = shipped.recording(cycle, None, *settings)
    np.testing.assert_array_equal(simulate(copied(shipped.simulation(cycle, None, *settings))).values, once.values)


def test_a_deep_copy_has_a_model_of_its_own():
    simulation = shipped.simulation("step_steer_iso7401")
    own = copy.deepcopy(simulation)
    own.model.opt.gravity[2] = 0.0
    assert simulation.model.opt.gravity[2] == pytest.approx(-9.81, abs=0.01)


@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_another_process_gives_the_same(way, tmp_path):
    """With a law of its own state, whose file is not there any more."""
    (tmp_path / "law.py").write_text(LAW)
    settings = ["duration=0.3 s"]
    simulation = simulation_of(read_inputs("roll_plane_step", controller=str(tmp_path / "law.py"), settings=settings))
    (tmp_path / "law.py").unlink()
    here = simulate(simulation)
    assert here["front.bar.command"][-1] == pytest.approx(1e-4 * 301)
    with multiprocessing.get_context(way).Pool(1) as pool:
        there = pool.apply_async(simulate, [simulation]).get(timeout=120)
    np.testing.assert_array_equal(there.values, here.values)
    assert there.inputs == here.inputs


def test_inputs_with_a_system_of_a_users_own_bring_it_with_them(tmp_path):
    (tmp_path / "mine.py").write_text(library.shipped("actuator")["passive"].with_name("system.py").read_text())
    (tmp_path / "mine.yaml").write_text("kind: passive\n")
    inputs = read_inputs("roll_plane_step", str(tmp_path / "mine.py"))
    assert pickled(inputs).record() == inputs.record()
    simulation = simulation_of(pickled(inputs))
    assert pickled(simulation).rig is simulation.rig  # not another system of the same file
