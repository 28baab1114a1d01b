# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces whose shape is known, closed, outwards, with a diagonal of 1 around the origin."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D


def unit(points):
    """Moved and scaled so that the box around them is centred at the origin and has a diagonal of 1."""
    low, high = points.min(axis=0), points.max(axis=0)
    return (points - (low + high) / 2) / np.linalg.norm(high - low)


def connected(count, pairs):
    """The same number for all of so many things that pairs connect."""
    label = np.arange(count)
    while True:
        least, most = np.sort(label[pairs.T], axis=0)
        apart = least < most
        if not apart.any():
            return label
        np.minimum.at(label, most[apart], least[apart])
        while (label[label] != label).any():
            label = label[label]


def sphere(levels=6):
    """An octahedron whose triangles are divided so often in four, on the sphere of diameter 1 / sqrt(3)."""
    points = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    triangles = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    for _ in range(levels):
        ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        edges, of = np.unique(ends, axis=0, return_inverse=True)
        middle = len(points) + of.reshape(-1, 3)
        points = np.vstack((points, points[edges].mean(axis=1)))
        (a, b, c), (ab, bc, ca) = triangles.T, middle.T
        triangles = np.vstack([np.column_stack(t) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return points / np.linalg.norm(points, axis=1)[:, None] / np.sqrt(12), triangles


def extruded(points, triangles, thickness):
    """A flat sheet of triangles that run counterclockwise, made so thick."""
    count = len(points)
    top, bottom = (np.column_stack((points, np.full(count, z))) for z in (thickness / 2, -thickness / 2))
    edges = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    keys, back = edges[:, 0] * count + edges[:, 1], edges[:, 1] * count + edges[:, 0]
    a, b = edges[~np.isin(back, keys)].T
    walls = np.vstack((np.column_stack((a, a + count, b + count)), np.column_stack((a, b + count, b))))
    return np.vstack((top, bottom)), np.vstack((triangles, triangles[:, ::-1] + count, walls))


def rectangle(width, height, step):
    """A flat grid of triangles with about so long legs."""
    nx, ny = round(width / step), round(height / step)
    x, y = np.meshgrid(np.linspace(0, width, nx + 1), np.linspace(0, height, ny + 1), indexing="ij")
    a = (np.arange(nx)[:, None] * (ny + 1) + np.arange(ny)).ravel()
    b, c, d = a + ny + 1, a + ny + 2, a + 1
    return np.column_stack((x.ravel(), y.ravel())), np.vstack((np.column_stack((a, b, c)), np.column_stack((a, c, d))))


def box(percent):
    """1 x 0.6, and so thick, in percent of the diagonal of these two."""
    points, triangles = extruded(*rectangle(1, 0.6, 0.6), percent / 100 * np.hypot(1, 0.6))
    return unit(points), triangles


def plate(percent=0.6):
    """1 x 0.6 with two round holes, and so thick."""
    points, triangles = rectangle(1, 0.6, 0.01)
    for x, y, radius in ((0.3, 0.25, 0.1), (0.7, 0.35, 0.07)):
        from_middle = points - (x, y)
        distance = np.linalg.norm(from_middle, axis=1)
        triangles = triangles[(distance[triangles] >= radius - 0.005).all(axis=1)]
        # What stands along the hole goes onto its circle.
        edges = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        ends, times = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
        rim = np.unique(ends[times == 1])
        rim = rim[distance[rim] < radius + 0.02]
        points[rim] = (x, y) + from_middle[rim] * (radius / distance[rim])[:, None]
    used, triangles = np.unique(triangles, return_inverse=True)
    points, triangles = extruded(points[used], triangles.reshape(-1, 3), percent / 100 * np.hypot(1, 0.6))
    return unit(points), triangles


def distance_to_rod(points, start, end, radius):
    """From a rod with round ends."""
    axis = end - start
    along = np.clip((points - start) @ axis / (axis @ axis), 0, 1)
    return np.linalg.norm(points - start - along[..., None] * axis, axis=-1) - radius


def rods(ends, radii, step):
    """The surface of all rods together, from a grid so fine."""
    low = ends.min(axis=(0, 1)) - radii.max() - 2 * step
    shape = np.ceil((ends.max(axis=(0, 1)) + radii.max() + 2 * step - low) / step).astype(int) + 1
    field = np.full(shape, 3 * step, np.float32)
    for (start, end), radius in zip(ends, radii):
        first = np.floor((np.minimum(start, end) - radius - 3 * step - low) / step).astype(int).clip(0)
        last = np.ceil((np.maximum(start, end) + radius + 3 * step - low) / step).astype(int) + 1
        part = tuple(slice(a, b) for a, b in zip(first, last))
        grid = np.stack(np.meshgrid(*(np.arange(s.start, min(s.stop, n)) for s, n in zip(part, shape)),
                                    indexing="ij"), axis=-1) * step + low
        field[part] = np.minimum(field[part], distance_to_rod(grid, start, end, radius))
    image = vtkImageData()
    image.SetDimensions(*shape)
    image.SetOrigin(*low)
    image.SetSpacing(step, step, step)
    image.GetPointData().SetScalars(numpy_to_vtk(field.ravel(order="F"), deep=True))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 1e-5 * step)  # no value of the grid is this one: no triangle without area
    contour.ComputeNormalsOff()
    contour.Update()
    points = vtk_to_numpy(contour.GetOutput().GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(contour.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(int)
    return points, triangles[:, ::-1]  # outwards


def chair():
    """Rods of radius 0.6 to 1.0 % of the diagonal: four legs, a seat of bars, a back of bars; genus 10."""
    width, depth, seat, top = 0.42, 0.42, 0.42, 0.85
    a, b, c, d = (np.array(corner, float) for corner in ((0, 0, 0), (width, 0, 0), (width, depth, 0), (0, depth, 0)))
    up, high = np.array([0, 0, seat]), np.array([0, 0, top])
    middle = np.array([0, 0, 0.2])
    ends = [(a, a + up), (b, b + up), (c, c + high), (d, d + high)]  # legs, of which two go on as the back
    radii = [1.0] * 4
    for z, radius in ((up, 0.9), (middle, 0.7)):  # the frame of the seat, and of the legs
        ends += [(p + z, q + z) for p, q in ((a, b), (b, c), (c, d), (d, a))]
        radii += [radius] * 4
    ends.append((c + high, d + high))
    radii.append(0.8)
    for part in (1 / 3, 2 / 3):  # bars of the seat, and of the back
        ends += [(a + up + part * (b - a), d + up + part * (c - d)),
                 (c + up + part * (high - up), d + up + part * (high - up))]
        radii += [0.6] * 2
    ends = np.array(ends)
    diagonal = np.linalg.norm(np.ptp(ends, axis=(0, 1)))
    points, triangles = rods(ends, np.array(radii) * diagonal / 100, 0.002)
    return unit(points), triangles
