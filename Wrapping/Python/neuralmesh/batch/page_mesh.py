# SPDX-License-Identifier: BSD-3-Clause
"""A mesh as a script that a page can load from a disk, where browsers read no other files."""

from __future__ import annotations

import base64
import json
import zlib
from typing import Any

import numpy as np

from .meshes import arrays_of


def page_mesh(name: str, mesh: Any) -> str:
    """A call of showMesh() with all vertices and triangles: little-endian numbers, by zlib and
    base64. Vertices are floats of 4 bytes, counted from the middle of the mesh, so that large
    coordinates lose no detail.
    """
    points, triangles, colors = arrays_of(mesh)
    points = points.astype(np.float64)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    content = {
        "name": name,
        "points": _encoded(points - middle, "<f4"),
        "triangles": _encoded(triangles, "<u4"),
    }
    if colors is not None:
        content["colors"] = _encoded(colors, "u1")
    return f"showMesh({json.dumps(content)});\n"


def _encoded(numbers: np.ndarray, number_type: str) -> str:
    return base64.b64encode(zlib.compress(numbers.astype(number_type).tobytes())).decode()
