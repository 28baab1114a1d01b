# SPDX-License-Identifier: BSD-3-Clause
"""Plain words for what went wrong, from what processes print and raise."""

from __future__ import annotations

import re
import signal
from typing import Iterable

NO_MEMORY = "there is not enough memory; fewer --processes leave more for each job"

_LONGEST = 4000  # characters of what a process says in the end
_COLOURS = re.compile(r"\x1b\[[0-9;]*m")
# VTK's logger puts the time, the thread and the place in the code before a message.
_LOGGER = re.compile(r"^(?:[-\d]+ [\d:.]+ )?\( *[\d.]+s\) \[[^]]*\] *\S+:\d+ +\w+\| ", re.MULTILINE)
_MEMORY = re.compile(r"bad_alloc|Unable to allocate|Cannot allocate memory|MemoryError")
_TAG = re.compile(r"\s*\[([a-z]+(?:-[a-z]+)*)\]$")


def words_of_process(status: int, said: str, scan: str) -> str:
    """Why a job has failed, by the exit status of its process and by what it printed."""
    said = _LOGGER.sub("", _COLOURS.sub("", said)).strip()
    if _MEMORY.search(said):
        return f"{scan}: {NO_MEMORY}"
    said = said[-_LONGEST:]
    if status > 0:
        return said or f"{scan}: the process ended with status {status}"
    name = signal.Signals(-status).name
    advice = ""
    if status == -signal.SIGKILL:
        advice = " (perhaps for lack of memory: use fewer processes)"
    return f"{scan}: the process was ended by {name}{advice}. {said}".strip()


def tag_of(warning: str) -> str:
    """The tag at the end of a warning; "other" where there is none."""
    found = _TAG.search(warning)
    return found.group(1) if found else "other"


def tags_of(warnings: Iterable[str]) -> str:
    """The tags of warnings, each once."""
    return " ".join(dict.fromkeys(map(tag_of, warnings)))


def without_tag(warning: str) -> str:
    return _TAG.sub("", warning)


def heading_of(tag: str) -> str:
    """The heading of Documentation/Guide/Failures.md that a tag stands for."""
    return tag.replace("-", " ").capitalize()
