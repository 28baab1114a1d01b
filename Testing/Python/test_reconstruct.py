# SPDX-License-Identifier: BSD-3-Clause
"""reconstruct(): whatever holds the points, the mesh is that of the filter."""

import pathlib
import re
import tempfile
import unittest

import neuralmesh
import numpy as np
import support
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_FLOAT
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkUnstructuredGrid,
)


class Arrays(unittest.TestCase):
    # Promise: the function gives the bytes of the filter, as often as it is called.
    def test_same_as_filter(self):
        cloud = support.sphere()
        algorithm = neuralmesh.vtkNeuralMesh()
        algorithm.SetInputData(support.point_set(cloud))
        algorithm.SetNumberOfVertices(300)
        algorithm.SetSeed(7)
        algorithm.Update()
        wanted = support.arrays_of(algorithm.GetOutput())
        for _ in range(2):
            mesh = neuralmesh.reconstruct(cloud, 300, 7)
            self.assertEqual(support.arrays_of(mesh), wanted)
        self.assertNotEqual(support.arrays_of(neuralmesh.reconstruct(cloud, 300, 8)), wanted)

    # Promise: any type of number is taken; 4-byte floats stay so, all else becomes 8-byte floats.
    def test_types(self):
        for name in ("f2", "f4", ">f4", "f8", ">f8", "g", "i1", "i2", "i4", "i8", "u1", "u8"):
            with self.subTest(name):
                cloud = (100 + 20 * support.sphere()).astype(name)
                mesh = neuralmesh.reconstruct(cloud, 100)
                self.assertEqual(mesh.GetNumberOfPoints(), 100)
                self.assertTrue(support.is_closed_manifold(mesh))
                single = name.endswith("f4")
                self.assertEqual(mesh.GetPoints().GetDataType(), VTK_FLOAT if single else VTK_DOUBLE)
                same = neuralmesh.reconstruct(cloud.astype("f4" if single else "f8"), 100)
                self.assertEqual(support.arrays_of(mesh), support.arrays_of(same))

    # Promise: any layout in memory is taken, and the array is neither kept nor changed.
    def test_layouts(self):
        cloud = support.sphere()
        wanted = support.arrays_of(neuralmesh.reconstruct(cloud, 100))
        wide = np.zeros((4000, 5))
        wide[::2, 1:4] = cloud
        frozen = cloud.copy()
        frozen.flags.writeable = False
        layouts = {
            "column by column": np.asfortranarray(cloud),
            "part of a larger array": wide[::2, 1:4],
            "backwards": cloud[::-1].copy()[::-1],
            "read-only": frozen,
            "a list of lists": cloud.tolist(),
            "a list of tuples": [tuple(point) for point in cloud],
            "a list of arrays": list(cloud),
        }
        for name, points in layouts.items():
            with self.subTest(name):
                mesh = neuralmesh.reconstruct(points, 100)
                self.assertEqual(support.arrays_of(mesh), wanted)
        self.assertTrue((cloud == support.sphere()).all())

    # Promise: what is no array of shape (N, 3) of numbers is a ValueError that names the shape.
    def test_wrong_shapes(self):
        wrong = {
            "(2000, 2)": support.sphere()[:, :2],
            "(2000, 4)": np.zeros((2000, 4)),
            "(3, 2000)": support.sphere().T,
            "(6000,)": support.sphere().ravel(),
            "(1, 2000, 3)": support.sphere()[None],
            "(0,)": [],
            "()": 5.0,
            "complex128": np.ones((10, 3), complex),
            "bool": np.ones((10, 3), bool),
            "<U1": [["a", "b", "c"]],
            "list": [[1, 2, 3], [4, 5]],
            "ImageData": vtkImageData(),
        }
        for part, points in wrong.items():
            with self.subTest(part):
                with self.assertRaisesRegex(ValueError, r"of shape \(N, 3\)") as caught:
                    neuralmesh.reconstruct(points, 100)
                self.assertIn(part, str(caught.exception))

    # Promise: arrays with more columns, on their side or with named fields are told what to pass, and
    # that works.
    def test_what_to_pass(self):
        cloud = support.sphere()
        wanted = support.arrays_of(neuralmesh.reconstruct(cloud, 100))
        fields = np.zeros(len(cloud), [("x", "f8"), ("y", "f8"), ("z", "f8"), ("intensity", "u1")])
        fields["x"], fields["y"], fields["z"] = cloud.T
        for points in np.hstack((cloud, cloud)), cloud.T, fields:
            with self.assertRaises(ValueError) as caught:
                neuralmesh.reconstruct(points, 100)
            said = re.search(r": pass (.*?)(?: if .*)?$", str(caught.exception))[1]
            mesh = neuralmesh.reconstruct(eval(said, {"numpy": np, "points": points}), 100)
            self.assertEqual(support.arrays_of(mesh), wanted)


