# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a mesh of a scan, by name.

Lengths are in percent of the diagonal of the reference, or of the cloud where there is none; the spacing of a
point is the mean distance of the 6 nearest. Parts of the area are those of 60,000 points drawn evenly on the mesh.

missed     % of the points (of 60,000) that are farther from the mesh than 3 of their own spacings
tenth      the same, in the tenth of the cloud along its longest axis where it is most
islands    parts of the cloud of which at most 0.5 % of the points are missed
ears       parts of which 90 % of the points have the mesh within 2 %
invented   % of the area that is farther than 3 spacings of the nearest point from all points
far        % of the area that is farther than 1 % from all points
inside     % of the area that is inside out: by the reference's normals, or looks away from the nearest point's eye
slivers    % of the triangles with 2 r / R below 0.1
seen       mean distance to the mesh of the seen part of the reference: that has 12 points within 1 %
seen99     ... and the distance that 99 % of it do not exceed
main       % of the points whose nearest place is on the same piece
torn       boundary loops with points beyond most of their length: 12 within 1 % of a place 1.5 % beyond
crossings  triangles that cross, touch or overlap another with which they share no corner
pieces, genus, loops   of `neuralmesh info`
mean, rms, hausdorff, normals   distances between mesh and reference, both ways, as `neuralmesh compare` has them
"""

import functools
import json
import subprocess

import numpy as np
from vtkmodules.vtkCommonCore import mutable, vtkIdList
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator, vtkStaticPointLocator

import files
import shapes
from crossings import crossing_triangles

SAMPLES = 60000
SEEN_SAMPLES = 40000
COMPARED_SAMPLES = 100000
SEEN_RADIUS, SEEN_POINTS = 0.01, 12


class Points:
    """Points, and which of them are nearest."""

    def __init__(self, points):
        self.points = points
        self.data = files.poly_data(points, np.zeros((0, 3), int))
        self.locator = vtkStaticPointLocator()
        self.locator.SetDataSet(self.data)
        # Points of a surface are in few of the cells, so that the usual number of cells would be too small.
        sides = np.ptp(points, axis=0)
        most = min(200, np.sqrt(len(points)) / 2)
        self.locator.AutomaticOff()
        self.locator.SetDivisions(*(max(1, int(most * side / sides.max())) for side in sides))
        self.locator.BuildLocator()

    def nearest(self, places):
        index = np.array([self.locator.FindClosestPoint(place) for place in places.tolist()], int)
        return index, np.linalg.norm(self.points[index] - places, axis=1)

    def distances(self, places, count):
        """To so many of the nearest points, the nearest first."""
        found, rows = vtkIdList(), []
        for place in places.tolist():
            self.locator.FindClosestNPoints(count, place, found)
            rows.append([found.GetId(i) for i in range(count)])
        away = self.points[np.array(rows, int).reshape(-1, count)] - places[:, None]
        return np.sort(np.linalg.norm(away, axis=2), axis=1)

    def spacings(self, index):
        return self.distances(self.points[index], 7)[:, 1:].mean(axis=1)

    def are_around(self, places, radius):
        """Whether there are so many points around each place that it counts as seen."""
        found, result = vtkIdList(), np.zeros(len(places), bool)
        for i, place in enumerate(places.tolist()):
            self.locator.FindPointsWithinRadius(radius, place, found)
            result[i] = found.GetNumberOfIds() >= SEEN_POINTS
        return result


class Surface:
    """Triangles that have an area, and which place of them is nearest."""

    def __init__(self, points, triangles):
        cross = np.cross(*(points[triangles[:, corner]] - points[triangles[:, 0]] for corner in (1, 2)))
        twice = np.linalg.norm(cross, axis=1)
        self.points, self.triangles, self.areas = points, triangles[twice > 0], twice[twice > 0]
        self.normals = cross[twice > 0] / self.areas[:, None]
        self.data = files.poly_data(points, self.triangles)
        self.locator = vtkStaticCellLocator()
        self.locator.SetDataSet(self.data)
        self.locator.BuildLocator()

    def nearest(self, places):
        """The nearest triangles and how far they are."""
        place, cell, sub, squared = [0.0] * 3, mutable(0), mutable(0), mutable(0.0)
        index, away = np.zeros(len(places), int), np.zeros(len(places))
        for i, wanted in enumerate(places.tolist()):
            self.locator.FindClosestPoint(wanted, place, cell, sub, squared)
            index[i], away[i] = int(cell), float(squared)
        return index, np.sqrt(away)

    def sample(self, count, seed):
        """Points drawn evenly, and the triangles that they lie on."""
        random = np.random.default_rng(seed)
        chosen = random.choice(len(self.triangles), count, p=self.areas / self.areas.sum())
        a, b, c = self.points[self.triangles[chosen]].transpose(1, 0, 2)
        root, part = np.sqrt(random.random((count, 1))), random.random((count, 1))
        return (1 - root) * a + root * (1 - part) * b + root * part * c, chosen

    def volume(self):
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        return np.einsum("ij,ij->", a, np.cross(b, c)) / 6

    def sliver_ratio(self):
        """2 r / R is 8 (s - a)(s - b)(s - c) / abc."""
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        x, y, z = (np.linalg.norm(p - q, axis=1) for p, q in ((b, c), (c, a), (a, b)))
        quality = (y + z - x) * (z + x - y) * (x + y - z) / (x * y * z)
        return np.mean(quality < 0.1)

    @functools.cached_property
    def half_edges(self):
        """Triangle, start and end of each side of each triangle, and the side that runs back, or -1."""
        ends = self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        count = len(self.points)
        keys, back = ends[:, 0] * count + ends[:, 1], ends[:, 1] * count + ends[:, 0]
        order = np.argsort(keys)
        place = np.searchsorted(keys[order], back).clip(None, len(keys) - 1)
        twin = np.where(keys[order][place] == back, order[place], -1)
        return np.repeat(np.arange(len(self.triangles)), 3), ends, twin

    def pieces(self):
        triangle, _, twin = self.half_edges
        inner = np.flatnonzero(twin >= 0)
        return shapes.connected(len(self.triangles), np.column_stack((triangle[inner], triangle[twin[inner]])))

    def boundary(self):
        """Of each side without a neighbour its ends, the way out of its triangle, and the number of its loop."""
        triangle, ends, twin = self.half_edges
        free = np.flatnonzero(twin < 0)
        start, end = ends[free].T
        along = self.points[end] - self.points[start]
        out = np.cross(along, self.normals[triangle[free]])
        out /= np.linalg.norm(out, axis=1)[:, None]
        following = dict(zip(start.tolist(), range(len(free))))
        loop = np.full(len(free), -1)
        for first in range(len(free)):
            at = first
            while at is not None and loop[at] < 0:
                loop[at] = first
                at = following.get(int(end[at]))
        return start, end, out, loop


class Measurement:
    """The figures of one mesh; each method of the name of a figure gives it."""

    def __init__(self, command, scan, mesh):
        """`scan` has the path of the cloud, that of the reference or None, view, eyes and part or None."""
        self.command, self.scan, self.mesh = command, scan, mesh
        points = files.read_points(scan.path)
        reference = files.read_mesh(scan.reference) if scan.reference else None
        box = reference[0] if reference else points
        middle, self.diagonal = (box.min(axis=0) + box.max(axis=0)) / 2, np.linalg.norm(np.ptp(box, axis=0))
        self.cloud = Points((points - middle) / self.diagonal)
        self.eyes = None if scan.eyes is None else (scan.eyes - middle) / self.diagonal
        found, triangles = files.read_mesh(mesh)
        self.surface = Surface((found - middle) / self.diagonal, triangles)
        self.reference = Surface((reference[0] - middle) / self.diagonal, reference[1]) if reference else None
        random = np.random.default_rng(1)
        self.some = random.permutation(len(points))[:SAMPLES]

    def figures(self, names):
        return {name: getattr(self, name)() for name in names}

    @functools.cached_property
    def info(self):
        return self.said("info", self.mesh)

    @functools.cached_property
    def ways(self):
        """From the mesh to the reference and back: distances of points drawn evenly, the largest of those and of
        the corners, and the angles between normals. Not by `neuralmesh compare`, which takes minutes where two
        layers lie close to one another."""
        result = []
        for one, other in ((self.surface, self.reference), (self.reference, self.surface)):
            places, triangle = one.sample(COMPARED_SAMPLES, 3)
            index, away = other.nearest(places)
            corners = other.nearest(one.points[np.unique(one.triangles)])[1]
            cosine = np.abs(np.einsum("ij,ij->i", one.normals[triangle], other.normals[index]))
            result.append((100 * away, 100 * max(away.max(), corners.max()), np.degrees(np.arccos(cosine.clip(0, 1)))))
        return result

    def said(self, *words):
        return json.loads(subprocess.run([self.command, *words, "--json"], check=True, capture_output=True,
                                         text=True).stdout)

    @functools.cached_property
    def to_mesh(self):
        """Of some points the nearest triangle, and how far it is."""
        return self.surface.nearest(self.cloud.points[self.some])

    @functools.cached_property
    def missing(self):
        return self.to_mesh[1] > 3 * self.cloud.spacings(self.some)

    @functools.cached_property
    def drawn(self):
        """Points of the mesh, their triangles, the nearest points of the cloud and how far they are."""
        places, triangle = self.surface.sample(SAMPLES, 1)
        return (places, triangle, *self.cloud.nearest(places))

    @functools.cached_property
    def seen_distances(self):
        places, _ = self.reference.sample(SEEN_SAMPLES, 2)
        seen = places[self.cloud.are_around(places, SEEN_RADIUS)]
        return 100 * self.surface.nearest(seen)[1]

    def missed(self):
        return 100 * np.mean(self.missing)

    def tenth(self):
        x = self.cloud.points[:, np.argmax(np.ptp(self.cloud.points, axis=0))]
        tenth = np.minimum((x - x.min()) / np.ptp(x) * 10, 9).astype(int)[self.some]
        return 100 * max(np.mean(self.missing[tenth == i]) for i in range(10) if (tenth == i).any())

    def islands(self):
        part = self.scan.part[self.some]
        return sum(np.mean(self.missing[part == i]) <= 0.005 for i in np.unique(part))

    def ears(self):
        part = self.scan.part[self.some]
        there = self.to_mesh[1] <= 0.02
        return sum(np.mean(there[part == i]) >= 0.9 for i in np.unique(part) if i > 0)

    def invented(self):
        _, _, index, away = self.drawn
        near, of = np.unique(index, return_inverse=True)
        return 100 * np.mean(away > 3 * self.cloud.spacings(near)[of] + 1e-12)

    def far(self):
        return 100 * np.mean(self.drawn[3] > 0.01)

    def inside(self):
        places, triangle, index, _ = self.drawn
        if self.reference:
            outside = self.reference.normals[self.reference.nearest(places)[0]] * np.sign(self.reference.volume())
        elif self.eyes is not None:
            outside = self.eyes[self.scan.view[index]] - places
        else:
            raise ValueError(f"{self.scan.path}: nothing tells which side is the outer one")
        return 100 * np.mean(np.einsum("ij,ij->i", self.surface.normals[triangle], outside) < 0)

    def slivers(self):
        return 100 * self.surface.sliver_ratio()

    def seen(self):
        return np.mean(self.seen_distances)

    def seen99(self):
        return np.quantile(self.seen_distances, 0.99)

    def main(self):
        pieces = self.surface.pieces()[self.to_mesh[0]]
        return 100 * np.unique(pieces, return_counts=True)[1].max() / len(pieces)

    def torn(self):
        start, end, out, loop = self.surface.boundary()
        ends = self.surface.points[[start, end]]
        data = self.cloud.are_around(ends.mean(axis=0) + 0.015 * out, SEEN_RADIUS)
        length = np.linalg.norm(ends[1] - ends[0], axis=1)
        return sum(length[data & (loop == i)].sum() > length[loop == i].sum() / 2 for i in np.unique(loop))

    def crossings(self):
        return len(crossing_triangles(self.surface.points, self.surface.triangles))

    def pieces(self):
        return self.info["components"]

    def genus(self):
        return self.info["genus"]

    def loops(self):
        return self.info["boundary_loops"]

    def mean(self):
        return np.mean([np.mean(away) for away, _, _ in self.ways])

    def rms(self):
        return np.sqrt(np.mean([np.mean(away ** 2) for away, _, _ in self.ways]))

    def hausdorff(self):
        return max(most for _, most, _ in self.ways)

    def normals(self):
        return np.mean([np.mean(angle) for _, _, angle in self.ways])
