"""The digest of a program: it changes with all that the machine code is made of, and with nothing else."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from textwrap import dedent
from types import FunctionType, ModuleType

import numba
import numpy as np
import pytest

from ars_mujoco.actuators.pump_controlled import full_stage
from ars_mujoco.bridge import native_loop
from ars_mujoco.bridge.mjdata import record_at
from ars_mujoco.kernels import program
from ars_mujoco.kernels.kernel import interpreted, kernel
from ars_mujoco.kernels.program import UntoldError, digest
from ars_mujoco.rigs.rig import rig

pytestmark = pytest.mark.skipif(interpreted, reason="nothing is compiled with NUMBA_DISABLE_JIT=1")

PACKAGE = Path(program.__file__).parents[1]
HEAD = """
import math
import enum
from collections import namedtuple
import numpy as np
from numba import types
from numba.extending import intrinsic, overload
from ars_mujoco.kernels.kernel import kernel, inlined
"""


def module(source: str, name: str = "own") -> ModuleType:
    made = ModuleType(name)
    exec(HEAD + dedent(source), made.__dict__)
    return made


def told(source: str, root: str = "entry") -> str:
    """Digest of the function `root` of a module with this text."""
    return digest(getattr(module(source), root))


BASE = """
    SCALE, UNUSED = 2.0, 1.0

    @kernel
    def inner(x):
        return SCALE * math.sin(x)

    def unreached(x):
        return x + 1.0

    @kernel
    def entry(x, gain=1.0):
        y = inner(x)
        return gain * y
"""


@pytest.mark.parametrize(
    "old, new",
    [
        ("return SCALE * math.sin(x)", "return SCALE * math.sin(x)  # a comment"),
        ("def inner(x):", 'def inner(x):\n        """A docstring."""'),
        ("    @kernel\n    def inner", "\n\n\n    # lines before it\n    @kernel\n    def inner"),
        ("UNUSED = 2.0, 1.0", "UNUSED = 2.0, 5.0"),
        ("return x + 1.0", "return x + 2.0"),
        ("return gain * y", "return (gain *\n            y)"),
    ],
)
def test_what_numba_does_not_see_changes_nothing(old, new):
    assert old in BASE
    assert told(BASE.replace(old, new)) == told(BASE)


@pytest.mark.parametrize(
    "old, new",
    [
        ("SCALE, UNUSED = 2.0", "SCALE, UNUSED = 2.5"),
        ("SCALE, UNUSED = 2.0", "SCALE, UNUSED = 2"),
        ("math.sin(x)", "math.cos(x)"),
        ("gain=1.0", "gain=2.0"),
        ("gain * y", "gain + y"),
        ("gain * y", "gain * y * 1.5"),
        ("@kernel\n    def inner", "@inlined\n    def inner"),
        ("return gain", "if y > 0.0:\n            return y\n        return gain"),
    ],
)
def test_what_numba_compiles_changes_it(old, new):
    assert old in BASE
    assert told(BASE.replace(old, new)) != told(BASE)


@pytest.mark.parametrize(
    "one, other",
    [
        ("0.0", "-0.0"),
        ("1", "1.0"),
        ("1", "True"),
        ("(1.0, 2.0)", "(2.0, 1.0)"),
        ("(1.0, (2.0, 3.0))", "((1.0, 2.0), 3.0)"),
        ("np.array([1.0, 2.0])", "np.array([1.0, 2.5])"),
        ("np.float32(1.0)", "np.float64(1.0)"),
        ("namedtuple('Pair', 'a b')(1.0, 2.0)", "namedtuple('Pair', 'b a')(1.0, 2.0)"),
        ("enum.IntEnum('Kind', 'A B').B", "enum.IntEnum('Kind', 'B A').B"),
    ],
)
def test_a_frozen_number_counts_with_its_type(one, other):
    source = "\n    HELD = {}\n    @kernel\n    def entry(x):\n        return x, HELD\n"
    assert told(source.format(one)) != told(source.format(other))
    assert told(source.format(one)) == told(source.format(one))


def test_the_keywords_of_a_call_count():
    source = BASE.replace("inner(x)\n        return gain", "inner(KEY=x)\n        return gain").replace(
        "inner(x):", "inner(a, b):"
    )
    assert told(source.replace("KEY=x", "a=x, b=y")) != told(source.replace("KEY=x", "b=x, a=y"))


CLOSURES = """
    def runge_kutta(rates, order):
        @kernel
        def stepped(x):
            return rates(x) * order
        return stepped

    @kernel
    def first(x):
        return x

    @kernel
    def second(x):
        return 2.0 * x

    made = {name: runge_kutta(rates, n) for name, rates, n in (("a", first, 1), ("b", second, 1), ("c", first, 2))}
