"""Course: a quantity over time as a few knots, as many that straight lines join, or as a recorded input."""

import numpy as np
from pydantic import ValidationInfo, field_validator, model_validator

from ars_mujoco.excitation.knots import KNOTS, Knots
from ars_mujoco.excitation.samples import MOST, SAMPLES, SamplesOf

FORMS = "knots or recorded"


class Course(Knots):
    """Knots or a recorded input; a subclass says of which quantity. More than KNOTS knots are joined: linear."""

    knots: tuple[tuple[float, float], ...] | None = None
    recorded: SamplesOf("1") | None = None

    @field_validator("knots")
    @classmethod
    def _make_a_signal(cls, knots, info: ValidationInfo):
        if knots is None or len(knots) <= KNOTS:
            return super()._make_a_signal(knots or (), info)
        if info.data.get("join") != "linear":
            raise ValueError(f"holds {len(knots)} knots; allowed: 1 to {KNOTS}, or {MOST} with join: linear")
        if len(knots) > MOST:
            raise ValueError(f"holds {len(knots)} knots; allowed: 1 to {MOST}")
        times = np.array(knots)[:, 0]
        if late := np.flatnonzero(np.diff(times) <= 0.0).tolist():
            raise ValueError(f"times of a signal must rise: {times[late[0] + 1]:g} s comes after {times[late[0]]:g} s")
        return knots

    @model_validator(mode="after")
    def _has_one_form(self):
        if (self.knots is None) == (self.recorded is None):
            raise ValueError(f"needs {FORMS}{', not both' * (self.knots is not None)}")
        return self

    @property
    def is_sampled(self) -> bool:
        """Whether it is a table of samples and no SIGNAL."""
        return self.knots is None or len(self.knots) > KNOTS

    def samples(self) -> np.record:
        """The SAMPLES record of a recorded input or of many knots, all zeros for a few."""
        record = np.zeros(1, SAMPLES).view(np.recarray)[0]
        if self.recorded:
            self.recorded.fill(record)
        elif self.is_sampled:
            times, values = np.transpose(self.knots)
            record.count, record.times[: len(times)], record.values[: len(times)] = len(times), times, values
        return record
