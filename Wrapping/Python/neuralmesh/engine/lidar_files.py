# SPDX-License-Identifier: BSD-3-Clause
"""Files of lidar scanners, by the packages that read them: laspy and pye57."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _engine
from .files import missing_package, view_numbers
from .mesh import Mesh

_EXTRA = "'neuralmesh[lidar]'"


def read_las(path: str) -> Mesh:
    """Read a .las or .laz: points, with `RGB`, `Intensity` and `Classification` where it has such."""
    try:
        import laspy
    except ImportError:
        raise missing_package(path, "laspy", _EXTRA) from None
    try:
        with laspy.open(path) as file:
            announced = file.header.point_count
            scan = file.read()
        points = np.ascontiguousarray(np.stack([scan.x, scan.y, scan.z], axis=1), dtype=np.float64)
        names = set(scan.point_format.dimension_names)
        data: dict[str, Any] = {}
        if "intensity" in names:
            data["Intensity"] = np.asarray(scan.intensity, dtype=np.float64)
        if "classification" in names:
            data["Classification"] = np.asarray(scan.classification, dtype=np.uint8)
        if {"red", "green", "blue"} <= names:
            data["RGB"] = _bytes_of(np.stack([scan.red, scan.green, scan.blue], axis=1))
    except Exception as error:  # whatever a damaged file makes of the package
        if "LazBackend" in str(error):
            raise missing_package(path, "laspy with lazrs", _EXTRA) from None
        raise _damaged(path, error) from None
    if len(points) < announced:
        raise ValueError(f"{path}: damaged: it ends before its last point")
    return Mesh(points, np.empty((0, 3), dtype=np.int64), data, {}, "RGB" if "RGB" in data else "")


def read_e57(path: str) -> Mesh:
    """Read all scans of an .e57 as one cloud: their poses are `Viewpoints`, and `View` tells which is whose."""
    try:
        import pye57
    except ImportError:
        raise missing_package(path, "pye57", _EXTRA) from None
    try:
        file = pye57.E57(path)
        try:
            scans = [_scan_of(file, i) for i in range(file.scan_count)]
        finally:
            file.close()
    except Exception as error:  # whatever a damaged file makes of the package
        raise _damaged(path, error) from None
    if not scans:
        raise ValueError(f"{path}: there are no scans in it")
    points = np.concatenate([scan["points"] for scan in scans])
    triangles = np.empty((0, 3), dtype=np.int64)
    mesh = Mesh(points, triangles)
    for name in ("RGB", "Intensity"):
        if all(name in scan for scan in scans):
            mesh.point_data[name] = np.concatenate([scan[name] for scan in scans])
    mesh.scalars = "RGB" if "RGB" in mesh.point_data else ""
    unknown = np.empty(0, dtype=np.uint32)
    joined = _engine.join_views(
        [(len(scan["points"]), scan["viewpoints"], unknown) for scan in scans]
    )
    if len(joined["viewpoints"]) > 0:
        mesh.field_data["Viewpoints"] = joined["viewpoints"]
    if len(joined["views"]) > 0:
        mesh.point_data["View"] = view_numbers(joined["views"])
    return mesh


def _scan_of(file: Any, number: int) -> dict[str, np.ndarray]:
    header = file.get_header(number)
    fields = set(header.point_fields)
    has_colors = {"colorRed", "colorGreen", "colorBlue"} <= fields
    has_intensity = "intensity" in fields
    raw = file.read_scan(
        number, colors=has_colors, intensity=has_intensity, ignore_missing_fields=True
    )
    axes = [raw[f"cartesian{axis}"] for axis in "XYZ"]
    scan = {
        "points": np.ascontiguousarray(np.stack(axes, axis=1), dtype=np.float64),
        "viewpoints": np.empty((0, 3)),
    }
    if has_colors:
        colors = [raw[f"color{name}"] for name in ("Red", "Green", "Blue")]
        scan["RGB"] = _bytes_of(np.stack(colors, axis=1))
    if has_intensity:
        scan["Intensity"] = np.asarray(raw["intensity"], dtype=np.float64)
    if header.has_pose():
        place = file.scan_position(number)
        scan["viewpoints"] = np.ascontiguousarray(place, dtype=np.float64).reshape(-1, 3)
    return scan


def _bytes_of(colors: np.ndarray) -> np.ndarray:
    """Colours of 8 or 16 bits as 8."""
    is_wide = colors.size > 0 and colors.max() > 255
    return np.ascontiguousarray(colors >> 8 if is_wide else colors, dtype=np.uint8)


def _damaged(path: str, error: Exception) -> ValueError:
    text = " ".join(str(error).split()) or type(error).__name__
    return ValueError(f"{path}: damaged, or not what its extension says: {text}")
