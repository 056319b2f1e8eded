"""Energy, symmetry and pressures of every stage of pump control before either circuit: quadrants and random runs."""

from types import MappingProxyType

import mujoco
import numpy as np
import pytest
from bench import bench
from detailed import ACTUATORS, VARIANTS
from hypothesis import assume, given
from hypothesis import settings as examples
from hypothesis import strategies as st
from test_energy import COMMANDS, ENDS, EVEN, moved

from ars_mujoco.actuators.pump_controlled.full_circuit import FULL_PLANT
from ars_mujoco.actuators.pump_controlled.pump_control import FULL
from ars_mujoco.bridge import world as worlds
from ars_mujoco.bridge.callback import installed
from ars_mujoco.simulation.simulation import simulate

STORED = ("oil", "bar", "inertia", "oil_motion")
LOSSES = ("pump_torque_loss", "pump_leakage", "motor_leakage", "relief", "friction", "line", "check", "bypass",
          "tank_leakage", "charge_loss", "capacitance")  # fmt: skip
SIDES = ("pressure_a", "pressure_b")
EACH = pytest.mark.parametrize(("circuit", "stage"), VARIANTS)
ANY = st.sampled_from(VARIANTS[1:])  # the verification set has its own
ABSOLUTE = st.sampled_from([each for each in VARIANTS if each[0] == "full" or each[1] == "full"])
DETAILED = st.fixed_dictionaries(
    {
        "leakage": st.floats(4e-13, 2e-12),
        "motor.inertia": st.floats(0.1, 0.25).map(lambda x: f"{x} kg*m^2"),
        "motor.viscous_friction": st.floats(6.5, 26.5).map(lambda x: f"{x} Nms/rad"),
        "pump.speed": st.floats(800.0, 6000.0).map(lambda x: f"{x} rpm"),
        "oil.temperature": st.floats(0.0, 90.0).map(lambda x: f"{x} degC"),
    }
)
JUMPS = st.lists(st.floats(-14.46, 14.46).map(lambda x: round(x, 6)), min_size=5, max_size=5)  # deg, each for 0.2 s


def prepared(variant, parameters, *moves):
    """The simulation of 1 s with these parameters of the front circuit."""
    circuit, stage = variant
    parameters, leakage = dict(parameters), parameters.get("leakage", 4e-13)
    parameters.pop("leakage", None)
    parameters |= {"pump.leakage": f"{0.5625 * leakage} m^3/s/Pa", "motor.leakage": f"{0.4375 * leakage} m^3/s/Pa"}
    settings = [f"actuator.front.{key}={value}" for key, value in parameters.items()]
    settings += [f"actuator.pump_control={stage}", "duration=1 s", *moves]
    return bench("bench_step_1deg", *settings, actuator=ACTUATORS[circuit])


def driven(variant, command=(), ends=(), parameters=MappingProxyType({}), side=1):
    moves = [moved(name, values, side) for name, values in (("command", command), ("ends", ends)) if values]
    return simulate(prepared(variant, parameters, *moves))


def astray(recording):
    """Work (n,) J of shaft and charge pump at each sample that is neither stored nor lost nor done on the car."""
    stored, lost = (of(recording, names) for names in (STORED, LOSSES))
    shaft, charge, work = (of(recording, (name,))[0] for name in ("shaft", "charge", "work"))
    return shaft + charge - work - sum(each - each[0] for each in stored) - sum(lost)


def of(recording, names):
    """The energies (J) of these names, zero where the plant has no such part."""
    channels = (f"front.energy.{name}" for name in names)
    return [recording[each] if each in recording.channels else np.zeros(recording.time.size) for each in channels]


def quadrants(recording):
    """Hydraulic energy (J) of the pump by the signs of (stroke, pressure): it pumps where they agree."""
    stroke, power = (
        recording["front.pump.stroke"],
        recording["front.pump.shaft_power"] - recording["front.pump.loss_power"],
    )
    pressure = np.sign(power * stroke)
    return {(x, p): abs(power[(np.sign(stroke) == x) & (pressure == p)].sum()) * 1e-3 for x in (1, -1) for p in (1, -1)}


@EACH
def test_energy_is_found_again_in_all_four_quadrants(circuit, stage):
    """There and back to either side against the bar: it drives the pump on each way back."""
    command = [(0.2 * i, angle, "deg") for i, angle in enumerate((0, 12, 0, -12, 0))]
    recording = driven((circuit, stage), command)
    shares = quadrants(recording)
    error = np.abs(astray(recording)).max() / recording["front.energy.throughput"][-1]
    print(f"{circuit}, {stage}: {100 * error:.4f} %, quadrants {[round(float(share)) for share in shares.values()]} J")
    assert min(shares.values()) > 0.1 * sum(shares.values())
    assert recording["front.energy.recovered"][-1] > 0.05 * recording["front.energy.throughput"][-1]
    assert error < 1e-3


