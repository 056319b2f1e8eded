"""Energy: the books of axle and supply close, whichever way the power goes and whatever limits it."""

import numpy as np
import pytest
from eha_runs import BYPASS, FAIL_SAFE, bench_run, books, ramp_to, step_to, switch
from shipped import recording

STILL = "{join: step, knots: [[0 s, 0 rad]]}"
SWAY = "{sine: {amplitude: 20 mm, frequency: 2 Hz}}"
WEAK = ("supply.converter_power=400 W", "supply.store_power=0 W", "supply.capacitance=0.05 F")
RUNS = {
    "step": lambda: bench_run(step_to(1200), 0.6),
    "s-curve": lambda: recording("bench_s_curve", "electro_hydrostatic"),
    "following its ends": lambda: bench_run(STILL, 1.0, ends=SWAY),
    "back-driven, holding its angle": lambda: bench_run(ramp_to(800), 1.0, "control.follow=angle", ends=SWAY),
    "back-driven, phases open": lambda: bench_run(STILL, 1.0, ends=SWAY, inputs=switch("phases", 0, 0, 0.5)),
    "back-driven, phases shorted": lambda: bench_run(STILL, 1.0, ends=SWAY, inputs=switch("phases", -1, -1, 0.5)),
    "step on a weak supply": lambda: bench_run(step_to(1200), 1.0, *WEAK),
    "over its relief valves": lambda: bench_run(step_to(1700), 1.0),
    "fail-safe": lambda: bench_run(ramp_to(600), 1.5, *FAIL_SAFE, inputs=switch("fail_safe", 1, 0, 1.0)),
    "bypass": lambda: bench_run(ramp_to(600), 1.5, *BYPASS, inputs=switch("bypass", 0, 1, 1.0)),
}


@pytest.mark.parametrize("name", RUNS)
def test_the_books_of_axle_and_supply_close(name):
    run = RUNS[name]()
    for block in ("front", "supply"):
        astray, crossed = books(run, block)
        print(f"{name}, {block}: {astray:.1e} J of {crossed:.4g} J")
        assert abs(astray) < 1e-4 * crossed
    assert run["supply.energy.loads"][-1] == pytest.approx(run["front.energy.electrical"][-1], rel=1e-9)


def test_no_axle_is_on_the_bench_but_the_front():
    run = bench_run(step_to(1200), 0.6)
    assert not [name for name in run.channels if name.startswith("rear.")]


def test_a_weak_supply_is_not_asked_for_more_than_it_has():
    run = RUNS["step on a weak supply"]()
    power = run["front.machine.power"]
    assert power[run.time > 0.02].max() < 1.02 * 400.0
    assert power.max() < 1.15 * 400.0  # while the rotor speeds up, its current lags behind what is granted
    assert run["supply.voltage"].min() > 36.0
    assert run["supply.share"].min() < 0.5
    strong = bench_run(step_to(1200), 0.6)
    assert np.argmax(run["front.bar.torque"] > 1080.0) > 1.5 * np.argmax(strong["front.bar.torque"] > 1080.0)


def test_a_store_bears_what_the_converter_does_not():
    run = bench_run(step_to(1200), 0.6, "supply.converter_power=400 W")
    strong = bench_run(step_to(1200), 0.6)
    assert run["front.bar.torque"] == pytest.approx(
        strong["front.bar.torque"], abs=0.005 * 1200.0
    )  # a sagging store slows the pump a little
    assert run["supply.voltage"].min() < 47.8


def test_as_the_ends_drive_it_the_machine_gives_power_back():
    run = RUNS["back-driven, holding its angle"]()
    given_back = np.maximum(-np.diff(run["front.energy.electrical"]), 0.0).sum()
    assert given_back > 1.0


def test_every_loss_only_grows():
    for name in ("step", "s-curve", "back-driven, phases shorted", "fail-safe"):
        run = RUNS[name]()
        for (
            loss
        ) in "copper inverter drag pump_torque_loss pump_leakage motor_leakage relief check valve friction".split():
            assert np.all(np.diff(run[f"front.energy.{loss}"]) >= -1e-12), (name, loss)
