"""The callback's contract: once a step, everything in mjData, and a run that goes on bit for bit from any restore."""

import warnings
from copy import copy

import mujoco
import numpy as np
import pytest
import shipped
from mujoco.batch import Batch
from shipped import drive_on
from twins import twins_apart

from ars_mujoco.bridge import world as worlds
from ars_mujoco.bridge.callback import installed
from ars_mujoco.schema.errors import ArsError, SimulationError
from ars_mujoco.simulation.simulation import check, empty_recording, simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

S_CURVE, ROLL_PLANE, BENCH = "s_curve_120kmh", "roll_plane_step", "bench_s_curve"
MIDDLE = 2.5  # s into a cycle, where everything moves
ON = 300  # steps driven on from there
CASES = [
    (S_CURVE, ()),
    (ROLL_PLANE, ()),
    (BENCH, ()),
    (S_CURVE, ("actuator.drive.kind=engine",)),
    (BENCH, ("actuator.drive.kind=electric",)),
    (ROLL_PLANE, ("actuator=pump_controlled_full", "actuator.pump_control=full", "actuator.rear.pipe.lumps=4")),
]
INTEGRATORS = ("mjINT_EULER", "mjINT_IMPLICIT", "mjINT_IMPLICITFAST")


@pytest.fixture(scope="session")
def sedan():
    return shipped.simulation(S_CURVE)


@pytest.fixture(scope="session")
def middle(sedan):
    """The state of the sedan in the middle of the S-curve."""
    return shipped.state_of(sedan.model, shipped.driven(sedan, MIDDLE))


@pytest.fixture(scope="session")
def end(sedan, middle):
    """The state ON steps later, driven without a break."""
    return drive_on(sedan, shipped.restored(sedan.model, middle))


def set_front_pump_speed(simulation, data, speed: float) -> None:
    world_of(simulation, data).parameters.system.front.circuit.pump.speed = speed


def world_of(simulation, data):
    return worlds.view(data, simulation.rig.WORLD)


# ---- installing


def test_installing_lasts_as_long_as_the_block_and_restores_what_was_there(sedan):
    def theirs(model, data):
        """A callback of somebody else."""

    data = sedan.start()
    mujoco.set_mjcb_control(theirs)
    try:
        with installed(sedan.rig, sedan.model, data):
            assert mujoco.get_mjcb_control() is not theirs
        assert mujoco.get_mjcb_control() is theirs
        with pytest.raises(ZeroDivisionError), installed(sedan.rig, sedan.model, data):
            raise ZeroDivisionError
        assert mujoco.get_mjcb_control() is theirs
    finally:
        mujoco.set_mjcb_control(None)


def test_runge_kutta_is_refused_and_the_error_says_why(sedan):
    model = copy(sedan.model)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    with (
        pytest.raises(ArsError, match=r"RK4 is refused: it evaluates forces four times a step"),
        installed(sedan.rig, model, mujoco.MjData(model)),
    ):
        pass
    assert mujoco.get_mjcb_control() is None


def test_a_model_of_another_rig_is_refused(sedan):
    with (
        pytest.raises(ArsError, match="not built for the rig 'bench'"),
        installed(shipped.simulation(BENCH).rig, sedan.model, sedan.start()),
    ):
        pass


@pytest.mark.parametrize("actuator", ["passive", "pump_controlled_full"])
def test_a_model_of_the_same_rig_with_another_system_is_refused(sedan, actuator):
    other = shipped.simulation(S_CURVE, actuator)
    with (
        pytest.raises(ArsError, match="not built for the rig 'sedan'"),
        installed(other.rig, sedan.model, sedan.start()),
    ):
        pass


def test_a_model_that_has_room_for_the_world_but_does_not_carry_it_is_refused():
    spec, bench = mujoco.MjSpec(), shipped.simulation(BENCH).rig
    spec.nuserdata = bench.SIZE
    model = spec.compile()
    with pytest.raises(ArsError, match="not built for the rig"), installed(bench, model, mujoco.MjData(model)):
        pass


# ---- once a step


@pytest.mark.parametrize(("cycle", "settings"), CASES)
def test_a_second_mj_forward_changes_nothing(cycle, settings):
    simulation = shipped.simulation(cycle, None, *settings)
    data = shipped.driven(simulation, 0.54)
    outputs = ("userdata", "xfrc_applied", "qfrc_applied", "ctrl", "mocap_pos")
    with installed(simulation.rig, simulation.model, data):
        mujoco.mj_forward(simulation.model, data)
        once = {name: getattr(data, name).copy() for name in outputs}
        mujoco.mj_forward(simulation.model, data)
    assert world_of(simulation, data).out.bars.front.bar.torque != 0
    for name in outputs:
        np.testing.assert_array_equal(getattr(data, name), once[name], err_msg=name)


