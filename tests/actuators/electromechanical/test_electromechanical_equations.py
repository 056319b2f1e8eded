"""Electromechanical bars: their equations against an independent solution, their modes, order and books."""

import math
from functools import cache

import numpy as np
import pytest
import shipped
from scipy.integrate import solve_ivp

from ars_mujoco.actuators.electromechanical import system
from ars_mujoco.actuators.system import Command
from ars_mujoco.control.control_unit import BarCommand
from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import numbers
from ars_mujoco.kernels.substeps import differences

C, J, RATIO, THETA, CG = 5700.0, 3.5e-4, 160.0, 0.175, 4e4
KT, R, L, PSI, P = 0.12, 0.03, 150e-6, 0.02, 4
ETA, M0, B, BUSH, BACKLASH = 0.88, 8.0, 4.0, 4.0, math.radians(0.2)
INTEGRATE = integrated(system.rates)
FRICTIONLESS = [f"actuator.front.gear.{each}" for each in ("friction=0 Nm", "efficiency=1", "backlash=0 deg")]


def own(*settings: str):
    """(parameters, state at rest) records of the bench's system, free to change."""
    _, world = shipped.own_copy(shipped.simulation("bench_step_1deg", "electromechanical", *settings))
    return world.parameters.system, world.now.system


def demand(torque: float = 0.0):
    one = BarCommand((torque / C, 0.0, 0.0), torque)
    return Command(one, BarCommand((0.0, 0.0, 0.0), 0.0), np.ones(2)), 0.0, 0.0


# ---- an independent solution, written from the equations of the machine, the gear and the supply


def independent(torque: float, times: np.ndarray) -> np.ndarray:
    """(5, n) current, rotor angle and rate, angle and rate of the front unit on an ideal 48 V supply."""
    vmax, wn, ka, wc = 0.95 * 48.0 / math.sqrt(3.0), 350.0, 70.0, 1885.0

    def fits(speed: float, q: float) -> bool:
        field = -np.linspace(0.0, 60.0, 4001)
        u = np.hypot(R * field - P * speed * L * q, R * q + P * speed * (L * field + PSI))
        return bool(((u <= vmax) & (np.hypot(field, q) <= 75.0)).any())

    def largest(speed: float) -> float:
        low, high = (75.0, 75.0) if fits(speed, 75.0) else (0.0, 75.0)
        for _ in range(25):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if fits(speed, middle) else (low, middle)
        return low

    # the largest torque current over speed, by trying; braking is never at its limit here
    speeds = np.linspace(0.0, 560.0, 281)
    table = [largest(speed) for speed in speeds]

    def most(speed: float) -> float:
        return float(np.interp(speed, speeds, table))

    def rates(_, x):
        current, rotor, rotor_rate, angle, rate = x
        speed = RATIO * rotor_rate
        wanted = torque / C
        wish = J * wn * (RATIO * np.clip(ka * (wanted - angle), -math.radians(160), math.radians(160)) - speed)
        wish = (wish + C * angle / RATIO) / KT
        wish = min(max(wish, -75.0), most(speed))
        braking = 4e-4 * speed + 0.03 * math.tanh(speed / 1.5)
        twist = rotor - angle
        mesh = CG * math.copysign(max(abs(twist) - BACKLASH / 2, 0.0), twist)
        driving = RATIO * (KT * current - braking)
        friction = (1 - ETA) / (1 + ETA) * abs(driving + mesh) + M0
        friction = friction * math.tanh(rotor_rate / math.radians(0.5)) + B * rotor_rate
        return (
            wc * (wish - current), rotor_rate, (driving - mesh - friction) / (J * RATIO * RATIO),
            rate, (mesh - C * angle - BUSH * rate) / THETA,
        )  # fmt: skip

    return solve_ivp(rates, (0.0, times[-1]), np.zeros(5), "LSODA", times, rtol=1e-8, atol=1e-9, max_step=1e-3).y


@pytest.mark.parametrize("torque", [500.0, 1200.0])
def test_a_step_is_that_of_an_independent_solution(torque):
    stiff = ("actuator.supply.capacitance=1e6 F", "actuator.supply.store_power=1e6 W",
             "actuator.supply.line_resistance=0 ohm")  # fmt: skip
    command = f"manoeuvre.command={{join: step, knots: [[0 s, {math.degrees(torque / C)} deg]]}}"
    run = shipped.recording("bench_step_1deg", "electromechanical", command, *stiff)
    few = np.searchsorted(run.time, 0.2)
    current, _, rotor_rate, angle, _ = independent(torque, run.time[:few])
    solved = {"bar.angle": angle, "machine.current": current, "machine.speed": RATIO * rotor_rate}
    for channel, expected in solved.items():
        apart = np.abs(run[f"front.{channel}"][:few] - expected).max() / np.abs(expected).max()
        print(f"{channel}: {100 * apart:.4f} % of the peak")
        assert apart < 1e-3


