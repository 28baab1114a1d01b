# SPDX-License-Identifier: BSD-3-Clause
"""Files that are there whole or not at all."""

from __future__ import annotations

import contextlib
import json
import os
from pathlib import Path
from typing import Any, Iterator

_MARK = ".part"


@contextlib.contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A name to write to, with the extension of the path, to which it is renamed at the end."""
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{_MARK}{path.suffix}")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: Path, content: Any) -> None:
    write_text(path, json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def remove_unfinished(folder: Path) -> None:
    """Remove what processes that were killed have left, for which nobody else may be writing."""
    for path in folder.glob(f".*{_MARK}*"):
        path.unlink(missing_ok=True)
