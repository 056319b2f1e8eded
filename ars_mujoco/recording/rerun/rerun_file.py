"""A run as a Rerun file, written while it is simulated.

What is not finished has another name: a killed process leaves `run.rrd.part`, which the viewer opens, and no `run.rrd`.
"""

import os
import time
import uuid
from pathlib import Path

import rerun as rr

from ars_mujoco.recording.recording import Recording, joined
from ars_mujoco.recording.rerun.layout import layout
from ars_mujoco.recording.rerun.run import RerunRun

APPLICATION = "ars_mujoco"
WRITE_EVERY = 0.1  # s of wall time between two writes: the fewer, the cheaper


class RerunFile:
    """The file `path`, of a run that begins: title, channels, bodies, scene and inputs are those of `run`.

    As a context it closes the unfinished file where the run fails, so that all up to the failure can be looked at.
    """

    def __init__(self, path: Path, run: Recording):
        self.path, self.part = Path(path), part_of(path)
        self.stream = open_stream(self.part, run.title)
        self.run = RerunRun(self.stream, run)
        self.waiting: list[Recording] = []
        self.written = time.monotonic()
        self.is_open = True

    def __enter__(self) -> "RerunFile":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def append(self, chunk: Recording) -> None:
        """Add the next seconds; they reach the disk while the run goes on, after WRITE_EVERY at the latest."""
        self.waiting.append(chunk.at_poses())
        if time.monotonic() - self.written > WRITE_EVERY:
            self.write()

    def write(self) -> None:
        """Hand over what waits; Rerun's own thread brings it to the disk."""
        if self.waiting:
            self.run.append(joined(self.waiting))
        self.waiting, self.written = [], time.monotonic()

    def close(self) -> None:
        """Write what waits, the layout and the footer; the file keeps its unfinished name; twice is once."""
        if self.is_open:
            self.write()
            close_stream(self.stream, [self.run])
            self.is_open = False

    def finish(self, run: Recording) -> None:
        """Add the metrics of the whole `run` and give the file its name."""
        self.run.log_notes(run)
        self.close()
        os.replace(self.part, self.path)


def write_rerun(path: Path, run: Recording) -> None:
    """Write the whole `run` to `path` at once."""
    with RerunFile(path, run) as file:
        file.append(run)
        file.finish(run)


def part_of(path: Path) -> Path:
    """The name of `path` while it is written."""
    return path.with_name(path.name + ".part")


def open_stream(path: Path, title: str) -> rr.RecordingStream:
    """A stream into the file `path`, without wall-clock times."""
    stream = rr.RecordingStream(APPLICATION, recording_id=str(uuid.uuid4()))
    rr.set_log_time_enabled(False, recording=stream)
    stream.save(path)
    stream.send_recording_name(title)
    return stream


def close_stream(stream: rr.RecordingStream, runs: list[RerunRun]) -> None:
    """Send the layout of `runs` with its final ranges and write the file's footer."""
    stream.send_blueprint(layout(runs))
    stream.disconnect()