class Datasets(unittest.TestCase):
    # Promise: any vtkPointSet is taken, and many as one cloud.
    def test_datasets(self):
        cloud = support.sphere()
        wanted = support.arrays_of(neuralmesh.reconstruct(cloud, 100))
        poly_data = support.point_set(cloud)
        grid = vtkUnstructuredGrid()
        grid.SetPoints(poly_data.GetPoints())
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, support.point_set(cloud[:500]))
        blocks.SetBlock(1, support.point_set(cloud[500:]))
        for dataset in (poly_data, grid, blocks):
            with self.subTest(dataset.GetClassName()):
                mesh = neuralmesh.reconstruct(dataset, 100)
                self.assertEqual(support.arrays_of(mesh), wanted)

    # Promise: the result belongs to the caller alone; no pipeline is behind it.
    def test_no_pipeline(self):
        mesh = neuralmesh.reconstruct(support.sphere(), 100)
        self.assertEqual(mesh.GetReferenceCount(), 1)
        # One reference is that of the mesh, one is that of this line.
        self.assertEqual(mesh.GetPoints().GetReferenceCount(), 2)


class FirstMesh(unittest.TestCase):
    # Promise: learning starts from the first mesh, as that of the filter does.
    def test_same_as_filter(self):
        cloud = support.sphere()
        first = neuralmesh.reconstruct(cloud, 100)
        algorithm = neuralmesh.vtkNeuralMesh()
        algorithm.SetInputData(support.point_set(cloud))
        algorithm.SetFirstMeshData(first)
        algorithm.SetNumberOfVertices(200)
        algorithm.Update()
        mesh = neuralmesh.reconstruct(cloud, 200, first_mesh=first)
        self.assertEqual(support.arrays_of(mesh), support.arrays_of(algorithm.GetOutput()))
        self.assertEqual(mesh.GetNumberOfPoints(), 200)
        self.assertTrue(support.is_closed_manifold(mesh))
        self.assertNotEqual(
            support.arrays_of(mesh), support.arrays_of(neuralmesh.reconstruct(cloud, 200))
        )

    # Promise: what is no vtkPolyData, or no manifold, is a ValueError that says so.
    def test_bad_meshes(self):
        cloud = support.sphere()
        for bad in (cloud, "mesh.ply", vtkUnstructuredGrid()):
            with self.assertRaisesRegex(ValueError, "first_mesh must be a vtkPolyData, not "):
                neuralmesh.reconstruct(cloud, 200, first_mesh=bad)
        with self.assertRaisesRegex(ValueError, "first mesh: there are no triangles"):
            neuralmesh.reconstruct(cloud, 200, first_mesh=support.point_set(cloud))
        fins = support.point_set(cloud[:5])
        triangles = vtkCellArray()
        for tip in (2, 3, 4):
            triangles.InsertNextCell(3, (0, 1, tip))
        fins.SetPolys(triangles)
        with self.assertRaisesRegex(ValueError, "edge 0-1 has 3 triangles"):
            neuralmesh.reconstruct(cloud, 200, first_mesh=fins)

    # Promise: one that has more vertices than asked for comes out as it is, with a warning.
    def test_large(self):
        cloud = support.sphere()
        first = neuralmesh.reconstruct(cloud, 100)
        with self.assertWarnsRegex(RuntimeWarning, "100 vertices, more than 50"):
            mesh = neuralmesh.reconstruct(cloud, 50, first_mesh=first)
        self.assertEqual(mesh.GetNumberOfPoints(), 100)


