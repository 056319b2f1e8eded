"""MuJoCo's own warnings, withheld while a rig runs: what it would write to its log file, the world records as a status
and the loop raises.

The handler is one for the whole process, so that threads share it: the first puts it there, the last takes it away.
"""

import contextlib
import ctypes
import os
import threading

import mujoco

_SILENCE = ctypes.CFUNCTYPE(None, ctypes.c_char_p)(lambda _: None)


class _Handler:
    """How many blocks withhold warnings, and what handled them before."""

    def __init__(self):
        self.lock, self.blocks, self.before = threading.Lock(), 0, None

    def renew(self) -> None:
        """Begin anew in a forked process, which has one thread of those that were in blocks, if any."""
        self.lock = threading.Lock()

    def enter(self) -> None:
        with self.lock:
            if self.blocks == 0:
                self.before = mujoco.get_mju_user_warning()
                mujoco.set_mju_user_warning(_SILENCE)
            self.blocks += 1

    def leave(self) -> None:
        with self.lock:
            self.blocks = max(self.blocks - 1, 0)
            if self.blocks == 0:
                mujoco.set_mju_user_warning(self.before)


_handler = _Handler()
os.register_at_fork(after_in_child=_handler.renew)


@contextlib.contextmanager
def withheld():
    """Keep MuJoCo silent for the length of a `with` block."""
    _handler.enter()
    try:
        yield
    finally:
        _handler.leave()
