"""The errors a user can meet, each one line that says where, what and what is allowed."""

from ars_mujoco.schema.quotation import seen


class ArsError(Exception):
    """Base of every error this package raises on purpose; the command line prints it without a traceback."""


class InputError(ArsError):
    """A file, a key, a value or an option that cannot be used. `problems` lists every one found."""

    def __init__(self, *problems: str):
        self.problems = tuple("\n".join(map(seen, problem.split("\n"))) for problem in problems)
        super().__init__("\n".join(self.problems))


class SimulationError(ArsError):
    """A run that cannot go on: `time` (s), `channel` (its name) and `samples` (the last ones, by channel)."""

    def __init__(self, message: str, time: float, channel: str, samples: dict[str, list[float]] | None = None):
        self.time, self.channel, self.samples = time, channel, samples or {}
        super().__init__(message)
