"""Compiled entries on disk: found again by another process, and whatever is wrong with them costs a compilation."""

import ctypes
import errno
import os
import resource
import time
import warnings
from pathlib import Path

import numba
import numpy as np
import pytest

from ars_mujoco.kernels import cache
from ars_mujoco.kernels.kernel import NativeCallback, entry, interpreted

pytestmark = pytest.mark.skipif(interpreted, reason="nothing is compiled with NUMBA_DISABLE_JIT=1")


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """The folder of entries, empty, as is the one for temporary files."""
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    cache._warn.cache_clear()
    return tmp_path / "cache" / "ars_mujoco"


def doubled(x):
    return 2.0 * x


def is_loaded() -> bool:
    """Run the function as a new process would, hold its result against Python's; whether it came from the disk."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        compiled = entry(doubled)
        assert compiled(21.0) == doubled(21.0)
    return sum(compiled.stats.cache_hits.values()) == 1


def only_file(folder: Path) -> Path:
    (file,) = folder.iterdir()
    return file


def own_folder(tmp_path: Path) -> Path:
    return tmp_path / "temporary" / f"ars_mujoco-{os.getuid()}"


# ---- as it should be


def test_an_entry_is_one_file_by_its_name_and_is_found_again(folder, tmp_path):
    assert not is_loaded()
    assert only_file(folder).name.startswith(f"{doubled.__module__}.doubled-")
    assert is_loaded()
    assert not own_folder(tmp_path).exists()


def test_other_argument_types_are_another_file(folder):
    compiled = entry(doubled)
    assert (compiled(1.0), compiled(1)) == (2.0, 2.0)
    assert len(list(folder.iterdir())) == 2


def add(address, value):
    numba.carray(numba_pointer(address), (1,))[0] += value


@numba.extending.intrinsic
def numba_pointer(_, address):
    def codegen(context, builder, signature, args):
        return builder.inttoptr(args[0], context.get_value_type(signature.return_type))

    return numba.types.CPointer(numba.float64)(numba.types.intp), codegen


SIGNATURE = numba.void(numba.types.intp, numba.types.intp)


@pytest.mark.parametrize("cached", [True, False])
def test_a_native_callback_is_kept_unless_it_is_not_to_be(folder, cached):
    for hits in (0, int(cached)):
        callback, numbers = NativeCallback(SIGNATURE, add, cached), np.array([1.0])
        ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(callback.address)(numbers.ctypes.data, 2)
        assert numbers[0] == 3.0
        assert callback.compiled.cache_hits == hits
    assert folder.exists() == cached


def test_a_file_out_of_use_is_removed_when_another_is_written(folder):
    folder.mkdir(parents=True)
    for name, days in (("old-1.entry", 31), ("recent-2.entry", 29), ("half-3.entry.0123456789abcdef", 31)):
        (folder / name).write_bytes(b"")
        os.utime(folder / name, (time.time() - days * cache.DAY,) * 2)
    assert not is_loaded()
    kept = {file.name.partition("-")[0] for file in folder.iterdir()}
    assert kept == {"recent", f"{doubled.__module__}.doubled"}


def test_a_file_in_use_stays_young(folder):
    is_loaded()
    os.utime(only_file(folder), (time.time() - 29 * cache.DAY,) * 2)
    assert is_loaded()
    assert only_file(folder).stat().st_mtime > time.time() - cache.DAY


# ---- what is broken is compiled again, and then is whole


def break_bit(content: bytes, at: int) -> bytes:
    return content[:at] + bytes([content[at] ^ 1]) + content[at + 1 :]


BROKEN = {
    "empty": lambda content: b"",
    "cut in its checksum": lambda content: content[:10],
    "cut after its checksum": lambda content: content[:32],
    "cut in half": lambda content: content[: len(content) // 2],
    "cut by one byte": lambda content: content[:-1],
    "too long": lambda content: content + b"\0",
    "a bit of its checksum": lambda content: break_bit(content, 3),
    "a bit of its pickle": lambda content: break_bit(content, 40),
    "a bit of its code": lambda content: break_bit(content, len(content) // 2),
    "nothing but zeros": lambda content: bytes(len(content)),
    "another's text": lambda content: b"not an entry at all, but long enough to hold a checksum",
    "whole, and no pickle": lambda content: cache.hashlib.sha256(b"text").digest() + b"text",
    "whole, and another pickle": lambda content: cache.hashlib.sha256(b"N.").digest() + b"N.",
}


@pytest.mark.parametrize("kind", BROKEN)
def test_a_broken_file_is_compiled_again_and_replaced(folder, kind):
    is_loaded()
    file = only_file(folder)
    file.write_bytes(BROKEN[kind](file.read_bytes()))
    assert not is_loaded()
    assert is_loaded()
    assert only_file(folder) == file


def test_nothing_broken_is_handed_on(folder, monkeypatch):
    is_loaded()
    file = only_file(folder)
    file.write_bytes(break_bit(file.read_bytes(), 40))
    monkeypatch.setattr(cache, "_Unpickler", lambda _: pytest.fail("it was read"))
    assert not is_loaded()


def test_what_cannot_be_read_is_compiled_and_kept_elsewhere(folder, tmp_path):
    """A folder in the file's place: even root can neither read nor replace it."""
    is_loaded()
    file = only_file(folder)
    file.unlink()
    (file / "within").mkdir(parents=True)
    assert not is_loaded()
    assert is_loaded()
    assert only_file(own_folder(tmp_path)).name == file.name
    assert only_file(folder) == file  # no half-written one beside it


