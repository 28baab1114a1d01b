# SPDX-License-Identifier: BSD-3-Clause
"""Arrays as people have them, as both worlds take them."""

from __future__ import annotations

import numpy as np


def as_points(points: object) -> np.ndarray:
    """Numbers of shape (N, 3), one behind the other; masked ones are NaN.

    Arrays of 4-byte floats stay so; all other numbers become 8-byte floats. ValueError for anything
    but numbers of that shape.
    """
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
            f"{_how_to_pass(array)}"
        )
    single = array.dtype.kind == "f" and array.dtype.itemsize == 4
    return np.ascontiguousarray(array, dtype=np.float32 if single else np.float64)


def _how_to_pass(array: np.ndarray) -> str:
    """What makes points of usual arrays that have more or other columns; else nothing."""
    if array.dtype.names is not None and {"x", "y", "z"} <= set(array.dtype.names):
        return ": pass numpy.stack([points[axis] for axis in 'xyz'], axis=1)"
    if array.ndim == 2 and array.shape[1] > 3 and array.dtype.kind in "fiu":
        if array.shape[0] == 3 and array.shape[1] > 6:
            return ": pass numpy.asarray(points).T"
        return ": pass numpy.asarray(points)[:, :3] if its first columns are x, y and z"
    return ""


def as_triangles(triangles: object, parameter: str) -> np.ndarray:
    """Whole numbers of shape (T, 3), as they are. ValueError for anything else, which names the parameter."""
    try:
        array = np.asarray(triangles)
    except ValueError as error:
        raise ValueError(f"{parameter}: triangles are of different lengths: {error}") from None
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iu":
        raise ValueError(
            f"{parameter}: triangles must be whole numbers of shape (T, 3), not of shape {array.shape} and "
            f"type {array.dtype}; other polygons go in as a dataset, of VTK or PyVista"
        )
    return array


def values_of_points(
    values: object, count: int, parameter: str, shape: tuple[int, ...]
) -> np.ndarray:
    """The values of a parameter for `count` points, each a number or of the given shape. ValueError for
    anything else.
    """
    array = np.asarray(values)
    wanted = (count, *shape)
    if array.shape != wanted or array.dtype.kind not in "fiub":
        named = "the name of a point array or " if not shape else ""
        raise ValueError(
            f"{parameter} must be {named}numbers of shape {wanted}, not "
            f"{type(values).__name__} of shape {array.shape} and type {array.dtype}"
        )
    return array


def kind_of_numbers(name: str, values: np.ndarray) -> type[np.int64] | type[np.float64]:
    """Whole numbers stay so where they name something: they are not to be averaged on the mesh."""
    return np.int64 if name == "View" and values.dtype.kind in "iub" else np.float64
