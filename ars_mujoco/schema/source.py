"""Source: the bytes and the text of a file that a user names, and of nothing else that bears a name."""

import os
import stat
from pathlib import Path

MARKS = {b"\xef\xbb\xbf": "utf-8-sig", b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}  # that a text may begin with


def content(path: Path, most: int) -> bytes:
    """The bytes of the file at `path`, `most` of them at most. Raises ValueError where it is no file or a longer one.

    Opened without waiting: a pipe that nobody fills, or a device, is told from a file before anything is read.
    """
    try:
        with os.fdopen(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode) and not stat.S_ISDIR(status.st_mode):
                raise ValueError("cannot be read: is a device or a pipe, not a file")
            found = file.read(most + 1)
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror or error}") from None
    if len(found) > most:
        raise ValueError(f"is too long: more than {most / 1e6:g} MB")
    return found


def text_of(found: bytes) -> str:
    """The text in UTF-8, in UTF-16 with its mark, or in what Western offices wrote before; raises ValueError."""
    coding = next((name for mark, name in MARKS.items() if found.startswith(mark)), "utf-8")
    for each in (coding, "cp1252"):
        try:
            text = found.decode(each)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text
    raise ValueError("cannot be read: is no text")