def test_looking_at_a_run_between_its_steps_does_not_change_it(sedan, middle, end):
    data = shipped.restored(sedan.model, middle)
    with installed(sedan.rig, sedan.model, data):
        for step in range(ON):
            if step % 7 == 0:
                solved = data.qacc_warmstart.copy()  # where the solver starts is its memory, not the callback's
                mujoco.mj_forward(sedan.model, data)
                data.qacc_warmstart = solved
            mujoco.mj_step(sedan.model, data)
    np.testing.assert_array_equal(shipped.state_of(sedan.model, data), end)


def test_finite_differences_about_a_state_do_not_disturb_the_run(sedan, middle, end):
    data, size = shipped.restored(sedan.model, middle), 2 * sedan.model.nv
    with installed(sedan.rig, sedan.model, data):
        mujoco.mjd_transitionFD(sedan.model, data, 1e-6, False, np.zeros((size, size)), None, None, None)
    data.qacc_warmstart = shipped.restored(sedan.model, middle).qacc_warmstart
    np.testing.assert_array_equal(drive_on(sedan, data), end)


@pytest.mark.parametrize("to", [0.0, 1.0, MIDDLE - 0.001, MIDDLE + 0.002, 10.0])
def test_a_jump_in_time_is_recorded(to, sedan, middle):
    data = shipped.restored(sedan.model, middle)
    with installed(sedan.rig, sedan.model, data):
        mujoco.mj_forward(sedan.model, data)
        assert world_of(sedan, data).header.status == worlds.RUNNING
        data.time = to
        with pytest.warns(UserWarning, match=f"at {to:g} s: time jumped: a state is restored with its userdata"):
            mujoco.mj_forward(sedan.model, data)
    header = world_of(sedan, data).header
    assert header.status == worlds.TIME_JUMP
    assert header.status_time == to


