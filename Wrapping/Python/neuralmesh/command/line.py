# SPDX-License-Identifier: BSD-3-Clause
"""The command neuralmesh with all its subcommands."""

from __future__ import annotations

import importlib
import os
import signal
import sys
from typing import Callable, Sequence

from .. import __version__
from .._parameters import hint
from .parsing import WRONG_USE, UsageError

_FAILED = 1
_INTERRUPTED = 128 + signal.SIGINT

_SUBCOMMANDS = {
    "reconstruct": "Make a triangle mesh from a point cloud",
    "tune": "Choose the parameters for a point cloud, with reasons",
    "compare": "Measure the distance of a mesh from a reference",
    "explain": "Measure the distance of each point from a mesh, and give the reason",
    "info": "Check whether meshes are sound, and how good they are",
    "batch": "Reconstruct many scans by one recipe",
    "paraview": "Make ParaView know the filters of NeuralMesh",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit status."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    if not words or words[0] in ("-h", "--help"):
        print(_help(), end="")
        return _finished(0)
    if words[0] == "--version":
        print(__version__)
        return _finished(0)
    if words[0] not in _SUBCOMMANDS:
        question = hint(words[0], _SUBCOMMANDS)
        meant = f"{words[0]}: {question}\n" if question else ""
        is_option = words[0].startswith("-")
        wrong = "A subcommand is required" if is_option else f"no such subcommand: {words[0]}"
        print(f"{wrong}\n{meant}\n{_help()}", end="", file=sys.stderr)
        return WRONG_USE
    return _run(_command(words[0]), words[1:])


def _help() -> str:
    lines = "".join(f"  {name:28}{text}\n" for name, text in _SUBCOMMANDS.items())
    return (
        "Triangle meshes from point clouds, by learning\n"
        "Usage: neuralmesh [OPTIONS] SUBCOMMAND\n\n"
        "Options:\n"
        "  -h,--help                   Print this help message and exit\n"
        "  --version                   Display program version information and exit\n\n"
        f"Subcommands:\n{lines}"
    )


def _command(name: str) -> Callable[[Sequence[str]], int | None]:
    if name == "batch":
        from ..batch.command import run as batch

        return batch
    if name == "paraview":
        return importlib.import_module("neuralmesh.paraview").main
    return importlib.import_module(f".{name}", __package__).run


def _run(command: Callable[[Sequence[str]], int | None], arguments: Sequence[str]) -> int:
    try:
        return _finished(command(arguments) or 0)
    except UsageError as error:
        return _say(error, WRONG_USE)
    except MemoryError:
        return _say(
            "there is not enough memory; --dry-run tells how much a run takes, and --in-place reads no "
            "more of a file than it needs",
            _FAILED,
        )
    except BrokenPipeError:
        # Whoever reads has had enough; nothing is to be said at the end, either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return _FAILED
    except (OSError, ValueError, RuntimeError) as error:
        return _say(error, _FAILED)
    except KeyboardInterrupt:
        return _INTERRUPTED


def _finished(status: int) -> int:
    """The status, once all is printed: a full disk tells only then."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        raise
    except OSError:
        # Python would say it once more at the end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        print(
            "neuralmesh: the standard output cannot be written: is the disk full?", file=sys.stderr
        )
        return status if status > 128 or status == WRONG_USE else _FAILED
    return status


def _say(message: object, status: int) -> int:
    print(f"neuralmesh: {message}", file=sys.stderr)
    return _finished(status)