def test_the_substeps_are_of_fourth_order():
    p, state = own(*FRICTIONLESS)
    ends = []
    for count in (10, 20, 40, 80):
        now, later = state.copy(), state.copy()
        ends.append(np.array(advanced(p, now, later, 200.0, count)[:5]))
    errors = [np.abs((end - ends[-1]) / np.maximum(np.abs(ends[-1]), 1e-9)).max() for end in ends[:-1]]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.5)


@kernel
def two_milliseconds(p, now, later, demand, count):
    INTEGRATE(p, now, later, demand, 2e-3, count)


def advanced(p, now, later, torque: float, count: int) -> tuple[float, ...]:
    two_milliseconds(p, now, later, demand(torque), count)
    return numbers(later.state)


def test_its_modes_are_those_of_two_inertias_on_two_springs():
    """A few Hz of the rotor on the bar, and 80 Hz of the output between gear and bar, without loops and friction."""
    dragless = [
        f"actuator.front.drive.machine.{each}" for each in ("friction=0 Nm", "hysteresis=0 Nm", "iron=0 Nms/rad")
    ]
    undamped = ("actuator.front.gear.damping=0 Nms/rad", "actuator.front.bar_damping=0 Nms/rad")
    p, state = own(*FRICTIONLESS, *dragless, *undamped)
    opened = (demand()[0]._replace(inputs=np.zeros(2)), 0.0, 0.0)
    rest = np.array(numbers(state.state))

    def rates(flat):
        return system.rates(p, opened, 0.0, tuple(flat))[0]

    A = differences(rates, rest, np.full(12, 1e-6))[1:5, 1:5]
    found = np.sort(np.unique(np.round(np.abs(np.linalg.eigvals(A)), 3)))[-2:]
    matrix = np.array([[CG / (J * RATIO * RATIO), -CG / (J * RATIO * RATIO)], [-CG / THETA, (CG + C) / THETA]])
    slow, fast = np.sort(np.sqrt(np.linalg.eigvals(matrix)))
    assert found == pytest.approx([slow, fast], rel=1e-3)
    assert slow == pytest.approx(math.sqrt(C / (J * RATIO * RATIO + THETA)), rel=0.08)
    assert fast / (2 * math.pi) == pytest.approx(80.0, rel=0.05)


# ---- the books


@cache
def driven(cycle: str, *settings: str):
    return shipped.measured(cycle, "actuator=electromechanical", *settings)


WEAK = ("actuator.supply.converter_power=60 W", "actuator.supply.store_power=0 W")


@pytest.mark.parametrize(
    ("cycle", "settings"),
    [
        ("s_curve_120kmh", ()),
        ("s_curve_120kmh", WEAK),
        ("single_wheel_bump", ()),  # the wheel drives the bar back
        ("step_steer_iso7401", ("actuator.supply.capacitance=0.05 F",)),
        ("bench_s_curve", ("actuator.front.loops.follow=angle",)),
    ],
)
def test_what_is_drawn_is_stored_lost_or_done_on_the_car(cycle, settings):
    assert driven(cycle, *settings).metrics["energy_audit_error"].value < 1e-3


def test_a_weak_supply_really_sheds_load():
    assert driven("s_curve_120kmh", *WEAK).recording["supply.share"].min() < 0.9


def test_a_bump_drives_the_machine_back():
    assert driven("single_wheel_bump").metrics["recovered_energy"].value > 0.0


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_what_the_supply_delivers_both_axles_draw(axle):
    run = driven("s_curve_120kmh").recording
    axles = run["front.energy.electrical"] + run["rear.energy.electrical"]
    assert run["supply.energy.loads"] == pytest.approx(axles, rel=1e-12)


def test_the_s_curve_at_0_6_g_is_reduced_by_more_than_7():
    assert driven("s_curve_120kmh").metrics["roll_reduction_factor"].value > 7.0


def test_on_a_flat_target_the_s_curve_takes_the_energy_that_was_derived():
    """1.24 kJ for both axles, the inverters' standby included; 15 %."""
    run = shipped.recording("s_curve_120kmh", "electromechanical", "controller=level")
    standby = 12.0 * run.time[-1]
    drawn = run["front.energy.electrical"][-1] + run["rear.energy.electrical"][-1]
    print(f"{drawn:.0f} J, of which standby {standby:.0f} J")
    assert drawn == pytest.approx(1240.0, rel=0.15)
