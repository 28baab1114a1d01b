# SPDX-License-Identifier: BSD-3-Clause
"""Point data of a cloud, carried over to the mesh that was made of it."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from .cloud import Cloud
from .mesh import Mesh

_BEGIN, _FOUND = 0.95, 0.975  # of the progress
_TAKEN = ("Normals", "Activity", "FeatureStrength", "Crease", "Boundary", "Residual", "Support", "Uncertainty")
_NO_LABEL = 2**32 - 1


def carry(
    run: Any,
    cloud: Cloud,
    arrays: dict[str, np.ndarray],
    mesh: Mesh,
    progress: Callable[[float], "bool | None"] | None,
) -> bool:
    """Add arrays of the cloud to the mesh. Floats and colours are fitted; other arrays get the most frequent
    value of the points of a vertex. Returns False, with only some of the arrays, if progress ended it.
    """
    is_done = run.find_places(_BEGIN, _FOUND, progress)
    for i, (name, values) in enumerate(arrays.items()):
        fraction = _FOUND + (1.0 - _FOUND) * i / len(arrays)
        if progress is not None and progress(fraction) is False:
            return False
        free = _free_name(name, mesh)
        mesh.point_data[free] = _fitted(run, values) if _is_fitted(values) else _voted(run, values)
        if name in cloud.vtk_data:
            mesh.vtk_kinds[free] = cloud.vtk_data[name]
        if name == cloud.scalars:
            mesh.scalars = free
    return is_done


def _is_color(values: np.ndarray) -> bool:
    return values.dtype == np.uint8 and values.ndim == 2 and values.shape[1] in (3, 4)


def _is_fitted(values: np.ndarray) -> bool:
    return values.dtype in (np.float32, np.float64) or _is_color(values)


def _fitted(run: Any, values: np.ndarray) -> np.ndarray:
    rows = np.ascontiguousarray(values.reshape(len(values), -1), dtype=np.float64)
    fitted = run.fit(rows)
    if _is_color(values):
        # Halves go up, and what no point tells is black.
        fitted = np.floor(np.nan_to_num(fitted, nan=0.0) + 0.5)
    return fitted.reshape(-1, *values.shape[1:]).astype(values.dtype)


def _voted(run: Any, values: np.ndarray) -> np.ndarray:
    if values.dtype == object:
        rows = values.reshape(len(values), -1)
        keys = ["\0".join(f"{len(text)}:{text}" for text in row) for row in rows]
        _, kinds = np.unique(np.array(keys), return_inverse=True)
    else:
        rows = np.ascontiguousarray(values.reshape(len(values), -1))
        size = rows.dtype.itemsize * rows.shape[1]
        _, kinds = np.unique(rows.view(np.dtype((np.void, size))).reshape(-1), return_inverse=True)
    winners = run.vote(np.ascontiguousarray(kinds.reshape(-1), dtype=np.uint32))
    is_known = winners != _NO_LABEL
    result = np.zeros((len(winners), *values.shape[1:]), dtype=values.dtype)
    if values.dtype == object:
        result[:] = ""
    result[is_known] = values[winners[is_known]]
    return result


def _free_name(name: str, mesh: Mesh) -> str:
    """One that neither an array of the mesh has nor any that it may have in other runs."""
    while name in _TAKEN or name in mesh.point_data:
        name += "_Input"
    return name
