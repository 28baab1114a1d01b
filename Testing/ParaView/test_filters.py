# SPDX-License-Identifier: BSD-3-Clause
"""The filters of the plugin, as a script in ParaView uses them."""

import unittest

import support
from paraview import simple


def setUpModule():
    support.load_plugin()


def arrays(fields):
    return {array.Name for array in fields.values()}


class Filters(unittest.TestCase):
    # Promise: after LoadPlugin the filters are functions in the namespace of the script that loaded
    # it, and no other than the seven.
    def test_names(self):
        namespace = {}
        exec(
            "from paraview.simple import *\n"
            f"LoadPlugin({support.PLUGIN!r}, ns=globals())\n"
            "mesh = NeuralMesh(Input=NeuralMeshScan(Input=Sphere(), NumberOfPoints=1000),"
            " NumberOfVertices=100)\n",
            namespace,
        )
        self.assertEqual(support.information_of(namespace["mesh"]).GetNumberOfPoints(), 100)
        ours = {name for name in namespace if name.startswith("NeuralMesh")}
        names = {"NeuralMesh", "NeuralMeshComparison", "NeuralMeshEnsemble", "NeuralMeshExplanation",
                 "NeuralMeshFileSampler", "NeuralMeshInformation", "NeuralMeshScan"}
        self.assertEqual(ours, names)

    # Promise: a scan gives the points that are asked for, visible in any representation; the view
    # point takes away what it does not see.
    def test_scan(self):
        whole = support.scan(points=5000)
        self.assertEqual(support.information_of(whole).GetNumberOfPoints(), 5000)
        self.assertEqual(support.information_of(whole).GetNumberOfCells(), 1)
        half = support.scan(points=5000, Occlusion=1, Viewpoint=[1000.0, 0.0, 0.0])
        self.assertLess(abs(support.information_of(half).GetNumberOfPoints() - 2500), 250)
        self.assertGreater(support.information_of(half).GetBounds()[0], -0.1)
        noisy = support.scan(points=5000, Noise=0.01, Outliers=0.1, Holes=3, HoleRadius=0.05)
        self.assertNotEqual(support.points_of(noisy), support.points_of(whole))

    # Promise: the mesh has exactly the vertices asked for; its figures are in the field data, which
    # the Information panel shows, and the learning curve is the second output.
    def test_reconstruction(self):
        mesh = simple.NeuralMesh(Input=support.scan(Noise=0.002), NumberOfVertices=2000)
        mesh.UpdatePipeline()
        self.assertEqual(support.information_of(mesh).GetNumberOfPoints(), 2000)
        self.assertLessEqual({"Normals", "Activity"}, arrays(mesh.PointData))
        figures = {"NumberOfVertices", "StopReason", "Residual", "Noise", "Genus", "Components"}
        self.assertLessEqual(figures, arrays(mesh.FieldData))
        self.assertEqual(mesh.FieldData["NumberOfVertices"].GetRange(), (2000.0, 2000.0))
        self.assertEqual(mesh.FieldData["Genus"].GetRange(), (0.0, 0.0))
        self.assertEqual(support.field_value(mesh, "StopReason"), "vertices")
        curve = support.fetch(mesh, 1)
        self.assertEqual(curve.GetColumnName(0), "Iteration")
        self.assertGreater(curve.GetNumberOfRows(), 10)

    # Promise: enumerations go by name, and what is set arrives at the filter.
    def test_properties_arrive(self):
        mesh = simple.NeuralMesh(Input=support.scan(5000), NumberOfVertices=300)
        mesh.UpdatePipeline()
        plain = support.points_of(mesh)
        mesh.Variant = "Normal Based"
        mesh.Order = "List"
        mesh.Seed = 7
        mesh.UpdatePipeline()
        self.assertNotEqual(support.points_of(mesh), plain)
        self.assertEqual(support.field_value(mesh, "Seed"), 7)
        mesh.Variant = "Noise Filtering"
        mesh.Order = "Exact"
        mesh.Seed = 1
        mesh.UpdatePipeline()
        self.assertEqual(support.points_of(mesh), plain)

    # Promise: weights are chosen among the point arrays of one component, and none is chosen at
    # first.
    def test_weights(self):
        scan = support.scan(5000)
        weighted = simple.Calculator(Input=scan, ResultArrayName="Trust", Function="coordsX > 0")
        mesh = simple.NeuralMesh(Input=weighted, NumberOfVertices=300)
        mesh.UpdatePipeline()
        self.assertLess(support.information_of(mesh).GetBounds()[0], -0.9)
        available = list(mesh.GetProperty("WeightArray").Available)
        self.assertIn("Trust", available)
        mesh.WeightArray = "Trust"
        mesh.UpdatePipeline()
        self.assertGreater(support.information_of(mesh).GetBounds()[0], -0.5)
        mesh.WeightArray = ""
        mesh.UpdatePipeline()
        self.assertLess(support.information_of(mesh).GetBounds()[0], -0.9)

    # Promise: blocks are taken as one cloud, and volumes give their points.
    def test_other_inputs(self):
        upper = simple.Transform(Input=support.scan(3000), Transform="Transform")
        upper.Transform.Translate = [0.0, 0.0, 1.0]
        blocks = simple.GroupDatasets(Input=[support.scan(3000), upper])
        mesh = simple.NeuralMesh(Input=blocks, NumberOfVertices=300)
        mesh.UpdatePipeline()
        bounds = support.information_of(mesh).GetBounds()
        self.assertLess(bounds[4], -0.9)
        self.assertGreater(bounds[5], 1.9)
        self.assertEqual(support.information_of(mesh).GetDataSetTypeAsString(), "vtkPolyData")
        grid = simple.AppendDatasets(Input=support.scan(3000))
        kind = support.information_of(grid).GetDataSetTypeAsString()
        self.assertEqual(kind, "vtkUnstructuredGrid")
        mesh = simple.NeuralMesh(Input=grid, NumberOfVertices=300)
        self.assertEqual(support.information_of(mesh).GetNumberOfPoints(), 300)

    # Promise: a first mesh is an input that may be missing, and is grown if it is there.
    def test_first_mesh(self):
        first = simple.Sphere(Radius=1.0)
        mesh = simple.NeuralMesh(Input=support.scan(5000), NumberOfVertices=10)
        mesh.FirstMesh = first
        mesh.UpdatePipeline()
        # It has more vertices than are asked for, and comes out as it is.
        expected = support.information_of(first).GetNumberOfPoints()
        self.assertEqual(support.information_of(mesh).GetNumberOfPoints(), expected)

    # Promise: an ensemble gives the mesh, and as further outputs the average mesh and the votes.
    def test_ensemble(self):
        mesh = simple.NeuralMeshEnsemble(
            Input=support.scan(), NumberOfVertices=2000, NumberOfMembers=3, VerticesPerMember=500,
            GridResolution=32,
        )
        mesh.UpdatePipeline()
        self.assertEqual(support.information_of(mesh).GetNumberOfPoints(), 2000)
        self.assertFalse(hasattr(mesh, "FirstMesh"))
        kinds = ["vtkPolyData", "vtkTable", "vtkPolyData", "vtkImageData"]
        for port, kind in enumerate(kinds):
            information = support.information_of(mesh, port)
            self.assertEqual(information.GetDataSetTypeAsString() or "vtkTable", kind)
        average = support.information_of(mesh, 2)
        self.assertGreater(average.GetNumberOfPoints(), 100)

    # Promise: feature lines are an output with a name, empty until they are asked for.
    def test_feature_lines(self):
        scan = simple.NeuralMeshScan(Input=simple.Box(), NumberOfPoints=20000)
        for mesh, port in (
            (simple.NeuralMesh(Input=scan, NumberOfVertices=1000), 3),
            (simple.NeuralMeshEnsemble(Input=scan, NumberOfVertices=1000, NumberOfMembers=3,
                                       VerticesPerMember=200), 5),
        ):
            self.assertEqual(mesh.SMProxy.GetOutputPortName(port), "Feature Lines")
            mesh.UpdatePipeline()
            self.assertEqual(support.information_of(mesh, port).GetNumberOfPoints(), 0)
            mesh.ComputeFeatureLines = 1
            mesh.UpdatePipeline()
            lines = simple.OutputPort(mesh, port)
            self.assertGreaterEqual(lines.GetDataInformation().GetNumberOfCells(), 20)
            sharpest = lines.GetCellDataInformation()["Angle"].GetRange()[1]
            self.assertAlmostEqual(sharpest, 90, delta=20)
            self.assertEqual(mesh.GetPointDataInformation()["Crease"].GetRange(0)[0], 0.0)

    # Promise: levels of detail are blocks of an output with a name, the last of them the mesh itself.
    def test_levels(self):
        mesh = simple.NeuralMesh(Input=support.scan(), NumberOfVertices=1000)
        self.assertEqual(mesh.SMProxy.GetOutputPortName(4), "Levels")
        mesh.UpdatePipeline()
        self.assertEqual(support.information_of(mesh, 4).GetNumberOfPoints(), 0)
        mesh.Levels = [200, 800]
        mesh.UpdatePipeline()
        self.assertEqual(support.information_of(mesh).GetNumberOfPoints(), 800)
        self.assertEqual(support.information_of(mesh, 4).GetNumberOfPoints(), 1000)

    # Promise: error bars are an array of the mesh that can be asked for in the panel.
    def test_uncertainty(self):
        mesh = simple.NeuralMesh(Input=support.scan(), NumberOfVertices=1000)
        mesh.UpdatePipeline()
        self.assertIsNone(mesh.GetPointDataInformation().GetArray("Uncertainty"))
        mesh.ComputeUncertainty = 1
        mesh.UpdatePipeline()
        self.assertGreater(mesh.GetPointDataInformation()["Uncertainty"].GetRange(0)[0], 0.0)

    # Promise: a comparison gives the distances on both meshes and the table of the figures.
    def test_comparison(self):
        inner = simple.Sphere(Radius=1.0, ThetaResolution=100, PhiResolution=100)
        outer = simple.Sphere(Radius=1.1, ThetaResolution=100, PhiResolution=100)
        comparison = simple.NeuralMeshComparison(Input=outer, Reference=inner, NumberOfSamples=5000)
        comparison.UpdatePipeline()
        for port in (0, 1):
            output = simple.OutputPort(comparison, port)
            low, high = output.GetPointDataInformation()["Distance"].GetRange()
            self.assertAlmostEqual(low, 0.1, places=2)
            self.assertAlmostEqual(high, 0.1, places=2)
        table = support.fetch(comparison, 2)
        self.assertEqual(table.GetNumberOfRows(), 2)
        self.assertAlmostEqual(table.GetColumnByName("Mean").GetValue(0), 0.1, places=2)

    # Promise: what a mesh is by itself stands in its field data, which the Information panel shows.
    def test_information(self):
        information = simple.NeuralMeshInformation(Input=simple.Cylinder(Resolution=30))
        information.UpdatePipeline()
        self.assertEqual(information.FieldData["Components"].GetRange(), (3.0, 3.0))
        self.assertEqual(information.FieldData["Closed"].GetRange(), (0.0, 0.0))
        self.assertGreater(support.information_of(information).GetNumberOfPoints(), 100)


if __name__ == "__main__":
    unittest.main()
