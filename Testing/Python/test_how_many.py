# SPDX-License-Identifier: BSD-3-Clause
"""reconstruct() where the number of vertices is to be found."""

import unittest

import neuralmesh
import numpy as np


def sphere(count=5000):
    """Points on the unit sphere."""
    points = np.random.default_rng(1).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def field(mesh, name):
    return mesh.GetFieldData().GetArray(name).GetValue(0)


class HowMany(unittest.TestCase):
    # Promise: "auto" and 0 are the same, and the field data say why.
    def test_automatic(self):
        mesh = neuralmesh.reconstruct(sphere(), "auto")
        self.assertGreater(mesh.GetNumberOfPoints(), 500)
        same = neuralmesh.reconstruct(sphere(), vertices=0)
        self.assertEqual(mesh.GetNumberOfPoints(), same.GetNumberOfPoints())
        reasons = mesh.GetFieldData().GetAbstractArray("Choice")
        self.assertGreaterEqual(reasons.GetNumberOfValues(), 3)
        self.assertGreater(field(mesh, "ErrorWithHalf"), field(mesh, "ErrorWithTwice"))

    # Promise: a tolerance takes the place of the number, in units or in percent, by the chosen measure.
    def test_tolerance(self):
        coarse = neuralmesh.reconstruct(sphere(), tolerance=0.02)
        self.assertLessEqual(field(coarse, "ReachedError"), 0.02)
        fine = neuralmesh.reconstruct(sphere(), tolerance=0.1, tolerance_is_percent=True)
        self.assertLessEqual(field(fine, "ReachedError"), 0.1 / 100 * 12**0.5)
        self.assertGreater(fine.GetNumberOfPoints(), coarse.GetNumberOfPoints())
        largest = neuralmesh.reconstruct(sphere(), tolerance=0.02, tolerance_measure="largest")
        self.assertGreater(largest.GetNumberOfPoints(), coarse.GetNumberOfPoints())

    # Promise: whoever ends the run has what was learnt until then.
    def test_ended(self):
        mesh = neuralmesh.reconstruct(sphere(), "auto", progress=lambda fraction: fraction < 0.5)
        self.assertGreater(mesh.GetNumberOfPoints(), 3)
        self.assertFalse(mesh.GetFieldData().HasArray("Choice"))

    # Promise: wrong use, and clouds that tell nothing, are told in words.
    def test_wrong_use(self):
        for points, more, words in (
            (sphere(), {"vertices": 3}, "an integer from 4 to 1000000000, or 0"),
            (sphere(), {"vertices": "AUTO"}, 'an integer from 4 to 1000000000, or 0, or "auto", not'),
            (sphere(), {"tolerance": -1}, "from 0"),
            (sphere(), {"tolerance": 0}, "larger than 0"),
            (sphere(), {"tolerance": 0.0, "vertices": "auto"}, "larger than 0"),
            (sphere(), {"tolerance": 100}, "any mesh meets it"),
            (sphere(3), {"vertices": "auto"}, "3 points"),
            (sphere(), {"vertices": 0, "time_limit": 5}, "stopping rule"),
            (sphere(), {"vertices": 0, "ensemble": 2}, "ensemble"),
            (sphere(), {"vertices": 0, "automatic": True}, "automatic"),
            (sphere(), {"vertices": "auto", "levels": (10, 100)}, "levels"),
            (sphere(), {"tolerance": 0.1, "levels": (100, 200)}, "tolerance and levels exclude"),
            (sphere(), {"tolerance": 0.1, "vertices": 500}, "vertices and tolerance exclude"),
            (sphere(), {"vertices": 500, "levels": (100, 200)}, "vertices and levels exclude"),
        ):
            with self.subTest(**more), self.assertRaisesRegex(ValueError, words):
                neuralmesh.reconstruct(points, **more)


if __name__ == "__main__":
    unittest.main()
