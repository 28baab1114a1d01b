# SPDX-License-Identifier: BSD-3-Clause
"""The classes in pipelines of VTK."""

import unittest

import neuralmesh
import support
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm, vtkTrivialProducer
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersSources import vtkSphereSource


class Pipeline(unittest.TestCase):
    # Promise: the filter stands in a pipeline as any other, and runs again when it is changed.
    def test_pipeline(self):
        source = vtkTrivialProducer()
        source.SetOutput(support.point_set(support.sphere()))
        mesh = neuralmesh.vtkNeuralMesh()
        if neuralmesh.VTK_VERSION:
            self.assertIsInstance(mesh, vtkPolyDataAlgorithm)
        mesh.SetInputConnection(source.GetOutputPort())
        mesh.SetNumberOfVertices(500)
        volume = vtkMassProperties()
        volume.SetInputConnection(mesh.GetOutputPort())
        volume.Update()
        # That of the unit ball is 4.19.
        self.assertAlmostEqual(volume.GetVolume(), 4.15, delta=0.1)
        self.assertEqual(mesh.GetStopReason(), "vertices")
        mesh.SetNumberOfVertices(600)
        volume.Update()
        self.assertEqual(mesh.GetOutput().GetNumberOfPoints(), 600)

    # Promise: a known shape can be scanned, reconstructed and compared with.
    def test_scan(self):
        shape = vtkSphereSource()
        shape.SetRadius(1.0)
        shape.SetThetaResolution(64)
        shape.SetPhiResolution(64)
        scan = neuralmesh.vtkNeuralMeshScan()
        scan.SetInputConnection(shape.GetOutputPort())
        scan.SetNumberOfPoints(20000)
        scan.SetNoise(0.001)
        mesh = neuralmesh.vtkNeuralMesh()
        mesh.SetInputConnection(scan.GetOutputPort())
        mesh.SetNumberOfVertices(1000)
        comparison = neuralmesh.vtkNeuralMeshComparison()
        comparison.SetInputConnection(mesh.GetOutputPort())
        comparison.SetReferenceConnection(shape.GetOutputPort())
        comparison.SetNumberOfSamples(5000)
        comparison.Update()
        self.assertLess(comparison.GetMean(comparison.RESULT_TO_REFERENCE), 0.005)

    # Promise: a filter is shown with all its properties, and the setters say what they are for.
    def test_documentation(self):
        self.assertIn("NumberOfVertices: 20000", str(neuralmesh.vtkNeuralMesh()))
        documentation = neuralmesh.vtkNeuralMesh.SetNumberOfVertices.__doc__
        self.assertIn("Default 20000, at least 4", " ".join(documentation.split()))
        self.assertIn("riangle mesh", neuralmesh.vtkNeuralMesh.__doc__)


if __name__ == "__main__":
    unittest.main()
