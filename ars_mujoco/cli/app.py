"""The command `ars`. Heavy imports wait until a command needs them, so that listing and refusing are quick."""

import json
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from ars_mujoco.schema import library
from ars_mujoco.schema.errors import ArsError, InputError, SimulationError

app = typer.Typer(
    help="A testbed for active stabilizer bars.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

RUNS = Path("runs")  # folder of results, unless --out names another
BENCH_CYCLE = "s_curve_120kmh"  # the sedan with everything on it
CIRCUITS = {"reduced": "pump_controlled", "full": "pump_controlled_full"}  # shipped actuators
STAGES = ("third_order", "reduced", "full")  # of pump control


class Axle(StrEnum):
    """Whose circuit `ars analyze` is of."""

    FRONT = "front"
    REAR = "rear"


class Listing(StrEnum):
    """What `ars list` can list."""

    CYCLES = "cycles"
    ACTUATORS = "actuators"
    VEHICLES = "vehicles"
    CONTROLLERS = "controllers"
    CHANNELS = "channels"


CycleName = Annotated[str, typer.Argument(metavar="CYCLE", help="Name or path of a cycle.")]
Actuator = Annotated[str | None, typer.Option(help="Name or path; else the cycle's.")]
Vehicle = Annotated[str | None, typer.Option(help="Name or path; else the cycle's.")]
Controller = Annotated[str | None, typer.Option(help="Name or path; else the cycle's.")]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="KEY=VALUE", help="A value of the cycle, or through it: actuator.front.pump.speed='1500 rpm'."
    ),
]
Out = Annotated[Path | None, typer.Option(help="Folder of the results; else runs/CYCLE.")]
Json = Annotated[bool, typer.Option("--json", help="A machine-readable result on stdout.")]


def main() -> None:
    """Run the command line; what a user did wrong is one line for each problem on stderr, and exit status 1."""
    try:
        with _warnings_in_one_line():
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
    compared = [read_compared(cycle, [None]) for cycle in cycles or library.shipped("cycle")]
    names = told_apart(runs[0].cycle.name for runs, _ in compared)
    for name, (runs, references) in zip(names, compared, strict=True):
        try:
            with _progress() as progress:
                (result,) = study(runs, references, None, progress)
            failures = [str(failure) for failure in failures_of(runs[0].cycle.value.expect, result.metrics)]
        except SimulationError as error:
            failures = [str(error)]
        verdicts[name] = {"passed": not failures, "failures": failures}
        if not as_json:
            print("\n      ".join([f"{'FAIL' if failures else 'pass'}  {name}", *failures]))
    if as_json:
        _print_json(verdicts)
    raise typer.Exit(not all(verdict["passed"] for verdict in verdicts.values()))


@app.command("list")
def list_(
    what: Annotated[Listing | None, typer.Argument(help="Else all but channels.")] = None, as_json: Json = False
) -> None:
    """List what is shipped, or the channels of every rig."""
    wanted = [what] if what else [each for each in Listing if each != Listing.CHANNELS]
    found = {each.value: _channels() if each == Listing.CHANNELS else _shipped(each) for each in wanted}
    if as_json:
        _print_json(found)
        return
    for kind, rows in found.items():
        _print_table(kind, rows)


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
        _print_json({"recording": str(found)})
    raise typer.Exit(subprocess.call([sys.executable, "-m", "rerun", str(found)]))


@app.command()
def bench(as_json: Json = False) -> None:
    """Cost of a closed-loop step over a bare mj_step of the same model, at every stage of the hydraulics."""
    from dataclasses import asdict

    from ars_mujoco.studies.benchmark import measure, recording_ratio
    from ars_mujoco.studies.inputs import read_inputs
    from ars_mujoco.studies.study import simulation_of

    rows = []
    for circuit, actuator in CIRCUITS.items():
        for stage in STAGES:
            inputs = read_inputs(BENCH_CYCLE, actuator, settings=[f"actuator.pump_control={stage}"])
            rows.append({"circuit": circuit, "pump_control": stage, **asdict(measure(simulation_of(inputs)))})
    recording = recording_ratio(simulation_of(read_inputs(BENCH_CYCLE)))
    if as_json:
        _print_json({"cycle": BENCH_CYCLE, "stages": rows, "recording_ratio": recording})
        return
    _print_table(BENCH_CYCLE, [_cost(row) for row in rows])
    print(f"A run that writes its .rrd takes {recording:.3f} times one that does not (reduced, third_order).")


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


