# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of VTK as NumPy arrays and back. VTK is imported where it is needed, not before; its package has
another name where PyVista takes another build of it.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .._kinds import vtk_package_of

if TYPE_CHECKING:
    from vtkmodules.vtkCommonCore import vtkAbstractArray, vtkBitArray, vtkDataArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData


def vtk_module(package: str | None, name: str) -> Any:
    """A module of a package of VTK. ImportError where there is none."""
    return importlib.import_module(f"{package or 'vtkmodules'}.{name}")


def to_numpy(array: vtkAbstractArray) -> np.ndarray:
    """The values, a row for each tuple of several components; where the layout allows, not copied. Texts
    are an array of objects.
    """
    components = array.GetNumberOfComponents()
    if array.IsA("vtkBitArray"):
        bit_array = cast("vtkBitArray", array)
        numbers = [bit_array.GetValue(i) for i in range(bit_array.GetNumberOfValues())]
        bits = np.array(numbers, dtype=np.uint8)
        return bits.reshape(-1, components) if components > 1 else bits
    if not array.IsA("vtkDataArray"):
        values = [array.GetVariantValue(i) for i in range(array.GetNumberOfValues())]
        texts = np.empty(len(values), dtype=object)
        texts[:] = [value.ToString() for value in values]
        return texts.reshape(-1, components) if components > 1 else texts
    if not array.HasStandardMemoryLayout():
        copy = array.NewInstance()
        if not copy.HasStandardMemoryLayout():
            copy = cast("vtkDataArray", array).CreateDataArray(array.GetDataType())
        copy.DeepCopy(array)
        array = copy
    return vtk_module(vtk_package_of(array), "util.numpy_support").vtk_to_numpy(array)


def named(
    values: Any, name: str, package: str | None = None, kind: vtkAbstractArray | None = None
) -> vtkAbstractArray:
    """A VTK array that refers to the values, or, of texts, has them; of the same kind as another one
    where that is given.
    """
    values = np.asarray(values)
    if kind is not None:
        return _of_kind(values, name, kind)
    if values.dtype.kind in "OU":
        array = vtk_module(package, "vtkCommonCore").vtkStringArray()
        array.SetNumberOfComponents(values.shape[1] if values.ndim > 1 else 1)
        for text in values.reshape(-1):
            array.InsertNextValue(str(text))
    else:
        support = vtk_module(package, "util.numpy_support")
        array = support.numpy_to_vtk(np.ascontiguousarray(values))
    array.SetName(name)
    return array


def _of_kind(values: np.ndarray, name: str, kind: vtkAbstractArray) -> vtkAbstractArray:
    package = vtk_package_of(kind)
    core = vtk_module(package, "vtkCommonCore")
    numpy_to_vtk = vtk_module(package, "util.numpy_support").numpy_to_vtk
    array = core.vtkAbstractArray.CreateArray(kind.GetDataType())
    is_bit = array.IsA("vtkBitArray")
    if is_bit or not array.IsA("vtkDataArray"):
        array.SetNumberOfComponents(kind.GetNumberOfComponents())
        array.SetNumberOfTuples(len(values))
        for i, value in enumerate(values.reshape(-1)):
            if is_bit:
                array.SetValue(i, int(value))
            else:
                array.SetVariantValue(i, core.vtkVariant(value))
    else:
        array = numpy_to_vtk(np.ascontiguousarray(values), array_type=kind.GetDataType())
    array.CopyComponentNames(kind)
    if kind.GetName():
        array.SetName(name)
    return array


def table_column(values: Any, name: str, package: str | None = None) -> vtkAbstractArray:
    """A column: whole numbers as VTK counts, others as 8-byte floats, texts as texts."""
    array = np.asarray(values)
    if array.dtype.kind in "OU":
        return named(array, name, package)
    numpy_to_vtk = vtk_module(package, "util.numpy_support").numpy_to_vtk
    if array.dtype.kind in "iu":
        kind = vtk_module(package, "vtkCommonCore").VTK_ID_TYPE
        column = numpy_to_vtk(array.astype(np.int64), array_type=kind)
    else:
        column = numpy_to_vtk(array.astype(np.float64))
    column.SetName(name)
    return column


def field_array(value: Any, name: str, package: str | None = None) -> vtkAbstractArray:
    """Field data: a number, a text, a list of texts, or an array."""
    if isinstance(value, str):
        value = [value]
    if isinstance(value, (list, tuple)):
        texts = np.empty(len(value), dtype=object)
        texts[:] = value
        return named(texts, name, package)
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        return named(value, name, package)
    values = np.atleast_1d(np.asarray(value))
    core = vtk_module(package, "vtkCommonCore")
    array = core.vtkDoubleArray() if values.dtype.kind == "f" else core.vtkIdTypeArray()
    for number in values:
        array.InsertNextValue(number.item())
    array.SetName(name)
    return array


def vtk_points(points: np.ndarray, package: str | None = None) -> vtkPoints:
    """Points that refer to the array."""
    result = vtk_module(package, "vtkCommonCore").vtkPoints()
    support = vtk_module(package, "util.numpy_support")
    result.SetData(support.numpy_to_vtk(np.ascontiguousarray(points)))
    return result


def polygons_of(data: vtkPolyData) -> tuple[np.ndarray, np.ndarray]:
    """Points, and triangles: polygons become fans, whatever their shape, and strips are taken apart."""
    points = data.GetPoints()
    places = to_numpy(points.GetData()) if points else np.empty((0, 3))
    triangles = []
    for cells, turns in ((data.GetPolys(), False), (data.GetStrips(), True)):
        if not cells or cells.GetNumberOfCells() == 0:
            continue
        offsets = to_numpy(cells.GetOffsetsArray()).astype(np.int64)
        corners = to_numpy(cells.GetConnectivityArray()).astype(np.int64)
        triangles.append(_strips(offsets, corners) if turns else _fans(offsets, corners))
    return places, np.concatenate(triangles) if triangles else np.empty((0, 3), dtype=np.int64)


def _fans(offsets: np.ndarray, corners: np.ndarray) -> np.ndarray:
    first, last = _corners_behind_two(offsets)
    return np.stack([corners[first], corners[last - 1], corners[last]], axis=1)


def _strips(offsets: np.ndarray, corners: np.ndarray) -> np.ndarray:
    first, last = _corners_behind_two(offsets)
    # Every second triangle runs the other way round.
    odd = (last - first) % 2
    return np.stack([corners[last - 2 + odd], corners[last - 1 - odd], corners[last]], axis=1)


def _corners_behind_two(offsets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For each triangle the place of the first corner of its cell, and of its own last one."""
    counts = np.maximum(np.diff(offsets) - 2, 0)
    first = np.repeat(offsets[:-1], counts)
    within = np.arange(len(first)) - np.repeat(np.cumsum(counts) - counts, counts)
    return first, first + 2 + within
