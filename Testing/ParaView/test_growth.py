# SPDX-License-Identifier: BSD-3-Clause
"""The growth of a mesh as time steps, played by ParaView's animation."""

import unittest

import support
from paraview import simple


def setUpModule():
    support.load_plugin()


def growing(**properties):
    return simple.NeuralMesh(
        Input=support.scan(), NumberOfVertices=2000, GrowthAsTime=1, **properties
    )


def everything_of(source):
    """Points, triangles and arrays, as bytes."""
    mesh = support.fetch(source)
    arrays = [mesh.GetPoints().GetData(), mesh.GetPolys().GetConnectivityArray()]
    arrays += [mesh.GetPointData().GetArray(name) for name in ("Normals", "Activity")]
    return [memoryview(array).tobytes() for array in arrays]


class Growth(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        support.load_plugin()

    # Promise: switched on, the growth is in the animation: a step for each snapshot, more and more
    # vertices, and in the end the mesh that there is without it, to the byte.
    def test_animation(self):
        plain = simple.NeuralMesh(Input=support.scan(), NumberOfVertices=2000)
        expected = everything_of(plain)
        simple.Delete(plain)
        mesh = growing(NumberOfSnapshots=10)
        mesh.UpdatePipelineInformation()
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual(scene.PlayMode, "Snap To TimeSteps")
        self.assertEqual(list(scene.TimeKeeper.TimestepValues), list(range(10)))
        vertices, data = [], []
        scene.GoToFirst()
        for _ in range(10):
            time = scene.TimeKeeper.Time
            vertices.append(support.information_at(mesh, time).GetNumberOfPoints())
            data.append(everything_of(mesh))
            scene.GoToNext()
        self.assertEqual(vertices, sorted(set(vertices)))
        self.assertEqual(vertices[-1], 2000)
        self.assertEqual(data[-1], expected)

    # Promise: off by default; then the time of the points passes through.
    def test_off(self):
        steps = simple.ProgrammableSource(
            OutputDataSetType="vtkPolyData",
            ScriptRequestInformation="""
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
information = self.GetOutputInformation(0)
information.Set(pipeline.TIME_STEPS(), [1.0, 2.0, 4.0], 3)
information.Set(pipeline.TIME_RANGE(), [1.0, 4.0], 2)
""",
            Script="""
import numpy
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
time = self.GetOutputInformation(0).Get(pipeline.UPDATE_TIME_STEP())
points = numpy.random.default_rng(1).normal(size=(5000, 3))
output.Points = time * points / numpy.linalg.norm(points, axis=1, keepdims=True)
""",
        )
        mesh = simple.NeuralMesh(Input=steps, NumberOfVertices=300)
        mesh.UpdatePipelineInformation()
        self.assertEqual(list(mesh.TimestepValues), [1.0, 2.0, 4.0])
        for time in (1.0, 4.0):
            bounds = support.information_at(mesh, time).GetBounds()
            self.assertAlmostEqual(bounds[1], time, delta=0.1 * time)
        # Switched on, the points stay where they were at first.
        mesh.GrowthAsTime = 1
        mesh.UpdatePipelineInformation()
        self.assertEqual(len(mesh.TimestepValues), 24)
        self.assertAlmostEqual(support.information_at(mesh, 23).GetBounds()[1], 1.0, delta=0.1)
        # ... or where another filter holds them.
        for held in (
            simple.ForceTime(Input=steps, ForcedTime=4.0),
            simple.ExtractTimeSteps(Input=steps, TimeStepIndices=[2]),
        ):
            mesh.Input = held
            bounds = support.information_at(mesh, 23).GetBounds()
            self.assertAlmostEqual(bounds[1], 4.0, delta=0.4)

    # Promise: the mesh is learnt once for all steps, and anew when a property has changed.
    def test_learnt_once(self):
        mesh = growing(NumberOfSnapshots=5)
        learnt = []
        mesh.UpdatePipelineInformation()
        mesh.GetClientSideObject().AddObserver(
            "ProgressEvent", lambda filter, _: learnt.append(filter.GetProgress())
        )
        mesh.UpdatePipeline(0)
        self.assertGreater(len(learnt), 5)
        del learnt[:]
        for step in (1, 2, 3, 4, 0, 2):
            mesh.UpdatePipeline(step)
        self.assertEqual([fraction for fraction in learnt if 0 < fraction < 1], [])
        mesh.Seed = 2
        mesh.UpdatePipeline(3)
        self.assertGreater(len(learnt), 5)


if __name__ == "__main__":
    unittest.main()
