"""Law: a user's own controller, one Python function in a file, in place of the target map.

    def command(sensors, memory):
        return front_angle, rear_angle      # rad, commanded angles of the bars

A file that says `GIVES = "torque"` returns the bars' torques (Nm) instead; a system that follows the other gets it by
the torsion of the bar, M = c (phi - psi).
`sensors` has the fields of `control.sensors.Sensors`; `memory` holds 32 numbers that stay from sample to sample and
begin at zero. The function is called once a sample of the control unit. Where numba can compile it, it runs natively.
What it keeps besides, as an object that is called or a module's variables, belongs to one run: the file is loaded
afresh for each, those that set the car up among them. Only what `memory` holds is restored with a state.
"""

import random
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numba
import numpy as np
from numba import carray

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.mjdata import SIGNATURE, doubles, record_at, word
from ars_mujoco.bridge.world import LAW_ASTRAY, LAW_FAILED, place, stop_in
from ars_mujoco.control.law_fault import compilers_reason, prints, takes_two
from ars_mujoco.control.law_module import SEED, loaded
from ars_mujoco.control.law_run import MOST, LawRun
from ars_mujoco.control.reference import ANGLE, STATE, TORQUE, put
from ars_mujoco.control.sensors import SENSORS
from ars_mujoco.kernels.kernel import JIT_OPTIONS, NativeCallback, entry, interpreted, kernel
from ars_mujoco.kernels.program import UntoldError, digest
from ars_mujoco.schema.errors import InputError

FUNCTION = "command"
GIVES = {"angle": ANGLE, "torque": TORQUE}
_USERDATA = mujoco_layout.offsets("mjData")["userdata"]
_NO_BOUND = 1 << 30  # of an array in mjData; a world is as long as its rig says
_SENSORS, _REFERENCE = record_at(SENSORS), record_at(STATE)
_ARGUMENTS = (numba.from_dtype(SENSORS), numba.types.Array(numba.float64, 1, "C"))


class Law:
    """A user's function, from the file `path` as it is now or from its `content`; `is_native` where numba compiles it.

    Raises InputError where the file holds none.
    """

    def __init__(self, path: Path, content: bytes | None = None):
        self.path, self.content = path, path.read_bytes() if content is None else content
        with self._module() as (self._function, self.gives):
            self._compiled = None if interpreted else _compiled(self.path, self.content, self._function)

    def __reduce__(self):
        return Law, (self.path, self.content)

    @property
    def is_native(self) -> bool:
        """Whether numba compiles it; what it keeps of its own is then constant."""
        return self._compiled is not None

    @contextmanager
    def running(self) -> Iterator[LawRun]:
        """The law for the length of a run."""
        if self.is_native:
            _seed(SEED)
            yield LawRun(self, self._function)
        else:
            with self._module() as (function, _):
                yield LawRun(self, function)

    def sampling(self, rig) -> NativeCallback:
        """The C function of a compiled law that takes a sample of `rig`, made once a process."""
        return self._compiled.sampling(rig, self.gives)

    @contextmanager
    def _module(self):
        """The function of the file, loaded afresh, and what it gives."""
        with loaded(self.path, self.content) as module:
            yield _function_of(module, self.path)


def _function_of(module, path: Path):
    """(function, what it gives) of a law's module."""
    function, gives = getattr(module, FUNCTION, None), getattr(module, "GIVES", "angle")
    if not callable(function):
        raise InputError(f"{path}: has no function {FUNCTION}(sensors, memory)")
    if not takes_two(function):
        raise InputError(f"{path}: {FUNCTION}() cannot be called as {FUNCTION}(sensors, memory)")
    if gives not in list(GIVES):  # whatever it is
        raise InputError(f"{path}: GIVES is {gives!r}; allowed: {', '.join(GIVES)}")
    return function, GIVES[gives]


class _Compiled:
    """A compiled law, and the C functions of the rigs that it was asked for."""

    def __init__(self, command):
        self._command = command
        self._made: dict[object, NativeCallback] = {}

    def sampling(self, rig, gives: int) -> NativeCallback:
        made = self._made.get((rig, gives)) or _sampling(rig, gives, self._command)
        return self._made.setdefault((rig, gives), made)  # the one of another thread, where that was quicker


_by_program: dict[str, _Compiled] = {}  # of this process, by the digest of the function
_not_compiled: dict[tuple[Path, bytes], str] = {}  # why not


def _compiled(path: Path, content: bytes, function) -> _Compiled | None:
    """`function` compiled, made once a process for each program; None where it runs in Python."""
    try:
        program = digest(function)
    except UntoldError:
        program = None
    if program in _by_program:
        return _by_program[program]
    if (path, content) not in _not_compiled:
        try:
            if prints(function):
                raise TypeError("it prints")
            made = _Compiled(_two_floats(function, is_cached=program is not None))
        except Exception as error:  # numba's own, or what its insides run into
            _not_compiled[path, content] = reason = compilers_reason(error, function, path)
            warnings.warn(f"{path}: {FUNCTION}() does not compile, so it runs in Python: {reason}", stacklevel=2)
        else:
            if program:
                _by_program[program] = made
            return made
    return None


def _two_floats(function, is_cached: bool = True):
    """`function` compiled, with its bounds checked and its result made two floats; raises where numba cannot."""
    own = numba.njit(boundscheck=True, **JIT_OPTIONS)(function)

    def command(sensors, memory):
        front, rear = own(sensors, memory)
        return float(1.0 * front), float(1.0 * rear)  # of a text, float() would make a number

    compiled = entry(command) if is_cached else kernel(command)
    compiled.compile(_ARGUMENTS)
    return compiled


def _sampling(rig, gives: int, command) -> NativeCallback:
    """A C function void(mjModel*, mjData*) that takes a sample of `rig` by `command`; nothing of the rig is in it."""
    sensors_at, kept_at = (8 * place(rig.WORLD, *names) for names in (("scratch", "sensors"), ("later", "reference")))
    most = MOST[gives]

    def sample(model, data):
        world = word(data + _USERDATA)
        userdata, sensors = carray(doubles(world), (_NO_BOUND,)), _SENSORS(world + sensors_at)
        kept = _REFERENCE(world + kept_at)
        try:
            front, rear = command(sensors, kept.memory)
            put(kept, gives, front, rear)
            if not (abs(front) <= most and abs(rear) <= most):  # NaN is not
                stop_in(userdata, LAW_ASTRAY, sensors.time)
        except Exception:  # all that compiled code can catch; the same in Python tells the reason
            stop_in(userdata, LAW_FAILED, sensors.time)

    return NativeCallback(SIGNATURE, sample)


@entry
def _seed(seed):
    # numba's random numbers, which are this thread's
    random.seed(seed)
    np.random.seed(seed)
