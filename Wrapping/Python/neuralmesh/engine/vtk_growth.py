# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots of a mesh that grows, as the time steps of a filter."""

from __future__ import annotations

from typing import Any

from .mesh import Mesh
from .vtk_names import vtkDataObject, vtkExecutive, vtkPolyData, vtkStreamingDemandDrivenPipeline

_Pipeline = vtkStreamingDemandDrivenPipeline


class Growth:
    """The snapshots of a run, and its outputs."""

    def __init__(self) -> None:
        self._snapshots: list[Mesh] = []
        self._finished: list[Any] = []
        self._time = 0

    def add(self, snapshot: Mesh) -> None:
        """A snapshot of the run that goes on."""
        self._snapshots.append(snapshot)

    def keep(self, outputs: Any, time: int) -> None:
        """The run is over: these are its outputs, and it was that of the pipeline at this time."""
        self._time = time
        for output in _data_of(outputs):
            kept = output.NewInstance()
            kept.ShallowCopy(output)
            self._finished.append(kept)

    def has(self, time: int) -> bool:
        """Whether there is a whole run of the pipeline at this time."""
        return bool(self._finished) and self._time == time

    def show(self, step: int, outputs: Any) -> None:
        """Put out that run: with the snapshot of this step as the mesh, or the finished one."""
        for output, finished in zip(_data_of(outputs), self._finished):
            output.ShallowCopy(finished)
            output.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), step)
        if step >= len(self._snapshots):
            return
        mesh = vtkPolyData.GetData(outputs, 0)
        seed = mesh.GetFieldData().GetAbstractArray("Seed")
        mesh.Initialize()
        self._snapshots[step].fill(mesh)
        mesh.GetFieldData().AddArray(seed)


def offer_steps(count: int, outputs: Any) -> None:
    """Give the outputs this number of time steps: whole numbers from 0 on."""
    steps = [float(step) for step in range(count)]
    for port in range(outputs.GetNumberOfInformationObjects()):
        output = outputs.GetInformationObject(port)
        output.Set(_Pipeline.TIME_STEPS(), steps, count)
        output.Set(_Pipeline.TIME_RANGE(), [steps[0], steps[-1]], 2)


def step_of(request: Any, count: int, outputs: Any) -> int:
    """Which of them is asked for. Without a time the last one is meant."""
    asked = request.Get(vtkExecutive.FROM_OUTPUT_PORT())
    # Whoever looks at another output without a time leaves the mesh as it is.
    for port in (max(0, asked), 0):
        output = outputs.GetInformationObject(port)
        if output.Has(_Pipeline.UPDATE_TIME_STEP()):
            time = output.Get(_Pipeline.UPDATE_TIME_STEP())
            return int(min(max(time, 0.0), count - 1.0))
    return count - 1


def hold_time(inputs: Any) -> None:
    """The time asked for is that of growth: the inputs stay at the beginning of theirs."""
    for i in range(inputs.GetNumberOfInformationObjects()):
        information = inputs.GetInformationObject(i)
        if information.Length(_Pipeline.TIME_STEPS()) > 0:
            first = information.Get(_Pipeline.TIME_STEPS(), 0)
            information.Set(_Pipeline.UPDATE_TIME_STEP(), first)
        else:
            information.Remove(_Pipeline.UPDATE_TIME_STEP())


def _data_of(outputs: Any) -> list[Any]:
    ports = range(outputs.GetNumberOfInformationObjects())
    return [vtkDataObject.GetData(outputs, port) for port in ports]
