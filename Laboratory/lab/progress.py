# SPDX-License-Identifier: BSD-3-Clause
"""The progress bar."""

from __future__ import annotations

import sys
import time

_WIDTH = 30


class ProgressBar:
    """How many runs are done, weighted by what they cost. Where nobody watches, ten lines in all."""

    def __init__(self, cost: float, count: int):
        self._whole, self._count = cost, count
        self._cost, self._done, self._tenths = 0.0, 0, 0
        self._start = time.monotonic()
        self._is_watched = sys.stderr.isatty()

    def add(self, cost: float, name: str) -> None:
        self._cost += cost
        self._done += 1
        part = self._cost / self._whole
        passed = time.monotonic() - self._start
        text = f"{self._done} of {self._count} runs, {_duration(passed / part - passed)} left"
        if self._is_watched:
            bar = "#" * round(_WIDTH * part)
            print(f"\r[{bar:{_WIDTH}}] {text} {name[:30]:30}", end="", file=sys.stderr, flush=True)
        elif int(10 * part + 1e-9) > self._tenths:
            self._tenths = int(10 * part + 1e-9)
            print(f"{self._tenths * 10:3} %  {text}", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self._is_watched and self._done:
            print(file=sys.stderr)


def _duration(seconds: float) -> str:
    return f"{seconds / 60:.0f} min" if seconds >= 90 else f"{max(0.0, seconds):.0f} s"
