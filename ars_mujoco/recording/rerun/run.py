"""One run in a Rerun stream, chunk by chunk: its car, its signals, its events and what is to be known about it."""

import numpy as np
import rerun as rr

from ars_mujoco.recording.recording import Recording
from ars_mujoco.recording.rerun.batch import Batch
from ars_mujoco.recording.rerun.car import Car
from ars_mujoco.recording.rerun.look import OWN, Look
from ars_mujoco.recording.rerun.notes import notes
from ars_mujoco.recording.rerun.signals import Signals


class RerunRun:
    """The entities of a run below `root`: `/world`, `/signals`, `/events`, `/meta`."""

    def __init__(self, stream: rr.RecordingStream, run: Recording, root: str = "", look: Look = OWN, row: int = 0):
        self.stream, self.root = stream, root
        self.car = Car(stream, run, root, look, row)
        self.signals = Signals(run.channels, run.tabs, root, look)
        styles = Batch()
        self.signals.style(styles)
        styles.send(stream)
        self.log_notes(run)

    def log_notes(self, run: Recording) -> None:
        """The page with the run's inputs and metrics; a later one replaces it."""
        document = rr.TextDocument(notes(run), media_type=rr.MediaType.MARKDOWN)
        self.stream.log(f"{self.root}/meta/run", document, static=True)

    def append(self, chunk: Recording) -> None:
        """Add a chunk whose values are at its pose times."""
        batch = Batch(chunk.time)
        if len(chunk.time):
            self.car.append(batch, chunk)
            self.signals.append(batch, chunk.values)
        batch.send(self.stream)
        if chunk.events:
            self._append_events(chunk)

    def _append_events(self, chunk: Recording) -> None:
        batch = Batch(np.array([event.time for event in chunk.events]))
        batch.add(f"{self.root}/events", "TextLog:text", np.array([[event.text] for event in chunk.events]))
        batch.add(f"{self.root}/events", "TextLog:level", np.array([[event.level] for event in chunk.events]))
        batch.send(self.stream)
