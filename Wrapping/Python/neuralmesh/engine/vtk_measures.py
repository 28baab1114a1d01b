# SPDX-License-Identifier: BSD-3-Clause
"""vtkNeuralMeshComparison and its sisters that do not learn, for any VTK."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .._info import FIGURES
from .cloud import as_cloud
from .file_sampler import NeuralMeshFileSampler
from .measures import (
    DIRECTIONS,
    Comparison,
    NeuralMeshComparison,
    NeuralMeshExplanation,
    report,
)
from .scan import NeuralMeshScan
from .vtk_algorithm import fill_table, vtkEngineAlgorithm
from .vtk_arrays import field_array, named, table_column, vtk_points
from .vtk_names import PACKAGE, vtkDataObject, vtkPolyData, vtkTable


_THRESHOLDS = ("0_1", "0_5")


class vtkNeuralMeshComparison(vtkEngineAlgorithm, NeuralMeshComparison):
    """How far a mesh is from a reference, over the surfaces and both ways.

    Input port 0 takes the mesh, port 1 the reference. Outputs are both with the point data `Distance`,
    and a vtkTable of the figures, a row for each direction. Its field data are the figures of both
    directions together.
    """

    _INPUTS = (("vtkPolyData",), ("vtkPolyData",))
    _OUTPUTS = ("vtkPolyData", "vtkPolyData", "vtkTable")
    REFERENCE_TO_RESULT, RESULT_TO_REFERENCE = 0, 1
    TENTH_PERCENT, HALF_PERCENT = 0, 1

    def __init__(self, **properties: Any) -> None:
        vtkEngineAlgorithm.__init__(self)
        NeuralMeshComparison.__init__(self)
        self._found: Comparison | None = None
        self._set(properties)

    def SetReferenceConnection(self, port: Any) -> None:
        """The reference, input port 1."""
        self.SetInputConnection(1, port)

    def SetReferenceData(self, reference: Any) -> None:
        """The same as data."""
        self.SetInputData(1, reference)

    def GetReferenceOutput(self) -> Any:
        """Output port 1."""
        return self.GetOutputDataObject(1)

    def GetTableOutput(self) -> Any:
        """Output port 2."""
        return self.GetOutputDataObject(2)

    def _figure(self, name: str, direction: int) -> float:
        if self._found is None or not 0 <= direction < len(DIRECTIONS):
            return math.nan
        return self._found.table[name][direction]

    def _of_both_ways(self, name: str) -> float:
        return self._found.both_ways[name] if self._found is not None else math.nan

    def _score(self, name: str, threshold: int) -> float:
        if not 0 <= threshold < len(_THRESHOLDS):
            return math.nan
        return self._of_both_ways(name + _THRESHOLDS[threshold])

    def GetMean(self, direction: int) -> float:
        """A figure of the last run, in units of the input, as the next ones; NaN if there is none."""
        return self._figure("Mean", direction)

    def GetRMS(self, direction: int) -> float:
        """Root of the mean square."""
        return self._figure("RMS", direction)

    def GetPercentile99(self, direction: int) -> float:
        """The distance that 99 % of the samples do not exceed."""
        return self._figure("Percentile99", direction)

    def GetMaximum(self, direction: int) -> float:
        """The largest distance found."""
        return self._figure("Maximum", direction)

    def GetNormalAngle(self, direction: int | None = None) -> float:
        """Mean angle between normals, in degrees; of both directions where none is given."""
        if direction is None:
            return self._of_both_ways("NormalAngle")
        return self._figure("NormalAngle", direction)

    def GetNormalConsistency(self, direction: int | None = None) -> float:
        """Mean of |n . n'| of the normals; of both directions where none is given."""
        if direction is None:
            return self._of_both_ways("NormalConsistency")
        return self._figure("NormalConsistency", direction)

    def GetEdgeLength(self, direction: int) -> float:
        """Length of the sharp edges of the surface from which the direction starts."""
        return self._figure("EdgeLength", direction)

    def GetEdgeMean(self, direction: int) -> float:
        """Mean distance of sharp edges from the nearest ones of the other surface; NaN without any."""
        return self._figure("EdgeMean", direction)

    def GetEdgeToSurface(self, direction: int) -> float:
        """Mean distance of sharp edges from the other surface, wherever; NaN without any."""
        return self._figure("EdgeToSurface", direction)

    def GetChamferDistance(self) -> float:
        """Half of the sum of both means."""
        return self._of_both_ways("Chamfer")

    def GetSquaredChamferDistance(self) -> float:
        """The sum of both mean squares."""
        return self._of_both_ways("ChamferSquared")

    def GetHausdorffDistance(self) -> float:
        """The larger maximum."""
        return self._of_both_ways("Hausdorff")

    def GetPrecision(self, threshold: int) -> float:
        """Part of the result that is nearer to the reference than 0.1 or 0.5 % of its diagonal."""
        return self._score("Precision", threshold)

    def GetRecall(self, threshold: int) -> float:
        """Part of the reference that is nearer to the result than that."""
        return self._score("Recall", threshold)

    def GetFScore(self, threshold: int) -> float:
        """The harmonic mean of both."""
        return self._score("FScore", threshold)

    def GetEdgeChamferDistance(self) -> float:
        """Half of the sum of both means of the edges; NaN if one of the surfaces has none."""
        return self._of_both_ways("EdgeChamfer")

    def GetReferenceDiagonal(self) -> float:
        """That of the bounding box of the reference, to which percentages refer."""
        return self._found.diagonal if self._found is not None else math.nan

    def _advance(self, fraction: float) -> bool:
        self.UpdateProgress(fraction)
        return not (self.CheckAbort() if hasattr(self, "CheckAbort") else self.GetAbortExecute())

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Compares."""
        self._found = None
        surfaces = [vtkPolyData.GetData(inputs[port]) for port in (0, 1)]
        result, reference = (self._surface(inputs, port) for port in (0, 1))
        if all(one.GetNumberOfPoints() == 0 and one.GetNumberOfCells() == 0 for one in surfaces):
            return 1
        try:
            found = self.compare(reference, result, self._advance)
        except (ValueError, RuntimeError, MemoryError) as error:
            self._error(str(error))
            return 0
        if found is None:
            return 1
        self._found = found
        distances = (found.result_distances, found.reference_distances)
        for port, (surface, values) in enumerate(zip(surfaces, distances)):
            output = vtkPolyData.GetData(outputs, port)
            output.ShallowCopy(surface)
            output.GetPointData().AddArray(named(values, "Distance", PACKAGE))
            output.GetPointData().SetActiveScalars("Distance")
        table = {"Direction": list(DIRECTIONS), **found.table}
        output = vtkTable.GetData(outputs, 2)
        fill_table(output, table)
        for name, figure in found.both_ways.items():
            output.GetFieldData().AddArray(field_array(figure, name, PACKAGE))
        return 1


class vtkNeuralMeshExplanation(vtkEngineAlgorithm, NeuralMeshExplanation):
    """How far each point of a cloud is from a mesh, whatever made that, and why.

    Input port 0 takes the cloud, port 1 the mesh.
    """

    _INPUTS = (("vtkPointSet", "vtkCompositeDataSet"), ("vtkPolyData",))

    def __init__(self, **properties: Any) -> None:
        vtkEngineAlgorithm.__init__(self)
        NeuralMeshExplanation.__init__(self)
        self._set(properties)

    def SetMeshConnection(self, port: Any) -> None:
        """The mesh, input port 1."""
        self.SetInputConnection(1, port)

    def SetMeshData(self, mesh: Any) -> None:
        """The same as data."""
        self.SetInputData(1, mesh)

    def GetMesh(self) -> Any:
        """None if there is none."""
        return self.GetInput(1)

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Explains."""
        cloud = as_cloud(vtkDataObject.GetData(inputs[0]))
        if len(cloud) == 0:
            return 1
        try:
            explained = self.explain(cloud, self._surface(inputs, 1), self._progress())
        except (ValueError, RuntimeError, MemoryError) as error:
            self._error(str(error))
            return 0
        if explained is not None:
            explained.fill(vtkPolyData.GetData(outputs))
        return 1


