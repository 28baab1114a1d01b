# SPDX-License-Identifier: BSD-3-Clause
"""The progress bar of a run."""

from __future__ import annotations

import sys
import time

_WIDTH = 30
_CLEAR = "\033[K"


class ProgressBar:
    """A bar on stderr, where that is a terminal."""

    def __init__(self, vertices: int) -> None:
        self._vertices = vertices
        self._is_on_terminal = sys.stderr.isatty()
        self._start = time.monotonic()
        self._is_shown = False

    def show(self, fraction: float) -> None:
        """So much is done."""
        done = min(max(fraction, 0.0), 1.0)
        seconds = time.monotonic() - self._start
        if not self._is_on_terminal or done <= 0.0 or seconds <= 0.0:
            return
        filled = int(done * _WIDTH)
        bar = "#" * filled + "." * (_WIDTH - filled)
        rate = done * self._vertices / seconds
        left = seconds * (1.0 - done) / done
        sys.stderr.write(
            f"\r[{bar}] {100.0 * done:3.0f} %  {rate:.0f} vertices/s  {left:.1f} s left {_CLEAR}"
        )
        sys.stderr.flush()
        self._is_shown = True

    def clear(self) -> None:
        """Leave nothing of it."""
        if self._is_shown:
            sys.stderr.write(f"\r{_CLEAR}")
            sys.stderr.flush()
            self._is_shown = False
