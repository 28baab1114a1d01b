# SPDX-License-Identifier: BSD-3-Clause
"""Which triangles of a mesh cross, touch or overlap another with which they share no corner."""

import numpy as np


def volume(a, b, c, d):
    """The sign of the volume of tetrahedra; 0 where rounding might have decided."""
    a, b, c = a - d, b - d, c - d
    normal = np.cross(b, c)
    result = np.einsum("ij,ij->i", a, normal)
    largest = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1) * np.linalg.norm(c, axis=1)
    return np.where(np.abs(result) > 1e-14 * largest, np.sign(result), 0)


def expanded(starts, counts):
    """Which range, and which place, of all places of ranges that follow one another."""
    of = np.repeat(np.arange(len(counts)), counts)
    return of, starts[of] + np.arange(len(of)) - np.repeat(np.cumsum(counts) - counts, counts)


def cells(low, high, size):
    """The cells that boxes no larger than a cell lie in: for each the index of the box and a key."""
    first = np.floor(low / size).astype(np.int64)
    last = np.floor(high / size).astype(np.int64)
    index, keys = [], []
    for corner in np.ndindex(2, 2, 2):
        there = ((last > first) | (np.array(corner) == 0)).all(axis=1)
        x, y, z = (first[there] + corner).T
        index.append(np.flatnonzero(there))
        keys.append((x << 42) + (y << 21) + z)
    return np.concatenate(index), np.concatenate(keys)


def close_pairs(low, high):
    """Pairs of boxes that overlap, each once; the first is the larger one, but for a factor of 2."""
    low, high = low - low.min(axis=0), high - low.min(axis=0)
    extent = (high - low).max(axis=1)
    largest = max(extent.max(), high.max() / 2 ** 20)
    level = np.floor(-np.log2(np.maximum(extent, high.max() / 2 ** 20) / largest)).astype(int)
    pairs = []
    for one in np.unique(level):
        size = largest / 2.0 ** one
        small = np.flatnonzero(level >= one)
        index, keys = cells(low[small], high[small], size)
        order = np.argsort(keys, kind="stable")
        index, keys = small[index[order]], keys[order]
        own = np.flatnonzero(level[index] == one)
        starts = np.searchsorted(keys, keys[own])
        of, place = expanded(starts, np.searchsorted(keys, keys[own], side="right") - starts)
        a, b = index[own[of]], index[place]
        kept = ((level[b] > one) | (a < b)) & (low[a] <= high[b]).all(axis=1) & (low[b] <= high[a]).all(axis=1)
        pairs.append(np.unique(np.column_stack((a[kept], b[kept])), axis=0))
    return np.vstack(pairs)


def edges_meet(one, other, sides):
    """Whether an edge of the one triangle meets the other; `sides`: of the other's plane its corners lie on."""
    a, b, c = other
    result = np.zeros(len(a), bool)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        p, q = one[i], one[j]
        around = np.stack([volume(p, q, *ends) for ends in ((a, b), (b, c), (c, a))])
        through = (around >= 0).all(axis=0) | (around <= 0).all(axis=0)
        result |= through & (sides[i] * sides[j] <= 0) & ((sides[i] != 0) | (sides[j] != 0))
    return result


def overlap_in_plane(one, other):
    """Whether triangles of one plane overlap: no line along an edge of either separates them."""
    normal = np.cross(one[1] - one[0], one[2] - one[0])
    apart = np.zeros(len(normal), bool)
    for triangle in (one, other):
        for i, j in ((0, 1), (1, 2), (2, 0)):
            axis = np.cross(normal, triangle[j] - triangle[i])
            first, second = (np.stack([np.einsum("ij,ij->i", axis, p) for p in t]) for t in (one, other))
            apart |= (first.max(axis=0) < second.min(axis=0)) | (second.max(axis=0) < first.min(axis=0))
    return ~apart


def crossing_triangles(points, triangles):
    """The indices of the triangles that meet one with which they share no corner."""
    corners = points[triangles]
    pairs = close_pairs(corners.min(axis=1), corners.max(axis=1))
    shared = (triangles[pairs[:, 0]][:, :, None] == triangles[pairs[:, 1]][:, None, :]).any(axis=(1, 2))
    pairs = pairs[~shared]
    for turn in (0, 1):  # all corners on one side of the other's plane: far apart
        plane, other = corners[pairs[:, turn]], corners[pairs[:, 1 - turn]]
        sides = np.stack([volume(*plane.transpose(1, 0, 2), other[:, corner]) for corner in range(3)])
        pairs = pairs[~((sides > 0).all(axis=0) | (sides < 0).all(axis=0))]
    if not len(pairs):
        return np.array([], int)
    one, other = (corners[pairs[:, turn]].transpose(1, 0, 2) for turn in (0, 1))
    sides_one, sides_other = (np.stack([volume(*plane, corner) for corner in triangle])
                              for plane, triangle in ((other, one), (one, other)))
    flat = (sides_one == 0).all(axis=0)
    meet = edges_meet(one, other, sides_one) | edges_meet(other, one, sides_other)
    meet[flat] = overlap_in_plane(one[:, flat], other[:, flat])
    return np.unique(pairs[meet])
