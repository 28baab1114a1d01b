# SPDX-License-Identifier: BSD-3-Clause
"""remesh(), and reconstruct() of a surface."""

import unittest

import neuralmesh
import numpy as np


def sheet(count=24):
    """Points and triangles of a bent sheet."""
    u, v = np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij")
    points = np.stack([u, v, 0.2 * np.sin(5 * u) * np.cos(4 * v)], axis=-1).reshape(-1, 3)
    a = (np.arange(count)[:, None] * (count + 1) + np.arange(count)[None, :]).reshape(-1)
    b = a + count + 1
    triangles = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    return points, triangles


def figure(mesh, name):
    return mesh.GetFieldData().GetArray(name).GetValue(0)


class Remesh(unittest.TestCase):
    # Promise: arrays in, a mesh of as many vertices out, with the boundary of the surface, and the same again.
    def test_arrays(self):
        mesh = neuralmesh.remesh(sheet(), 150)
        self.assertEqual(mesh.GetNumberOfPoints(), 150)
        self.assertEqual(figure(mesh, "BoundaryLoops"), 1)
        self.assertLess(figure(mesh, "Residual"), 0.005)
        again = neuralmesh.remesh(sheet(), 150, number_of_threads=1)
        self.assertEqual(
            [mesh.GetPoint(i) for i in range(150)], [again.GetPoint(i) for i in range(150)]
        )

    # Promise: a mesh goes in again, by either function, with its point data.
    def test_mesh(self):
        mesh = neuralmesh.remesh(sheet(), 200)
        smaller = neuralmesh.remesh(mesh, 100)
        self.assertEqual(smaller.GetNumberOfPoints(), 100)
        self.assertTrue(smaller.GetPointData().HasArray("Activity_Input"))
        other = neuralmesh.reconstruct(mesh, 100, input_is="surface")
        self.assertEqual(
            [smaller.GetPoint(i) for i in range(100)], [other.GetPoint(i) for i in range(100)]
        )

    # Promise: what is no surface, and what it excludes, are told in words.
    def test_wrong_use(self):
        points, triangles = sheet()
        for surface, more, words in (
            ((points, triangles[:0]), {}, "no triangles"),
            ((points * (1, 0, 0), triangles), {}, "no area"),
            (points, {}, "surface must be"),
            ((points, triangles.reshape(-1, 2)), {}, r"whole numbers of shape \(T, 3\), not of shape"),
            ((points, points), {}, "type float64"),
            ((points, triangles), {"time_limit": 5}, "ends a run early"),
            ((points, triangles), {"automatic": True}, "automatic"),
            ((points, triangles), {"boundaries": "close"}, "boundaries that are closed"),
            ((points, triangles), {"preset": "thesis"}, "which the preset Thesis sets"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                neuralmesh.remesh(surface, 100, **more)
        for name, value in (("levels", (10, 100)), ("input_is", "surface"), ("checkpoint", "state")):
            with self.assertRaisesRegex(TypeError, f"^remesh.* '{name}'; .*neuralmesh.remesh"):
                neuralmesh.remesh((points, triangles), 100, **{name: value})


if __name__ == "__main__":
    unittest.main()
