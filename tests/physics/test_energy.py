"""Energy and symmetry of runs on the bench: random commands, moving ends, parameters in Table 2's ranges."""

import numpy as np
import pytest
from bench import drive
from hypothesis import given
from hypothesis import settings as examples
from hypothesis import strategies as st

STORED = ("oil", "bar", "inertia")
LOSSES = ("pump_torque_loss", "pump_leakage", "motor_leakage", "relief", "friction", "capacitance")
# channels with these in their name do not change sign with the side
EVEN = ("power", "energy", "drive", "pump.speed", "extrapolation")


def knots(largest, unit):
    """Five values from 0 on, a fifth of a second apart, each within +-`largest`."""
    return st.lists(st.floats(-largest, largest).map(lambda x: round(x, 6)), min_size=4, max_size=4).map(
        lambda values: [(0.2 * i, value, unit) for i, value in enumerate([0.0, *values])]
    )


COMMANDS, ENDS = knots(14.46, "deg"), knots(60.0, "mm")
PARAMETERS = st.fixed_dictionaries(
    {
        "leakage": st.floats(4e-13, 2e-12),
        "line.capacitance": st.floats(4e-14, 8e-14).map(lambda x: f"{x} m^3/Pa"),
        "motor.inertia": st.floats(0.1, 0.25).map(lambda x: f"{x} kg*m^2"),
        "motor.viscous_friction": st.floats(6.5, 26.5).map(lambda x: f"{x} Nms/rad"),
        "pump.speed": st.floats(1500.0, 6000.0).map(lambda x: f"{x} rpm"),
    }
)


def moved(name, values, side=1):
    points = ", ".join(f"[{t:g} s, {side * value} {unit}]" for t, value, unit in values)
    return f"manoeuvre.{name}={{join: smooth, knots: [{points}]}}"


def run(command=(), ends=(), parameters=None, side=1):
    parameters = dict(parameters or {})
    leakage = parameters.pop("leakage", 4e-13)
    parameters |= {"pump.leakage": f"{0.5625 * leakage} m^3/s/Pa", "motor.leakage": f"{0.4375 * leakage} m^3/s/Pa"}
    chosen = [f"actuator.front.{key}={value}" for key, value in parameters.items()]
    chosen += [moved(name, values, side) for name, values in (("command", command), ("ends", ends)) if values]
    return drive("bench_step_1deg", "duration=1 s", *chosen)


def astray(recording):
    """Shaft work (n,) J at each sample that is neither stored nor lost nor done on the car."""
    energy = {name: recording[f"front.energy.{name}"] for name in ("shaft", "work", *STORED, *LOSSES)}
    stored = sum(energy[name] - energy[name][0] for name in STORED)
    return energy["shaft"] - energy["work"] - stored - sum(energy[name] for name in LOSSES)


@examples(max_examples=40)
@given(command=COMMANDS, parameters=PARAMETERS)
def test_shaft_work_is_found_again_to_a_thousandth_of_the_throughput(command, parameters):
    recording = run(command, parameters=parameters)
    assert np.abs(astray(recording)).max() < 1e-3 * recording["front.energy.throughput"][-1]


FLOW_LOSS = """{norm: 5.4 L/min, normal_speed: 3000 rpm, normal_pressure: 180 bar,
    coefficients: {k_000: 0.003, k_100: 0.004, k_011: 0.01, k_101: -0.005, k_102: 0.02},
    validity: {stroke: [0, 1], speed: [500 rpm, 6000 rpm], pressure: [0 bar, 300 bar]}}"""


@pytest.mark.parametrize("side", [1, -1])
def test_it_is_found_again_with_a_polynomial_flow_loss_as_a_pump_and_as_a_motor(side):
    command = [(0.2 * i, angle, "deg") for i, angle in enumerate((0, 10, 2, 12, 0))]
    recording = run(command, parameters={"pump.flow_loss": FLOW_LOSS, "pump.torque_loss.norm": "1 Nm"}, side=side)
    oil = recording["front.pump.flow"] * recording["front.motor.pressure"]
    assert recording["front.energy.recovered"][-1] > 5.0
    assert oil.max() > 500.0 and oil.min() < -500.0
    assert np.all(recording["front.pump.leakage_power"] >= 0.0)
    error = np.abs(astray(recording)).max() / recording["front.energy.throughput"][-1]
    print(f"{100 * error:.5f} %, {recording['front.energy.recovered'][-1]:.0f} J recovered")
    assert error < 1e-3


@pytest.mark.parametrize("travel", [5.0, 20.0, 40.0])
def test_it_is_found_again_where_the_ends_move_too(travel):
    ends = [(0.2 * i, side * travel, "mm") for i, side in enumerate((0, 1, -1, 1, 0))]
    command = [(0.2 * i, angle, "deg") for i, angle in enumerate((0, 6, -6, 6, 0))]
    recording = run(command, ends)
    error = np.abs(astray(recording)).max() / recording["front.energy.throughput"][-1]
    print(f"{travel} mm: {100 * error:.4f} %")
    assert error < 1e-3


@examples(max_examples=20)
@given(command=COMMANDS, ends=ENDS, parameters=PARAMETERS)
def test_no_loss_ever_gives_energy_back(command, ends, parameters):
    recording = run(command, ends, parameters)
    for name in (*LOSSES[:-1], "recovered", "charge", "throughput"):
        assert np.all(np.diff(recording[f"front.energy.{name}"]) >= 0.0), name
    for name in STORED:
        assert np.all(recording[f"front.energy.{name}"] >= 0.0), name


@examples(max_examples=20)
@given(command=COMMANDS, ends=ENDS, parameters=PARAMETERS)
def test_a_mirrored_run_is_the_mirror_image_to_the_last_bit(command, ends, parameters):
    left, right = run(command, ends, parameters), run(command, ends, parameters, side=-1)
    for name in left.channels:
        even = any(word in name for word in EVEN)
        assert np.array_equal(right[name], left[name] if even else -left[name]), name


@examples(max_examples=10)
@given(parameters=PARAMETERS)
def test_a_command_of_zero_leaves_everything_at_rest_and_pays_the_idling_pump(parameters):
    recording = run([(0.0, 0.0, "deg")], parameters=parameters)
    paid = {"front.energy.shaft", "front.energy.pump_torque_loss", "front.energy.charge", "front.energy.throughput"}
    paid |= {"front.pump.shaft_power", "front.pump.loss_power", "drive.power"}
    paid |= {"front.energy.charge_loss", "front.charge.power"}
    turning = {"front.pump.speed", "drive.speed"}
    moving = {name for name in recording.channels if np.any(recording[name])}
    assert moving == paid | turning
    assert recording["front.energy.charge"][-1] == pytest.approx(80.0)


@examples(max_examples=15)
@given(
    angle=st.floats(0.5, 14.46), leakages=st.lists(st.floats(4e-13, 2e-12), min_size=2, max_size=2, unique=True),
    parameters=PARAMETERS,
)  # fmt: skip
def test_more_leakage_never_holds_more_torque(angle, leakages, parameters):
    tight, leaky = (
        run([(0.0, 0.0, "deg"), (0.3, angle, "deg")], parameters={**parameters, "leakage": leakage})
        for leakage in sorted(leakages)
    )
    assert leaky["front.bar.torque"][-1] <= tight["front.bar.torque"][-1] + 1e-3