"""


def test_functions_made_by_closures_are_told_apart_by_what_they_close_over():
    made = module(CLOSURES).made
    assert len({digest(function) for function in made.values()}) == 3
    assert digest(made["a"]) == digest(module(CLOSURES).made["a"])


def test_copies_of_a_function_are_told_apart_by_their_own_globals():
    own = module("def native(x):\n    return KERNEL(x) + SIZE\n")
    kernels = module(CLOSURES)

    def copy(**globals_):
        return FunctionType(own.native.__code__, {**own.__dict__, **globals_}, "copy")

    base = digest(copy(KERNEL=kernels.first, SIZE=1))
    assert digest(copy(KERNEL=kernels.first, SIZE=1)) == base
    assert digest(copy(KERNEL=kernels.second, SIZE=1)) != base
    assert digest(copy(KERNEL=kernels.first, SIZE=2)) != base


SYSTEM = """
    LIMIT = 1.0

    @kernel
    def advance(x):
        return clipped(x)

    @kernel
    def clipped(x):
        return min(x, LIMIT)

    @kernel
    def sense(x):
        return 2.0 * x

    def fill(file):
        return file.advance

    class File:
        kind = "own"

    SETTINGS = File()
"""
RIG = """
    @kernel
    def act(x, system):
        return system.advance(x)

    def entry(x):
        return act(x, SYSTEM)
"""


def of_system(system: str, rig: str = RIG) -> str:
    made = module(rig, "rig")
    made.SYSTEM = module(system, "system")
    return digest(made.entry)


@pytest.mark.parametrize(
    "old, new, counts",
    [
        ("min(x, LIMIT)", "max(x, LIMIT)", True),
        ("LIMIT = 1.0", "LIMIT = 1.5", True),
        ("return 2.0 * x", "return 3.0 * x", False),  # the rig does not read `sense`
        ("return file.advance", "return file.other", False),
        ('kind = "own"', 'kind = "another"', False),
    ],
)
def test_of_a_module_handed_on_what_is_read_from_it_counts(old, new, counts):
    assert old in SYSTEM
    assert (of_system(SYSTEM.replace(old, new)) != of_system(SYSTEM)) == counts


def test_what_is_read_from_a_module_is_found_wherever_that_happens():
    """`sense` is read by a kernel that is reached through the module itself, and from a module it was handed to."""
    system = SYSTEM + "\n    @kernel\n    def bridge(x, system):\n        return system.sense(x)\n"
    rig = RIG.replace("system.advance(x)", "system.bridge(x, system)")
    assert of_system(system, rig) != of_system(system.replace("2.0 * x", "3.0 * x"), rig)


def test_the_layout_of_a_nested_record_counts():
    def view(*names):
        inner = np.dtype([(name, "f8") for name in names])
        own = module("def entry(address):\n    return AT(address)\n")
        own.AT = record_at(np.dtype([("now", inner), ("out", "f8", 3)]))
        return digest(own.entry)

    assert view("a", "b") == view("a", "b")
    assert len({view("a", "b"), view("b", "a"), view("a"), view("a", "c")}) == 4


INTRINSIC = """
    def helper(builder, x):
        return builder.fadd(x, x)

    @intrinsic
    def doubled(_, x):
        def codegen(context, builder, signature, args):
            return helper(builder, args[0])
        return types.float64(types.float64), codegen

    @kernel
    def entry(x):
        return doubled(x)
"""
OVERLOAD = """
    def total(values):
        return sum(values)

    def written(first):
        scope = {}
        exec("def unrolled(values): return " + first + " + values[0]", scope)
        return lambda values: scope["unrolled"]

    @overload(total)
    def _total(values):
        return written("1.0")(values)

    @kernel
    def entry(x):
        return total((x, x))
