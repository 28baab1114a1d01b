# SPDX-License-Identifier: BSD-3-Clause
"""The classes in pipelines of VTK."""

import gc
import threading
import unittest

import neuralmesh
import numpy as np
import support
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm, vtkTrivialProducer
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersModeling import vtkHausdorffDistancePointSetFilter
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

    # Promise: what is written in Python has its properties as attributes and keywords, too.
    @unittest.skipIf(neuralmesh.VTK_VERSION, "VTK wraps classes so from 9.4 on")
    def test_keywords(self):
        mesh = neuralmesh.vtkNeuralMesh(number_of_vertices=77, up_direction=(0, 0, 1))
        self.assertEqual((mesh.GetNumberOfVertices(), mesh.GetUpDirection()), (77, (0.0, 0.0, 1.0)))
        mesh.edge_flips = False
        self.assertEqual((mesh.GetEdgeFlips(), mesh.number_of_vertices), (0, 77))
        with self.assertRaisesRegex(TypeError, "no property 'vertices'"):
            neuralmesh.vtkNeuralMesh(vertices=77)

    # Promise: the reader, the filter and others stand behind each other, also where nothing but the last
    # one is held.
    def test_held_by_pipeline(self):
        def make():
            mesh = neuralmesh.vtkNeuralMesh()
            mesh.SetInputData(support.point_set(support.sphere()))
            mesh.SetNumberOfVertices(300)
            distance = vtkHausdorffDistancePointSetFilter()
            distance.SetInputConnection(0, mesh.GetOutputPort())
            distance.SetInputData(1, support.point_set(support.sphere()))
            return distance

        distance = make()
        gc.collect()
        distance.Update()
        self.assertEqual(distance.GetOutput(0).GetNumberOfPoints(), 300)
        self.assertLess(distance.GetHausdorffDistance(), 0.3)

    # Promise: an error ends the pipeline, and is told to who observes it.
    def test_error(self):
        said = []
        mesh = neuralmesh.vtkNeuralMesh()
        mesh.SetInputData(support.point_set(np.ones((10, 3))))
        mesh.AddObserver("ErrorEvent", lambda *_: said.append(1))
        mesh.GetExecutive().AddObserver("ErrorEvent", lambda *_: said.append(2))
        mesh.Update()
        self.assertEqual(said, [1, 2])

    # Promise: another thread of Python can end a run, and what is learnt stays.
    @unittest.skipIf(neuralmesh.VTK_VERSION, "VTK's wrapping lets no other thread in while C++ works")
    def test_abort_from_thread(self):
        mesh = neuralmesh.vtkNeuralMesh()
        mesh.SetInputData(support.point_set(support.sphere(20000)))
        mesh.SetNumberOfVertices(100000)
        has_begun = threading.Event()
        mesh.AddObserver("ProgressEvent", lambda *_: has_begun.set())
        other = threading.Thread(target=lambda: (has_begun.wait(), mesh.SetAbortExecute(1)))
        other.start()
        mesh.Update()
        other.join()
        self.assertEqual(mesh.GetStopReason(), "cancelled")
        self.assertGreater(mesh.GetOutput().GetNumberOfPolys(), 0)

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
