"""What the commands print: tables, JSON, progress, and warnings that do not scroll what was said away."""

import json
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from typing import Any

from ars_mujoco.schema.errors import InputError


@contextmanager
def extra(command: str) -> Iterator[None]:
    """Say what to install where a command needs more than a plain installation brings."""
    try:
        yield
    except ModuleNotFoundError as missing:
        extra = "pip install 'ars_mujoco[analysis]'"
        raise InputError(f"ars {command} needs the package '{missing.name}'; it comes with {extra}") from None


@contextmanager
def warnings_in_one_line() -> Iterator[None]:
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
def prints_on_stderr() -> Iterator[None]:
    """What a user's own code prints is told beside the results, not among them."""
    with redirect_stdout(sys.stderr):
        yield


@contextmanager
def progress_bars() -> Iterator[Callable[[str, float], None]]:
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


def print_json(result: Any) -> None:
    """A machine-readable result on stdout."""
    print(json.dumps(result, indent=2, allow_nan=False))


def print_table(title: str, rows: list[dict[str, str]]) -> None:
    """Rows with the same keys as a table; not wrapped where nobody looks."""
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title, title_justify="left", title_style="bold", box=None, header_style="dim")
    for column in rows[0]:
        table.add_column(column, overflow="fold")
    for row in rows:
        table.add_row(*map(str, row.values()))
    Console(width=None if sys.stdout.isatty() else 240, markup=False).print(table)
