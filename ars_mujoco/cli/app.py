"""The command `ars`. Heavy imports wait until a command needs them, so that listing and refusing are quick."""

import sys
from collections.abc import Iterator
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from ars_mujoco.cli.analyze import analyze, fit_losses, reproduce
from ars_mujoco.cli.console import print_json, print_table, prints_on_stderr, progress_bars, warnings_in_one_line
from ars_mujoco.cli.options import RUNS, Actuator, Controller, CycleName, Json, Out, Settings, Vehicle
from ars_mujoco.cli.size import size
from ars_mujoco.schema import library
from ars_mujoco.schema.errors import ArsError, InputError, SimulationError

app = typer.Typer(
    help="A testbed for active stabilizer bars.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

BENCH_CYCLE = "s_curve_120kmh"  # the sedan with everything on it
CIRCUITS = {"reduced": "pump_controlled", "full": "pump_controlled_full"}  # shipped actuators
STAGES = ("third_order", "reduced", "full")  # of pump control


class Listing(StrEnum):
    """What `ars list` can list."""

    CYCLES = "cycles"
    ACTUATORS = "actuators"
    VEHICLES = "vehicles"
    CONTROLLERS = "controllers"
    PUMPS = "pumps"
    CHANNELS = "channels"
    SENSORS = "sensors"


def main() -> None:
    """Run the command line; what a user did wrong is one line for each problem on stderr, and exit status 1."""
    try:
        with warnings_in_one_line():
            app()
    except ArsError as error:
        problems = error.problems if isinstance(error, InputError) else [str(error)]
        sys.exit("\n".join(f"error: {problem}" for problem in problems))
    except OSError as error:
        sys.exit(f"error: {error}")


@app.command()
def run(
    cycle: CycleName,
    actuator: Actuator = None,
    vehicle: Vehicle = None,
    controller: Controller = None,
    settings: Settings = None,
    out: Out = None,
    as_json: Json = False,
) -> None:
    """Drive a cycle: a recording to look at, a table to analyse, and its metrics."""
    _study(cycle, [actuator], vehicle, controller, settings, out, as_json)


@app.command()
def compare(
    cycle: CycleName,
    actuators: Annotated[str, typer.Option(help="Names or paths, with commas between; the last is drawn solid.")],
    vehicle: Vehicle = None,
    controller: Controller = None,
    settings: Settings = None,
    out: Out = None,
    as_json: Json = False,
) -> None:
    """Drive a cycle with several actuators: one recording with all of them, and a table."""
    _study(cycle, [name.strip() for name in actuators.split(",")], vehicle, controller, settings, out, as_json)


@app.command()
def check(
    cycles: Annotated[
        list[str] | None, typer.Argument(metavar="[CYCLE ...]", help="Else all that are shipped.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Drive cycles and hold them to what they expect; exit status 1 where one falls short."""
    from ars_mujoco.metrics.expectation import check as failures_of
    from ars_mujoco.studies.inputs import read_compared
    from ars_mujoco.studies.study import study, told_apart

    verdicts = {}
    with prints_on_stderr():
        compared = [read_compared(cycle, [None]) for cycle in cycles or library.shipped("cycle")]
    names = told_apart(runs[0].cycle.name for runs, _ in compared)
    for name, (runs, references) in zip(names, compared, strict=True):
        try:
            with prints_on_stderr(), progress_bars() as progress:
                (result,) = study(runs, references, None, progress)
            failures = [str(failure) for failure in failures_of(runs[0].cycle.value.expect, result.metrics)]
        except SimulationError as error:
            failures = [str(error)]
        verdicts[name] = {"passed": not failures, "failures": failures}
        if not as_json:
            print("\n      ".join([f"{'FAIL' if failures else 'pass'}  {name}", *failures]))
    if as_json:
        print_json(verdicts)
    raise typer.Exit(not all(verdict["passed"] for verdict in verdicts.values()))


@app.command("list")
def list_(
    what: Annotated[Listing | None, typer.Argument(help="Else what is shipped.")] = None, as_json: Json = False
) -> None:
    """List what is shipped, the channels of every rig, or the sensors that a controller in Python reads."""
    declared = {Listing.CHANNELS: _channels, Listing.SENSORS: _sensors}
    wanted = [what] if what else [each for each in Listing if each not in declared]
    found = {each.value: declared[each]() if each in declared else _shipped(each) for each in wanted}
    if as_json:
        print_json(found)
        return
    for kind, rows in found.items():
        print_table(kind, rows)


@app.command()
def view(
    path: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run or a comparison, or an .rrd file.")],
    as_json: Json = False,
) -> None:
    """Open a recording in the viewer."""
    import subprocess

    candidates = [path / "compare.rrd", path / "run.rrd"] if path.is_dir() else [path]
    found = next((each for each in candidates if each.is_file()), None)
    if found is None:
        raise InputError(f"no recording '{path}'; allowed: an .rrd file, or the folder of a run or a comparison")
    if as_json:
        print_json({"recording": str(found)})
    raise typer.Exit(subprocess.call([sys.executable, "-m", "rerun", str(found)]))


@app.command()
def bench(as_json: Json = False) -> None:
    """Cost of a closed-loop step over a bare mj_step of the same model, at every stage of the hydraulics."""
    from dataclasses import asdict

    from ars_mujoco.studies.benchmark import measure, preparation, recording_ratio
    from ars_mujoco.studies.inputs import read_inputs
    from ars_mujoco.studies.study import simulation_of

    rows = []
    for circuit, actuator in CIRCUITS.items():
        for stage in STAGES:
            inputs = read_inputs(BENCH_CYCLE, actuator, settings=[f"actuator.pump_control={stage}"])
            rows.append({"circuit": circuit, "pump_control": stage, **asdict(measure(simulation_of(inputs)))})
    recording = recording_ratio(simulation_of(read_inputs(BENCH_CYCLE)))
    before = preparation(simulation_of(read_inputs(BENCH_CYCLE)), lambda: simulation_of(read_inputs(BENCH_CYCLE)))
    if as_json:
        print_json({"cycle": BENCH_CYCLE, "stages": rows, "recording_ratio": recording, "before_a_run": before})
        return
    print_table(BENCH_CYCLE, [_cost(row) for row in rows])
    print(f"A run that writes its .rrd takes {recording:.3f} times one that does not (reduced, third_order).")
    print("Before a run, of a second of it: set-up {set_up:.2f}, digest of its entry {digest:.2f}.".format(**before))


def _cost(row: dict[str, Any]) -> dict[str, str]:
    """A stage of the benchmark in the table."""
    return {
        "circuit": row["circuit"],
        "pump control": row["pump_control"],
        "closed loop": f"{1e6 * row['closed_loop']:.2f} us",
        "bare step": f"{1e6 * row['bare']:.2f} us",
        "ratio": f"{row['ratio']:.3f}",
        "quartiles": "{:.3f} to {:.3f}".format(*row["ratio_quartiles"]),
        "times real time": f"{row['real_time_factor']:.0f}",
    }


def _study(cycle, actuators, vehicle, controller, settings, out, as_json) -> None:
    """Run, write and show a cycle with one or several actuators."""
    from ars_mujoco.recording.summary import summary
    from ars_mujoco.studies.inputs import read_compared
    from ars_mujoco.studies.study import study

    with prints_on_stderr(), progress_bars() as progress:
        runs, references = read_compared(cycle, actuators, controller, vehicle, settings or ())
        folder = out or RUNS / runs[0].cycle.name
        results = study(runs, references, folder, progress)
    if as_json:
        print_json({"folder": str(folder), "runs": {each.name: summary(each.recording) for each in results}})
        return
    rows = [
        {"metric": name, **{each.name: _cell(each.metrics[name]) for each in results}} for name in results[0].metrics
    ]
    measured = [row for row in rows if set(list(row.values())[1:]) != {"-"}]
    print_table(runs[0].cycle.value.title, measured)
    print("\n".join(_remarks(results)))
    print(f"Look at it: ars view {folder if len(runs) > 1 else folder / results[0].name}")


def _cell(value: Any) -> str:
    """A metric in the table; why there is none is said below it."""
    return "-" if value.value is None else str(value)


def _remarks(results) -> Iterator[str]:
    """What the metrics have to say, each remark once, with the runs and metrics it is about."""
    about: dict[str, list[str]] = {}
    for result in results:
        for name, value in result.metrics.items():
            if value.note:
                about.setdefault(value.note, []).append(name if len(results) == 1 else f"{result.name} {name}")
    for note, names in about.items():
        yield f"{', '.join(names)}: {note}"


def _shipped(kind: Listing) -> list[dict[str, str]]:
    """Name and description of what is shipped of a kind; of actuators and pumps how many values are of which grade."""
    rows = []
    for name, path in library.shipped(kind.value.removesuffix("s")).items():
        rows.append({"name": name, "description": library.description(path)})
        if kind in (Listing.ACTUATORS, Listing.PUMPS):
            counts = library.grades(path)
            rows[-1]["grades"] = ", ".join(f"{count} {library.GRADES[each]}" for each, count in counts.items())
    return rows


def _channels() -> list[dict[str, str]]:
    """Every channel, with its unit, its description and the rigs that record it."""
    from ars_mujoco.studies.channels import recorded_channels

    found = {}
    rigs: dict[str, dict[str, None]] = {}
    for rig, channels in recorded_channels():
        for channel in channels:
            found[channel.name] = channel
            rigs.setdefault(channel.name, {})[rig] = None  # each once, in their order
    return [
        {"name": name, "unit": channel.unit, "description": channel.description, "rigs": ", ".join(rigs[name])}
        for name, channel in found.items()
    ]


def _sensors() -> list[dict[str, str]]:
    """What `sensors` holds in a controller's `command(sensors, memory)`, with unit and description."""
    from ars_mujoco.control.sensors import Sensors
    from ars_mujoco.schema.channels import channels

    return [{"name": each.name, "unit": each.unit, "description": each.description} for each in channels(Sensors)]


app.command()(analyze)
app.command()(reproduce)
app.command()(size)
app.command("fit-losses")(fit_losses)