@pytest.mark.filterwarnings("ignore:.*the run diverged")
@pytest.mark.parametrize("field", ["qpos", "qvel"])
def test_whatever_coordinate_is_not_finite_is_recorded_at_once(field, sedan, middle, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes what it warns of into the current folder
    for index in range(getattr(sedan.start(), field).size):
        data = shipped.restored(sedan.model, middle)
        getattr(data, field)[index] = np.nan
        with installed(sedan.rig, sedan.model, data):
            mujoco.mj_step(sedan.model, data)
            mujoco.mj_step(sedan.model, data)
        header = world_of(sedan, data).header
        assert header.status == worlds.NOT_FINITE, f"{field}[{index}]"
        assert header.status_time == pytest.approx(MIDDLE, abs=0.0011)  # at the latest a step later


# ---- who steps by himself is told


@pytest.mark.parametrize("state", ["mjSTATE_FULLPHYSICS", "mjSTATE_INTEGRATION"])
def test_a_restore_without_the_world_is_told_and_one_with_it_says_nothing(state, sedan):
    data, spec = shipped.driven(sedan, 0.1), getattr(mujoco.mjtState, state)
    kept = np.empty(mujoco.mj_stateSize(sedan.model, spec))
    with installed(sedan.rig, sedan.model, data), warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        mujoco.mj_getState(sedan.model, data, kept, spec)
        mujoco.mj_step(sedan.model, data, 50)
        mujoco.mj_setState(sedan.model, data, kept, spec)
        mujoco.mj_step(sedan.model, data, 50)
    texts = [str(each.message) for each in told]
    assert len(texts) == (state == "mjSTATE_FULLPHYSICS")
    assert all(text.startswith("at 0.1 s: time jumped") for text in texts)


def test_a_plain_reset_which_does_not_start_the_cycle_is_told(sedan):
    data = shipped.driven(sedan, 0.1)
    with installed(sedan.rig, sedan.model, data):
        mujoco.mj_resetData(sedan.model, data)
        with pytest.warns(UserWarning, match=r"the cycle's start is mj_resetDataKeyframe\(model, data, 0\)"):
            mujoco.mj_step(sedan.model, data)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mujoco.mj_resetDataKeyframe(sedan.model, data, 0)
            mujoco.mj_step(sedan.model, data)


def test_a_law_drives_a_loop_of_ones_own_as_it_drives_a_run(tmp_path):
    """Compiled or in Python, with what it keeps."""
    (tmp_path / "law.py").write_text(
        "def command(sensors, memory):\n    memory[0] += 1e-4\n    return memory[0], 0.0\n"
    )
    slow = "total = 0.0\n\ndef command(sensors, memory):\n    global total\n    total += 1e-4\n    return total, 0.0\n"
    (tmp_path / "slow.py").write_text(slow)
    for name in ("law.py", "slow.py"):
        inputs = read_inputs(ROLL_PLANE, None, str(tmp_path / name), settings=["duration=0.1 s"])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            simulation = simulation_of(inputs)
        data = simulation.start()
        with installed(simulation.rig, simulation.model, data, simulation.law):
            mujoco.mj_step(simulation.model, data, 101)
        out = data.userdata[simulation.rig.slots]
        np.testing.assert_array_equal(out, simulate(simulation).values[-1])


# ---- everything in mjData


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_run_restored_in_its_middle_ends_identical(integrator, sedan):
    own, _ = shipped.own_copy(sedan)
    own.model.opt.integrator = getattr(mujoco.mjtIntegrator, integrator)
    data = shipped.driven(own, MIDDLE)
    state = shipped.state_of(own.model, data)
    np.testing.assert_array_equal(drive_on(own, shipped.restored(own.model, state)), drive_on(own, data))


@pytest.mark.parametrize(
    "settings",
    [
        ("controller.unit.sample_time=5 ms",),
        ("controller.unit.sample_time=0 s", "controller.unit.delay=3 ms"),
        ("controller.reference.trim.rate=1 1/s",),
        ("actuator.drive.kind=engine",),
        ("actuator.drive.kind=electric",),
    ],
)
def test_so_does_a_run_with_another_control_unit_or_drive(settings):
    simulation = shipped.simulation(S_CURVE, None, *settings)
    data = shipped.driven(simulation, 0.902)  # between two samples of 5 ms
    state = shipped.state_of(simulation.model, data)
    np.testing.assert_array_equal(
        drive_on(simulation, shipped.restored(simulation.model, state)), drive_on(simulation, data)
    )


def test_nothing_outside_the_state_matters(sedan, middle, end):
    derived = """qacc xpos xquat xmat xipos ximat xanchor xaxis site_xpos site_xmat geom_xpos subtree_com cvel cacc
        cfrc_int qfrc_bias qfrc_passive qfrc_actuator qfrc_constraint qfrc_smooth qacc_smooth actuator_force
        actuator_length actuator_velocity ten_length ten_velocity sensordata""".split()
    data, random = shipped.restored(sedan.model, middle), np.random.default_rng(1)
    with installed(sedan.rig, sedan.model, data):
        for _ in range(ON):
            for name in derived:
                field = getattr(data, name)
                field[:] = random.normal(scale=1e3, size=field.shape)
            mujoco.mj_step(sedan.model, data)
    np.testing.assert_array_equal(shipped.state_of(sedan.model, data), end)


def test_after_a_reset_the_cycle_begins_anew(sedan, middle):
    data = shipped.restored(sedan.model, middle)
    mujoco.mj_resetDataKeyframe(sedan.model, data, 0)
    assert not data.userdata.any()
    np.testing.assert_array_equal(drive_on(sedan, data), drive_on(sedan, sedan.start()))


def test_two_cars_in_one_process_do_not_disturb_each_other(sedan, middle, end):
    other = shipped.simulation(S_CURVE, None, "actuator.front.pump.speed=1500 rpm")
    alone = drive_on(other, shipped.driven(other, 1.0))
    active, slower = shipped.restored(sedan.model, middle), shipped.driven(other, 1.0)
    with installed(sedan.rig, sedan.model, active):
        for _ in range(ON):
            mujoco.mj_step(sedan.model, active)
            mujoco.mj_step(other.model, slower)
    np.testing.assert_array_equal(shipped.state_of(sedan.model, active), end)
    np.testing.assert_array_equal(shipped.state_of(other.model, slower), alone)


# ---- batches

SPEEDS = (314.159, 157.08, 628.318)  # rad/s, of each row's front pump


@pytest.fixture(scope="session")
def rows(sedan, middle):
    """Ends of three cars that differ in their front pump's speed, driven one by one."""
    ends = []
    for speed in SPEEDS:
        data = shipped.restored(sedan.model, middle)
        set_front_pump_speed(sedan, data, speed)
        ends.append(drive_on(sedan, data))
    return ends


@pytest.mark.parametrize("threads", [1, 2])
def test_a_batch_is_bit_identical_to_a_loop_and_each_row_has_its_own_parameters(threads, sedan, middle, rows):
    batch = Batch(sedan.model, nsim=len(SPEEDS), nthread=threads)
    for row, speed in enumerate(SPEEDS):
        data = shipped.restored(sedan.model, middle)
        set_front_pump_speed(sedan, data, speed)
        batch.state[row] = shipped.state_of(sedan.model, data)
    with installed(sedan.rig, sedan.model, sedan.start()):
        for _ in range(ON):
            batch.step()
    for row, alone in enumerate(rows):
        np.testing.assert_array_equal(batch.state[row], alone)
    assert len({alone.tobytes() for alone in rows}) == len(SPEEDS)


@pytest.mark.filterwarnings("ignore:.*mj_resetDataKeyframe")
def test_a_batch_that_is_reset_begins_anew(sedan):
    batch = Batch(sedan.model, nsim=2, nthread=1)
    with installed(sedan.rig, sedan.model, sedan.start()):
        for _ in range(5):
            batch.step()
        batch.reset()
        for _ in range(5):
            batch.step()
    once = mujoco.MjData(sedan.model)
    once_end = drive_on(sedan, once, 5)
    np.testing.assert_array_equal(batch.state[0], once_end)


# ---- the interpreted twin


@pytest.mark.parametrize(("cycle", "settings"), CASES)
def test_the_interpreted_twin_agrees_to_1e_12(cycle, settings, tmp_path, monkeypatch):
    """From where all moves: beside peaks near rest, the tolerance of MuJoCo's solver shows as 1e-11."""
    simulation = shipped.simulation(cycle, None, *settings)
    moving = shipped.driven(simulation, 1.5 if cycle == S_CURVE else 0.54)
    assert twins_apart(simulation, moving, 60, tmp_path, monkeypatch) < 1e-12


# ---- models of others


def test_a_callback_leaves_models_alone_that_are_not_its_own():
    sedan, roll_plane = shipped.simulation(S_CURVE), shipped.simulation(ROLL_PLANE)
    plain = mujoco.MjModel.from_xml_string("<mujoco><size nuserdata='3'/><worldbody><body><freejoint/>"
                                           "<geom size='.1'/></body></worldbody></mujoco>")  # fmt: skip
    alone, beside = sedan.start(), sedan.start()
    other, falling = roll_plane.start(), mujoco.MjData(plain)
    with installed(sedan.rig, sedan.model, alone):
        for _ in range(20):
            mujoco.mj_step(sedan.model, alone)
        for _ in range(20):
            mujoco.mj_step(sedan.model, beside)
            mujoco.mj_step(roll_plane.model, other)
            mujoco.mj_step(plain, falling)
    assert not other.userdata.any()
    assert not falling.userdata.any()
    np.testing.assert_array_equal(alone.qpos, beside.qpos)


def test_nor_does_a_law_reach_them(tmp_path):
    """A model without userdata, one of another rig, and one of another system in a world that has begun."""
    (tmp_path / "law.py").write_text("def command(sensors, memory):\n    str(sensors)\n    return 0.1, 0.1\n")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mine = simulation_of(read_inputs(ROLL_PLANE, None, str(tmp_path / "law.py")))
    plain = mujoco.MjModel.from_xml_string("<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody>"
                                           "</mujoco>")  # fmt: skip
    other, falling = shipped.driven(shipped.simulation(ROLL_PLANE, "passive"), 0.01), mujoco.MjData(plain)
    before = other.userdata.copy()
    with installed(mine.rig, mine.model, mine.start(), mine.law):
        mujoco.mj_step(plain, falling, 3)
        mujoco.mj_step(shipped.simulation(ROLL_PLANE, "passive").model, other, 3)
    np.testing.assert_array_equal(other.userdata, before)


@pytest.mark.filterwarnings("ignore:.*another rig")
def test_a_restored_state_of_another_layout_is_told():
    simulation = shipped.simulation(S_CURVE)
    data = simulation.start()
    with installed(simulation.rig, simulation.model, data):
        mujoco.mj_step(simulation.model, data)
        data.userdata[1] += 1.0
        mujoco.mj_step(simulation.model, data)
    with pytest.raises(SimulationError, match="has another layout"):
        check(simulation, data, empty_recording(simulation))
