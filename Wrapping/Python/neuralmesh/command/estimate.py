# SPDX-License-Identifier: BSD-3-Clause
"""What a run will take, roughly: --dry-run."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from .. import _engine
from ..engine.cloud import as_cloud
from ..engine.mesh import Mesh


def print_estimate(mesh: Any, points: Mesh, first: Mesh | None, names: str) -> None:
    """Learn a small mesh, or somewhat more of the first one, and tell what the whole one will take."""
    vertices = mesh.GetNumberOfVertices()
    features = mesh.GetFeatureSamples() * vertices if mesh.GetComputeFeatureStrength() else 0.0
    tried = (0 if first is None else len(first.points)) + _engine.tried_vertices
    mesh.SetNumberOfVertices(min(vertices, tried))
    mesh.ComputeFeatureStrengthOff()
    start = time.monotonic()
    try:
        outcome = mesh.run(as_cloud(points), first)
    except ValueError as error:
        raise ValueError(f"{names}: {error}") from None
    if len(outcome.mesh.points) == 0:
        raise ValueError(f"{names}: there are no points in it")
    columns = [outcome.curve[name] for name in ("Iteration", "Vertices", "Seconds")]
    arrays = [points.points, *(np.asarray(one) for one in points.point_data.values())]
    size, samples, seconds = _engine.estimate(
        vertices,
        len(points.points),
        sum(one.nbytes for one in arrays),
        features,
        mesh.IS_ENSEMBLE,
        np.ascontiguousarray(np.stack(columns, axis=1), dtype=np.float64),
        time.monotonic() - start,
    )
    print(f"points     {len(points.points)}")
    print(f"vertices   {vertices}")
    print(f"samples    about {1e-6 * samples:.3g} million")
    print(f"memory     about {1e-6 * size:.0f} MB")
    print(f"time       about {seconds:.2g} s of learning, on this machine as it is now")
