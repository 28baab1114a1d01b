# SPDX-License-Identifier: BSD-3-Clause
"""reconstruct(feature_lines=True)."""

import unittest

import neuralmesh
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy


def cube(count=20000):
    """Points on the cube of side 1."""
    random = np.random.default_rng(1)
    points = random.uniform(-0.5, 0.5, (count, 3))
    points[np.arange(count), random.integers(0, 3, count)] = random.choice((-0.5, 0.5), count)
    return points


class FeatureLines(unittest.TestCase):
    # Promise: they are one more result, behind explained points if those are asked for, and the mesh is the
    # same as without, but for its creases.
    def test_results(self):
        mesh, lines = neuralmesh.reconstruct(cube(), 1000, feature_lines=True)
        self.assertGreaterEqual(lines.GetNumberOfLines(), 12)
        lengths = vtk_to_numpy(lines.GetCellData().GetArray("Length"))
        self.assertAlmostEqual(lengths.sum(), 12, delta=0.5)
        creases = vtk_to_numpy(mesh.GetPointData().GetArray("Crease"))
        self.assertEqual((creases > 0).sum(), lines.GetNumberOfPoints())
        plain, explained, again = neuralmesh.reconstruct(
            cube(), 1000, feature_lines=True, explain=True, feature_angle=120
        )
        self.assertEqual(explained.GetNumberOfPoints(), 20000)
        self.assertEqual(again.GetNumberOfPoints(), 0)
        without = neuralmesh.reconstruct(cube(), 1000)
        for one in (mesh, plain):
            np.testing.assert_array_equal(
                vtk_to_numpy(one.GetPoints().GetData()), vtk_to_numpy(without.GetPoints().GetData())
            )
        self.assertIsNone(without.GetPointData().GetArray("Crease"))

    # Promise: the angle is a parameter with a range, and the flag is none.
    def test_parameters(self):
        with self.assertRaisesRegex(ValueError, "feature_angle"):
            neuralmesh.reconstruct(cube(100), 50, feature_lines=True, feature_angle=0)
        with self.assertRaises(TypeError):
            neuralmesh.reconstruct(cube(100), 50, compute_feature_lines=True)

    # Promise: whoever ends the run gets no lines.
    def test_ended(self):
        mesh, lines = neuralmesh.reconstruct(
            cube(), 1000, feature_lines=True, progress=lambda fraction: fraction < 0.3
        )
        self.assertEqual(lines.GetNumberOfPoints(), 0)
        self.assertIsNone(mesh.GetPointData().GetArray("Crease"))


if __name__ == "__main__":
    unittest.main()
