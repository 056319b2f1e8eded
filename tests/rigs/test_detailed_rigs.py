"""The detailed circuits in the rigs: the sedan drives with them, restores bit for bit, and has its interpreted twin."""

import numpy as np
import pytest
import shipped
from shipped import drive_on
from twins import twins_apart

S_CURVE, BENCH, FULL = "s_curve_120kmh", "bench_s_curve", "pump_controlled_full"
STAGES = ("third_order", "reduced", "full")


def simulation(cycle, stage, actuator=FULL):
    return shipped.simulation(cycle, actuator, f"actuator.pump_control={stage}", "duration=1 s")


@pytest.mark.parametrize("stage", STAGES)
def test_the_sedan_drives_with_full_circuits(stage):
    recording = shipped.recording(S_CURVE, FULL, f"actuator.pump_control={stage}", "duration=1 s")
    for axle in ("front", "rear"):
        for side in ("a", "b"):
            assert recording[f"{axle}.motor.pressure_{side}"].min() > 1e5
        assert np.abs(recording[f"{axle}.bar.angle"]).max() > 0.0


@pytest.mark.parametrize("stage", STAGES)
def test_a_run_restored_in_its_middle_ends_identical(stage):
    car = simulation(S_CURVE, stage)
    data = shipped.driven(car, 0.6)
    state = shipped.state_of(car.model, data)
    np.testing.assert_array_equal(drive_on(car, shipped.restored(car.model, state), 100), drive_on(car, data, 100))


@pytest.mark.parametrize(("stage", "actuator"), [("full", FULL), ("reduced", "pump_controlled")])
def test_the_interpreted_twin_agrees_to_1e_12(stage, actuator, tmp_path, monkeypatch):
    bench = simulation(BENCH, stage, actuator)
    data = shipped.driven(bench, 0.7)
    apart = twins_apart(bench, data, 40, tmp_path, monkeypatch)
    assert abs(data.userdata.view(bench.rig.WORLD).view(np.recarray)[0].out.system.front.motor.rate) > 1e-3
    assert apart < 1e-12
