# SPDX-License-Identifier: BSD-3-Clause
"""A virtual range scanner: what a laser and a camera beside it see of a closed mesh that stands on a table.

Lengths are in percent of the diagonal of the mesh, which must be 1. As in A Benchmark for Surface Reconstruction
(Berger et al. 2013), there is noise that grows at grazing angles, depth is rounded, some points beside
silhouettes lie between two surfaces, and each view is a little out of place.
"""

import numpy as np

DISTANCE = 2.5  # of the eyes
WIDTH = 1.1  # of the picture, at the middle of the object


def eyes_above_table(count, up, turn):
    """Places all around, spread evenly, not below the middle of the object."""
    index = np.arange(count) + 0.5
    height = index / count
    angle = turn + np.pi * (1 + np.sqrt(5)) * index
    ring = np.sqrt(1 - height * height)
    eyes = np.column_stack((ring * np.cos(angle), ring * np.sin(angle), height)) * DISTANCE
    return eyes[:, [1, 2, 0]] if up == "y" else eyes


def axes_of(eye):
    """The right, upper and inward direction of the picture that is seen from there."""
    inward = -eye / np.linalg.norm(eye)
    right = np.cross(inward, np.eye(3)[np.argmin(np.abs(inward))])
    right /= np.linalg.norm(right)
    return np.stack((right, np.cross(right, inward), inward))


class DepthMap:
    """Which triangle is seen in each pixel, and how deep along the inward direction."""

    def __init__(self, points, triangles, eye, size):
        self.eye, self.axes, self.size = eye, axes_of(eye), size
        seen = self.pixels(points)
        a, b, c = (seen[triangles[:, corner]] for corner in range(3))
        low = np.ceil(np.minimum(np.minimum(a, b), c)[:, :2]).astype(int).clip(0)
        high = np.floor(np.maximum(np.maximum(a, b), c)[:, :2]).astype(int).clip(None, size - 1)
        width, height = (high - low + 1).clip(0).T
        # All pixels of the boxes of all triangles, in one row.
        of = np.repeat(np.arange(len(triangles)), width * height)
        place = np.arange(len(of)) - np.repeat(np.cumsum(width * height) - width * height, width * height)
        x, y = low[of, 0] + place % width[of], low[of, 1] + place // width[of]
        (ux, uy), (vx, vy) = (b - a)[of, :2].T, (c - a)[of, :2].T
        dx, dy = x - a[of, 0], y - a[of, 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            s, t = (dx * vy - dy * vx) / (ux * vy - uy * vx), (ux * dy - uy * dx) / (ux * vy - uy * vx)
            inside = (s >= 0) & (t >= 0) & (s + t <= 1)
        of, s, t, pixel = of[inside], s[inside], t[inside], (y * size + x)[inside]
        # In the picture not depth but its reciprocal is linear.
        near = ((1 - s - t) / a[of, 2] + s / b[of, 2] + t / c[of, 2])
        order = np.lexsort((-near, pixel))
        first = order[np.r_[True, np.diff(pixel[order]) > 0]]
        self.depth = np.full(size * size, np.inf)
        self.triangle = np.full(size * size, -1)
        self.depth[pixel[first]], self.triangle[pixel[first]] = 1 / near[first], of[first]

    def pixels(self, points):
        """Column, row and depth of points."""
        seen = (points - self.eye) @ self.axes.T
        return np.column_stack((((seen[:, :2] / seen[:, 2:]) * DISTANCE / WIDTH + 0.5) * self.size - 0.5, seen[:, 2]))

    def rays(self):
        """The direction of each pixel, of length 1 along the inward direction."""
        row, column = np.divmod(np.arange(self.size * self.size), self.size)
        plane = ((np.column_stack((column, row)) + 0.5) / self.size - 0.5) * WIDTH / DISTANCE
        return plane @ self.axes[:2] + self.axes[2]

    def hides(self, points, tolerance):
        """Whether something lies before each of the points."""
        seen = self.pixels(points)
        column, row = np.rint(seen[:, :2]).astype(int).clip(0, self.size - 1).T
        return seen[:, 2] > self.depth[row * self.size + column] + tolerance


def mixed(depth, kept, random, part, size):
    """Depths of which some, beside a jump of more than 1 %, lie between the two surfaces or behind the outline."""
    picture, result = depth.reshape(size, size), depth.copy()
    for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
        chosen = np.flatnonzero(kept & (random.random(len(depth)) < part))
        gap = np.roll(picture, step, axis).ravel()[chosen] - depth[chosen]
        jump = np.isfinite(gap) & (gap > 0.01)
        between, outline = chosen[jump], chosen[np.isinf(gap)]
        result[between] += gap[jump] * random.random(len(between)) ** 2
        result[outline] += random.exponential(0.01, len(outline))
    return result


def turned_a_little(points, random, percent):
    """Turned and shifted so that points are moved by about so much."""
    shift, axis = random.normal(size=(2, 3))
    shift *= percent / 100 / np.sqrt(2) / np.linalg.norm(shift)
    axis *= percent / 100 / np.sqrt(2) / 0.3 / np.linalg.norm(axis)  # points are .3 from the middle, on average
    return points + np.cross(axis, points) + shift


def scan(points, triangles, views, registration, *, up="y", seed=1, size=385, noise=0.04, rounding=0.02,
         grazing=78, mixed_part=0.1, laser=18):
    """Points, the index of the view of each, and the eyes of the views.

    No point is seen at more than `grazing` degrees; the laser stands so many degrees beside the camera, and what
    it cannot reach is not seen."""
    random = np.random.default_rng(seed)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None].clip(1e-30)
    eyes = eyes_above_table(views, up, random.uniform(0, 2 * np.pi))
    clouds, view = [], []
    for index, eye in enumerate(eyes):
        camera = DepthMap(points, triangles, eye, size)
        rays, kept = camera.rays(), camera.triangle >= 0
        place = eye + rays * np.where(kept, camera.depth, 0)[:, None]
        angle = np.radians(laser)
        beside = DISTANCE * (camera.axes[0] * np.sin(angle) - camera.axes[2] * np.cos(angle))
        kept &= ~DepthMap(points, triangles, beside, 2 * size).hides(place, 0.006)
        cosine = np.abs(np.einsum("ij,ij->i", normals[camera.triangle], rays)) / np.linalg.norm(rays, axis=1)
        incidence = np.degrees(np.arccos(cosine.clip(0, 1)))
        kept &= random.random(len(kept)) < (grazing - incidence) / (grazing - 60)
        depth = mixed(camera.depth, kept, random, mixed_part, size)[kept]
        depth += random.normal(0, noise / 100, len(depth)) / cosine[kept].clip(0.15)
        depth = np.rint(depth / (rounding / 100)) * (rounding / 100)
        clouds.append(turned_a_little(eye + rays[kept] * depth[:, None], random, registration))
        view.append(np.full(kept.sum(), index, np.uint8))
    order = random.permutation(sum(map(len, view)))
    return np.vstack(clouds)[order], np.concatenate(view)[order], eyes