@app.command()
def analyze(
    actuator: Annotated[str | None, typer.Option(help="Name or path; else pump_controlled.")] = None,
    axle: Annotated[Axle, typer.Option(help="Whose circuit.")] = Axle.FRONT,
    controller: Annotated[str | None, typer.Option(help="Name or path; else verification.")] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="A value of a file: actuator.front.pump.speed='1500 rpm'."),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Folder of the results; else runs/analyze.")] = None,
    as_json: Json = False,
) -> None:
    """Linear theory of an axle's actuator on the bench: poles, margins, responses and the gain's stable region."""
    with _extra("analyze"):
        from ars_mujoco.analysis import analyze as analysis
        from ars_mujoco.analysis.loop import loop_of
    inputs = analysis.read_analyzed(actuator, controller, settings or [])
    folder = out or RUNS / "analyze"
    loop = loop_of(inputs, axle)
    left_out = analysis.left_out(loop)
    with _progress() as progress:
        results = analysis.analyze(loop, analysis.named(inputs, axle), folder, progress)
    if as_json:
        _print_json({"folder": str(folder), "analyses": results, "left_out": left_out})
        return
    rows = [{key: row[key] for key in ("quantity", "value", "paper")} for row in analysis.headlines(results)]
    _print_table(f"{inputs.actuator.name} {axle} on the bench, {inputs.controller.name}", rows)
    for reason in dict.fromkeys(left_out.values()):
        print(f"Left out: {', '.join(name for name in left_out if left_out[name] == reason)}: {reason}")
    print(f"Figures and numbers: {folder}")


@app.command()
def reproduce(
    out: Annotated[Path | None, typer.Option(help="Folder of the results; else runs/reproduce.")] = None,
    as_json: Json = False,
) -> None:
    """The paper's claims, each held against the running code: one page with figures, and the numbers."""
    with _extra("reproduce"):
        from ars_mujoco.reproduce import reproduce as claims
        from ars_mujoco.reproduce.evidence import Evidence
    folder = out or RUNS / "reproduce"
    with _progress() as progress:
        numbers = claims.reproduce(Evidence(), folder, progress)
    if as_json:
        _print_json({"folder": str(folder), **{key: numbers[key] for key in numbers if key != "analyses"}})
        return
    for group in numbers["groups"]:
        rows = [
            {"claim": each["text"], "ours": each["told"], "verdict": " ".join(filter(None, each["verdict"].values()))}
            for each in group["claims"]
        ]
        _print_table(group["title"], rows)
    print(f"Page: {folder / claims.HTML}\nNumbers: {folder / claims.JSON}")


