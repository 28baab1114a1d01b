# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes, drawn by one process, on a virtual screen if necessary."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

from .._build import PARAVIEW
from .meshes import why_no_pictures

_SCRIPT = Path(__file__).with_name("draw_pictures.py")


def draw_pictures(pictures: list[tuple[Path, Path]], view: dict[str, Any]) -> str:
    """Draw each mesh, the first of a pair, to the second; what went wrong, or ""."""
    if not pictures:
        return ""
    problem = why_no_pictures()
    if problem:
        return problem
    command = [_interpreter(), str(_SCRIPT)]
    if not os.environ.get("DISPLAY"):
        screen = shutil.which("xvfb-run")
        if screen is None:
            return "no pictures: there is neither a screen nor xvfb-run (Debian: xvfb xauth)"
        # Without -noreset the server may end between two windows.
        command = [screen, "-a", "-s", "-screen 0 1280x1024x24 -noreset", *command]
    order = {"view": view, "pictures": [[str(mesh), str(path)] for mesh, path in pictures]}
    return _run(command, json.dumps(order))


def _interpreter() -> str:
    """ParaView's batch program where this package goes with its VTK, else this Python."""
    return (shutil.which("pvbatch") if PARAVIEW else None) or sys.executable


def _run(command: list[str], order: str) -> str:
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as process:
        try:
            said, _ = process.communicate(order)
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    if process.returncode == 0:
        return ""
    return f"pictures: {said.strip()} (status {process.returncode})"
