# SPDX-License-Identifier: BSD-3-Clause
"""reconstruct() and stream(): which side of an open surface is the outer one."""

import unittest
import warnings

import neuralmesh
import numpy as np
import support
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SIDES = (1.0, -1.0)


def sheet(height=0.0):
    """Points of a square that lies level."""
    points = np.random.default_rng(2).uniform(-1, 1, (3000, 3))
    points[:, 2] = height
    return points


def upwards(mesh):
    """The part of the normals that point upwards."""
    return (vtk_to_numpy(mesh.GetPointData().GetNormals())[:, 2] > 0).mean()


def told_by(mesh):
    return mesh.GetFieldData().GetAbstractArray("OrientedBy").GetValue(0)


def unoriented(mesh):
    fields = mesh.GetFieldData()
    return tuple(fields.GetArray(f"Unoriented{name}").GetTuple1(0) for name in ("Pieces", "Share"))


class Sides(unittest.TestCase):
    # Promise: where nothing tells the side, the field data says so.
    def test_unknown(self):
        mesh = neuralmesh.reconstruct(sheet(), 200)
        self.assertEqual(told_by(mesh), "nothing")
        self.assertEqual(unoriented(mesh), (1, 1))

    # Promise: viewpoints, normals and an up direction tell it, as whatever holds the numbers.
    def test_given(self):
        normals = np.zeros((3000, 3)) + (0, 0.2, 1)
        for side in SIDES:
            for told, given in (
                ("viewpoints", {"viewpoints": (0.2, 0, 3 * side)}),
                ("viewpoints", {"viewpoints": np.array([[0, 0, 3 * side], [1, 0, side]])}),
                ("viewpoints", {"viewpoints": [(0, 0, side), (0, 0, -side)], "views": np.zeros(3000, int)}),
                ("normals", {"normals": side * normals}),
                ("up direction", {"up": [0, 0, side], "normals": normals.astype(np.float32)}),
            ):
                with self.subTest(told, side=side):
                    mesh = neuralmesh.reconstruct(sheet(), 200, **given)
                    self.assertEqual(upwards(mesh), side > 0)
                    self.assertEqual(told_by(mesh), told)
                    self.assertEqual(unoriented(mesh), (0, 0))
        self.assertEqual(neuralmesh.reconstruct(support.sphere(), 200, ensemble=3, up=(0, 1, 0),
                                                viewpoints=(0, 0, 0)).GetNumberOfPoints(), 200)

    # Promise: an array of views arrives on the mesh, one of normals does not; the dataset of the caller
    # stays as it is.
    def test_arrays(self):
        dataset = support.point_set(sheet())
        mesh = neuralmesh.reconstruct(dataset, 200, viewpoints=[(0, 0, 1)], views=[0] * 3000,
                                      normals=np.ones((3000, 3)))
        data = mesh.GetPointData()
        names = {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
        self.assertEqual(names, {"Normals", "Activity", "Boundary", "Residual", "Support", "View"})
        self.assertEqual(dataset.GetPointData().GetNumberOfArrays(), 0)

    # Promise: a dataset may bring its viewpoint, and which of its points were seen from there. Of another one, which
    # is given, these tell nothing.
    def test_own_viewpoint(self):
        for number, told in ((0, "viewpoints"), (7, "nothing")):
            dataset = support.point_set(sheet())
            for data, name, values in ((dataset.GetFieldData(), "Viewpoints", np.array([[0., 0., -1.]])),
                                       (dataset.GetPointData(), "View", np.full(3000, number))):
                array = numpy_to_vtk(values, deep=True)
                array.SetName(name)
                data.AddArray(array)
            self.assertEqual(told_by(neuralmesh.reconstruct(dataset, 200)), told)
            mesh = neuralmesh.reconstruct(dataset, 200, viewpoints=(0, 0, -1))
            self.assertEqual((upwards(mesh), told_by(mesh)), (False, "viewpoints"))

    # Promise: normals may be an array of the dataset, by its name, which counts in place of the active
    # ones; none count that are "off".
    def test_named_normals(self):
        for side in SIDES:
            dataset = support.point_set(sheet())
            for name, height in (("Normals", -side), ("Slope", side)):
                array = numpy_to_vtk(np.zeros((3000, 3)) + (0, 0, height), deep=True)
                array.SetName(name)
                dataset.GetPointData().AddArray(array)
            dataset.GetPointData().SetActiveNormals("Normals")
            mesh = neuralmesh.reconstruct(dataset, 200, normals="Slope")
            self.assertEqual((upwards(mesh), told_by(mesh)), (side > 0, "normals"))
            for given in ({"normals": "off"}, {"use_normals": False}):
                mesh = neuralmesh.reconstruct(dataset, 200, **given)
                self.assertEqual(told_by(mesh), "nothing")
            message = "called Up for the normals. Arrays with three components: Normals, Slope."
            with self.assertRaisesRegex(ValueError, message):
                neuralmesh.reconstruct(dataset, 200, normals="Up")

    # Promise: what tells nothing is a warning.
    def test_warnings(self):
        for given in ({"normals": np.zeros((3000, 3))}, {"viewpoints": (np.nan, 0, 0)},
                      {"viewpoints": [(0, 0, 1)] * 2, "views": np.full(3000, 7)}):
            with self.assertWarnsRegex(RuntimeWarning, r"determine no side .*\[side-is-unknown\]$"):
                mesh = neuralmesh.reconstruct(sheet(), 200, **given)
            self.assertEqual(told_by(mesh), "nothing")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            neuralmesh.reconstruct(sheet(), 200)

    # Promise: what is none of them is a ValueError that says what it must be.
    def test_errors(self):
        for given, wanted in (
            ({"viewpoints": (1, 2)}, r"viewpoints must be .* \(3,\) or \(V, 3\)"),
            ({"viewpoints": "above"}, "viewpoints must be"),
            ({"viewpoints": [(1, 2, 3), (1, 2)]}, "viewpoints must be"),
            ({"up": (0, 0, 0)}, "up must have a length"),
            ({"up": [(0, 0, 1)] * 2}, "up must be three numbers"),
            ({"up": (0, np.inf, 0)}, "up must be three numbers"),
            ({"up": "z"}, "up must be three numbers, not 'z'"),
            ({"normals": np.zeros((2999, 3))}, r"normals must be numbers of shape \(3000, 3\)"),
            ({"views": np.zeros(3000)}, "views tell nothing without viewpoints"),
            ({"viewpoints": (0, 0, 1), "views": np.zeros(5)}, r"views must be .* \(3000,\)"),
            ({"viewpoints": (0, 0, 1), "views": "Missing"}, "called Missing for the views"),
            ({"normals": "Missing"}, "called Missing for the normals. None has three components."),
        ):
            with self.subTest(str(given)[:60]), self.assertRaisesRegex(ValueError, wanted):
                neuralmesh.reconstruct(sheet(), 200, **given)


class Streams(unittest.TestCase):
    # Promise: points know the viewpoint that they came with, or their normals.
    def test_given(self):
        for side in SIDES:
            for given in ({"viewpoint": (0, 0, side)}, {"normals": [(0, 0, side)] * 3000}):
                stream = neuralmesh.stream(200)
                stream.add_points(sheet(), **given)
                stream.add_points(sheet())
                stream.learn(20000)
                for finish in (True, False):
                    self.assertEqual(upwards(stream.mesh(finish)), side > 0)
            dataset = support.point_set(sheet())
            array = numpy_to_vtk(np.zeros((3000, 3)) + (0, 0, side), deep=True)
            array.SetName("Slope")
            dataset.GetPointData().SetNormals(array)
            stream = neuralmesh.stream(200)
            stream.add_points(dataset, normals="off")
            stream.learn(20000)
            self.assertEqual(told_by(stream.mesh()), "nothing")
            with self.assertRaisesRegex(ValueError, "called Up for the normals"):
                stream.add_points(dataset, normals="Up")
            stream.add_points(dataset, normals="Slope")
            stream.learn(20000)
            self.assertEqual((upwards(stream.mesh()), told_by(stream.mesh())), (side > 0, "normals"))
            stream = neuralmesh.stream(200, up=(0, 0, side))
            stream.add_points(sheet())
            stream.learn(20000)
            self.assertEqual(upwards(stream.mesh()), side > 0)


if __name__ == "__main__":
    unittest.main()
