"""Records for kernels under test."""

import numpy as np

from ars_mujoco.schema.parameters import Parameters, fill, record_dtype


def blank(model: type[Parameters]) -> np.record:
    """A record of `model`, all zeros."""
    return np.zeros(1, record_dtype(model)).view(np.recarray)[0]


def filled(parameters: Parameters) -> np.record:
    """A record that holds `parameters`."""
    record = blank(type(parameters))
    fill(record, parameters)
    return record
