# SPDX-License-Identifier: BSD-3-Clause
"""Progress and early ends, here and on a server."""

import os
import socket
import subprocess
import unittest

# Before any filter is wrapped by GetClientSideObject().
import neuralmesh
import support
from paraview import servermanager, simple


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


class Progress:
    """What the client is told while a filter works, here or on the server."""

    def __init__(self):
        self.handler = servermanager.ActiveConnection.Session.GetProgressHandler()
        self.handler.SetProgressInterval(0.01)
        self.fractions, self.texts = [], set()

    def __enter__(self):
        self.observer = self.handler.AddObserver("ProgressEvent", self.tell)
        return self

    def tell(self, handler, _event):
        self.fractions.append(handler.GetLastProgress())
        self.texts.add(handler.GetLastProgressText())

    def __exit__(self, *_):
        self.handler.RemoveObserver(self.observer)


class Runs:
    """What holds wherever the filters run."""

    # Promise: the client is told of progress while the filter works; a time limit ends a run that
    # would take minutes, and keeps the mesh.
    def test_progress_and_time_limit(self):
        mesh = simple.NeuralMesh(Input=support.scan(1000000), NumberOfVertices=900000)
        mesh.Input.UpdatePipeline()
        # Servers tell of progress once in a second.
        mesh.TimeLimit = 4.0
        with Progress() as progress:
            mesh.UpdatePipeline()
        self.assertGreater(len(progress.fractions), 2)
        self.assertTrue(any(0 < fraction < 100 for fraction in progress.fractions))
        # The name of the filter, not that of a class.
        self.assertIn("Neural Mesh", progress.texts)
        self.assertFalse([text for text in progress.texts if "NeuralMesh" in text])
        self.assertEqual(support.field_value(mesh, "StopReason"), "time limit")
        points = support.information_of(mesh).GetNumberOfPoints()
        self.assertTrue(1000 < points < 900000, points)


class Here(Runs, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        support.load_plugin()

    # Promise: an abort from an observer of progress ends the run and keeps the mesh; the next run
    # is as ever.
    def test_abort(self):
        mesh = simple.NeuralMesh(Input=support.scan(100000), NumberOfVertices=50000)
        mesh.Input.UpdatePipeline()
        filter = mesh.GetClientSideObject()
        self.assertIsInstance(filter, neuralmesh.vtkNeuralMesh)

        def abort(caller, _event):
            if caller.GetProgress() > 0.3:
                caller.RemoveObserver(observer)
                caller.SetAbortExecute(1)

        observer = filter.AddObserver("ProgressEvent", abort)
        mesh.UpdatePipeline()
        self.assertEqual(support.field_value(mesh, "StopReason"), "cancelled")
        self.assertTrue(10 < support.information_of(mesh).GetNumberOfPoints() < 50000)
        mesh.NumberOfVertices = 500
        self.assertEqual(support.field_value(mesh, "StopReason"), "vertices")


class OnServer(Runs, unittest.TestCase):
    # The server ends when this process does.
    @classmethod
    def setUpClass(cls):
        port = free_port()
        cls.server = subprocess.Popen(
            [os.environ["NEURALMESH_PVSERVER"], f"--server-port={port}"],
            stdout=subprocess.PIPE,
            text=True,
        )
        for line in cls.server.stdout:
            if "Accepting connection" in line:
                break
        simple.Connect("localhost", port)
        support.load_plugin()

    # Promise: the filters run there, and not here.
    def test_runs_there(self):
        mesh = simple.NeuralMesh(Input=support.scan(5000), NumberOfVertices=300)
        self.assertEqual(support.information_of(mesh).GetNumberOfPoints(), 300)
        self.assertTrue(servermanager.ActiveConnection.IsRemote())
        self.assertIsNone(mesh.GetClientSideObject())


if __name__ == "__main__":
    unittest.main()