class Variants(unittest.TestCase):
    # Promise: what is asked for by keyword reaches the filter, words included.
    def test_same_as_filter(self):
        cloud = support.sphere()
        algorithm = neuralmesh.vtkNeuralMesh()
        algorithm.SetInputData(support.point_set(cloud))
        algorithm.SetNumberOfVertices(300)
        algorithm.SetVariantToNormalBased()
        algorithm.SetOrderToList()
        algorithm.SetPresetToDefault()
        algorithm.SetListVertices(50)
        algorithm.SetJumpToVolumeChange()
        algorithm.SetJumpFraction(0.1)
        algorithm.ComputeFeatureStrengthOn()
        algorithm.Update()
        mesh = neuralmesh.reconstruct(
            cloud,
            300,
            variant="normal",
            order="list",
            list_vertices=50,
            jump="volume_change",
            jump_fraction=0.1,
            compute_feature_strength=True,
        )
        self.assertEqual(support.arrays_of(mesh), support.arrays_of(algorithm.GetOutput()))
        self.assertTrue(mesh.GetPointData().HasArray("FeatureStrength"))

    # Promise: error bars are positive floats of the vertices, and no other mesh; without a fit there are none, but
    # words.
    def test_uncertainty(self):
        cloud = support.sphere()
        plain = neuralmesh.reconstruct(cloud, 300)
        mesh = neuralmesh.reconstruct(cloud, 300, compute_uncertainty=True)
        bars = mesh.GetPointData().GetArray("Uncertainty")
        self.assertEqual(bars.GetDataTypeAsString(), "float")
        self.assertGreater(bars.GetRange()[0], 0.0)
        mesh.GetPointData().RemoveArray("Uncertainty")
        self.assertEqual(support.arrays_of(mesh), support.arrays_of(plain))
        with self.assertRaisesRegex(ValueError, "Error bars need the fit"):
            neuralmesh.reconstruct(cloud, 300, compute_uncertainty=True, fit_rounds=0)

    # Promise: topology learning and ensembles give a torus its handle; nothing else does.
    def test_topology(self):
        u, v = 2 * np.pi * np.random.default_rng(1).random((2, 40000))
        r = 1 + 0.4 * np.cos(v)
        torus = np.stack((r * np.cos(u), r * np.sin(u), 0.4 * np.sin(v)), axis=1)
        ways = {
            "start": {},
            "topology": {"start": "tetrahedron", "topology_learning": True},
            "ensemble": {"ensemble": 5, "vertices_per_member": 1500},
            "neither": {"start": "tetrahedron"},
        }
        for way, parameters in ways.items():
            with self.subTest(way):
                mesh = neuralmesh.reconstruct(torus, 2000, **parameters)
                self.assertTrue(support.is_closed_manifold(mesh))
                euler = mesh.GetNumberOfPoints() - mesh.GetNumberOfPolys() // 2
                self.assertEqual(euler, 2 if way == "neither" else 0)

    # Promise: what does not go together is a ValueError that tells what does.
    def test_without_sense(self):
        cloud = support.sphere()
        with self.assertRaisesRegex(ValueError, "with the order list"):
            neuralmesh.reconstruct(cloud, 300, jump="area_change")
        with self.assertRaisesRegex(ValueError, "noise_filtering and basic"):
            neuralmesh.reconstruct(cloud, 300, variant="normal", topology_learning=True)
        with self.assertRaisesRegex(ValueError, "ensemble"):
            neuralmesh.reconstruct(cloud, 300, ensemble=0)


