"""Compiled entries across processes: what one has compiled another loads, with every numba that is allowed.

The environment variable ARS_OLDEST_NUMBA may name the Python of an environment with the oldest numba, which then has to
do the same as the one that runs the tests.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

import pytest

import ars_mujoco
from ars_mujoco.kernels.kernel import interpreted

pytestmark = pytest.mark.skipif(interpreted, reason="nothing is compiled with NUMBA_DISABLE_JIT=1")

ROOT = Path(ars_mujoco.__file__).parents[1]
OLDEST = os.environ.get("ARS_OLDEST_NUMBA")
INTERPRETERS = [
    pytest.param(sys.executable, id="this numba"),
    pytest.param(OLDEST, id="oldest numba", marks=pytest.mark.skipif(not OLDEST, reason="ARS_OLDEST_NUMBA is not set")),
]


class Elsewhere:
    """Modules of one's own, and processes that run them with a cache of their own."""

    def __init__(self, place: Path):
        self.place, self.folder = place / "own", place / "cache" / "ars_mujoco"
        self.temporary = place / "temporary"
        self.place.mkdir()
        self.temporary.mkdir()
        self.environment = os.environ | {
            "PYTHONPATH": str(ROOT),
            "PYTHONDONTWRITEBYTECODE": "1",
            "XDG_CACHE_HOME": str(place / "cache"),
            "TMPDIR": str(self.temporary),
        }

    def write(self, **modules: str) -> None:
        for name, text in modules.items():
            (self.place / f"{name}.py").write_text(dedent(text))

    def start(self, *command: str, **environment: str) -> subprocess.Popen:
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        return subprocess.Popen(command, env=self.environment | environment, cwd=self.place, **pipes)

    def run(self, *before: str) -> tuple[float, int]:
        """(result, whether it came from the disk); nothing but that is said."""
        return ended(self.start(*before, sys.executable, "run.py"))

    def file(self) -> Path:
        (file,) = self.folder.iterdir()
        return file


def ended(process: subprocess.Popen) -> tuple[float, ...]:
    output, errors = process.communicate(timeout=300)
    assert not errors and process.returncode == 0, errors
    return tuple(float(word) for word in output.split())


@pytest.fixture
def elsewhere(tmp_path) -> Elsewhere:
    made = Elsewhere(tmp_path)
    made.write(run=RUN, own=OWN)
    return made


RUN = """
    import own
    print(own.made(2.0), sum(own.made.stats.cache_hits.values()))
"""
OWN = """
    from ars_mujoco.kernels.kernel import entry, kernel

    GAIN = 3.0

    @kernel
    def inner(x):
        return GAIN * x

    @entry
    def made(x):
        return inner(x) + 1.0
"""


def test_a_second_process_loads_whatever_was_edited_but_the_program(elsewhere):
    assert elsewhere.run() == (7.0, 0)
    assert elsewhere.run() == (7.0, 1)
    commented = OWN.replace("return GAIN", "# a comment\n        return GAIN")
    elsewhere.write(own=f'    """Moved."""\n{commented}\n    OTHER = 1\n')
    assert elsewhere.run() == (7.0, 1)
    os.utime(elsewhere.place / "own.py", (0, 0))
    assert elsewhere.run() == (7.0, 1)


def test_an_edit_of_the_program_is_never_answered_with_the_old_one(elsewhere):
    """Neither one of a callee nor one of a number, nor where size and time of the file stay as they were."""
    assert elsewhere.run() == (7.0, 0)
    before = (elsewhere.place / "own.py").stat()
    elsewhere.write(own=OWN.replace("3.0", "4.0"))
    os.utime(elsewhere.place / "own.py", ns=(before.st_atime_ns, before.st_mtime_ns))
    assert elsewhere.run() == (9.0, 0)
    elsewhere.write(own=OWN.replace("GAIN * x", "GAIN - x"))
    assert elsewhere.run() == (2.0, 0)
    elsewhere.write(own=OWN)
    assert elsewhere.run() == (7.0, 1)


def test_processes_that_write_at_once_do_not_hurt_each_other(elsewhere):
    together = [elsewhere.start(sys.executable, "run.py") for _ in range(3)]
    assert [ended(process)[0] for process in together] == [7.0] * 3
    assert elsewhere.file().suffix == ".entry"
    assert elsewhere.run() == (7.0, 1)


def test_a_process_killed_while_it_writes_leaves_nothing_in_the_way(elsewhere):
    assert elsewhere.run() == (7.0, 0)
    whole = elsewhere.file()
    whole.rename(whole.with_name(f"{whole.name}.0123456789abcdef"))
    assert elsewhere.run() == (7.0, 0)
    assert elsewhere.run() == (7.0, 1)


