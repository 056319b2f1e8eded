"""Arguments and options that commands share."""

from pathlib import Path
from typing import Annotated

import typer

RUNS = Path("runs")  # folder of results, unless --out names another

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
