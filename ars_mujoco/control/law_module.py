"""A law's file as a Python module: loaded afresh for every run, with the modules beside it, and random numbers that
begin alike.

While the run lasts the module is in `sys.modules` and its folder in `sys.path`, and one run at a time has these: a law
in Python holds the interpreter's lock anyhow. Nothing is written beside the file.
"""

import importlib
import os
import random
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

import numpy as np

from ars_mujoco.control.law_fault import told
from ars_mujoco.schema.errors import InputError

SEED = 0
_INSTALLED = {"site-packages", "dist-packages"}
_one_at_a_time = threading.RLock()


@contextmanager
def loaded(path: Path, content: bytes) -> Iterator[ModuleType]:
    """The module that `content`, of the file `path`, makes, for the length of a `with` block.

    Raises InputError where it cannot be run.
    """
    folder, name = path.resolve().parent, f"law_{path.stem}"
    module = ModuleType(name)
    module.__file__ = str(path)
    with _one_at_a_time, _random_numbers():
        theirs = {each: sys.modules.pop(each) for each in _beside(folder)}
        sys.path.insert(0, str(folder))
        importlib.invalidate_caches()  # a module beside it may have been written just now
        writes_not, sys.dont_write_bytecode = sys.dont_write_bytecode, True
        sys.modules[name] = module  # where dataclasses look for what the file defines
        try:
            _run(module, content, path)
            sys.modules.update(theirs)
            yield module
        finally:
            sys.dont_write_bytecode = writes_not
            for each in _beside(folder) - theirs.keys() | {name}:
                sys.modules.pop(each, None)
            sys.modules.update(theirs)
            if str(folder) in sys.path:
                sys.path.remove(str(folder))


def _run(module: ModuleType, content: bytes, path: Path) -> None:
    try:
        exec(compile(content, str(path), "exec", dont_inherit=True), module.__dict__)
    except (Exception, SystemExit) as error:  # whatever a user's file raises
        raise InputError(f"{path}: {told(error, path)}") from None


def _beside(folder: Path) -> set[str]:
    """Names of the loaded modules that lie in `folder`, but for this package's, the program's and installed ones."""
    found = set()
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if not file or name.partition(".")[0] in ("ars_mujoco", "__main__", "__mp_main__"):
            continue
        if not _INSTALLED & set(Path(file).parts) and folder in Path(os.path.abspath(file)).parents:
            found.add(name)
    return found


@contextmanager
def _random_numbers() -> Iterator[None]:
    """Python's and numpy's random numbers from SEED on, and afterwards from where they were."""
    state, numpy_state = random.getstate(), np.random.get_state()
    random.seed(SEED)
    np.random.seed(SEED)
    try:
        yield
    finally:
        random.setstate(state)
        np.random.set_state(numpy_state)


def _release_in_child() -> None:
    """A process that is forked in the middle of a run has no thread that would end it."""
    global _one_at_a_time
    _one_at_a_time = threading.RLock()


os.register_at_fork(after_in_child=_release_in_child)
