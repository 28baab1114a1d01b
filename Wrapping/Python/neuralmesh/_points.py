# SPDX-License-Identifier: BSD-3-Clause
"""Points as people have them, as a VTK dataset."""

from __future__ import annotations

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPointSet, vtkPolyData


def as_dataset(points: object, blocks: bool = True) -> vtkPointSet | vtkCompositeDataSet:
    """The dataset itself, or a vtkPolyData that refers to the coordinates of the array.

    Without blocks, composite datasets are not taken.

    Arrays of 4-byte floats stay so; all other numbers become 8-byte floats. ValueError for
    anything but numbers of shape (N, 3).
    """
    if isinstance(points, (vtkPointSet, vtkCompositeDataSet) if blocks else vtkPointSet):
        return points
    array = _as_array(points)
    vtk_points = vtkPoints()
    # The VTK array keeps the coordinates alive.
    vtk_points.SetData(numpy_to_vtk(array))
    dataset = vtkPolyData()
    dataset.SetPoints(vtk_points)
    return dataset


def with_weights(dataset: vtkPointSet | vtkCompositeDataSet, weights: object) -> tuple:
    """The dataset and the name of its array of weights; where they are an array, in a copy that
    refers to the points. ValueError for anything but numbers of shape (N,).
    """
    if isinstance(weights, str):
        return dataset, weights
    if not isinstance(dataset, vtkPointSet):
        raise ValueError("weights must be the name of a point array where points are in blocks")
    array = np.asarray(weights)
    count = dataset.GetNumberOfPoints()
    if array.shape != (count,) or array.dtype.kind not in "fiub":
        raise ValueError(
            f"weights must be the name of a point array or numbers of shape ({count},), not "
            f"{type(weights).__name__} of shape {array.shape} and type {array.dtype}"
        )
    vtk_array = numpy_to_vtk(np.ascontiguousarray(array, dtype=np.float64))
    vtk_array.SetName("Weights")
    copy = dataset.NewInstance()
    copy.ShallowCopy(dataset)
    copy.GetPointData().AddArray(vtk_array)
    return copy, "Weights"


def _as_array(points: object) -> np.ndarray:
    wanted = "points must be a vtkPointSet or an array of numbers of shape (N, 3)"
    try:
        array = np.asarray(points)
    except ValueError as error:
        raise ValueError(f"{wanted}, not {type(points).__name__}: {error}") from None
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "fiu":
        raise ValueError(
            f"{wanted}, not {type(points).__name__} of shape {array.shape} and type {array.dtype}"
        )
    single = array.dtype.kind == "f" and array.dtype.itemsize == 4
    return np.ascontiguousarray(array, dtype=np.float32 if single else np.float64)
