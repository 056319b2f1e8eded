"""Commands of linear theory, of the paper's claims and of a pump's losses: more than a plain installation brings."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ars_mujoco.cli.console import extra, print_json, print_table, progress_bars
from ars_mujoco.cli.options import RUNS, Json


class Axle(StrEnum):
    """Whose circuit `ars analyze` is of."""

    FRONT = "front"
    REAR = "rear"


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
    with extra("analyze"):
        from ars_mujoco.analysis import analyze as analysis
        from ars_mujoco.analysis.loop import loop_of
    inputs = analysis.read_analyzed(actuator, controller, settings or [])
    folder = out or RUNS / "analyze"
    loop = loop_of(inputs, axle)
    left_out = analysis.left_out(loop)
    with progress_bars() as progress:
        results = analysis.analyze(loop, analysis.named(inputs, axle), folder, progress)
    if as_json:
        print_json({"folder": str(folder), "analyses": results, "left_out": left_out})
        return
    rows = [{key: row[key] for key in ("quantity", "value", "paper")} for row in analysis.headlines(results)]
    print_table(f"{inputs.actuator.name} {axle} on the bench, {inputs.controller.name}", rows)
    for reason in dict.fromkeys(left_out.values()):
        print(f"Left out: {', '.join(name for name in left_out if left_out[name] == reason)}: {reason}")
    print(f"Figures and numbers: {folder}")


def reproduce(
    out: Annotated[Path | None, typer.Option(help="Folder of the results; else runs/reproduce.")] = None,
    as_json: Json = False,
) -> None:
    """The paper's claims, each held against the running code: one page with figures, and the numbers."""
    with extra("reproduce"):
        from ars_mujoco.reproduce import reproduce as claims
        from ars_mujoco.reproduce.evidence import Evidence
    folder = out or RUNS / "reproduce"
    with progress_bars() as progress:
        numbers = claims.reproduce(Evidence(), folder, progress)
    if as_json:
        print_json({"folder": str(folder), **{key: numbers[key] for key in numbers if key != "analyses"}})
        return
    for group in numbers["groups"]:
        rows = [
            {"claim": each["text"], "ours": each["told"], "verdict": " ".join(filter(None, each["verdict"].values()))}
            for each in group["claims"]
        ]
        print_table(group["title"], rows)
    print(f"Page: {folder / claims.HTML}\nNumbers: {folder / claims.JSON}")


def fit_losses(
    data: Annotated[
        Path,
        typer.Argument(
            metavar="DATA.csv",
            help="Measured points; the header names speed, pressure, displacement (or stroke), flow and torque with "
            "units: 'speed (rpm),pressure (bar),...'; a Parquet file does too.",
        ),
    ],
    orders: Annotated[tuple[int, int, int], typer.Option(help="Of stroke, speed and pressure.", metavar="P Q R")],
    displacement: Annotated[
        str | None, typer.Option(help="Of the full stroke, such as '1.8 cm^3/rev'; else the largest measured.")
    ] = None,
    scale_to: Annotated[
        str | None, typer.Option(help="Displacement of a similar pump that losses.yaml is to be for.")
    ] = None,
    units: Annotated[
        str | None,
        typer.Option(metavar="COLUMN=UNIT,...", help="Of columns whose header has none: speed=rpm,pressure=bar,..."),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Folder of the results; else runs/fit_losses.")] = None,
    as_json: Json = False,
) -> None:
    """Fit a pump's flow and torque loss to measured points: a block for an actuator's file, numbers and a figure."""
    with extra("fit-losses"):
        from ars_mujoco.analysis import fit_losses as fitting
    folder = out or RUNS / fitting.NAME
    result = fitting.fit_losses(data, orders, folder, displacement, scale_to, units)
    if as_json:
        print_json({"folder": str(folder), **result})
        return
    print_table(f"{data.name}: {result['points']} points", fitting.rows(result))
    for remark in fitting.remarks(result):
        print(remark)
    print(f"For an actuator's file: {folder / 'losses.yaml'}")
