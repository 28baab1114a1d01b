# SPDX-License-Identifier: BSD-3-Clause
"""vtkNeuralMesh and vtkNeuralMeshEnsemble for any VTK."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _engine
from .algorithm import NeuralMeshAlgorithm
from .cloud import Cloud, as_cloud, numbers_of
from .mesh import Mesh
from .reconstruction import NeuralMesh, NeuralMeshEnsemble, Outcome
from .vtk_algorithm import fill_table, vtkEngineAlgorithm
from .vtk_arrays import named
from .vtk_growth import Growth, hold_time, offer_steps, step_of
from .vtk_names import (
    PACKAGE,
    vtkAlgorithm,
    vtkCommand,
    vtkCompositeDataSet,
    vtkDataObject,
    vtkDemandDrivenPipeline,
    vtkImageData,
    vtkLogger,
    vtkMultiBlockDataSet,
    vtkPolyData,
    vtkStreamingDemandDrivenPipeline,
    vtkTable,
)

_CANCELLED = "cancelled"
_POINT_SETS = ("vtkPointSet", "vtkCompositeDataSet")
# Field data that is about a mesh: that of the input, which VTK passes on, is not about this one.
_REPORT = (
    "Residual", "Noise", "SharedNoise", "OutlierShare", "RegularRatio", "TriangleQuality", "Components",
    "Genus", "BoundaryLoops", "FoldedEdges", "IntersectingTriangles", "NarrowHandles", "FitRoundsTakenBack",
    "ChosenParameters", "ReasonsOfChoice", "OutlierPoints", "SmallPiecePoints", "UnreachablePoints",
    "UnexplainedPoints", "UnexplainedShare", "Warnings",
)  # fmt: skip


class vtkNeuralMeshAlgorithm(vtkEngineAlgorithm, NeuralMeshAlgorithm):
    """The parameters of learning, for the filters that learn meshes."""

    def CheckParameters(self) -> bool:
        """Whether the properties go together. If not, an error says what does."""
        problems = self.parameter_errors()
        for text in problems:
            self._error(text)
        return not problems


class vtkNeuralMesh(vtkNeuralMeshAlgorithm, NeuralMesh):
    """Triangle mesh with a given number of vertices from a raw point cloud, by learning.

    Input port 0 takes a vtkPointSet, or a composite dataset whose point sets are one cloud. Port 1, optional,
    takes the first mesh. Outputs are the mesh, the learning curve as a vtkTable, the explained points, the
    feature lines, and the levels as a vtkMultiBlockDataSet.
    """

    _INPUTS: tuple[tuple[str, ...], ...] = (_POINT_SETS, ("vtkPolyData",))
    _OUTPUTS: tuple[str, ...] = (
        "vtkPolyData", "vtkTable", "vtkPolyData", "vtkPolyData", "vtkMultiBlockDataSet",
    )  # fmt: skip
    _OPTIONAL_INPUTS = True
    _EXPLANATION_PORT = 2  # feature lines and levels follow
    SnapshotEvent = vtkCommand.UserEvent + 2004

    def __init__(self, **properties: Any) -> None:
        vtkNeuralMeshAlgorithm.__init__(self)
        self._begin_values()
        self._growth = Growth()
        self._set(properties)

    def _begin_values(self) -> None:
        NeuralMesh.__init__(self)

    def SetFirstMeshConnection(self, port: Any) -> None:
        """The triangles from which learning starts, input port 1."""
        self.SetInputConnection(1, port)

    def SetFirstMeshData(self, mesh: Any) -> None:
        """The same as data."""
        self.SetInputData(1, mesh)

    def GetFirstMesh(self) -> Any:
        """None if there is none."""
        return self.GetInput(1)

    def GetLearningCurve(self) -> Any:
        """Output port 1, a vtkTable."""
        return self.GetOutputDataObject(1)

    def GetExplainedPoints(self) -> Any:
        """Output port 2, of an ensemble port 4; empty without ExplainPoints."""
        return self.GetOutputDataObject(self._EXPLANATION_PORT)

    def GetFeatureLines(self) -> Any:
        """Output port 3, of an ensemble port 5; empty without ComputeFeatureLines."""
        return self.GetOutputDataObject(self._EXPLANATION_PORT + 1)

    def GetLevels(self) -> Any:
        """Output port 4: a block for each level, in their order; empty without levels. None of an ensemble."""
        port = self._EXPLANATION_PORT + 2
        return self.GetOutputDataObject(port) if port < len(self._OUTPUTS) else None

    def SetWeightArrayName(self, name: str | None) -> None:
        """The point array of weights: the same as SetInputArrayToProcess(0, 0, 0, POINTS, name)."""
        if name:
            self.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, name)
        elif self._weight_information() is not None:
            self.GetInformation().Remove(vtkAlgorithm.INPUT_ARRAYS_TO_PROCESS())
            self.Modified()

    def GetWeightArrayName(self) -> str:
        """Empty if there is none."""
        array = self._weight_information()
        return (array and array.Get(vtkDataObject.FIELD_NAME())) or ""

    def _weight_information(self) -> Any:
        arrays = self.GetInformation().Get(vtkAlgorithm.INPUT_ARRAYS_TO_PROCESS())
        return arrays.GetInformationObject(0) if arrays else None

    def _weights(self, cloud: Cloud) -> np.ndarray | None:
        information = self._weight_information()
        if information is None:
            return None
        weights = numbers_of([_weights_of(block, information) for block in cloud.blocks])
        if weights is None:
            name = self.GetWeightArrayName()
            called = "called " if name else ""
            raise ValueError(
                f"There is no numeric point array of one component {called}{name} for the weights."
            )
        return weights

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Offers the time steps of growth."""
        if self.GetGrowthAsTime():
            offer_steps(self.GetNumberOfSnapshots(), outputs)
        return 1

    def RequestUpdateExtent(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Holds the time of the inputs, where that of the output is growth."""
        for port in inputs if self.GetGrowthAsTime() else ():
            hold_time(port)
        return 1

    def ProcessRequest(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Learns, unless what is asked for is another time step of the growth that is there."""
        if not request.Has(vtkDemandDrivenPipeline.REQUEST_DATA()):
            return super().ProcessRequest(request, inputs, outputs)
        time = self.GetExecutive().GetPipelineMTime()
        if not self.GetGrowthAsTime() or not self._growth.has(time):
            self._growth = Growth()
            if not self._execute(inputs, outputs):
                return 0
            if not self.GetGrowthAsTime() or self.GetStopReason() == _CANCELLED:
                return 1
            self._growth.keep(outputs, time)
        self._growth.show(step_of(request, self.GetNumberOfSnapshots(), outputs), outputs)
        return 1

    def _execute(self, inputs: Any, outputs: Any) -> int:
        has_input = inputs[0].GetNumberOfInformationObjects() > 0
        if has_input == bool(self.GetPointFileName()):
            self._error(
                "There are both an input and a PointFileName."
                if has_input
                else "There is neither an input nor a PointFileName."
            )
            return 0
        self._stop_reason, self._resumed_iterations, self._times = "none", 0, {}
        if not self.CheckParameters():
            return 0
        try:
            outcome = self._learn(inputs, has_input)
        except (ValueError, RuntimeError, MemoryError) as error:
            self._error(str(error))
            return 0
        self._obey_abort()
        self._fill(outcome, outputs)
        return 1

    def _learn(self, inputs: Any, has_input: bool) -> Outcome:
        has_first = len(inputs) > 1 and inputs[1].GetNumberOfInformationObjects() > 0
        first = self._surface(inputs, 1) if has_first else None
        is_watched = self.GetGrowthAsTime() or self.HasObserver(self.SnapshotEvent)
        take = self._take_snapshot if is_watched else None
        if not has_input:
            return self.run_on_file(first, self._progress(), take_snapshot=take, tell=self._tell)
        cloud = as_cloud(vtkDataObject.GetData(inputs[0]))
        return self.run(cloud, first, self._progress(), take, self._tell)

    def _take_snapshot(self, snapshot: Mesh) -> None:
        if self.HasObserver(self.SnapshotEvent):
            self.InvokeEvent(self.SnapshotEvent, snapshot.to_vtk_of(PACKAGE))
        if self.GetGrowthAsTime():
            self._growth.add(snapshot)

    def _tell(self, kind: str, text: str) -> None:
        if kind == "warning":
            self._warn(text)
        elif kind == "step":
            self.SetProgressText(text)
        else:
            separator = " " if text.startswith("has chosen ") else ": "
            said = type(self).__name__ + separator + text
            vtkLogger.Log(vtkLogger.VERBOSITY_INFO, __file__, 0, said)

    def _fill(self, outcome: Outcome, outputs: Any) -> None:
        if not outcome.is_drawn:
            return
        fill_table(vtkTable.GetData(outputs, 1), outcome.curve or _engine.empty_curve())
        if not outcome.mesh.field_data:
            return
        output = vtkPolyData.GetData(outputs, 0)
        for name in _REPORT:
            output.GetFieldData().RemoveArray(name)
        outcome.mesh.fill(output)
        if outcome.explained is not None and outcome.explained.point_data:
            outcome.explained.fill(vtkPolyData.GetData(outputs, self._EXPLANATION_PORT))
        if outcome.feature_lines is not None:
            outcome.feature_lines.fill(vtkPolyData.GetData(outputs, self._EXPLANATION_PORT + 1))
        if self.GetNumberOfLevels() > 0:
            self._fill_levels(outcome, outputs)

    def _fill_levels(self, outcome: Outcome, outputs: Any) -> None:
        meshes = [level.to_vtk_of(PACKAGE) for level in outcome.smaller_levels]
        if self.GetStopReason() != _CANCELLED:
            largest = vtkPolyData()
            largest.ShallowCopy(vtkPolyData.GetData(outputs, 0))
            meshes.append(largest)
        levels = vtkMultiBlockDataSet.GetData(outputs, self._EXPLANATION_PORT + 2)
        for number, mesh in enumerate(meshes):
            levels.SetBlock(number, mesh)
            name = f"{mesh.GetNumberOfPoints()} vertices"
            levels.GetMetaData(number).Set(vtkCompositeDataSet.NAME(), name)


def _weights_of(block: Any, information: Any) -> np.ndarray | None:
    """The array of a point set that SetInputArrayToProcess() has named; None if there is none."""
    data = block.dataset.GetPointData()
    if information.Has(vtkDataObject.FIELD_NAME()):
        array = data.GetArray(information.Get(vtkDataObject.FIELD_NAME()))
    else:
        array = data.GetAttribute(information.Get(vtkDataObject.FIELD_ATTRIBUTE_TYPE()))
    is_whole = array and array.GetNumberOfTuples() == block.dataset.GetNumberOfPoints()
    return block.of_points(array) if is_whole else None


class vtkNeuralMeshEnsemble(vtkNeuralMesh, NeuralMeshEnsemble):
    """Triangle mesh of a wanted size and the right topology, by an ensemble of meshes.

    Inputs and outputs are those of vtkNeuralMesh, without a first mesh; output port 2 is the average mesh,
    port 3 the votes as a vtkImageData.
    """

    _INPUTS = (_POINT_SETS,)
    _OUTPUTS = (
        "vtkPolyData", "vtkTable", "vtkPolyData", "vtkImageData", "vtkPolyData", "vtkPolyData",
    )  # fmt: skip
    _EXPLANATION_PORT = 4

    def _begin_values(self) -> None:
        NeuralMeshEnsemble.__init__(self)

    def GetAverageMesh(self) -> Any:
        """Output port 2."""
        return self.GetOutputDataObject(2)

    def GetVotes(self) -> Any:
        """Output port 3, a vtkImageData."""
        return self.GetOutputDataObject(3)

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Says how large the votes are."""
        last = _engine.grid_count(self.GetGridResolution()) - 1
        extent = (0, last) * 3
        key = vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT()
        outputs.GetInformationObject(3).Set(key, extent, 6)
        return super().RequestInformation(request, inputs, outputs)

    def _fill(self, outcome: Outcome, outputs: Any) -> None:
        super()._fill(outcome, outputs)
        if not outcome.is_drawn:
            return
        votes = vtkImageData.GetData(outputs, 3)
        count = _engine.grid_count(self.GetGridResolution())
        votes.SetDimensions(count, count, count)
        values = np.zeros(count**3, dtype=np.float32)
        if outcome.votes:
            votes.SetOrigin(outcome.votes["origin"])
            votes.SetSpacing(*[outcome.votes["spacing"]] * 3)
            values = outcome.votes["values"]
        votes.GetPointData().SetScalars(named(values, "Votes", PACKAGE))
        if outcome.average is not None:
            outcome.average.fill(vtkPolyData.GetData(outputs, 2))
