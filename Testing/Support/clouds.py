# SPDX-License-Identifier: BSD-3-Clause
"""Clouds for the benchmarks, as numpy arrays, and the files that the command reads."""

import io
import tarfile

import numpy as np

CGAL_DATA = "/usr/share/doc/libcgal-dev/data.tar.gz"  # of the Debian package libcgal-demo


def torus(count, tube=0.4, seed=1):
    """Points evenly on a torus around the z axis, of radius 1, with a tube of the given radius."""
    random = np.random.default_rng(seed)
    around, along = random.uniform(0, 2 * np.pi, (2, 4 * count))
    # The outside has more area than the inside.
    kept = random.uniform(0, 1 + tube, 4 * count) < 1 + tube * np.cos(along)
    around, along = around[kept][:count], along[kept][:count]
    radius = 1 + tube * np.cos(along)
    return np.column_stack((radius * np.cos(around), radius * np.sin(around), tube * np.sin(along)))


def cube(count, seed=1):
    """Points evenly on the axis-parallel cube of side 1 around the origin."""
    random = np.random.default_rng(seed)
    points = random.uniform(-0.5, 0.5, (count, 3))
    points[np.arange(count), random.integers(0, 3, count)] = random.choice((-0.5, 0.5), count)
    return points


def cgal_mesh(name):
    """Vertices and triangles of meshes/NAME.off in CGAL's data."""
    with tarfile.open(CGAL_DATA) as archive:
        text = archive.extractfile(f"data/meshes/{name}.off").read().decode()
    lines = [line for line in io.StringIO(text) if line.strip() and not line.startswith("#")]
    vertices, faces = map(int, lines[1].split()[:2])
    points = np.array([line.split() for line in lines[2:2 + vertices]], float)
    triangles = np.array([line.split()[1:4] for line in lines[2 + vertices:2 + vertices + faces]], int)
    return points, triangles


def sample(points, triangles, count, seed=1):
    """Points evenly on a surface of triangles."""
    random = np.random.default_rng(seed)
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(triangles), count, p=areas / areas.sum())
    u, v = random.uniform(0, 1, (2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen]


def write_ply(path, points):
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % len(points))
        file.write(b"property float x\nproperty float y\nproperty float z\nend_header\n")
        file.write(points.astype("<f4").tobytes())


def write_obj(path, points, triangles):
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v %.9g %.9g %.9g\n" % tuple(point) for point in points)
        file.writelines("f %d %d %d\n" % tuple(triangle) for triangle in triangles + 1)
