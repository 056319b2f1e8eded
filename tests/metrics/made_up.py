"""Made-up recordings: signals that are formulas of time."""

import numpy as np

from ars_mujoco.metrics.metric import Run, measure
from ars_mujoco.recording.recording import Recording
from ars_mujoco.schema.channels import Channel

WINDOW = (1.0, 9.0)
TIME = np.linspace(0, 10, 10001)


def recording(time=TIME, roles=(), **signals) -> Recording:
    """A recording of the signals, their dots written as two underscores; `roles` are those of energies, by name."""
    signals = {name.replace("__", "."): np.broadcast_to(values, time.shape) for name, values in signals.items()}
    channels = {name: Channel(name, "", "", dict(roles).get(name)) for name in signals}
    return Recording("made up", channels, time=time, values=np.column_stack(list(signals.values())))


def values(run: Recording, **more) -> dict:
    return measure(Run(run, **{"window": WINDOW, **more}))
