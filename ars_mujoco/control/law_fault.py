"""What a law did wrong, in one line that names the place in its file."""

import inspect
import traceback
from pathlib import Path

PAIR = "it must return two numbers, the front bar's and the rear bar's"


def told(error: BaseException, path: Path) -> str:
    """Type, text and place of what was raised: the innermost line of the law's own folder, or the last line at all."""
    frames = traceback.extract_tb(error.__traceback__)
    folder = path.resolve().parent
    own = [frame for frame in frames if folder in Path(frame.filename).resolve().parents]
    if isinstance(error, SyntaxError):
        place = f" ({Path(error.filename or path).name}, line {error.lineno})"
        return f"{type(error).__name__}: {error.msg}{place}"
    last = (own or frames)[-1:]
    place = f" ({Path(last[0].filename).name}, line {last[0].lineno})" if last else ""
    text = " ".join(str(error).split())
    return f"{type(error).__name__}{f': {text}' if text else ''}{place}"


def no_pair(result: object) -> str:
    """What to say of a result that is not two numbers."""
    shown = repr(result)
    return f"command() returned {shown if len(shown) < 80 else shown[:76] + ' ...'}; {PAIR}"


def compilers_reason(error: Exception, function: object, path: Path) -> str:
    """Why numba does not compile `function`: its own first words, and the line of the file where it stopped."""
    if not inspect.isfunction(function):
        return f"it is an object of {type(function).__name__}, and only functions are compiled"
    if prints(function):
        return "it prints"
    lines = [line.strip() for line in str(error).splitlines()]
    lines = [line for line in lines if line and not line.startswith("Failed in nopython mode")]
    text = lines[0] if lines and type(error).__module__.startswith("numba") else f"{type(error).__name__}: {error}"
    if text.endswith(":") and len(lines) > 1 and lines[1].startswith(">>>"):
        text += lines[1].removeprefix(">>>")
    text, _, raised = text.partition(". Raised from ")
    place = next((line for line in (raised, *lines) if path.name in line), "")
    number = place.rpartition("line " if "line " in place else "(")[2].strip(":)")
    return f"{text} (line {number})" if number else text


def prints(function: object, seen: tuple[object, ...] = ()) -> bool:
    """Whether a function, or a compiled one that it names, prints.

    Native code then takes the interpreter's lock and looks for the text in the Environment of its function, which code
    from numba's cache has for the entry alone. It returns with an error and keeps the lock: the run hangs.
    """
    code = getattr(function, "__code__", None)
    if code is None or function in seen:
        return False
    named = [function.__globals__.get(name) for name in code.co_names]  # type: ignore[attr-defined]
    compiled = [each.py_func for each in named if hasattr(each, "py_func")]
    return "print" in code.co_names or any(prints(each, (*seen, function)) for each in compiled)


def takes_two(function: object) -> bool:
    """Whether `function` can be called with sensors and memory; True where that cannot be told."""
    try:
        inspect.signature(function).bind(None, None)  # type: ignore[arg-type]
    except TypeError:
        return False
    except ValueError:
        return True
    return True
