"""A law in one run: what it keeps of its own there, its calls from Python, and what went wrong in them."""

import ctypes
import warnings
from collections.abc import Callable
from math import isfinite
from typing import Any

import numpy as np

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.mujoco_functions import C_FUNCTION
from ars_mujoco.bridge.world import LAW_ASTRAY, LAW_FAILED, place, stop_in
from ars_mujoco.control.control_unit import samples_now
from ars_mujoco.control.law_fault import no_pair, told
from ars_mujoco.control.reference import ANGLE, TORQUE
from ars_mujoco.control.sensors import MEMORY, SENSORS, Readings

_USERDATA = mujoco_layout.offsets("mjData")["userdata"]
KEPT = {ANGLE: ("front", "rear"), TORQUE: ("front_torque", "rear_torque")}  # where the reference keeps what a law gives
MOST = {ANGLE: 100.0, TORQUE: 1e6}  # rad, Nm; no bar turns or pushes so far, and the actuator's limit would hide it
MAYBE_DEGREES = "what it returns is in rad: does it give degrees?"
RADIAN = 1.0  # rad; no bar's angle, but what an angle in degrees soon is


class LawRun:
    """A law while a run lasts; `function` is the run's own, with whatever it keeps."""

    def __init__(self, law, function):
        self.law, self.function = law, function
        self.fault = ""  # what it raised
        self.interruption: BaseException | None = None  # of the user, in the middle of it
        self._held: list[Any] = []  # what C code calls must live

    def sampling(self, rig) -> int:
        """Address of a C function void(mjModel*, mjData*) that takes a sample, for as long as this object lives."""
        if self.law.is_native:
            return self.law.sampling(rig).address
        samples: dict[int, Callable[[], None]] = {}

        def take(_, data) -> None:
            address = ctypes.c_uint64.from_address(data + _USERDATA).value
            if address not in samples:
                room = (ctypes.c_double * rig.SIZE).from_address(address)
                samples[address] = self._sampling(rig, np.ctypeslib.as_array(room))
            samples[address]()

        self._held.append(C_FUNCTION(take))
        return ctypes.cast(self._held[-1], ctypes.c_void_p).value or 0

    def sample_if_due(self, rig, userdata: np.ndarray) -> None:
        """Take a sample in `userdata` in the interpreted twin, where the control unit takes one in this step."""
        world = userdata.view(rig.WORLD).view(np.recarray)[0]
        if samples_now(world.parameters.unit, world.header.time, world.header.step):
            self._sampling(rig, userdata)()

    def _sampling(self, rig, userdata: np.ndarray) -> Callable[[], None]:
        first = place(rig.WORLD, "scratch", "sensors")
        at, (front, rear) = place(rig.WORLD, "later", "reference", "memory"), self.slots(rig)
        most = MOST[self.law.gives]
        sensors, memory = userdata[first : first + len(SENSORS)], userdata[at : at + MEMORY]

        def sample() -> None:
            readings = Readings._make(sensors.tolist())
            status = LAW_FAILED
            try:
                asked = self._asked(readings, memory)
                if asked:
                    userdata[front], userdata[rear] = asked
                    if abs(asked[0]) <= most and abs(asked[1]) <= most:  # NaN is not
                        return
                    status = LAW_ASTRAY
            except BaseException as error:  # whatever a user's code raises; C code cannot hand it on
                self.fault = told(error, self.law.path)
                if isinstance(error, KeyboardInterrupt):
                    self.interruption = error
            stop_in(userdata, status, readings.time)

        return sample

    def _asked(self, readings, memory) -> tuple[float, float] | None:
        result = self.function(readings, memory)
        try:
            front, rear = result
            isfinite(front), isfinite(rear)
            return float(front), float(rear)
        except (TypeError, ValueError):
            self.fault = no_pair(result)
            return None

    def slots(self, rig) -> list[int]:
        """Where userdata holds what the law gave last, front and rear."""
        return [place(rig.WORLD, "later", "reference", name) for name in KEPT[self.law.gives]]

    def remark(self, asked: np.ndarray) -> None:
        """Warn where angles `asked` (n, 2) look like degrees."""
        size = np.abs(asked)
        if self.law.gives == ANGLE and ((size > RADIAN) & (size <= MOST[ANGLE])).any():
            warnings.warn(
                f"{self.law.path}: the controller asks for bar angles over {np.degrees(RADIAN):.0f} deg; "
                f"{MAYBE_DEGREES}",
                stacklevel=2,
            )

    def explained(self, world) -> str:
        """What went wrong, from the world it went wrong in; of compiled code, what the same does in Python."""
        reference, header, gives = world.later.reference, world.header, self.law.gives
        if header.status == LAW_ASTRAY:
            asked = zip(("front", "rear"), (float(reference[name]) for name in KEPT[gives]), strict=True)
            quantity, unit = ("angle", "rad") if gives == ANGLE else ("torque", "Nm")
            wrong = [
                f"{value:g} for the {bar} bar's {quantity}" for bar, value in asked if not abs(value) <= MOST[gives]
            ]
            returned = f"{self.law.path}: the controller returned {' and '.join(wrong)} at {header.status_time:g} s"
            return f"{returned}; allowed: up to {MOST[gives]:g} {unit}"
        fault = self.fault or self._fault_in_python(world)
        return f"{self.law.path}: the controller failed at {header.status_time:g} s: {fault}"

    def _fault_in_python(self, world) -> str:
        readings = Readings(*world.scratch.sensors.tolist())
        try:
            self._asked(readings, np.array(world.now.reference.memory))
        except Exception as error:
            return told(error, self.law.path)
        return self.fault or "compiled code raised what the same code in Python does not"
