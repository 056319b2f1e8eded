"""Compiled kernels: plain Python functions over floats and records, native through numba.

`@kernel` compiles on first use; with NUMBA_DISABLE_JIT=1 the same source runs uncompiled, for debugging and coverage.
No fastmath: compiled and interpreted runs must agree to the last bits, and NaN must stay NaN. Only the entry points,
which hold all they call, are cached on disk (`entry`), in a folder whose name is a hash of everything that could make
the code stale: every source of this package, the versions of numba and MuJoCo, the Python version and the processor.
"""

import contextlib
import hashlib
import os
import sys
import tempfile
from functools import cache, cached_property
from importlib.metadata import version
from pathlib import Path

import llvmlite.binding
import numba
from numba.extending import overload

interpreted = bool(numba.config.DISABLE_JIT)  # numba reads the environment once, at its import

JIT_OPTIONS = {"error_model": "numpy", "fastmath": False, "nogil": True}


def kernel(function):
    """Compile `function` to native code without fastmath; division by zero gives inf or NaN, not an exception."""
    return numba.njit(**JIT_OPTIONS)(function)


def inlined(function):
    """Like `kernel`, always put in place where it is called: for what a loop over substeps must see through."""
    return numba.njit(forceinline=True, **JIT_OPTIONS)(function)


def specialized(plain):
    """Declare how `plain`, a Python function whose compiled form depends on the types it gets, is written for them.

    The decorated function takes the types and returns the function to compile. Interpreted, `plain` itself runs.
    """

    def declare(writer):
        plain.writer = writer  # a part of every program that reaches `plain`
        if not interpreted:
            overload(plain, jit_options=JIT_OPTIONS)(writer)
        return writer

    return declare


def entry(function):
    """Like `kernel`, for a function that Python or a user's controller calls: compiled on first use, cached on disk."""
    if interpreted:
        return function
    with cache_folder():
        return numba.njit(cache=True, **JIT_OPTIONS)(function)


class NativeCallback:
    """A C function of `signature`, compiled when its address is first asked for, and cached on disk if `cached`."""

    def __init__(self, signature, function, cached: bool = True):
        self.signature, self.function, self.cached = signature, function, cached

    @cached_property
    def address(self) -> int:
        with cache_folder():
            self.compiled = numba.cfunc(self.signature, cache=self.cached, error_model="numpy")(self.function)
        return self.compiled.address


@contextlib.contextmanager
def cache_folder():
    """Let numba cache what is decorated in a `with` block in this package's own folder."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(cache_path())
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


@cache
def cache_path() -> Path:
    """Folder of the compiled code of exactly these sources on exactly this machine."""
    digest = hashlib.sha256()
    package = Path(__file__).parents[1]
    for source in sorted(package.rglob("*.py")):
        digest.update(source.relative_to(package).as_posix().encode() + b"\0" + source.read_bytes() + b"\0")
    machine = (sys.version, numba.__version__, version("mujoco-core"), llvmlite.binding.get_host_cpu_name())
    digest.update(repr((*machine, llvmlite.binding.get_host_cpu_features().flatten())).encode())
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "ars_mujoco"
    folder = base / digest.hexdigest()[:20]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:  # no writable home: compile once a boot rather than not at all
        folder = Path(tempfile.gettempdir()) / f"ars_mujoco-{os.getuid()}" / folder.name
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    return folder
