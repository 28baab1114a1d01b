# SPDX-License-Identifier: BSD-3-Clause
"""Points as people have them, as a VTK dataset."""

from __future__ import annotations

from typing import overload

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPointSet, vtkPolyData


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
    array = _as_array(points)
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
    array = _array_of_points(point_set, values, parameter, ())
    return _with(point_set, array, name), name


def with_normals(dataset: vtkPointSet | vtkCompositeDataSet, normals: object) -> vtkPointSet:
    """A copy of the dataset that refers to the points and has these normals. ValueError for anything
    but numbers of shape (N, 3).
    """
    point_set = _one_block(dataset, "normals", "given with the blocks")
    array = _array_of_points(point_set, normals, "normals", (3,))
    copy = _with(point_set, array, "Normals")
    copy.GetPointData().SetActiveNormals("Normals")
    return copy


def _one_block(
    dataset: vtkPointSet | vtkCompositeDataSet, parameter: str, other: str
) -> vtkPointSet:
    if not isinstance(dataset, vtkPointSet):
        raise ValueError(f"{parameter} must be {other} where points are in blocks")
    return dataset


def _array_of_points(
    dataset: vtkPointSet, values: object, parameter: str, shape: tuple[int, ...]
) -> np.ndarray:
    array = np.asarray(values)
    wanted = (dataset.GetNumberOfPoints(), *shape)
    if array.shape != wanted or array.dtype.kind not in "fiub":
        named = "the name of a point array or " if not shape else ""
        raise ValueError(
            f"{parameter} must be {named}numbers of shape {wanted}, not "
            f"{type(values).__name__} of shape {array.shape} and type {array.dtype}"
        )
    return array


def _with(dataset: vtkPointSet, array: np.ndarray, name: str) -> vtkPointSet:
    # Whole numbers stay so where they name something: they are not to be averaged on the mesh.
    kind = np.int64 if name == "View" and array.dtype.kind in "iub" else np.float64
    vtk_array = numpy_to_vtk(np.ascontiguousarray(array, dtype=kind))
    vtk_array.SetName(name)
    copy = dataset.NewInstance()
    copy.ShallowCopy(dataset)
    copy.GetPointData().AddArray(vtk_array)
    return copy


def _as_array(points: object) -> np.ndarray:
    if isinstance(points, np.ma.MaskedArray):
        # Masked points are not there.
        points = np.ma.filled(points.astype(float), np.nan)
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
