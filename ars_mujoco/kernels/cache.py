"""Cache: compiled entries on disk, a file each, named by the entry and the digest of its program.

A file holds what numba makes of a compiled function and begins with a checksum of it, so that nothing broken is handed
on; a file that is missing, broken or unreadable means a compilation, and no more. The files lie in the user's cache, or
where that cannot be written in a folder of the user's own for temporary files. A file that has not been used for 30
days is removed when another is written.
"""

import contextlib
import hashlib
import importlib
import io
import itertools
import os
import pickle
import re
import secrets
import stat
import tempfile
import time
import warnings
from functools import cache
from pathlib import Path

from numba.core.bytecode import FunctionIdentity
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.environment import Environment, lookup_environment
from numba.core.serialize import dumps

from ars_mujoco.kernels.program import digest

SUFFIX = ".entry"
DAY = 86400.0  # s
KEPT = 30.0 * DAY
_CHECKSUM = hashlib.sha256().digest_size


class EntryCache(NullCache):
    """What numba asks for the code of an entry before it compiles, and gives it afterwards.

    `program` is all that is compiled, the entry's function among it, as `program.digest` takes it.
    """

    def __init__(self, function, *program):
        name = f"{function.__module__}.{function.__qualname__}"
        self.name, self.program = re.sub(r"[^\w.]+", "_", name)[-100:], program
        self._files: dict = {}

    def load_overload(self, sig, target_context):
        """The code for these argument types, or None."""
        target_context.refresh()
        file = self._file(sig)
        for path in [folder / file for folder in folders()] if file else ():
            with contextlib.suppress(Exception):  # whatever a file of another hand runs into: it is compiled again
                result = CompileResult._rebuild(target_context, *_Unpickler(io.BytesIO(_read(path))).load())
                _touch(path)
                return result
        return None

    def save_overload(self, sig, result) -> None:
        """Keep the code for these argument types, where that can be done."""
        file = self._file(sig)
        if file is None:
            return
        if result.lifted or result.library.has_dynamic_globals:
            _warn(f"{self.name} is compiled at every start: it holds addresses of this process")
            return
        try:
            _write_anywhere(file, dumps(result._reduce()))
        except Exception as error:
            _warn(f"compiled code is not kept, so every start compiles it again: {error}")

    def _file(self, sig) -> str | None:
        """Name of the file for these argument types; None for a program that cannot be told from others."""
        if sig not in self._files:
            self._files[sig] = None
            try:
                self._files[sig] = f"{self.name}-{digest(sig, *self.program)}{SUFFIX}"
            except Exception as error:  # an UntoldError, or what a user's object does when it is looked at
                _warn(f"{self.name} is compiled at every start: {error}")
        return self._files[sig]


def folders(writing: bool = False):
    """Where files are looked for, and in which order it is tried to write them."""
    base = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))
    if base.is_absolute():
        yield base / "ars_mujoco"
    own, trusted = None, False
    with contextlib.suppress(OSError):
        own = Path(tempfile.gettempdir()) / f"ars_mujoco-{os.getuid()}"
        if writing:
            own.mkdir(mode=0o700, exist_ok=True)
        status = own.lstat()  # anyone may make folders there, and what is loaded is run
        trusted = stat.S_ISDIR(status.st_mode) and status.st_uid == os.getuid() and not status.st_mode & 0o022
    if trusted:
        yield own


def _read(path: Path) -> bytes:
    """The content of a file. Raises OSError or ValueError."""
    stored = path.read_bytes()
    checksum, content = stored[:_CHECKSUM], stored[_CHECKSUM:]
    if hashlib.sha256(content).digest() != checksum:
        raise ValueError(f"{path} is broken")
    return content


def _write_anywhere(file: str, content: bytes) -> None:
    """Put a file into the first folder that takes it. Raises the OSError of the first where none does."""
    failures = []
    for folder in folders(writing=True):
        try:
            return _write(folder / file, content)
        except OSError as error:
            failures.append(error)
    raise failures[0] if failures else OSError("there is no folder for it")


def _write(path: Path, content: bytes) -> None:
    """Put a file in its place at once, whoever else writes it, and remove those out of use. Raises OSError."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"{path.name}.{secrets.token_hex(8)}")
    try:
        part.write_bytes(hashlib.sha256(content).digest() + content)
        part.replace(path)
    except OSError:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
        raise
    for other in path.parent.glob(f"*{SUFFIX}*"):
        with contextlib.suppress(OSError):
            if other.stat().st_mtime < time.time() - KEPT:
                other.unlink()


def _touch(path: Path) -> None:
    """Note that a file is in use, to the day."""
    with contextlib.suppress(OSError):
        if path.stat().st_mtime < time.time() - DAY:
            os.utime(path)


@cache
def _warn(text: str) -> None:
    """Say something once a process."""
    warnings.warn(text, stacklevel=2)


class _Unpickler(pickle.Unpickler):
    """Reads what numba has pickled, but for functions of modules that cannot be imported by name: a user's own file."""

    def find_class(self, module: str, name: str):
        if (module, name) == ("numba.core.environment", "_rebuild_env"):
            return _environment
        return super().find_class(module, name)


def _environment(module: str, constants, name: str) -> Environment:
    """As numba's own, which wants to import the module."""
    found = lookup_environment(name)
    if found is None:
        scope = {}
        with contextlib.suppress(ImportError):
            scope = importlib.import_module(module).__dict__
        found = Environment(scope)
        found.consts[:] = constants
        found.env_name = name
        Environment._memo[name] = found
    return found


def _number_functions_apart() -> None:
    """Let numba number functions from a start of this process's own.

    The number is all that tells closures of one name apart in machine code, and numba starts at 1 in every process. So
    code from two processes, loaded into a third, could hold two closures under one symbol, and the second entry would
    silently run the first one's.
    """
    FunctionIdentity._unique_ids = itertools.count(secrets.randbits(48))


_number_functions_apart()
os.register_at_fork(after_in_child=_number_functions_apart)