"""


@pytest.mark.parametrize(
    "source, old, new",
    [
        (INTRINSIC, "builder.fadd", "builder.fmul"),
        (INTRINSIC, "helper(builder, args[0])", "helper(builder, args[-1])"),
        (OVERLOAD, '"1.0"', '"2.0"'),
        (OVERLOAD, "+ values[0]", "+ values[1]"),
        (OVERLOAD, "@overload(total)", "@overload(total, jit_options={'error_model': 'numpy'})"),
    ],
)
def test_intrinsics_and_overloads_are_followed(source, old, new):
    assert old in source
    assert told(source) == told(source)
    assert told(source.replace(old, new)) != told(source)


def test_a_function_without_a_text_is_told_by_itsinstructions():
    def unrolled(count):
        scope = {}
        exec(f"def unrolled(x): return ({'x[0], ' * count})", scope)
        return digest(kernel(scope["unrolled"]))

    assert unrolled(2) == unrolled(2) != unrolled(3)


def test_functions_that_call_each_other_in_a_circle_come_to_an_end():
    source = "\n    @kernel\n    def a(x):\n        return b(x)\n    @kernel\n    def b(x):\n        return a(x) + {}\n"
    assert told(source.format(1), "a") == told(source.format(1), "a") != told(source.format(2), "a")


@pytest.mark.parametrize("held", ["object()", "type('Own', (), {})"])
def test_what_has_no_description_is_refused_rather_than_passed_over(held):
    with pytest.raises(UntoldError):
        told(f"\n    HELD = {held}\n    @kernel\n    def entry(x):\n        return HELD(x)\n")


@pytest.mark.parametrize(
    "used", ["abs", "math.tan", "np.cos", "np.dot", "np.linalg.norm", "np.random.normal", "np.full"]
)
def test_what_numba_knows_of_python_and_numpy_is_told_by_its_name(used):
    source = "\n    HELD = {}\n    @kernel\n    def entry(x):\n        return HELD(x)\n"
    assert told(source.format(used)) == told(source.format(used)) != told(source.format("math.sin"))


def test_a_name_of_the_standard_library_is_not_enough():
    """A user's module may be called as one of the standard library, and what `exec` makes is of builtins by name."""
    made = [module(BASE.replace("2.0", number), "statistics") for number in ("2.0", "3.0")]
    assert digest(made[0].entry) != digest(made[1].entry)
    rig = RIG.replace("system.advance", "system.entry")
    systems = [module(rig, "rig") for _ in made]
    for each, system in zip(systems, made, strict=True):
        each.SYSTEM = system
    assert digest(systems[0].entry) != digest(systems[1].entry)


def test_argument_types_count():
    function = module(BASE).entry
    assert digest(function, (numba.float64,)) != digest(function, (numba.float32,)) != digest(function)


@pytest.mark.parametrize("setting, value", [("OPT", 0), ("BOUNDSCHECK", 1)])
def test_how_numba_compiles_counts(monkeypatch, setting, value):
    before = told(BASE)
    monkeypatch.setattr(numba.config, setting, value)
    program.machine.cache_clear()
    assert told(BASE) != before
    monkeypatch.undo()
    program.machine.cache_clear()
    assert told(BASE) == before


def test_versions_and_processor_count():
    processor = program.cpu_target.target_context.codegen().magic_tuple()
    for part in (sys.version, numba.__version__, program.llvmlite.__version__, np.__version__, *processor):
        assert part in program.machine()
    assert program.version("mujoco-core") in program.machine()


def test_no_function_of_a_whole_car_is_told_twice(monkeypatch):
    told, tell = [], program._Telling._tell_function
    monkeypatch.setattr(program._Telling, "_tell_function", lambda self, each: (told.append(each), tell(self, each)))
    digest(rig("sedan", full_stage).CALLBACK.function)
    assert len(told) == len({id(each) for each in told}) > 100


TOLD = """
from ars_mujoco.actuators.electromechanical import system
from ars_mujoco.actuators.pump_controlled import third_order_stage
from ars_mujoco.bridge import native_loop
from ars_mujoco.kernels.program import digest
from ars_mujoco.rigs.rig import rig
callbacks = (rig("bench", each).CALLBACK for each in (third_order_stage, system))
print(*(digest(each.function) for each in callbacks), digest(native_loop._advance))
"""


def digests(place: Path, seed: str = "0") -> list[str]:
    """Of the bench with a vane motor and with an electric one, and of the loop around them, in a process of its own."""
    environment = os.environ | {"PYTHONPATH": str(place), "PYTHONHASHSEED": seed}
    command = [sys.executable, "-c", TOLD]
    done = subprocess.run(command, cwd=place, env=environment, capture_output=True, text=True, check=True, timeout=120)
    return done.stdout.split()


def test_edits_of_the_package_change_the_keys_of_what_they_reach(tmp_path):
    package = tmp_path / PACKAGE.name
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    vane, electric, loop = digests(tmp_path)
    assert loop == digest(native_loop._advance)  # another process and place, the same key

    for file in ("cli/app.py", "recording/recording.py", "hydraulics/vane_motor.py", "bridge/native_loop.py"):
        text = (package / file).read_text()
        (package / file).write_text("'''Another docstring.'''\n\n" + text + "\n\ndef unreached():\n    return 1.0\n")
    assert digests(tmp_path, seed="1") == [vane, electric, loop]

    file = package / "hydraulics" / "vane_motor.py"
    text = file.read_text()
    at = text.index("return", text.index("@kernel"))
    file.write_text(text[:at] + "return 1.5 * " + text[at + len("return ") :])
    edited = digests(tmp_path)
    assert edited[0] != vane and edited[1:] == [electric, loop]
