# SPDX-License-Identifier: BSD-3-Clause
"""Runs a VTK filter as a function: errors are raised, warnings issued, and Ctrl-C ends it."""

from __future__ import annotations

import contextlib
import signal
import threading
from typing import TYPE_CHECKING, Callable, Iterator, TypeVar

import numpy as np
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from ._types import Progress
from ._warning import warn

if TYPE_CHECKING:
    from .vtkFiltersNeuralMesh import vtkNeuralMeshAlgorithm

Result = TypeVar("Result")


def execute(algorithm: vtkAlgorithm, progress: Progress | None = None) -> None:
    """Update the filter; VTK prints nothing.

    progress is called with fractions from 0 to 1; if it returns False, the filter ends.
    What it raises, or what a handler of Ctrl-C raises, ends the filter and is raised again. Errors
    of the filter, which concern its input, are ValueErrors; other errors of the pipeline are
    RuntimeErrors. Warnings are RuntimeWarnings.
    """
    execution = _Execution(algorithm, progress)
    with execution.observed(), _guarded_interrupts(execution.call):
        algorithm.Update()
    execution.report()


def observed_call(
    algorithm: vtkAlgorithm,
    progress: Progress | None,
    function: Callable[..., Result],
    *arguments: object,
) -> Result:
    """Call a method of a filter of this package that reports as an update does; its result."""
    execution = _Execution(algorithm, progress)
    with execution.observed(), _guarded_interrupts(execution.call):
        result = function(*arguments)
    execution.report()
    return result


def check_parameters(algorithm: vtkNeuralMeshAlgorithm) -> None:
    """Raise ValueError if the properties of a filter of this package exclude each other."""
    execution = _Execution(algorithm, None)
    # What a handler of Ctrl-C raises in an observer would end the process.
    with execution.observed(), _guarded_interrupts(execution.call):
        algorithm.CheckParameters()
    execution.report()


class _Execution:
    """Observes a filter while it runs. No exception may pass through VTK."""

    def __init__(self, algorithm: vtkAlgorithm, progress: Progress | None):
        self._algorithm = algorithm
        self._progress = progress
        self._raised: BaseException | None = None
        self._input_errors: list[str] = []
        self._other_errors: list[str] = []
        self._warnings: list[str] = []

    @contextlib.contextmanager
    def observed(self) -> Iterator[None]:
        executive = self._algorithm.GetExecutive()
        observers = [
            # Also without a function to call: handlers of signals run when Python code does.
            (self._algorithm, "ProgressEvent", self._on_progress),
            (self._algorithm, "ErrorEvent", self._on_error),
            (self._algorithm, "WarningEvent", self._on_warning),
            (executive, "ErrorEvent", self._on_error),
            (executive, "WarningEvent", self._on_warning),
        ]
        tags = [(sender, sender.AddObserver(*observer)) for sender, *observer in observers]
        try:
            yield
        finally:
            for sender, tag in tags:
                sender.RemoveObserver(tag)
            self._algorithm.SetAbortExecute(0)

    def call(self, function: Callable, *arguments: object) -> object:
        """Call the function; if it raises, end the filter, and keep the first exception."""
        try:
            return function(*arguments)
        except BaseException as error:
            self._raised = self._raised or error
            self._algorithm.SetAbortExecute(1)
            return None

    def report(self) -> None:
        if self._raised is not None:
            raise self._raised
        for text in self._warnings:
            warn(text)
        if self._input_errors:
            raise ValueError(" ".join(self._input_errors))
        if self._other_errors:
            raise RuntimeError(" ".join(self._other_errors))

    def _on_progress(self, algorithm: vtkAlgorithm, _event: str) -> None:
        # Sends nothing, but asks for signals: of one that a thread of another library has taken,
        # Python would not know until then.
        signal.raise_signal(0)
        if self._progress is None or self._raised is not None:
            return
        go_on = self.call(self._progress, algorithm.GetProgress())
        if isinstance(go_on, (bool, np.bool_)) and not go_on:
            algorithm.SetAbortExecute(1)

    @calldata_type("string0")
    def _on_error(self, sender: object, _event: str, text: str) -> None:
        errors = self._input_errors if sender is self._algorithm else self._other_errors
        errors.append(_plain_text(text))

    @calldata_type("string0")
    def _on_warning(self, _sender: object, _event: str, text: str) -> None:
        self._warnings.append(_plain_text(text))


@contextlib.contextmanager
def _guarded_interrupts(call: Callable) -> Iterator[None]:
    """Meanwhile, Python's handler of Ctrl-C, if there is one, is called by way of the function."""
    handler = signal.getsignal(signal.SIGINT)
    if not callable(handler) or threading.current_thread() is not threading.main_thread():
        yield
        return
    signal.signal(signal.SIGINT, lambda *arguments: call(handler, *arguments))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)


def _plain_text(message: str) -> str:
    """The text behind VTK's "ERROR: In file, line n" and "vtkClass (address): "."""
    _, separator, text = message.partition("): ")
    return (text if separator else message).strip()
