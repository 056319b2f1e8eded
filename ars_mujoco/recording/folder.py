"""The folder of a run: `run.rrd` written as it goes, `run.parquet` and `summary.json` at its end.

A file carries its final name only when it is whole: it is written under another and renamed.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryFile

from ars_mujoco.recording.parquet_file import write_parquet
from ars_mujoco.recording.recording import Recording
from ars_mujoco.recording.rerun.rerun_file import RerunFile, part_of
from ars_mujoco.recording.summary import write_summary
from ars_mujoco.schema.errors import InputError

RRD, PARQUET, SUMMARY = "run.rrd", "run.parquet", "summary.json"


class RunFolder:
    """The folder `path`, made where it is missing, for a run that begins; what an earlier run left in it is removed.

    The Rerun file is written in a thread of its own, while the simulation, which needs no interpreter, goes on.
    As a context it closes the Rerun file where the run fails: `run.rrd.part` then holds all up to the failure.
    """

    def __init__(self, path: Path, run: Recording):
        self.path = Path(path)
        self.path.mkdir(parents=True, exist_ok=True)
        for name in (RRD, PARQUET, SUMMARY):
            (self.path / name).unlink(missing_ok=True)
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="rerun")
        self._rerun = self._thread.submit(RerunFile, self.path / RRD, run)
        self._tasks = [self._rerun]

    def __enter__(self) -> "RunFolder":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def append(self, chunk: Recording) -> None:
        """Show the next seconds of the run."""
        self._do(lambda rerun: rerun.append(chunk))

    def close(self) -> None:
        """End a run that has failed: what was shown so far stays, under the unfinished name."""
        self._do(lambda rerun: rerun.close())
        self._wait()

    def finish(self, run: Recording) -> None:
        """Write what the whole `run` leaves, metrics included; the summary comes last and says that all is there."""
        self._do(lambda rerun: rerun.finish(run))
        write_whole(self.path / PARQUET, lambda part: write_parquet(part, run))
        self._wait()
        write_whole(self.path / SUMMARY, lambda part: write_summary(part, run))

    def _do(self, task: Callable[[RerunFile], None]) -> None:
        """Let the thread do `task` with the Rerun file, after all it was given before."""
        self._tasks.append(self._thread.submit(lambda: task(self._rerun.result())))

    def _wait(self) -> None:
        """Until the thread has done all; raises what went wrong there."""
        while self._tasks:
            self._tasks.pop(0).result()


def check_writable(path: Path) -> None:
    """Raise InputError where the folder `path` cannot be written to, or made; nothing is left behind."""
    try:
        nearest = next(each for each in (path, *path.absolute().parents) if each.exists())
        TemporaryFile(dir=nearest).close()
    except OSError as error:
        raise InputError(f"{path}: cannot be written to: {error.strerror or error}") from None


def write_whole(path: Path, write: Callable[[Path], None]) -> None:
    """Let `write` fill a file under another name, then give it the name `path`; nothing is left where it fails."""
    part = part_of(path)
    try:
        write(part)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