@app.command("fit-losses")
def fit_losses(
    data: Annotated[
        Path,
        typer.Argument(
            metavar="DATA.csv",
            help="Measured points; the header names speed, pressure, displacement (or stroke), flow and torque with "
            "units: 'speed (rpm),pressure (bar),...'.",
        ),
    ],
    orders: Annotated[tuple[int, int, int], typer.Option(help="Of stroke, speed and pressure.", metavar="P Q R")],
    displacement: Annotated[
        str | None, typer.Option(help="Of the full stroke, such as '1.8 cm^3/rev'; else the largest measured.")
    ] = None,
    scale_to: Annotated[
        str | None, typer.Option(help="Displacement of a similar pump that losses.yaml is to be for.")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Folder of the results; else runs/fit_losses.")] = None,
    as_json: Json = False,
) -> None:
    """Fit a pump's flow and torque loss to measured points: a block for an actuator's file, numbers and a figure."""
    with _extra("fit-losses"):
        from ars_mujoco.analysis import fit_losses as fitting
    folder = out or RUNS / fitting.NAME
    result = fitting.fit_losses(data, orders, folder, displacement, scale_to)
    if as_json:
        _print_json({"folder": str(folder), **result})
        return
    _print_table(f"{data.name}: {result['points']} points", fitting.rows(result))
    for remark in fitting.remarks(result):
        print(remark)
    print(f"For an actuator's file: {folder / 'losses.yaml'}")


def _study(cycle, actuators, vehicle, controller, settings, out, as_json) -> None:
    """Run, write and show a cycle with one or several actuators."""
    from ars_mujoco.recording.summary import summary
    from ars_mujoco.studies.inputs import read_compared
    from ars_mujoco.studies.study import study

    runs, references = read_compared(cycle, actuators, controller, vehicle, settings or ())
    folder = out or RUNS / runs[0].cycle.name
    with _progress() as progress:
        results = study(runs, references, folder, progress)
    if as_json:
        _print_json({"folder": str(folder), "runs": {each.name: summary(each.recording) for each in results}})
        return
    rows = [
        {"metric": name, **{each.name: _cell(each.metrics[name]) for each in results}} for name in results[0].metrics
    ]
    measured = [row for row in rows if set(list(row.values())[1:]) != {"-"}]
    _print_table(runs[0].cycle.value.title, measured)
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
    """Name and description of what is shipped of a kind."""
    return [
        {"name": name, "description": library.description(path)}
        for name, path in library.shipped(kind.value.removesuffix("s")).items()
    ]


def _channels() -> list[dict[str, str]]:
    """Every channel, with its unit, its description and the rigs that record it."""
    from importlib import import_module

    from ars_mujoco.schema.channels import channels

    found: dict[str, dict[str, str]] = {}
    for rig in ("sedan", "roll_plane", "bench"):
        for channel in channels(import_module(f"ars_mujoco.rigs.{rig}").Output):
            row = {"name": channel.name, "unit": channel.unit, "description": channel.description, "rigs": rig}
            if channel.name in found:
                row["rigs"] = f"{found[channel.name]['rigs']}, {rig}"
            found[channel.name] = row
    return list(found.values())


@contextmanager
def _extra(command: str) -> Iterator[None]:
    """Say what to install where a command needs more than a plain installation brings."""
    try:
        yield
    except ModuleNotFoundError as missing:
        extra = "pip install 'ars_mujoco[analysis]'"
        raise InputError(f"ars {command} needs the package '{missing.name}'; it comes with {extra}") from None


@contextmanager
def _warnings_in_one_line() -> Iterator[None]:
    """Whatever warns, numpy too, is one line on stderr, and the same line only once."""
    told = set()

    def tell(message: Warning | str, *_: object, **__: object) -> None:
        line = " ".join(str(message).split())
        if line not in told:
            told.add(line)
            print(f"warning: {line}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.showwarning = tell
        yield


@contextmanager
def _progress() -> Iterator[Callable[[str, float], None]]:
    """Bars on a terminal, one a run; elsewhere nothing."""
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bars:
        tasks: dict[str, Any] = {}

        def show(name: str, share: float) -> None:
            if name not in tasks:
                tasks[name] = bars.add_task(name, total=1.0)
            bars.update(tasks[name], completed=share)

        yield show


def _print_json(result: Any) -> None:
    print(json.dumps(result, indent=2, allow_nan=False))


def _print_table(title: str, rows: list[dict[str, str]]) -> None:
    """Rows with the same keys as a table; not wrapped where nobody looks."""
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title, title_justify="left", title_style="bold", box=None, header_style="dim")
    for column in rows[0]:
        table.add_column(column, overflow="fold")
    for row in rows:
        table.add_row(*map(str, row.values()))
    Console(width=None if sys.stdout.isatty() else 240, markup=False).print(table)
