# SPDX-License-Identifier: BSD-3-Clause
"""Several files as one cloud, and from where their points were seen."""

from __future__ import annotations

import numpy as np

from .. import _engine
from ..engine import files
from ..engine.mesh import Mesh
from .names import read_points

_VIEW, _VIEWPOINTS, _MISSING = "View", "Viewpoints", "MissingReturns"
_NO_VIEW = 2**32 - 1


def read_inputs(paths: list[str], given_viewpoints: int, view_array: str) -> Mesh:
    """The points of all files one after the other, with the arrays that all have.

    The viewpoints of all files are the field data `Viewpoints`, and `View` is the number of the viewpoint
    of each point. Viewpoints of options replace those of files: as many as there are files, or scans in
    a single one, are one for each. Otherwise points have no number, unless an option names an array, or
    all files have `View` and no viewpoints.
    """
    parts = [read_points(path) for path in paths]
    seen = [_views_of(part) for part in parts]
    points = parts[0] if len(parts) == 1 else _joined(parts)
    if given_viewpoints > 0:
        if not view_array:
            _apply_given(points, seen, given_viewpoints)
    elif len(parts) > 1:
        found = _engine.join_views(seen)
        if len(found["viewpoints"]) > 0:
            points.field_data[_VIEWPOINTS] = found["viewpoints"]
            points.point_data.pop(_VIEW, None)
        if len(found["views"]) > 0:
            points.point_data[_VIEW] = files.view_numbers(found["views"])
    return points


def _views_of(part: Mesh) -> tuple[int, np.ndarray, np.ndarray]:
    viewpoints = np.asarray(part.field_data.get(_VIEWPOINTS, np.empty((0, 3))), dtype=np.float64)
    if viewpoints.ndim != 2 or viewpoints.shape[1] != 3:
        viewpoints = np.empty((0, 3))
    views = np.asarray(part.point_data.get(_VIEW, np.empty(0)))
    if views.ndim != 1 or views.dtype.kind not in "fiub":
        views = np.empty(0)
    is_view = (views >= 0) & (views < _NO_VIEW)  # false for NaN
    numbers = np.where(is_view, views, _NO_VIEW).astype(np.uint32)
    return len(part.points), np.ascontiguousarray(viewpoints), np.ascontiguousarray(numbers)


def _joined(parts: list[Mesh]) -> Mesh:
    has_doubles = any(part.points.dtype == np.float64 for part in parts)
    points = np.concatenate([part.points for part in parts])
    joined = Mesh(
        points.astype(np.float64 if has_doubles else np.float32, copy=False),
        np.empty((0, 3), dtype=np.int64),
    )
    for name, first in parts[0].point_data.items():
        arrays = [part.point_data[name] for part in parts if name in part.point_data]
        if len(arrays) == len(parts) and all(_is_like(array, first) for array in arrays):
            joined.point_data[name] = np.concatenate(arrays)
    joined.normals_name = parts[0].normals_name
    if parts[0].scalars in joined.point_data:
        joined.scalars = parts[0].scalars
    missing = sum(int(part.field_data.get(_MISSING, 0)) for part in parts)
    if missing:
        joined.field_data[_MISSING] = missing
    return joined


def _is_like(array: np.ndarray, first: np.ndarray) -> bool:
    return array.dtype == first.dtype and array.shape[1:] == first.shape[1:]


def _apply_given(points: Mesh, seen: list[tuple[int, np.ndarray, np.ndarray]], wanted: int) -> None:
    scans = sum(len(viewpoints) for _, viewpoints, _ in seen)
    are_of_files = all(
        len(viewpoints) == 0 and len(views) == count for count, viewpoints, views in seen
    )
    if are_of_files or (len(seen) == 1 and wanted == scans):
        return
    points.point_data.pop(_VIEW, None)
    if len(seen) > 1 and wanted == len(seen):
        counts = [count for count, _, _ in seen]
        points.point_data[_VIEW] = np.repeat(np.arange(len(seen), dtype=np.int32), counts)