@examples(max_examples=25)
@given(variant=ANY, command=COMMANDS, ends=ENDS, parameters=DETAILED)
def test_energy_is_found_again_and_no_loss_gives_any_back(variant, command, ends, parameters):
    recording = driven(variant, command, ends, parameters)
    assert np.abs(astray(recording)).max() < 1e-3 * recording["front.energy.throughput"][-1]
    growing = (*LOSSES[:-1], "recovered", "charge", "throughput")
    for name, energy in zip(growing, of(recording, growing), strict=True):
        assert np.all(np.diff(energy) >= 0.0), name
    for name, energy in zip(STORED, of(recording, STORED), strict=True):
        assert np.all(energy >= 0.0), name


@examples(max_examples=15)
@given(variant=ANY, command=COMMANDS, ends=ENDS, parameters=DETAILED)
def test_a_mirrored_run_is_the_mirror_image_but_for_rounding(variant, command, ends, parameters):
    """Both sides are integrated, so sums come in another order; without a command that is all there is to see."""
    assume(max(abs(angle) for _, angle, _ in command) > 1.0)
    left, right = (driven(variant, command, ends, parameters, side) for side in (1, -1))
    for name in left.channels:
        even = any(word in name for word in (*EVEN, *SIDES, "charge", "valve"))
        expected = left[name] if even else -left[name]
        assert np.abs(right[opposite(name)] - expected).max() <= 1e-9 * np.abs(expected).max(), name


def opposite(name):
    """The channel of the other side."""
    a, b = SIDES
    return name.replace(a, b) if a in name else name.replace(b, a)


@examples(max_examples=25)
@given(variant=ABSOLUTE, command=JUMPS, ends=JUMPS, parameters=DETAILED, charged=st.booleans())
def test_no_pressure_falls_to_zero_whatever_is_commanded(variant, command, ends, parameters, charged):
    """Not with jumps of command and ends, nor with the charge pump off and sides that leak."""
    moves = [jumping("command", command, "deg"), jumping("ends", [4 * value for value in ends], "mm")]
    if variant[0] == "full" and not charged:
        parameters = parameters | {"charge_pump.displacement": "1e-9 cm^3/rev", "tank_leakage": "1e-12 m^3/s/Pa"}
    least = least_pressures(prepared(variant, parameters, *moves))
    assert min(least.values()) > 0.0


def jumping(name, values, unit):
    points = ", ".join(f"[{0.2 * i:g} s, {value} {unit}]" for i, value in enumerate(values))
    return f"manoeuvre.{name}={{join: step, knots: [{points}]}}"


def least_pressures(simulation):
    """The least absolute pressure (Pa) of each kind that there is, over all steps."""
    data, least = simulation.start(), {}
    with installed(simulation.rig, simulation.model, data):
        for _ in range(1000):
            mujoco.mj_step(simulation.model, data)
            world = worlds.view(data, simulation.rig.WORLD)
            assert world.header.status == worlds.RUNNING
            detail, out = world.later.system.front.detail, world.out.system.front
            found = {"cylinder": min(detail.p_a, detail.p_b)}
            if world.parameters.system.front.detail.plant == FULL_PLANT:
                found |= {
                    "pump": min(out.pump.pressure_a, out.pump.pressure_b),
                    "motor": min(out.motor.pressure_a, out.motor.pressure_b), "gallery": out.charge.pressure,
                }  # fmt: skip
            least = {name: min(value, least.get(name, value)) for name, value in found.items()}
    axle = world.parameters.system.front.detail
    has = int(axle.stage == FULL) * ["cylinder"] + int(axle.plant == FULL_PLANT) * ["pump", "motor", "gallery"]
    return {name: least[name] for name in has}


@examples(max_examples=8)
@given(
    variant=ANY, angle=st.floats(0.5, 14.46), parameters=DETAILED,
    leakages=st.lists(st.floats(4e-13, 2e-12), min_size=2, max_size=2, unique=True),
)  # fmt: skip
def test_more_leakage_never_holds_more_torque(variant, angle, parameters, leakages):
    tight, leaky = (
        driven(variant, [(0.0, 0.0, "deg"), (0.3, angle, "deg")], parameters={**parameters, "leakage": leakage})
        for leakage in sorted(leakages)
    )
    assert leaky["front.bar.torque"][-1] <= tight["front.bar.torque"][-1] + 1e-3
