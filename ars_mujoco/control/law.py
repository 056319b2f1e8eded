"""Law: a user's own controller, one Python function in a file, in place of the target map.

    def command(sensors, memory):
        return front_angle, rear_angle      # rad, commanded angles of the bars

A file that says `GIVES = "torque"` returns the bars' torques (Nm) instead; a system that follows the other gets it by
the torsion of the bar, M = c (phi - psi).
`sensors` has the fields of `control.sensors.Sensors`; `memory` holds 32 numbers that stay from sample to sample and
begin at zero. The function is called once a sample of the control unit. Where numba can compile it, it runs natively.
"""

import importlib.util
import warnings
from functools import cache
from pathlib import Path

import numba

from ars_mujoco.bridge.callback import SIGNATURE, world_address
from ars_mujoco.bridge.world import LAW_FAILED, stop
from ars_mujoco.control.control_unit import samples_now
from ars_mujoco.control.reference import ANGLE, TORQUE, put
from ars_mujoco.control.sensors import SENSORS
from ars_mujoco.kernels.kernel import JIT_OPTIONS, NativeCallback, entry, interpreted
from ars_mujoco.schema.errors import InputError

FUNCTION = "command"
GIVES = {"angle": ANGLE, "torque": TORQUE}
_ARGUMENTS = (numba.from_dtype(SENSORS), numba.types.Array(numba.float64, 1, "C"))


class Law:
    """A user's function, from the file `path`; `is_native` where numba compiles it."""

    def __init__(self, path: Path):
        self.path, (self.function, self.gives) = path, _load(path)
        self.failure = ""  # what it raised, where that is known
        self._callbacks: dict[object, NativeCallback] = {}
        self.is_native = not interpreted and self._compiles()

    def _compiles(self) -> bool:
        try:
            self._command = _two_floats(self.function)
        except Exception as error:  # numba's own, or what its insides run into
            reason = str(error).splitlines()[:2][-1]  # the first of several lines names the compiler's stage
            warnings.warn(
                f"{self.path}: {FUNCTION}() does not compile, so it runs in Python and every step takes several times"
                f" as long: {reason}",
                stacklevel=2,
            )
            return False
        return True

    def callback(self, rig) -> NativeCallback:
        """The callback of `rig` with this law in it; only the law is compiled, and once."""
        if rig not in self._callbacks:
            self._callbacks[rig] = _callback(rig, self._command)
        return self._callbacks[rig]

    def apply(self, world) -> None:
        """The same from Python."""
        reference, sensors = world.later.reference, world.scratch.sensors
        if samples_now(world.parameters.unit, sensors.time, world.header.step):
            try:
                front, rear = self.function(sensors, reference.memory)
                put(reference, self.gives, float(front), float(rear))
            except Exception as error:
                self.failure = f": {type(error).__name__}: {error}"
                stop(world, LAW_FAILED, sensors.time)


def _two_floats(function):
    """`function` compiled, with its bounds checked and its result made two floats; raises where numba cannot."""
    own = numba.njit(boundscheck=True, **JIT_OPTIONS)(function)

    def command(sensors, memory):
        front, rear = own(sensors, memory)
        return float(front), float(rear)

    compiled = entry(command)
    compiled.compile(_ARGUMENTS)
    return compiled


def _callback(rig, command) -> NativeCallback:
    """The callback of `rig` whose reference is `command`."""
    sense, act, world_at, size, version = rig.native_sense, rig.native_act, rig.world_at, rig.SIZE, rig.VERSION

    def control(model, data):
        address = world_address(model, data, size, version)
        if address == 0:
            return
        sense(model, data)
        world = world_at(address)
        reference, sensors = world.later.reference, world.scratch.sensors
        if samples_now(world.parameters.unit, sensors.time, world.header.step):
            try:
                front, rear = command(sensors, reference.memory)
                put(reference, world.parameters.reference.gives, front, rear)
            except Exception:  # all that compiled code can catch
                stop(world, LAW_FAILED, sensors.time)
        act(model, data)

    return NativeCallback(SIGNATURE, control)


def law(path: Path) -> Law:
    """The Law of a file, made once a process for each content. Raises InputError where the file holds none."""
    return _law(path, path.resolve(), path.read_bytes())


@cache
def _law(path: Path, _place: Path, _content: bytes) -> Law:
    return Law(path)


def _load(path: Path):
    spec = importlib.util.spec_from_file_location(f"law_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:  # whatever a user's file raises
        raise InputError(f"{path}: {type(error).__name__}: {error}") from None
    function, gives = getattr(module, FUNCTION, None), getattr(module, "GIVES", "angle")
    if not callable(function):
        raise InputError(f"{path}: has no function {FUNCTION}(sensors, memory)")
    if gives not in list(GIVES):  # whatever it is
        raise InputError(f"{path}: GIVES is {gives!r}; allowed: {', '.join(GIVES)}")
    return function, GIVES[gives]
