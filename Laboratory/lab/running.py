# SPDX-License-Identifier: BSD-3-Clause
"""Runs, spread over processes that stay for one run after the other."""

from __future__ import annotations

import json
import os
import selectors
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import IO, Callable

from .experiment import Run

# The locators of VTK's other backends sort otherwise each time, and take another one of the triangles
# that are equally near.
_ON_ONE_THREAD = {
    "VTK_SMP_BACKEND_IN_USE": "Sequential",
    "VTK_SMP_MAX_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
}
_LONGEST_MESSAGE = 4000  # characters of what a process says in the end


def do_runs(
    runs: list[Run], folder: Path, processes: int, on_end: Callable[[Run, str], None]
) -> None:
    """Do all runs, long ones first; on_end is called with what went wrong, or "".

    A run that crashes its process fails alone. However this function is left, no process is.
    """
    waiting = sorted(runs, key=lambda run: run.cost)
    selector = selectors.DefaultSelector()
    workers: list[_Worker] = []

    def employ(worker: _Worker) -> None:
        """Give it the next run, or let it go."""
        if waiting:
            worker.begin(waiting.pop())
            selector.register(worker.answers, selectors.EVENT_READ, worker)
        else:
            worker.end()

    try:
        for _ in range(min(processes, len(runs))):
            workers.append(_Worker(folder))
            employ(workers[-1])
        while selector.get_map():
            for key, _ in selector.select():
                worker = key.data
                selector.unregister(worker.answers)
                error = worker.answer()
                on_end(worker.run, error)
                if worker.has_ended:
                    workers.remove(worker)
                    worker.end()
                    workers.append(worker := _Worker(folder))
                employ(worker)
    finally:
        for worker in workers:
            worker.kill()
        selector.close()


class _Worker:
    """A process that does a run for each line that it is given."""

    def __init__(self, folder: Path):
        self.run: Run
        self.has_ended = False
        self._messages: IO[bytes] = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            [sys.executable, "-m", "neuralmesh.lab.worker", str(folder)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._messages,
            # Ctrl-C reaches only the process that looks after this one.
            start_new_session=True,
            env={**os.environ, **_ON_ONE_THREAD},
        )
        self.answers = self._process.stdout

    def begin(self, run: Run) -> None:
        self.run = run
        try:
            self._process.stdin.write(json.dumps(run.content()).encode() + b"\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            pass  # It has ended already, and the answer tells.

    def answer(self) -> str:
        """What went wrong with the run, or nothing."""
        line = self.answers.readline()
        if line:
            return json.loads(line)
        self.has_ended = True
        status = self._process.wait()
        self._messages.seek(0)
        said = self._messages.read().decode(errors="replace").strip()[-_LONGEST_MESSAGE:]
        if status < 0:
            return f"the process was ended by {signal.Signals(-status).name}. {said}".strip()
        return said or f"the process ended with status {status}"

    def end(self) -> None:
        """Let it go: it has nothing to do."""
        try:
            self._process.stdin.close()
        except BrokenPipeError:
            pass
        self._process.wait()
        self.answers.close()
        self._messages.close()

    def kill(self) -> None:
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
