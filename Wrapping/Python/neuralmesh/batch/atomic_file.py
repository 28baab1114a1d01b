# SPDX-License-Identifier: BSD-3-Clause
"""Files that are there whole or not at all, and folders in which one works alone."""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
from pathlib import Path
from typing import Any, Iterator

from .._command import words_of

_MARK = ".part"


class WriteError(OSError):
    """A file could not be written; the message names it, and says why."""


@contextlib.contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """A name to write to, with the extension of the path, to which it is renamed at the end.

    What goes wrong meanwhile is a WriteError, which names the path.
    """
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{_MARK}{path.suffix}")
    try:
        yield temporary
        os.replace(temporary, path)
    except (OSError, RuntimeError, ValueError) as error:
        # Writers name the file that they know, and so does the system.
        why = words_of(error).replace(f"{temporary}: ", "").removeprefix("cannot be written: ")
        raise WriteError(f"{path}: cannot be written: {why}") from None
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    with atomic_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: Path, content: Any) -> None:
    write_text(path, json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def remove_unfinished(folder: Path) -> None:
    """Remove the remains of processes that were killed. No other process may be writing."""
    for path in folder.glob(f".*{_MARK}*"):
        path.unlink(missing_ok=True)


@contextlib.contextmanager
def alone_in(folder: Path, work: str) -> Iterator[None]:
    """Refuse to work where another process works. Remove half-written files of any process."""
    with open(folder / ".lock", "w", encoding="ascii") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise OSError(f"{folder}: another {work} is working there") from None
        remove_unfinished(folder)
        try:
            yield
        finally:
            remove_unfinished(folder)
