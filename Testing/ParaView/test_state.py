# SPDX-License-Identifier: BSD-3-Clause
"""States and traces: what they bring back is what there was, to the byte."""

import os
import tempfile
import unittest

import support
from paraview import simple, smstate, smtrace


def setUpModule():
    support.load_plugin()


def make_pipeline():
    """One of each filter, with properties of each kind away from their defaults."""
    sphere = simple.Sphere(registrationName="Shape", ThetaResolution=32, PhiResolution=32)
    scan = simple.NeuralMeshScan(
        registrationName="Scan",
        Input=sphere,
        NumberOfPoints=5000,
        Noise=0.005,
        Occlusion=1,
        Viewpoint=[0.0, 0.0, 9.0],
    )
    trust = simple.Calculator(
        registrationName="Trust", Input=scan, ResultArrayName="Trust", Function="1 + coordsZ"
    )
    mesh = simple.NeuralMesh(
        registrationName="Mesh",
        Input=trust,
        NumberOfVertices=300,
        Seed=3,
        Variant="Basic",
        WeightArray="Trust",
        EdgeFlips=0,
        WinnerRate=0.07,
    )
    simple.NeuralMeshEnsemble(
        registrationName="Ensemble",
        Input=scan,
        NumberOfVertices=300,
        NumberOfMembers=1,
        VerticesPerMember=100,
        GridResolution=16,
    )
    simple.NeuralMeshComparison(
        registrationName="Comparison", Input=mesh, Reference=sphere, NumberOfSamples=2000
    )


def results():
    """What the pipeline makes."""
    meshes = [simple.FindSource(name) for name in ("Scan", "Mesh", "Ensemble", "Comparison")]
    table = support.fetch(simple.FindSource("Comparison"), 2)
    means = [table.GetColumnByName("Mean").GetValue(row) for row in (0, 1)]
    return [support.points_of(mesh) for mesh in meshes] + means


class RoundTrips(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        support.load_plugin()

    def expect_again(self, results_before, restore):
        simple.ResetSession()
        support.load_plugin()
        self.assertIsNone(simple.FindSource("Mesh"))
        restore()
        self.assertEqual(results(), results_before)
        mesh = simple.FindSource("Mesh")
        self.assertEqual((mesh.Variant, mesh.WeightArray, mesh.EdgeFlips), ("Basic", "Trust", 0))

    # Promise: a state file brings the pipeline back.
    def test_state_file(self):
        make_pipeline()
        before = results()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            self.expect_again(before, lambda: simple.LoadState(path))

    # Promise: so does a state as a script.
    def test_state_script(self):
        make_pipeline()
        before = results()
        script = smstate.get_state()
        self.expect_again(before, lambda: exec(script, vars(simple).copy()))

    # Promise: a trace of what was done does it again.
    def test_trace(self):
        smtrace.start_trace()
        make_pipeline()
        script = smtrace.stop_trace()
        before = results()
        self.assertIn("NumberOfVertices = 300", script)
        self.expect_again(before, lambda: exec(script, vars(simple).copy()))


if __name__ == "__main__":
    unittest.main()
