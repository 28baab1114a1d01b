# SPDX-License-Identifier: BSD-3-Clause
"""reconstruct(levels=...)."""

import unittest

import neuralmesh
import numpy as np


def sphere(count=5000):
    """Points on the unit sphere."""
    points = np.random.default_rng(1).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


class Levels(unittest.TestCase):
    # Promise: the meshes of all levels are a list, in their order, whatever else is asked for.
    def test_results(self):
        meshes = neuralmesh.reconstruct(sphere(), levels=(100, 300, 900))
        self.assertEqual([mesh.GetNumberOfPoints() for mesh in meshes], [100, 300, 900])
        for mesh in meshes:
            self.assertEqual(mesh.GetFieldData().GetArray("Components").GetValue(0), 1)
        again, explained = neuralmesh.reconstruct(sphere(), levels=np.array([200, 400]), explain=True)
        self.assertEqual([mesh.GetNumberOfPoints() for mesh in again], [200, 400])
        self.assertEqual(explained.GetNumberOfPoints(), 5000)

    # Promise: whoever ends the run has what was learnt until then.
    def test_ended(self):
        meshes = neuralmesh.reconstruct(
            sphere(), levels=(100, 300, 900), progress=lambda fraction: fraction < 0.5
        )
        self.assertLess(len(meshes), 4)
        self.assertGreater(meshes[-1].GetNumberOfPoints(), 4)

    # Promise: levels that are none, and what they exclude, are told in words.
    def test_wrong_use(self):
        for levels, more, words in (
            ((300, 100), {}, "ascend"),
            ((3, 100), {}, "from 4 to"),
            ((100.5, 200), {}, "whole number"),
            (("many",), {}, "whole number"),
            (500, {}, "levels must be several numbers"),
            ((100, 200), {"time_limit": 5}, "stopping rule"),
            ((100, 200), {"ensemble": 2}, "ensemble"),
            ((100, 200), {"automatic": True}, "automatic"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                neuralmesh.reconstruct(sphere(), levels=levels, **more)


if __name__ == "__main__":
    unittest.main()
