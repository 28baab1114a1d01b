# SPDX-License-Identifier: BSD-3-Clause
"""How the functions work where the C++ classes of VTK are: by these. engine/world.py has the same names
for where they are not.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCompositeDataSet, vtkPolyData

from ._arrays import as_triangles
from ._both_ways import BOTH_WAYS
from ._execution import Progress, check_parameters, execute, observed_call
from ._kinds import as_given
from ._parameters import snake_case
from ._points import as_dataset as take_points, with_array, with_normals
from .vtkFiltersNeuralMesh import (
    vtkNeuralMesh as NeuralMesh,
    vtkNeuralMeshComparison as NeuralMeshComparison,
    vtkNeuralMeshEnsemble as NeuralMeshEnsemble,
    vtkNeuralMeshExplanation as NeuralMeshExplanation,
    vtkNeuralMeshInformation as NeuralMeshInformation,
    vtkNeuralMeshStream as NeuralMeshStream,
)

__all__ = [
    "NeuralMesh",
    "NeuralMeshComparison",
    "NeuralMeshEnsemble",
    "NeuralMeshExplanation",
    "NeuralMeshStream",
    "add_points",
    "check_parameters",
    "compare",
    "explain",
    "learn",
    "learn_for_seconds",
    "learn_samples",
    "learnt_mesh",
    "report",
    "take_points",
    "take_polygons",
    "take_surface",
    "with_array",
    "with_normals",
]


def take_surface(surface: object, parameter: str) -> vtkPolyData:
    """The surface itself. ValueError if it is no vtkPolyData."""
    if not isinstance(surface, vtkPolyData):
        raise ValueError(f"{parameter} must be a vtkPolyData, not {type(surface).__name__}")
    return surface


def take_polygons(surface: Any, parameter: str) -> vtkPolyData | vtkCompositeDataSet:
    """A surface as a dataset; one of points and triangles. ValueError for anything else."""
    if isinstance(surface, (vtkPolyData, vtkCompositeDataSet)):
        return surface
    if isinstance(surface, tuple) and len(surface) == 2:
        points: Any = take_points(surface[0])
        triangles = as_triangles(surface[1], parameter)
        cells = vtkCellArray()
        corners = np.ascontiguousarray(triangles, dtype=np.int64)
        cells.SetData(3, numpy_to_vtkIdTypeArray(corners.reshape(-1), deep=True))
        points.SetPolys(cells)
        return points
    raise ValueError(
        f"{parameter} must be a vtkPolyData, or a pair of arrays, points and triangles, not "
        f"{type(surface).__name__}"
    )


def learn(
    mesh: NeuralMesh,
    points: Any,
    first_mesh: vtkPolyData | None,
    progress: Progress | None,
    given: object = None,
) -> tuple[Any, Any, Any, list[Any]]:
    """Execute a filter with points, or with its file where there are none; mesh, explained points,
    feature lines and smaller levels.
    """
    if points is not None:
        mesh.SetInputData(points)
    if first_mesh is not None:
        mesh.SetFirstMeshData(first_mesh)
    execute(mesh, progress)
    levels = mesh.GetLevels()
    # The last one is the mesh itself, unless the run was ended early. An ensemble has none.
    there = levels.GetNumberOfBlocks() if levels else 0
    count = min(there, max(mesh.GetNumberOfLevels() - 1, 0))
    return (
        _copy(mesh.GetOutput(), given),
        _copy(mesh.GetExplainedPoints(), given),
        _copy(mesh.GetFeatureLines(), given),
        [_copy(levels.GetBlock(number), given) for number in range(count)],
    )


def add_points(stream: NeuralMeshStream, points: Any) -> None:
    observed_call(stream, None, stream.AddPoints, points)


def learn_samples(stream: NeuralMeshStream, samples: int, progress: Progress | None) -> int:
    return observed_call(stream, progress, stream.Learn, samples)


def learn_for_seconds(stream: NeuralMeshStream, seconds: float, progress: Progress | None) -> int:
    return observed_call(stream, progress, stream.LearnForSeconds, seconds)


def learnt_mesh(stream: NeuralMeshStream, progress: Progress | None, given: object = None) -> Any:
    execute(stream, progress)
    return _copy(stream.GetOutput(), given)


def compare(
    comparison: NeuralMeshComparison, reference: vtkPolyData, result: vtkPolyData
) -> tuple[dict[str, list[Any]], dict[str, float]]:
    """Columns with a row for each direction, and the figures of both directions together; empty if both
    surfaces are empty.
    """
    comparison.SetReferenceData(reference)
    comparison.SetInputData(result)
    execute(comparison)
    table = comparison.GetTableOutput()
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    fields = table.GetFieldData()
    both_ways = {}
    # VTK passes the field data of the first input along.
    if columns:
        both_ways = {name: fields.GetArray(name).GetValue(0) for name in BOTH_WAYS}
    return {
        column.GetName(): [column.GetValue(row) for row in range(table.GetNumberOfRows())]
        for column in columns
        if column.GetName() != "Direction"
    }, both_ways


def report(mesh: vtkPolyData) -> dict[str, Any]:
    """The figures of vtkNeuralMeshInformation that the mesh has, by their names in snake case."""
    bare = vtkPolyData()
    bare.CopyStructure(mesh)
    information = NeuralMeshInformation()
    information.SetInputData(bare)
    execute(information)
    fields = information.GetOutput().GetFieldData()
    arrays = [fields.GetArray(i) for i in range(fields.GetNumberOfArrays())]
    return {snake_case(array.GetName()): _figure(array) for array in arrays}


def _figure(array: Any) -> Any:
    """The figure in a vtkDataArray: a number, a flag, or a dict of numbers."""
    if array.GetNumberOfComponents() == 2:
        pairs = [array.GetTuple2(i) for i in range(array.GetNumberOfTuples())]
        return {int(number): int(count) for number, count in pairs}
    value = array.GetValue(0)
    return bool(value) if array.IsA("vtkUnsignedCharArray") else value


def explain(
    explanation: NeuralMeshExplanation,
    points: Any,
    mesh: vtkPolyData,
    progress: Progress | None,
    given: object = None,
) -> Any:
    explanation.SetInputData(points)
    explanation.SetMeshData(mesh)
    execute(explanation, progress)
    return _copy(explanation.GetOutput(), given)


def _copy(output: vtkPolyData, given: object) -> Any:
    """What a filter has made, without its pipeline."""
    result = vtkPolyData()
    result.ShallowCopy(output)
    return as_given(result, given)
