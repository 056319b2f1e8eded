"""Conditions: moments of a run that are worth a line, as plain data that rigs and actuators declare."""

from dataclasses import dataclass

import numpy as np

from ars_mujoco.schema.suggestion import did_you_mean

RELATIONS = {"above": np.greater, "at_least": np.greater_equal, "at_most": np.less_equal, "below": np.less}
LEVELS = ("INFO", "WARN", "ERROR")


@dataclass(frozen=True)
class Condition:
    """A condition on one channel, and the `text` that tells when it begins to hold.

    The channel's value, or its absolute value where `of_size`, stands in `relation` (of RELATIONS) to `bound` (SI).
    """

    channel: str
    relation: str
    bound: float
    level: str  # of LEVELS
    text: str
    of_size: bool = False

    def __post_init__(self) -> None:
        for name, known in (("relation", RELATIONS), ("level", LEVELS)):
            if (value := getattr(self, name)) not in known:
                hint = did_you_mean(value, known)
                raise ValueError(f"{self.channel}: unknown {name} '{value}'{hint}; known: {', '.join(known)}")

    def holds(self, values: np.ndarray) -> np.ndarray:
        """Where the channel's `values` (n,) keep the condition, as booleans (n,)."""
        held: np.ndarray = RELATIONS[self.relation](np.abs(values) if self.of_size else values, self.bound)
        return held
