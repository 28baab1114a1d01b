# SPDX-License-Identifier: BSD-3-Clause
"""What the commands that are Python have in common."""

from __future__ import annotations

import argparse
import signal
import sys
from typing import Callable

from ._world import NeuralMesh

_INTERRUPTED = 128 + signal.SIGINT


def run_command(command: Callable[[], int], bad_input: type[Exception]) -> int:
    """Run a command whose work goes on where it was ended; its exit status.

    1 after an OSError, 2 after a `bad_input`, each told on stderr.
    """
    # However the command is told to end, its processes end first.
    signal.signal(signal.SIGTERM, lambda number, _frame: sys.exit(128 + number))
    try:
        return command()
    except bad_input as error:
        return _say(error, 2)
    except OSError as error:
        return _say(words_of(error), 1)
    except KeyboardInterrupt:
        return _say("interrupted; the same command does the rest", _INTERRUPTED)


def words_of(error: Exception) -> str:
    """What went wrong; what the system says stands without its number."""
    if not isinstance(error, OSError) or not error.strerror:
        return str(error) or type(error).__name__
    why = error.strerror[0].lower() + error.strerror[1:]
    return f"{error.filename}: {why}" if error.filename else why


def _say(message: object, status: int) -> int:
    print(f"neuralmesh: {message}", file=sys.stderr)
    return status


def add_processes_option(parser: argparse.ArgumentParser, what: str) -> None:
    """Add --processes: the number of `what` (jobs, runs) that are done at a time."""
    parser.add_argument(
        "--processes",
        type=_count,
        default=NeuralMesh.GetNumberOfAvailableProcessors(),
        metavar="N",
        help=f"how many {what} at a time (default: as many as there are processors, %(default)s)",
    )


def _count(text: str) -> int:
    number = int(text)
    if not 1 <= number <= 1024:
        raise argparse.ArgumentTypeError(f"{text} is not from 1 to 1024")
    return number
