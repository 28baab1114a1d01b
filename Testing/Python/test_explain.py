# SPDX-License-Identifier: BSD-3-Clause
"""explain(), reconstruct(explain=True), and what is warned of."""

import unittest
import warnings

import neuralmesh
import numpy as np
import support
from vtkmodules.util.numpy_support import vtk_to_numpy


def array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def field(data, name):
    return data.GetFieldData().GetArray(name).GetTuple1(0)


class Explain(unittest.TestCase):
    # Promise: each point has a distance to any mesh, and a reason.
    def test_any_mesh(self):
        first = support.sphere(4000)
        mesh = neuralmesh.reconstruct(first, 500)
        both = np.vstack((first, support.sphere(1000) + (5, 0, 0)))
        explained = neuralmesh.explain(both, mesh)
        reasons = array(explained, "Reason")
        self.assertEqual(reasons[:4000].max(), 0)
        self.assertEqual(set(reasons[4000:]), {3})
        self.assertLess(array(explained, "Distance")[:4000].max(), 0.1)
        self.assertEqual(field(explained, "UnexplainedPoints"), 1000)
        small = neuralmesh.explain(both, mesh, 0.5)
        self.assertEqual(field(small, "SmallPiecePoints"), 1000)

    # Promise: a run gives them with the mesh, which is the same as without.
    def test_of_a_run(self):
        points = support.sphere(4000)
        mesh, explained = neuralmesh.reconstruct(points, 300, explain=True)
        self.assertEqual(explained.GetNumberOfPoints(), 4000)
        self.assertEqual(array(explained, "Reason").max(), 0)
        without = neuralmesh.reconstruct(points, 300)
        np.testing.assert_array_equal(
            vtk_to_numpy(mesh.GetPoints().GetData()), vtk_to_numpy(without.GetPoints().GetData())
        )
        self.assertAlmostEqual(array(mesh, "Support").sum(), 4000, delta=1)
        self.assertEqual(array(mesh, "Boundary").max(), 0)
        self.assertEqual(len(array(mesh, "Residual")), 300)

    # Promise: of points that a depth camera has not seen, one counts; the others are dropped, and there is a warning.
    def test_unseen_points(self):
        points = support.sphere(4000) + (3, 0, 0)
        points[::8] = 0
        with self.assertWarnsRegex(RuntimeWarning, r"499 points were dropped.*\[points-coincide\]"):
            mesh, explained = neuralmesh.reconstruct(points, 300, explain=True)
        self.assertEqual(field(mesh, "DroppedPoints"), 499)
        for found in (explained, neuralmesh.explain(points, mesh)):
            reasons = array(found, "Reason")
            np.testing.assert_array_equal(np.unique(reasons, return_counts=True), ([0, 1, 4], [3500, 1, 499]))
            self.assertEqual(set(reasons[8::8]), {4})
            np.testing.assert_array_equal(np.isnan(array(found, "Distance")), reasons == 4)

    # Promise: warnings are Python's, and those of the field data.
    def test_warnings(self):
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            mesh = neuralmesh.reconstruct(support.sphere(300), 200)
        texts = mesh.GetFieldData().GetAbstractArray("Warnings")
        self.assertGreater(texts.GetNumberOfValues(), 0)
        self.assertEqual(
            [texts.GetValue(i) for i in range(texts.GetNumberOfValues())],
            [str(warning.message) for warning in warned],
        )

    # Promise: what is wrong is a ValueError.
    def test_errors(self):
        mesh = neuralmesh.reconstruct(support.sphere(1000), 100)
        for arguments in (
            (np.zeros((0, 3)), mesh),
            (np.zeros((5, 3)), mesh),
            (support.sphere(100), None),
            (support.sphere(100), type(mesh)()),
            (support.sphere(100), mesh, 2),
        ):
            with self.assertRaises(ValueError):
                neuralmesh.explain(*arguments)


if __name__ == "__main__":
    unittest.main()