class vtkNeuralMeshScan(vtkEngineAlgorithm, NeuralMeshScan):
    """The point cloud that a scan of a surface might give, with noise, outliers, holes and shadows."""

    def __init__(self, **properties: Any) -> None:
        vtkEngineAlgorithm.__init__(self)
        NeuralMeshScan.__init__(self)
        self._set(properties)

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Scans."""
        data = vtkPolyData.GetData(inputs[0])
        if data.GetNumberOfPoints() == 0 and data.GetNumberOfCells() == 0:
            return 1
        try:
            cloud = self.scan(self._surface(inputs, 0), self._progress())
        except (ValueError, RuntimeError, MemoryError) as error:
            self._error(str(error))
            return 0
        self._obey_abort()
        cloud.fill(vtkPolyData.GetData(outputs))
        return 1


class vtkNeuralMeshFileSampler(vtkEngineAlgorithm, NeuralMeshFileSampler):
    """Some points of a file that may be larger than the memory, drawn at random."""

    _INPUTS = ()

    def __init__(self, **properties: Any) -> None:
        vtkEngineAlgorithm.__init__(self)
        NeuralMeshFileSampler.__init__(self)
        self._set(properties)

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Draws."""
        try:
            block = self.draw(self._progress())
        except (ValueError, RuntimeError, MemoryError) as error:
            self._error(str(error))
            return 0
        self._obey_abort()
        if block is None:
            return 1
        output = vtkPolyData.GetData(outputs)
        output.SetPoints(vtk_points(block.points, PACKAGE))
        if block.scalars:
            output.GetPointData().SetScalars(
                named(block.data[block.scalars], block.scalars, PACKAGE)
            )
        if block.normals is not None:
            output.GetPointData().SetNormals(named(block.normals, "Normals", PACKAGE))
        return 1


class vtkNeuralMeshInformation(vtkEngineAlgorithm):
    """Whether a mesh is sound, and how good its triangles are: the input with a report as field data."""

    def __init__(self, **properties: Any) -> None:
        vtkEngineAlgorithm.__init__(self)
        self._set(properties)

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Reports."""
        try:
            found = report(self._surface(inputs, 0))
        except (ValueError, RuntimeError, MemoryError) as error:
            self._error(str(error))
            return 0
        output = vtkPolyData.GetData(outputs)
        output.ShallowCopy(vtkPolyData.GetData(inputs[0]))
        fields = output.GetFieldData()
        # The input may bring those of an earlier report along.
        fields.RemoveArray("Genus")
        fields.RemoveArray("Volume")
        for figure in FIGURES:
            name = "".join(word.capitalize() for word in figure.split("_"))
            value = found.get(figure)
            if isinstance(value, dict):
                pairs = np.array(list(value.items()), dtype=np.int64).reshape(-1, 2)
                fields.AddArray(table_column(pairs, name, PACKAGE))
            elif isinstance(value, bool):
                fields.AddArray(named(np.array([value], dtype=np.uint8), name, PACKAGE))
            elif value is not None:
                fields.AddArray(field_array(value, name, PACKAGE))
        return 1
