"""Digests of every channel of shipped runs, so that a move of code can be shown to change nothing.

`python tests/net/digests.py out.json` writes them; with two files, `old.json new.json`, it says what differs: a channel
that a run no longer has must have been zero all the time.
"""

import hashlib
import json
import sys
from pathlib import Path

import numpy as np

from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

STAGES = ("third_order", "reduced", "full")


def cases():
    """(cycle, actuator, settings) of every run, by name."""
    for path in sorted((Path(__file__).parents[2] / "cycles").glob("*.yaml")):
        cycle = path.stem
        bench = "rig: bench" in path.read_text()
        for actuator in () if bench else ("none", "passive", "locked"):
            yield cycle, actuator, ()
        if cycle.startswith("robot"):
            yield cycle, None, ()
            continue
        for stage in STAGES:
            for actuator in ("pump_controlled", "pump_controlled_full"):
                if "fail_safe" in cycle and actuator == "pump_controlled":
                    continue
                if "decoupled" in cycle and actuator == "pump_controlled":
                    continue
                yield cycle, actuator, (f"actuator.pump_control={stage}",)
    for motor in ("held", "free"):
        for actuator in ("pump_controlled", "pump_controlled_full"):
            yield "bench_ends_free", actuator, (f"manoeuvre.motor={motor}",)
    for settings in (
        ("controller.unit.sample_time=2 ms", "controller.unit.delay=6 ms"),
        (
            "controller.unit.sample_time=1 ms",
            "controller.unit.delay=1 ms",
            "controller.pressure_feedback={gain: 2e-8 1/Pa, corner: 100 rad/s}",
            "controller.compensator={frequency: 500 rad/s, damping: 0.1, new_damping: 0.6}",
        ),
        ("actuator.drive={kind: table, speed: {knots: [[0 s, 1500 rpm], [4 s, 4000 rpm]]}}",),
    ):
        yield "s_curve_120kmh", "pump_controlled", settings
    yield "s_curve_120kmh", "pump_controlled_full", ("actuator.front.oil.temperature=80 degC",)


FLOW = tuple(f"actuator.{axle}.swash_plate.stop=flow" for axle in ("front", "rear"))
FIXED = (
    *FLOW,
    "actuator.control.loop.gain=60 1/rad",
    "actuator.control.loop.schedule=0",
)  # the bench's loop, once its own


def today(cycle: str, actuator: str | None, settings: tuple[str, ...]) -> tuple[str | None, tuple[str, ...]]:
    """The same run as it is asked for today."""
    settings = tuple(each.replace("controller.pressure", "actuator.control.pressure") for each in settings)
    settings = tuple(each.replace("controller.compens", "actuator.control.compens") for each in settings)
    if actuator and actuator.startswith("pump") and not cycle.startswith("bench"):
        settings = (*settings, *FLOW)
    if cycle.startswith("bench"):
        return ("verification", settings) if actuator == "pump_controlled" else (actuator, (*settings, *FIXED))
    return actuator, settings


def digest(values: np.ndarray) -> str:
    return "zero" if not values.any() else hashlib.sha256(values.tobytes()).hexdigest()[:10]


def take() -> dict:
    found = {}
    for cycle, actuator, settings in cases():
        name = " ".join([cycle, actuator or "own", *settings])
        try:
            own, asked = today(cycle, actuator, settings)
            run = simulate(simulation_of(read_inputs(cycle, own, settings=asked)))
        except Exception as error:
            found[name] = {"error": f"{type(error).__name__}: {str(error).splitlines()[0][:100]}"}
            print(name, found[name], file=sys.stderr)
            continue
        found[name] = {each: digest(np.ascontiguousarray(run[each])) for each in run.channels}
        found[name] |= {"poses": digest(run.poses), "time": digest(run.time)}
    return found


def compare(old: dict, new: dict) -> int:
    wrong = 0
    for run in old:
        if run not in new:
            print("gone:", run)
            wrong += 1
            continue
        for channel, was in old[run].items():
            now = new[run].get(channel, "absent")
            if now != was and not (now == "absent" and was == "zero"):
                print(f"{run}: {channel}: {was} -> {now}")
                wrong += 1
        for channel in new[run].keys() - old[run].keys():
            print(f"{run}: new channel {channel}")
    print(f"{len(old)} runs, {wrong} differences")
    return wrong


if __name__ == "__main__":
    first, *second = (Path(name) for name in sys.argv[1:])
    if second:
        sys.exit(compare(json.loads(first.read_text()), json.loads(second[0].read_text())) > 0)
    first.write_text(json.dumps(take(), indent=0))
