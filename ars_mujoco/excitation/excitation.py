"""Excitation: what drives the bench, as knots, a sine, a sweep or a recorded input."""

from functools import cache, partial

import numpy as np
from pydantic import model_validator

from ars_mujoco.excitation import knots as signal
from ars_mujoco.excitation.knots import SIGNAL, Knots, KnotsOf
from ars_mujoco.excitation.oscillation import OSCILLATION, SineOf, SweepOf, oscillating
from ars_mujoco.excitation.samples import SAMPLES, SamplesOf, sampled
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import derived

JOINED, OSCILLATING, SAMPLED = range(3)
FORMS = ("knots", "sine", "sweep", "recorded")

# kind is a whole number held as a float; the records of the other kinds stay zero; samples are a table beside it
EXCITATION = np.dtype([("kind", "f8"), ("knots", SIGNAL), ("oscillation", OSCILLATION)])


class Excitation(Knots):
    """One of the forms; a step is two knots with `join: step`."""

    knots: tuple[tuple[float, float], ...] | None = None
    sine: SineOf("1") | None = None
    sweep: SweepOf("1") | None = None
    recorded: SamplesOf("1") | None = None  # a CSV file of times and values, units in its header

    @model_validator(mode="after")
    def _has_one_form(self):
        forms = [form for form in FORMS if getattr(self, form) is not None]
        if len(forms) != 1:
            raise ValueError(f"needs one of {', '.join(FORMS)}{', not ' * bool(forms)}{' and '.join(forms)}")
        if "join" in self.model_fields_set and self.knots is None:
            raise ValueError(f"join is for knots; a {forms[0]} has none")
        return self

    def record(self) -> np.record:
        """The EXCITATION record, in s and SI."""
        record = np.zeros(1, EXCITATION).view(np.recarray)[0]
        if self.knots:
            record.kind, record.knots = JOINED, self.signal()
        elif self.recorded:
            record.kind = SAMPLED
        else:
            record.kind, record.oscillation = OSCILLATING, (self.sine or self.sweep).oscillation()
        return record

    def samples(self) -> np.record:
        """The SAMPLES record of a recorded input, all zeros for another form."""
        record = np.zeros(1, SAMPLES).view(np.recarray)[0]
        if self.recorded:
            self.recorded.fill(record)
        return record

    def peak(self) -> float:
        """The largest magnitude that it can reach."""
        record = self.record()
        knots, wave = np.abs(record.knots["values"]).max(), record.oscillation
        return max(knots, abs(wave.offset) + abs(wave.amplitude), np.abs(self.samples()["values"]).max())


@cache
def ExcitationOf(unit: str) -> type[Excitation]:  # noqa: N802 (reads as a type)
    """An Excitation whose values carry a unit of the dimension of `unit`."""
    return derived(
        Excitation,
        f"ExcitationOf({unit})",
        partial(ExcitationOf, unit),
        knots=(KnotsOf(unit).model_fields["knots"].annotation | None, None),
        sine=(SineOf(unit) | None, None),
        sweep=(SweepOf(unit) | None, None),
        recorded=(SamplesOf(unit) | None, None),
    )


@kernel
def value(p, samples, t: float) -> float:
    """Value at `t` (s) of an EXCITATION, with its SAMPLES beside it."""
    if p.kind == OSCILLATING:
        return oscillating(p.oscillation, t)
    if p.kind == SAMPLED:
        return sampled(samples, t)
    return signal.value(p.knots, t)