class PointData(unittest.TestCase):
    # Promise: point data of a dataset arrives on the mesh, unless it is not wanted.
    def test_carried(self):
        cloud = support.sphere()
        dataset = support.point_set(cloud)
        heights = numpy_to_vtk(cloud[:, 2].copy())
        heights.SetName("Height")
        dataset.GetPointData().AddArray(heights)
        mesh = neuralmesh.reconstruct(dataset, 300)
        carried = vtk_to_numpy(mesh.GetPointData().GetArray("Height"))
        self.assertEqual(carried.dtype, np.float64)
        self.assertLess(np.abs(carried - support.coordinates(mesh)[:, 2]).max(), 0.1)
        mesh = neuralmesh.reconstruct(dataset, 300, carry_point_data=False)
        self.assertFalse(mesh.GetPointData().HasArray("Height"))

    # Promise: weights are an array or a name; points of weight 0 have no influence; the points of
    # the caller stay as they are.
    def test_weights(self):
        cloud = np.concatenate((support.sphere(), support.sphere() + (5, 0, 0)))
        trust = np.repeat((0.5, 0.0), 2000)
        mesh = neuralmesh.reconstruct(cloud, 300, weights=trust)
        self.assertLess(support.coordinates(mesh)[:, 0].max(), 1.5)
        self.assertTrue((vtk_to_numpy(mesh.GetPointData().GetArray("Weights")) == 0.5).all())
        dataset = support.point_set(cloud)
        wanted = support.coordinates(mesh).tobytes()
        for weights in (trust, trust.tolist(), trust > 0, (10 * trust).astype(np.uint8)):
            mesh = neuralmesh.reconstruct(dataset, 300, weights=weights)
            self.assertEqual(support.coordinates(mesh).tobytes(), wanted)
        self.assertEqual(dataset.GetPointData().GetNumberOfArrays(), 0)
        named = numpy_to_vtk(trust)
        named.SetName("Trust")
        dataset.GetPointData().AddArray(named)
        mesh = neuralmesh.reconstruct(dataset, 300, weights="Trust")
        self.assertEqual(support.coordinates(mesh).tobytes(), wanted)

    # Promise: what are no weights is a ValueError that says what they must be.
    def test_bad_weights(self):
        cloud = support.sphere()
        for weights in (np.ones(5), np.ones((2000, 1)), 3, ["a"] * 2000):
            with self.assertRaisesRegex(ValueError, r"weights must be .* of shape \(2000,\)"):
                neuralmesh.reconstruct(cloud, 300, weights=weights)
        with self.assertRaisesRegex(ValueError, "No weight is positive"):
            neuralmesh.reconstruct(cloud, 300, weights=np.zeros(2000))
        with self.assertRaisesRegex(ValueError, "called Missing"):
            neuralmesh.reconstruct(cloud, 300, weights="Missing")
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, support.point_set(cloud))
        with self.assertRaisesRegex(ValueError, "weights must be the name"):
            neuralmesh.reconstruct(blocks, 300, weights=np.ones(2000))

    # Promise: the field data tells how good the mesh is.
    def test_report(self):
        mesh = neuralmesh.reconstruct(support.sphere(), 300)
        values = {
            name: mesh.GetFieldData().GetArray(name).GetTuple1(0)
            for name in ("Residual", "Noise", "OutlierShare", "Components", "Genus")
        }
        self.assertLess(values["Residual"], 0.05)
        self.assertGreater(values["Noise"], 0)
        self.assertEqual((values["OutlierShare"], values["Components"], values["Genus"]), (0, 1, 0))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "cloud.ply"

    def write(self, cloud):
        header = "ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % len(cloud)
        header += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
        self.path.write_bytes(header.encode() + cloud.astype("<f4").tobytes())

    # Promise: points are drawn from a file where they lie: all of few, with the same bytes as from
    # the array, else as many as are asked for.
    def test_in_place(self):
        cloud = support.sphere(5000, np.float32)
        self.write(cloud)
        wanted = support.arrays_of(neuralmesh.reconstruct(cloud, 300))
        for path in (self.path, str(self.path)):
            self.assertEqual(support.arrays_of(neuralmesh.reconstruct(path, 300)), wanted)
        some = neuralmesh.reconstruct(self.path, 300, maximum_points=2000)
        self.assertEqual(some.GetNumberOfPoints(), 300)
        self.assertNotEqual(support.arrays_of(some), wanted)

    # Promise: what is wrong with a file is a ValueError that names it.
    def test_bad_files(self):
        self.path.write_bytes(b"no ply")
        with self.assertRaisesRegex(ValueError, "cloud.ply: this is no .ply"):
            neuralmesh.reconstruct(self.path, 300)
        with self.assertRaisesRegex(ValueError, "missing.ply: there is no such file"):
            neuralmesh.reconstruct("missing.ply", 300)
        with self.assertRaisesRegex(ValueError, "weights"):
            neuralmesh.reconstruct(self.path, 300, weights="Trust")
        self.write(np.empty((0, 3)))
        with self.assertRaisesRegex(ValueError, "there are none"):
            neuralmesh.reconstruct(self.path, 300)


class BadPoints(unittest.TestCase):
    # Promise: where there is no cloud, a ValueError says so, and VTK prints nothing.
    def test_no_cloud(self):
        output, errors, status = support.run_script(
            """
            import neuralmesh, numpy, support
            no_points = numpy.empty((0, 3))
            not_finite = numpy.full((10, 3), numpy.nan)
            for points in (no_points, support.point_set(no_points), not_finite, numpy.ones((10, 3))):
                try:
                    neuralmesh.reconstruct(points, 100)
                except ValueError as error:
                    print(error)
            """
        )
        self.assertEqual(errors, "")
        self.assertEqual(status, 0)
        none, none_of_dataset, not_finite, all_equal = output.splitlines()
        self.assertEqual(none, "points: there are none")
        self.assertEqual(none_of_dataset, none)
        self.assertRegex(not_finite, "finite")
        self.assertRegex(all_equal, "coincide")

    # Promise: points that are not finite are dropped and counted.
    def test_some_not_finite(self):
        cloud = support.sphere()
        cloud[[5, 50, 500], 1] = np.nan, np.inf, -np.inf
        mesh = neuralmesh.reconstruct(cloud, 100)
        self.assertEqual(mesh.GetFieldData().GetArray("DroppedPoints").GetValue(0), 3)
        self.assertTrue(np.isfinite(support.coordinates(mesh)).all())

    # Promise: a warning of VTK is one of Python, with the caller's line, and can be made an error.
    def test_warnings(self):
        with self.assertWarnsRegex(RuntimeWarning, "more|beyond|points") as caught:
            neuralmesh.reconstruct(support.sphere(50), 100)
        self.assertEqual(caught.filename, __file__)
        output, errors, status = support.run_script(
            """
            import neuralmesh, support, warnings
            warnings.simplefilter("error")
            try:
                neuralmesh.reconstruct(support.sphere(50), 100)
            except RuntimeWarning:
                print("raised")
            """
        )
        self.assertEqual((output, errors, status), ("raised\n", "", 0))


if __name__ == "__main__":
    unittest.main()
