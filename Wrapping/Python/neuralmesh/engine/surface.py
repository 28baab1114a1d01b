# SPDX-License-Identifier: BSD-3-Clause
"""A surface that is to be remeshed, as a cloud of samples with its point data, and as triangles."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _engine
from .cloud import Block, Cloud
from .mesh import Mesh
from .vtk_arrays import polygons_of, to_numpy


def sampled(cloud: Cloud, parameters: dict[str, int | float]) -> tuple[Cloud, Mesh, str]:
    """Samples, the surface as an oriented manifold, and what must be known of it, which may be nothing.
    ValueError for what is no surface.
    """
    if cloud.other_blocks:
        raise ValueError(
            "A surface is polygons (vtkPolyData), and the input has other blocks: vtkDataSetSurfaceFilter "
            "(Extract Surface) makes one of them."
        )
    parts = [_polygons_of(block) for block in cloud.blocks]
    first_points = np.cumsum([0, *(len(points) for points, _ in parts)])
    first_triangles = np.cumsum([0, *(len(triangles) for _, triangles in parts)])
    points = [np.asarray(points, dtype=np.float64) for points, _ in parts]
    triangles = [part + first for (_, part), first in zip(parts, first_points)]
    found = _engine.sample_surface(
        parameters,
        np.ascontiguousarray(np.concatenate([np.empty((0, 3)), *points])),
        np.ascontiguousarray(
            np.concatenate([np.empty((0, 3), dtype=np.int64), *triangles]), dtype=np.int64
        ),
    )
    blocks = []
    for number, block in enumerate(cloud.blocks):
        is_own = (found["triangles"] >= first_triangles[number]) & (
            found["triangles"] < first_triangles[number + 1]
        )
        corners = parts[number][1][found["triangles"][is_own] - first_triangles[number]]
        blocks.append(_samples_of(block, found, is_own, corners))
    surface = Mesh(found["surface_points"], found["surface_triangles"])
    samples = Cloud([block for block in blocks if len(block.points) > 0])
    return samples, surface, found["warning"]


def _polygons_of(block: Block) -> tuple[np.ndarray, np.ndarray]:
    if block.dataset is None:
        triangles = np.empty((0, 3)) if block.triangles is None else block.triangles
        return block.points, np.asarray(triangles).astype(np.int64)
    if not block.dataset.IsA("vtkPolyData"):
        raise ValueError(
            "A surface is polygons (vtkPolyData), and the input has a "
            f"{block.dataset.GetClassName()}: vtkDataSetSurfaceFilter (Extract Surface) makes one of it."
        )
    return polygons_of(block.dataset)


def _samples_of(
    block: Block, found: dict[str, Any], is_own: np.ndarray, corners: np.ndarray
) -> Block:
    points = found["points"][is_own]
    is_single = block.points.dtype == np.float32
    weights = found["weights"][is_own]
    data = {
        name: _at(to_numpy(block.vtk_data[name]) if name in block.vtk_data else values, corners, weights)
        for name, values in block.data.items()
        if name != "Normals"
    }
    return Block(
        np.ascontiguousarray(points, dtype=np.float32 if is_single else np.float64),
        data,
        found["normals"][is_own],
        scalars=block.scalars,
        vtk_data=block.vtk_data,
    )


def _at(values: np.ndarray, corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Values at places on triangles: reals and colours are interpolated, anything else is that of the corner
    that counts most.
    """
    is_color = values.dtype == np.uint8 and values.ndim == 2 and values.shape[1] in (3, 4)
    if values.dtype not in (np.float32, np.float64) and not is_color:
        most = np.argmax(weights, axis=1)
        return values[corners[np.arange(len(corners)), most]]
    shape = (-1,) + (1,) * (values.ndim - 1)
    a, b, c = (weights[:, k].reshape(shape) for k in range(3))
    mixed = (
        a * values[corners[:, 0]].astype(np.float64)
        + b * values[corners[:, 1]].astype(np.float64)
        + c * values[corners[:, 2]].astype(np.float64)
    )
    return (np.floor(mixed + 0.5) if is_color else mixed).astype(values.dtype)
