# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that are shown while they learn."""

import unittest

import support
from neuralmesh.live import watch
from paraview import simple


tearDownModule = support.delete_views


class Live(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        support.load_plugin()
        self.view = simple.CreateView("RenderView")
        self.view.OrientationAxesVisibility = 0

    def mesh(self):
        return simple.NeuralMesh(
            Input=support.scan(), NumberOfVertices=2000, NumberOfSnapshots=6, Start="Tetrahedron"
        )

    # Promise: each snapshot is in the view while the mesh learns, seen from where the whole will be;
    # in the end the finished mesh is there, the same as if nobody had watched.
    def test_shows_growth(self):
        plain = self.mesh()
        expected = support.points_of(plain)
        simple.Delete(plain)
        vertices, parts = [], []

        def after_each(snapshot):
            vertices.append(snapshot.GetNumberOfPoints())
            parts.append(support.covered(self.view))

        mesh = self.mesh()
        watch(mesh, self.view, after_each)
        self.assertEqual(len(vertices), 5)
        self.assertEqual(vertices, sorted(set(vertices)))
        # The tetrahedron is a tenth of the sphere; then the disk grows to its size.
        self.assertTrue(0 < parts[0] < 0.1 * parts[-1], parts)
        self.assertAlmostEqual(support.covered(self.view), parts[-1], delta=0.02)
        self.assertEqual(support.points_of(mesh), expected)
        self.assertNotIn("Growing mesh", [name for name, _ in simple.GetSources()])

    # Promise: what the caller's function raises ends the run, and is raised again.
    def test_raises(self):
        class Enough(Exception):
            pass

        def after_each(snapshot):
            raise Enough

        mesh = self.mesh()
        with self.assertRaises(Enough):
            watch(mesh, self.view, after_each)
        self.assertEqual(support.field_value(mesh, "StopReason"), "cancelled")

    # Promise: other filters are refused.
    def test_refuses_others(self):
        with self.assertRaisesRegex(TypeError, "not vtkNeuralMeshScan"):
            watch(support.scan(), self.view)


if __name__ == "__main__":
    unittest.main()
