"""Program: all that an entry's machine code is made of, as one digest.

It follows what numba follows: the instructions of every function that an entry reaches through globals, closures,
defaults and modules handed on as values; the intrinsics and overloads that stand for some of them; every constant that
is frozen into them; the versions of all that compiles, and the processor. What is not reached changes nothing.

A function is told by its instructions and what they load, not by its text: they are what numba compiles, those in
memory even where the file has been edited since, and a function made by `exec` has them too. So comments, docstrings
and the lines on which a function stands do not count. Methods that are overloaded on a type are not followed.
"""

import builtins
import contextlib
import dis
import enum
import hashlib
import sys
from collections import defaultdict
from functools import cache
from importlib.metadata import version
from types import BuiltinFunctionType, CodeType, FunctionType, MethodType, ModuleType

import llvmlite
import numba
import numpy as np
from numba.core.dispatcher import Dispatcher
from numba.core.registry import cpu_target
from numba.core.typing import Signature
from numba.core.typing.templates import builtin_registry

# what belongs to these is told by its name, as their versions are told
_VERSIONED = sys.stdlib_module_names | {"numba", "numpy", "llvmlite", "mujoco"}
_PLAIN = frozenset({int, float, complex, bool, str, bytes, type(None), type(Ellipsis)})
_GLOBAL = "global"
_READS = frozenset({"LOAD_ATTR", "LOAD_METHOD"})
_SETTINGS = ("OPT", "BOUNDSCHECK", "DEBUGINFO_DEFAULT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "DISABLE_INTEL_SVML")


class UntoldError(Exception):
    """A program holds something without a description that is the same in every process."""


def digest(*roots) -> str:
    """Of functions and of what is handed to them, signatures, modules, numbers, in their order. Raises UntoldError."""
    telling = _Telling()
    telling.tell((machine(), *roots))
    return telling.finish()


@cache
def machine() -> str:
    """What makes other code of the same program: versions, numba's settings, and the processor."""
    versions = (sys.version, numba.__version__, llvmlite.__version__, np.__version__, version("mujoco-core"))
    settings = tuple(getattr(numba.config, name) for name in _SETTINGS)
    return repr((versions, settings, cpu_target.target_context.codegen().magic_tuple()))


class _Telling:
    """One digest in the making."""

    def __init__(self):
        self.said = hashlib.sha256()
        self.numbers: dict[int, int] = {}  # functions and modules by identity; a second mention says the number only
        self.waiting: list[FunctionType] = []
        self.modules: list[tuple[ModuleType, set[str]]] = []  # handed on as values, and which names of each are told
        self.names: set[str] = set()  # that any function reads from something
        self.overloads = _overloads()

    def finish(self) -> str:
        """Tell the functions that wait, and of each module whatever any of them may read from it, until all is told."""
        while self.waiting or self._tell_modules():
            while self.waiting:
                self._tell_function(self.waiting.pop())
        return self.said.hexdigest()[:20]

    def say(self, *words) -> None:
        self.said.update(repr(words).encode())

    def tell(self, value) -> None:
        kind = type(value)
        if kind in _PLAIN:
            self.say(kind.__name__, value)
        elif isinstance(value, ModuleType):
            self._tell_module(value)
        elif _is_versioned(value):
            self.say("named", value.__module__, value.__name__)
        elif isinstance(value, FunctionType):
            if self._is_new(value):
                self.waiting.append(value)
        elif isinstance(value, type):
            self._tell_class(value)
        elif (stands_for := _stands_for(value)) is not None:
            self.say(kind.__qualname__)
            self.tell(stands_for)
        else:
            self._tell_data(kind, value)

    def _tell_data(self, kind: type, value) -> None:
        if isinstance(value, np.dtype | numba.types.Type):
            self.say(kind.__name__, _repr(value))
        elif isinstance(value, np.ndarray | np.generic) and not value.dtype.hasobject:
            self.say("array", repr(value.dtype), value.shape, value.tobytes())
        elif isinstance(value, enum.Enum):
            self.say(kind.__qualname__, value.name)
            self.tell(value.value)
        elif isinstance(value, tuple | list | dict | set | frozenset):
            self.say(kind.__qualname__, getattr(kind, "_fields", ""), len(value))
            unordered = isinstance(value, set | frozenset)
            for each in sorted(value, key=repr) if unordered else value.items() if isinstance(value, dict) else value:
                self.tell(each)
        else:
            raise UntoldError(f"it holds {_repr(value):.80}")

    def _tell_class(self, value: type) -> None:
        self.say(value.__module__, value.__qualname__)
        if hasattr(value, "_fields"):
            self.tell((value._fields, value._field_defaults))
        elif issubclass(value, enum.Enum):
            self.tell([(each.name, each.value) for each in value])
        elif not issubclass(value, BaseException):
            raise UntoldError(f"it uses the class {value.__qualname__}")

    def _tell_module(self, module: ModuleType) -> None:
        if _is_versioned(module):
            self.say("module", module.__name__)
        elif self._is_new(module):
            self.modules.append((module, set()))

    def _tell_function(self, function: FunctionType) -> None:
        self.tell((function.__defaults__, function.__kwdefaults__))
        for cell in function.__closure__ or ():
            try:
                self.tell(cell.cell_contents)
            except ValueError:
                self.say("empty")
        self._tell_code(function.__code__, function.__globals__)
        for template in self.overloads.get(id(function), ()):
            self.tell((template._jit_options, template._overload_func))

    def _tell_code(self, code: CodeType, scope: dict) -> None:
        text, names, loads = instructions(code)
        self.said.update(text)
        self.names |= names
        for kind, value in loads:
            if kind is _GLOBAL:
                self._tell_global(scope, *value)
            elif isinstance(value, CodeType):
                self._tell_code(value, scope)
            else:
                self.tell(value)

    def _tell_global(self, scope: dict, name: str, *attributes: str) -> None:
        """What stands under a name; of a module whose attribute is read, the attribute alone."""
        value = scope.get(name, getattr(builtins, name, None))
        for read in attributes:
            if not isinstance(value, ModuleType):
                break
            value = getattr(value, read, None)
        self.tell(value)

    def _tell_modules(self) -> bool:
        """Tell what functions may read from modules and is not told yet; whether a function came of it."""
        for module, told in self.modules:  # which may grow underway
            for name in sorted((self.names & vars(module).keys()) - told):
                told.add(name)
                value = vars(module)[name]
                if self._can_be_compiled(value):
                    self.say(name)
                    with contextlib.suppress(UntoldError):  # of what cannot be told, numba makes no constant either
                        self.tell(value)
        return bool(self.waiting)

    def _can_be_compiled(self, value) -> bool:
        """Whether compiled code can use what a module holds: a plain function only where an overload stands for it."""
        if isinstance(value, FunctionType):
            return bool(self.overloads.get(id(value)))
        return hasattr(value, "_fields") if isinstance(value, type) else True

    def _is_new(self, value) -> bool:
        known = len(self.numbers)
        number = self.numbers.setdefault(id(value), known)
        self.say("number", number)
        return number == known


@cache
def instructions(code: CodeType) -> tuple[bytes, frozenset[str], list[tuple]]:
    """A function's text, the names that it reads from something, and what it loads: globals and constants.

    A global is told as its name and the attributes that are read from it at once. A constant that no instruction loads,
    as a docstring, is not among them.
    """
    words, names, loads, path = [], set(), [], None
    for each in dis.get_instructions(code):
        name, argument = each.opname, each.argval
        if argument is dis.UNKNOWN:  # names of keywords, in Python 3.11
            argument = code.co_consts[each.arg]
        is_plain = type(argument) in _PLAIN
        words.append((name, argument if is_plain else ""))
        if name in _READS:
            names.add(argument)
            if path is not None:
                path.append(argument)
                continue
        path = None
        if name in ("LOAD_GLOBAL", "LOAD_NAME"):
            path = [argument]
            loads.append((_GLOBAL, path))
        elif name == "IMPORT_NAME" and argument.partition(".")[0] not in _VERSIONED:
            raise UntoldError(f"it imports {argument} underway")
        elif name == "LOAD_CONST" and isinstance(argument, str):
            names.add(argument)
        elif not is_plain:
            loads.append((name, argument))
    frame = (code.co_varnames, code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount, code.co_flags)
    frame += code.co_cellvars, code.co_freevars, code.co_exceptiontable
    return repr((frame, words)).encode(), frozenset(names), loads


def _stands_for(value):
    """What there is to tell of an object that stands for a function, or for another thing; None where it does not."""
    if isinstance(value, Dispatcher):
        return value.targetoptions, value.py_func
    if isinstance(value, numba.types.Dispatcher):
        return value.dispatcher
    if isinstance(value, Signature):
        return value.return_type, value.args
    if isinstance(value, slice):
        return value.start, value.stop, value.step
    if isinstance(value, BuiltinFunctionType | MethodType):  # as of numpy's random numbers
        return type(value.__self__), value.__name__
    for name in ("_defn", "__wrapped__"):  # an intrinsic; what functools has wrapped
        if hasattr(value, name):
            return (getattr(value, name),)
    return None


def _repr(value) -> str:
    text = repr(value)
    if " at 0x" in text:
        raise UntoldError(f"it holds {text:.80}")
    return text


def _overloads() -> dict[int, list]:
    """What numba compiles in place of plain functions, by their identity."""
    found = defaultdict(list)
    for function, kind in builtin_registry.globals:
        if isinstance(function, FunctionType):
            found[id(function)] += [each for each in kind.templates if hasattr(each, "_overload_func")]
    return found


def _is_versioned(value) -> bool:
    """Whether it is found in a library whose version is told; what `exec` makes only says that it is of builtins."""
    if isinstance(value, ModuleType):
        return value.__name__.partition(".")[0] in _VERSIONED and sys.modules.get(value.__name__) is value
    name = getattr(value, "__module__", None) or "builtins"
    scope = vars(sys.modules[name]) if name in sys.modules and name.partition(".")[0] in _VERSIONED else {}
    return scope.get(getattr(value, "__name__", None)) is value or getattr(value, "__globals__", None) is scope
