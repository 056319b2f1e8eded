"""Both compensators in the running controller: digital filters of a unit that samples."""

import control
import mujoco
import numpy as np
import pytest
from bench import bench, drive
from scipy.signal import lfilter

from ars_mujoco.analysis.compensators import pole_compensator, pressure_feedback
from ars_mujoco.bridge.callback import installed
from ars_mujoco.bridge.world import view
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

SAMPLED = "controller.unit.sample_time=2 ms"
FEEDBACK = ("actuator.control.pressure_feedback.gain=0.05 1/bar", "actuator.control.pressure_feedback.corner=300 rad/s")
COMPENSATOR = (
    "actuator.control.compensator.frequency=834 rad/s",
    "actuator.control.compensator.damping=0.06",
    "actuator.control.compensator.new_damping=0.4",
)
CHANNELS = ("front.bar.angle", "front.motor.pressure", "front.pump.stroke")
MIRRORED = "manoeuvre.command.knots=[[0 s, -1 deg]]"


def samples(*settings: str) -> np.ndarray:
    """(stroke command, angle, pressure) at each sample of 2 ms, from the world of a run."""
    simulation = bench("bench_step_1deg", SAMPLED, *settings)
    data, seen = simulation.start(), []
    with installed(simulation.rig, simulation.model, data):
        for _ in range(300):
            mujoco.mj_step(simulation.model, data)
            world = view(data, simulation.rig.WORLD)
            circuit = world.now.system.front.circuit
            seen.append((float(world.later.system.front_stroke), float(circuit.angle), float(circuit.pressure)))
    return np.array(seen[::2])


def filtered(system: control.TransferFunction, signal: np.ndarray) -> np.ndarray:
    return lfilter(system.num_array[0, 0], system.den_array[0, 0], signal)


@pytest.mark.parametrize("settings", [FEEDBACK, COMPENSATOR, FEEDBACK + COMPENSATOR])
def test_the_running_unit_computes_the_filters_of_the_analysis(settings):
    strokes, angles, pressures = samples(*settings).T
    wanted = np.clip(60.0 * (np.radians(1.0) - angles), -1.0, 1.0)
    if COMPENSATOR[0] in settings:
        wanted = filtered(pole_compensator(834.0, 0.06, 0.4, 2e-3), wanted)
    if FEEDBACK[0] in settings:
        wanted = wanted - filtered(pressure_feedback(5e-7, 300.0, 2e-3), pressures)
    np.testing.assert_allclose(strokes, np.clip(wanted, -1.0, 1.0), atol=1e-11)
    assert np.ptp(strokes) > 0.5


def test_a_gain_of_zero_is_no_feedback_to_the_last_bit():
    without, off = drive("bench_step_1deg", SAMPLED), drive("bench_step_1deg", SAMPLED, FEEDBACK[1], _gain("0 1/bar"))
    for name in CHANNELS:
        assert np.array_equal(without[name], off[name])


def test_the_mirrored_command_gives_the_mirrored_run():
    plus, minus = (drive("bench_step_1deg", SAMPLED, *FEEDBACK, *COMPENSATOR, *more) for more in ((), (MIRRORED,)))
    for name in CHANNELS:
        assert np.array_equal(plus[name], -minus[name])


def test_another_call_at_the_same_time_changes_nothing():
    def run(again: bool) -> np.ndarray:
        simulation = bench("bench_step_1deg", SAMPLED, *FEEDBACK, *COMPENSATOR)
        data = simulation.start()
        with installed(simulation.rig, simulation.model, data):
            for _ in range(101):
                mujoco.mj_step(simulation.model, data)
                if again:
                    mujoco.mj_forward(simulation.model, data)
            mujoco.mj_forward(simulation.model, data)
            return np.array(data.userdata)

    assert np.array_equal(run(True), run(False))


def _gain(gain: str) -> str:
    return f"actuator.control.pressure_feedback.gain={gain}"


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (
            FEEDBACK,
            "pressure_feedback: .*a digital filter, but the unit is continuous; allowed: with a controller.unit.sample",
        ),
        (COMPENSATOR, "compensator: .*a digital filter, but the unit is continuous"),
        (
            (*COMPENSATOR, "controller.unit.sample_time=5 ms"),
            "compensator: .*frequency of 834 rad/s is beyond what a controller.unit.sample_time of 5 ms can "
            "filter; allowed: less "
            "than 628.319 rad/s",
        ),
        ((SAMPLED, _gain("0.1 1/bar")), "pressure_feedback.corner: is missing"),
        ((SAMPLED, FEEDBACK[1], _gain("0.1 bar")), r"pressure_feedback.gain: '0.1 bar': wrong unit; allowed: 1/Pa"),
    ],
)
def test_what_no_unit_can_filter_is_refused(settings, expected):
    with pytest.raises(InputError, match=expected):
        simulation_of(read_inputs("bench_step_1deg", settings=settings))
