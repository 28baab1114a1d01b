# SPDX-License-Identifier: BSD-3-Clause
"""What a mesh is, and how far it is from the model."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator

from .models import cloud_of, surface_of

# On each surface, but no more than a tenth of the scan: hundreds of meshes are measured, and asked for
# are differences of some percent.
_MOST_SAMPLES = 10000
_EDGE_WIDTH = 0.05  # of the side of a cube


def measure(mesh: vtkPolyData, model: str, points: int) -> dict[str, Any]:
    """Figures by the names of COLUMNS, for the mesh of a scan of so many points."""
    count = min(_MOST_SAMPLES, points // 10)
    of_mesh = _Surface(mesh, count)
    figures = shape_figures(of_mesh.points, of_mesh.triangles)
    if surface_of(model) is not None:
        figures.update(_distances(of_mesh, _reference(model, count)))
    else:
        cloud = cloud_of(model, points)
        figures.update(_distances_of_points(of_mesh, vtk_to_numpy(cloud.GetPoints().GetData())))
    if model == "cube":
        figures["edge_density"] = _edge_density(of_mesh.points)
    return figures


def arrays_of(mesh: vtkPolyData) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles."""
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return points, triangles


def shape_figures(points: np.ndarray, triangles: np.ndarray) -> dict[str, float]:
    """Valences and triangles."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, uses = np.unique(edges, axis=0, return_counts=True)
    valences = np.bincount(edges.ravel(), minlength=len(points))
    regular = np.full(len(points), 6)
    regular[edges[uses == 1].ravel()] = 4
    areas = np.linalg.norm(_normals(points, triangles), axis=1) / 2
    return {
        "regular": 100 * float((valences == regular).mean()),
        "valence_deviation": float(np.sqrt(((valences - regular) ** 2).mean())),
        "largest_triangle": float(areas.max() / areas.mean()),
    }


def _normals(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Of the triangles, as long as twice their areas."""
    a, b, c = (points[triangles[:, corner]].astype(float) for corner in range(3))
    return np.cross(b - a, c - a)


@dataclass(frozen=True)
class _Nearest:
    """The nearest places on a surface to some points: how far they are, and in which triangles."""

    distances: np.ndarray
    triangles: np.ndarray

    @property
    def rms(self) -> float:
        return float(np.sqrt((self.distances**2).mean()))


class _Surface:
    """Triangles, with points spread evenly over them, always at the same places."""

    def __init__(self, surface: vtkPolyData, count: int):
        self.points, self.triangles = arrays_of(surface)
        self.points = self.points.astype(float)
        self.diagonal = surface.GetLength()
        normals = _normals(self.points, self.triangles)
        areas = np.linalg.norm(normals, axis=1)
        self.normals = normals / np.maximum(areas, 1e-300)[:, None]
        random = np.random.default_rng(1)
        self.sampled = random.choice(len(areas), count, p=areas / areas.sum())
        u, v = random.uniform(0, 1, (2, count, 1))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        a, b, c = (self.points[self.triangles[self.sampled, corner]] for corner in range(3))
        self.samples = a + u * (b - a) + v * (c - a)
        self._locator = vtkStaticCellLocator()
        self._locator.SetDataSet(surface)
        self._locator.BuildLocator()

    def nearest(self, points: np.ndarray) -> _Nearest:
        closest, cell, part, squared = [0.0, 0.0, 0.0], mutable(0), mutable(0), mutable(0.0)
        distances, triangles = np.empty(len(points)), np.empty(len(points), int)
        for i, point in enumerate(points.tolist()):
            self._locator.FindClosestPoint(point, closest, cell, part, squared)
            distances[i], triangles[i] = squared.get(), cell.get()
        return _Nearest(np.sqrt(distances), triangles)


@functools.lru_cache(maxsize=8)
def _reference(model: str, count: int) -> _Surface:
    return _Surface(surface_of(model), count)


def _distances(mesh: _Surface, model: _Surface) -> dict[str, Any]:
    """Both ways, over points of the surfaces, in percent of the diagonal of the model."""
    percent = 100 / model.diagonal
    there, back = model.nearest(mesh.samples), mesh.nearest(model.samples)
    cosines = np.concatenate([
        (mesh.normals[mesh.sampled] * model.normals[there.triangles]).sum(axis=1),
        (model.normals[model.sampled] * mesh.normals[back.triangles]).sum(axis=1),
    ])  # fmt: skip
    inverted = float((cosines < 0).mean())
    missing, excess = (percent * float(found.distances.max()) for found in (back, there))
    return {
        "rms": percent * (there.rms + back.rms) / 2,
        "hausdorff": max(missing, excess),
        "missing": missing,
        "excess": excess,
        "normal_angle": float(np.degrees(np.arccos(np.minimum(1, np.abs(cosines)))).mean()),
        # A mesh may be inside out as a whole.
        "inverted": 100 * min(inverted, 1 - inverted),
        "worst_place": (percent * mesh.samples[there.distances.argmax()]).tolist(),
    }


def _distances_of_points(mesh: _Surface, points: np.ndarray) -> dict[str, float]:
    """Of a cloud without a surface: one way, from its points to the mesh."""
    percent = 100 / float(np.linalg.norm(np.ptp(points, axis=0)))
    found = mesh.nearest(points[:: -(-len(points) // _MOST_SAMPLES)])
    farthest = percent * float(found.distances.max())
    return {"rms": percent * found.rms, "hausdorff": farthest, "missing": farthest}


def _edge_density(points: np.ndarray) -> float:
    """How many of the vertices of a unit cube are near its edges, over the part of its area there."""
    depth = np.sort(0.5 - np.abs(points), axis=1)[:, 1]
    share = 1 - (1 - 2 * _EDGE_WIDTH) ** 2
    return float((depth < _EDGE_WIDTH).mean() / share)