@pytest.mark.skipif(os.getuid() != 0 or not shutil.which("setpriv"), reason="takes root to become another user")
@pytest.mark.parametrize("broken", [False, True])
def test_another_user_loads_what_root_has_compiled_or_keeps_his_own_where_that_is_broken(elsewhere, tmp_path, broken):
    """He has no home, and can write neither the cache nor the place he is in."""
    elsewhere.run()
    if broken:
        elsewhere.file().write_bytes(b"")
    for folder in (*tmp_path.parents[:2], tmp_path, *tmp_path.glob("**/")):
        folder.chmod(0o755)
    elsewhere.temporary.chmod(0o777)
    elsewhere.environment["HOME"] = "/nonexistent"
    other = ["setpriv", "--reuid=12345", "--regid=12345", "--clear-groups"]
    other += ["--inh-caps=+dac_read_search", "--ambient-caps=+dac_read_search"]  # may be what it takes to get at Python
    assert elsewhere.run(*other) == (7.0, 0 if broken else 1)
    assert elsewhere.run(*other) == (7.0, 1)
    assert bool(list(elsewhere.temporary.iterdir())) == broken


def test_a_function_of_a_module_that_cannot_be_imported_by_name_is_loaded_too(elsewhere):
    """As a user's law or system, read from a file; it raises an exception, for which numba keeps a reference to it."""
    raising = OWN.replace(
        "return inner(x)", "if x < 0.0:\n            raise ValueError('negative')\n        return inner(x)"
    )
    run = """
        import importlib.util
        spec = importlib.util.spec_from_file_location("of a file", "law.py")
        own = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(own)
        try:
            own.made(-2.0)
        except ValueError as error:
            print(len(str(error)))
        print(own.made(2.0), sum(own.made.stats.cache_hits.values()))
    """
    elsewhere.write(law=raising, run=run)
    assert elsewhere.run() == (8.0, 7.0, 0.0)
    assert elsewhere.run() == (8.0, 7.0, 1.0)


# ---- what rests on numba's inside: held against it, and against Python

FAMILY = """
    import math
    from ars_mujoco.kernels.kernel import kernel

    def integrated(rates):
        @kernel
        def stepped(x, h):  # too long to be inlined
            total = 0.0
            for i in range(int(x) + 5):
                total += h * rates(x + math.sin(x * i))
                if total > 1e6:
                    for j in range(10):
                        total -= math.cos(total + j) * math.exp(-total * j)
            return total
        return stepped
"""
SYSTEM = """
    from ars_mujoco.kernels.kernel import kernel
    from family import integrated

    @kernel
    def rates(x):
        return GAIN - x

    advance = integrated(rates)
"""
RIG = """
    import ctypes, sys
    from importlib import import_module
    from types import FunctionType
    import numba
    import numpy as np
    from ars_mujoco.bridge.mjdata import record_at
    from ars_mujoco.kernels.kernel import NativeCallback, interpreted, kernel

    WORLD = np.dtype([("step", "f8"), ("now", np.dtype([("x", "f8"), ("y", "f8")]))])

    @kernel
    def act(world, system):
        x, step = world.now.x, world.step
        world.now.x = system.advance(x, step) + system.advance(x + 1.0, step) * system.advance(x + 2.0, step)

    def _native(model, data):
        KERNEL(WORLD_AT(data), SYSTEM)

    def composed(system):
        own = {"KERNEL": act, "WORLD_AT": record_at(WORLD), "SYSTEM": system}
        made = FunctionType(_native.__code__, {**_native.__globals__, **own}, system.__name__)
        made.__qualname__ = system.__name__
        return NativeCallback(numba.void(numba.types.intp, numba.types.intp), made)

    for name in sys.argv[1:]:
        system, world = import_module(name), np.zeros(1, WORLD).view(np.recarray)
        world[0].step, world[0].now.x = 0.1, 3.0
        if interpreted:
            act(world[0], system)
        else:
            callback = composed(system)
            ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(callback.address)(0, world.ctypes.data)
            print(callback.compiled.cache_hits)
        print(repr(float(world[0].now.x)))
"""


@pytest.mark.parametrize("python", INTERPRETERS)
def test_systems_are_modules_and_entries_copies_and_each_keeps_its_own_code(elsewhere, python):
    """Compiled by a process each, loaded by a third: numba names the closures of both alike, and must not mix them."""
    elsewhere.write(family=FAMILY, rig=RIG, one=SYSTEM.replace("GAIN", "2.0"), two=SYSTEM.replace("GAIN", "9.0"))

    def run(*systems: str, **environment: str) -> tuple[float, ...]:
        return ended(elsewhere.start(python, "rig.py", *systems, **environment))

    one, two = run("one", "two", NUMBA_DISABLE_JIT="1")
    assert one != two
    assert run("one") == (0.0, pytest.approx(one, rel=1e-14))
    assert run("two") == (0.0, pytest.approx(two, rel=1e-14))
    assert run("one", "two") == (1.0, pytest.approx(one, rel=1e-14), 1.0, pytest.approx(two, rel=1e-14))
    assert run("two", "one") == (1.0, pytest.approx(two, rel=1e-14), 1.0, pytest.approx(one, rel=1e-14))


@pytest.mark.parametrize("python", INTERPRETERS)
def test_every_process_numbers_its_functions_apart_a_forked_one_too(elsewhere, python):
    numbering = """
        import os
        from numba.core.bytecode import FunctionIdentity
        from ars_mujoco.kernels import kernel
        if os.fork():
            os.wait()
        print(FunctionIdentity.from_function(lambda: 0).unique_id, flush=True)
    """
    elsewhere.write(number=numbering)
    numbers = [number for _ in range(2) for number in ended(elsewhere.start(python, "number.py"))]
    assert len({int(number // 1e6) for number in numbers}) == 4
