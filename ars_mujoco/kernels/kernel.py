"""Compiled kernels: plain Python functions over floats and records, native through numba.

`@kernel` compiles on first use; with NUMBA_DISABLE_JIT=1 the same source runs uncompiled, for debugging and coverage.
No fastmath: compiled and interpreted runs must agree to the last bits, and NaN must stay NaN. Only the entry points,
which hold all they call, are cached on disk (`entry`, `NativeCallback`), under a digest of their program.
"""

import os
import threading
from collections.abc import Callable
from functools import cached_property
from typing import Any, TypeVar, cast

import numba
from numba.core.ccallback import CFunc
from numba.core.sigutils import normalize_signature
from numba.extending import overload

from ars_mujoco.kernels.cache import EntryCache

interpreted = bool(numba.config.DISABLE_JIT)  # numba reads the environment once, at its import

# to a type checker a kernel is the function that it was made of
Function = TypeVar("Function", bound=Callable[..., Any])

JIT_OPTIONS = {"error_model": "numpy", "fastmath": False, "nogil": True}


def kernel(function: Function) -> Function:
    """Compile `function` to native code without fastmath; division by zero gives inf or NaN, not an exception."""
    return cast(Function, numba.njit(**JIT_OPTIONS)(function))


def inlined(function: Function) -> Function:
    """Like `kernel`, always put in place where it is called: for what a loop over substeps must see through."""
    return cast(Function, numba.njit(forceinline=True, **JIT_OPTIONS)(function))


def specialized(plain):
    """Declare how `plain`, a Python function whose compiled form depends on the types it gets, is written for them.

    The decorated function takes the types and returns the function to compile. Interpreted, `plain` itself runs.
    """

    def declare(writer):
        if not interpreted:
            overload(plain, jit_options=JIT_OPTIONS)(writer)
        return writer

    return declare


def entry(function):
    """Like `kernel`, for a function that Python or a user's controller calls: compiled on first use, cached on disk."""
    if interpreted:
        return function
    compiled = numba.njit(**JIT_OPTIONS)(function)
    compiled._cache = EntryCache(function, compiled)
    return compiled


class _Once:
    """A lock for what is made once a process, whichever thread asks first."""

    def __init__(self) -> None:
        self.renew()

    def renew(self) -> None:
        """Begin anew, as in a forked process, whose other threads are gone."""
        self.lock = threading.RLock()


once = _Once()
os.register_at_fork(after_in_child=once.renew)


class NativeCallback:
    """A C function of `signature`, compiled when its address is first asked for, and cached on disk if `cached`."""

    def __init__(self, signature, function, cached: bool = True):
        self.signature, self.function, self.cached = signature, function, cached

    @property
    def compiled(self) -> CFunc:
        """What numba makes of it; its `cache_hits` are 1 where it came from the disk."""
        with once.lock:  # a second one, made by another thread, would take the first one's code with it
            return self._compiled

    @cached_property
    def _compiled(self) -> CFunc:
        options = {"error_model": "numpy"}
        made = CFunc(self.function, normalize_signature(self.signature), locals={}, options=options)
        if self.cached:
            made._cache = EntryCache(self.function, self.function, options)
        made.compile()
        return made

    @property
    def address(self) -> int:
        return self.compiled.address