# ---- what cannot be written


def test_without_a_cache_folder_the_one_for_temporary_files_serves(folder, tmp_path):
    folder.parent.write_text("a file where the folder should be")
    assert not is_loaded()
    assert is_loaded()
    assert own_folder(tmp_path).stat().st_mode & 0o777 == 0o700


def test_without_any_folder_it_compiles_with_one_line_of_warning(folder, tmp_path):
    folder.parent.write_text("a file where the folder should be")
    own_folder(tmp_path).write_text("here too")
    with pytest.warns(UserWarning, match="compiled code is not kept") as warned:
        assert entry(doubled)(21.0) == 42.0
        assert entry(add_one)(21.0) == 22.0
    assert len(warned) == 1


def add_one(x):
    return x + 1.0


def test_on_a_full_disk_nothing_half_written_stays(folder, tmp_path):
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    compiled = entry(doubled)
    with pytest.warns(UserWarning, match="compiled code is not kept") as warned:
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
        try:
            assert compiled(21.0) == 42.0
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert os.strerror(errno.EFBIG) in str(warned[0].message) and len(warned) == 1
    assert list(folder.iterdir()) == list(own_folder(tmp_path).iterdir()) == []
    assert not is_loaded()
    assert is_loaded()


def test_a_temporary_folder_that_others_may_write_is_not_used(folder, tmp_path):
    """What lies there is run."""
    folder.parent.write_text("a file where the folder should be")
    own_folder(tmp_path).mkdir()
    own_folder(tmp_path).chmod(0o777)
    with pytest.warns(UserWarning, match="compiled code is not kept"):
        entry(doubled)(21.0)
    assert list(own_folder(tmp_path).iterdir()) == []


TABLE = np.arange(200_000.0)  # so large that numba holds its address
ABSOLUTE = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(lambda x: abs(x))


def looked_up(x):
    return TABLE[int(x)]


def called(x):
    return ABSOLUTE(x)


@pytest.mark.parametrize("function", [looked_up, called])
def test_what_holds_addresses_of_this_process_is_compiled_each_time_and_says_so_once(folder, function):
    with pytest.warns(UserWarning, match=f"{function.__qualname__} is compiled at every start") as warned:
        assert entry(function)(3.0) == 3.0
        assert entry(function)(3.0) == 3.0
    assert len(warned) == 1
    assert not folder.exists()
