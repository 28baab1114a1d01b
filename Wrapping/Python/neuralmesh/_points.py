# SPDX-License-Identifier: BSD-3-Clause
"""Points as people have them, as a VTK dataset."""

from __future__ import annotations

from typing import overload

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPointSet, vtkPolyData

from ._arrays import as_points, kind_of_numbers, values_of_points


@overload
def as_dataset(points: vtkPointSet | np.ndarray, blocks: bool = True) -> vtkPointSet: ...


@overload
def as_dataset(points: object, blocks: bool = True) -> vtkPointSet | vtkCompositeDataSet: ...


def as_dataset(points: object, blocks: bool = True) -> vtkPointSet | vtkCompositeDataSet:
    """The dataset itself, or a vtkPolyData that refers to the coordinates of the array.

    Without blocks, composite datasets are not taken.

    Arrays of 4-byte floats stay so; all other numbers become 8-byte floats. ValueError for
    anything but numbers of shape (N, 3).
    """
    if isinstance(points, (vtkPointSet, vtkCompositeDataSet) if blocks else vtkPointSet):
        return points
    array = as_points(points)
    vtk_points = vtkPoints()
    # The VTK array keeps the coordinates alive.
    vtk_points.SetData(numpy_to_vtk(array))
    dataset = vtkPolyData()
    dataset.SetPoints(vtk_points)
    return dataset


def with_array(
    dataset: vtkPointSet | vtkCompositeDataSet, values: object, parameter: str, name: str
) -> tuple:
    """The dataset and the name of an array of it that a parameter gives; where the parameter is an
    array, in a copy that refers to the points. ValueError for anything but numbers of shape (N,).
    """
    if isinstance(values, str):
        return dataset, values
    point_set = _one_block(dataset, parameter, "the name of a point array")
    array = values_of_points(values, point_set.GetNumberOfPoints(), parameter, ())
    return _with(point_set, array, name), name


def with_normals(dataset: vtkPointSet | vtkCompositeDataSet, normals: object) -> vtkPointSet:
    """A copy of the dataset that refers to the points and has these normals. ValueError for anything
    but numbers of shape (N, 3).
    """
    point_set = _one_block(dataset, "normals", "given with the blocks")
    array = values_of_points(normals, point_set.GetNumberOfPoints(), "normals", (3,))
    copy = _with(point_set, array, "Normals")
    copy.GetPointData().SetActiveNormals("Normals")
    return copy


def _one_block(
    dataset: vtkPointSet | vtkCompositeDataSet, parameter: str, other: str
) -> vtkPointSet:
    if not isinstance(dataset, vtkPointSet):
        raise ValueError(f"{parameter} must be {other} where points are in blocks")
    return dataset


def _with(dataset: vtkPointSet, array: np.ndarray, name: str) -> vtkPointSet:
    values: np.ndarray = np.ascontiguousarray(array, dtype=kind_of_numbers(name, array))
    vtk_array = numpy_to_vtk(values)
    vtk_array.SetName(name)
    copy = dataset.NewInstance()
    copy.ShallowCopy(dataset)
    copy.GetPointData().AddArray(vtk_array)
    return copy
