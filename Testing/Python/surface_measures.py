# SPDX-License-Identifier: BSD-3-Clause
"""The measures of compare(), once more: by NumPy, triangle by triangle, with samples of its own. It shares
nothing with the engine, and is slow.
"""

import numpy as np

SHARP = np.cos(np.radians(30.0))


def lattice_cube(lines):
    """A cube of side 1 around the origin with grid lines at these places of each face: points, triangles."""
    lines = np.asarray(lines)
    count = len(lines)
    points, triangles = [], []
    for axis in range(3):
        for side in (-0.5, 0.5):
            first = len(points) * count * count
            grid = np.empty((count * count, 3))
            grid[:, axis] = side
            grid[:, (axis + 1) % 3] = np.repeat(lines, count)
            grid[:, (axis + 2) % 3] = np.tile(lines, count)
            points.append(grid)
            corner = first + (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
            for b, c in ((count, count + 1), (count + 1, 1)):
                triangles.append(np.column_stack((corner, corner + b, corner + c)))
    return np.vstack(points), np.vstack(triangles)


def rounded_cube(radius):
    """The same with rounded edges and corners: facets that turn by some 15 degrees."""
    flat = 0.5 - radius
    steps = flat + radius * np.tan(np.radians([0.0, 15.0, 30.0, 45.0]))
    points, triangles = lattice_cube(np.concatenate((-steps[::-1], steps)))
    inner = np.clip(points, -flat, flat)
    away = points - inner
    return inner + radius * away / np.linalg.norm(away, axis=1, keepdims=True), triangles


def ball(radius, count=7):
    """A cube that is blown up."""
    points, triangles = lattice_cube(0.5 * np.tan(np.radians(np.linspace(-45.0, 45.0, count))))
    return radius * points / np.linalg.norm(points, axis=1, keepdims=True), triangles


def measures(reference, result, count=3000):
    """What compare() gives of them, by the same names."""
    random = np.random.default_rng(7)
    diagonal = np.linalg.norm(np.ptp(reference[0], axis=0))
    ways = {}
    within = {}
    for name, here, there in (
        ("reference_to_result", reference, result),
        ("result_to_reference", result, reference),
    ):
        places, triangle = _samples(here, count, random)
        distances, nearest = _nearest(places, there[0][there[1]])
        cosines = np.abs((_normals(here)[triangle] * _normals(there)[nearest]).sum(axis=1))
        edges, others = _sharp_edges(here), _sharp_edges(there)
        lengths = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1)
        ways[name] = {
            "mean": distances.mean(),
            "rms": np.sqrt((distances**2).mean()),
            "normal_consistency": cosines.mean(),
            "edge_length": lengths.sum(),
            "edge_mean": np.nan,
            "edge_to_surface": np.nan,
        }
        if len(edges):
            drawn = _drawn(lengths, count, random)
            part = random.random((count, 1))
            places = (1.0 - part) * edges[drawn, 0] + part * edges[drawn, 1]
            ways[name]["edge_to_surface"] = _nearest(places, there[0][there[1]])[0].mean()
            if len(others):
                thin = others[:, (0, 1, 1)]
                ways[name]["edge_mean"] = _nearest(places, thin)[0].mean()
        within[name] = [(distances < percent / 100.0 * diagonal).mean() for percent in (0.1, 0.5)]
    to, back = ways.values()
    both = {
        "chamfer": (to["mean"] + back["mean"]) / 2.0,
        "chamfer_squared": to["rms"] ** 2 + back["rms"] ** 2,
        "normal_consistency": (to["normal_consistency"] + back["normal_consistency"]) / 2.0,
        "edge_chamfer": (to["edge_mean"] + back["edge_mean"]) / 2.0,
    }
    both["chamfer_percent"] = 100.0 * both["chamfer"] / diagonal
    both["edge_chamfer_percent"] = 100.0 * both["edge_chamfer"] / diagonal
    for at, recall, precision in zip(("0_1", "0_5"), *within.values()):
        both["precision_" + at], both["recall_" + at] = precision, recall
        both["f_score_" + at] = 2.0 / (1.0 / precision + 1.0 / recall) if precision * recall else 0.0
    return {**ways, "both_ways": both}


def _crosses(mesh):
    a, b, c = (mesh[0][mesh[1][:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def _normals(mesh):
    crosses = _crosses(mesh)
    return crosses / np.linalg.norm(crosses, axis=1, keepdims=True)


def _samples(mesh, count, random):
    areas = np.linalg.norm(_crosses(mesh), axis=1)
    triangle = _drawn(areas, count, random)
    a, b, c = (mesh[0][mesh[1][triangle, k]] for k in range(3))
    u, v = np.sqrt(random.random((count, 1))), random.random((count, 1))
    return (1.0 - u) * a + u * (1.0 - v) * b + u * v * c, triangle


def _drawn(weights, count, random):
    """So many of what has these weights, one in each of as many equal shares."""
    shares = (np.arange(count) + random.random(count)) / count
    return np.minimum(np.searchsorted(np.cumsum(weights) / weights.sum(), shares), len(weights) - 1)


def _nearest(places, corners):
    """The distance of each place from the nearest of the triangles, and which that is."""
    best = np.full(len(places), np.inf)
    which = np.zeros(len(places), dtype=int)
    for i, (a, b, c) in enumerate(corners):
        squares = np.full(len(places), np.inf)
        for start, end in ((a, b), (b, c), (c, a)):
            along = end - start
            part = np.clip((places - start) @ along / max(along @ along, 1e-300), 0.0, 1.0)
            squares = np.minimum(squares, ((places - start - part[:, None] * along) ** 2).sum(axis=1))
        normal = np.cross(b - a, c - a)
        if normal @ normal > 0.0:
            inside = np.ones(len(places), dtype=bool)
            for start, end in ((a, b), (b, c), (c, a)):
                inside &= (places - start) @ np.cross(normal, end - start) >= 0.0
            squares[inside] = (((places - a) @ normal) ** 2 / (normal @ normal))[inside]
        nearer = squares < best
        best[nearer], which[nearer] = squares[nearer], i
    return np.sqrt(best), which


def _sharp_edges(mesh):
    """The ends of edges of two triangles whose normals, both outwards, differ by more than 30 degrees."""
    normals = _normals(mesh)
    centers = mesh[0][mesh[1]].mean(axis=1)
    normals *= np.sign((normals * centers).sum(axis=1))[:, None]
    at = {}
    for triangle, corners in enumerate(mesh[1]):
        for k in range(3):
            ends = sorted(tuple(np.round(mesh[0][corners[j]], 9) + 0.0) for j in (k, (k + 1) % 3))
            at.setdefault(tuple(ends), []).append(triangle)
    sharp = [ends for ends, (a, b) in at.items() if normals[a] @ normals[b] < SHARP]
    return np.array(sharp).reshape(-1, 2, 3)
