# SPDX-License-Identifier: BSD-3-Clause
"""Jobs in processes of their own, several at a time."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import IO, Callable

from .._world import NeuralMesh
from .recipe import Job
from .report import identity_of, report_path, result_path
from .atomic_file import WriteError, write_json
from .words import words_of_process

_PAUSE = 0.02  # seconds between looks at the processes


def run_jobs(
    jobs: list[Job],
    folder: Path,
    mesh_format: str,
    processes: int,
    time_limit: float | None,
    on_end: Callable[[Job, str], None],
) -> None:
    """Run all jobs, `processes` at a time; on_end is called with the error, or "".

    A process that fails, crashes, or takes more than time_limit is a failure of its job alone:
    there is a report on it, and no result. However this function is left, no process is.
    """
    waiting = list(reversed(jobs))
    running: list[_Process] = []
    threads = max(1, NeuralMesh.GetNumberOfAvailableProcessors() // processes)
    try:
        while waiting or running:
            while waiting and len(running) < processes:
                running.append(_Process(waiting.pop(), folder, mesh_format, threads, time_limit))
            time.sleep(_PAUSE)
            for process in [process for process in running if process.has_ended()]:
                running.remove(process)
                error = process.error()
                if error:
                    error = _write_failure(process.job, folder, mesh_format, error)
                on_end(process.job, error)
    finally:
        for process in running:
            process.kill()


class _Process:
    """A process that does a job."""

    def __init__(
        self, job: Job, folder: Path, mesh_format: str, threads: int, time_limit: float | None
    ):
        self.job = job
        self._time_limit = time_limit
        self._start = time.monotonic()
        self._is_late = False
        self._messages: IO[bytes] = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            [sys.executable, "-m", "neuralmesh.batch.job"],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=self._messages,
            # Ctrl-C reaches only the process that looks after this one.
            start_new_session=True,
            env={"VTK_SMP_MAX_THREADS": str(threads), **os.environ},
        )
        content = {
            "name": job.name,
            "scan": str(job.scan),
            "first_mesh": str(job.first_mesh) if job.first_mesh else None,
            "shift": job.shift,
            "parameters": job.parameters,
            "folder": str(folder),
            "format": mesh_format,
        }
        try:
            assert self._process.stdin is not None  # as it is a pipe
            with self._process.stdin as stdin:
                stdin.write(json.dumps(content).encode())
        except BrokenPipeError:
            pass  # It has ended already, and its status tells.

    def has_ended(self) -> bool:
        """Whether the process has ended by itself, or was late and has been ended."""
        if self._process.poll() is not None:
            return True
        if self._time_limit is not None and time.monotonic() - self._start > self._time_limit:
            self.kill()
            self._is_late = True
        return self._is_late

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()

    def error(self) -> str:
        """What the process has said, if it has failed, and how it ended."""
        status = self._process.returncode
        if status == 0:
            return ""
        if self._is_late:
            limit = f"{self._time_limit:g} s, the time_limit of the recipe"
            return f"{self.job.scan}: ended after {limit}"
        self._messages.seek(0)
        said = self._messages.read().decode(errors="replace")
        return words_of_process(status, said, str(self.job.scan))


def _write_failure(job: Job, folder: Path, mesh_format: str, error: str) -> str:
    """Write a report of what went wrong; the error, with that of the report if it cannot be written."""
    # What an earlier recipe left under this name is no result of this one.
    for name in (job.name, *map(job.level_name, job.smaller_levels)):
        with contextlib.suppress(OSError):
            result_path(folder, name, mesh_format).unlink(missing_ok=True)
    report = {"job": job.name, "status": "failed", **identity_of(job, mesh_format), "error": error}
    path = report_path(folder, job.name)
    try:
        write_json(path, report)
    except WriteError as unwritten:
        # That of an earlier run would be read as that of this one.
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)
        return f"{error}; {unwritten}"
    return error
