# SPDX-License-Identifier: BSD-3-Clause
"""One cloud on a server of two processes, and the same cloud here."""

import os
import subprocess
import tempfile
import unittest

import support
from paraview import servermanager, simple
from test_server import free_port
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

PARTS = 3


def write_cloud(folder):
    """A cloud in pieces, which the processes of a server share out."""
    pieces = []
    for seed in range(1, PARTS + 1):
        writer = vtkXMLPolyDataWriter()
        pieces.append(f"piece{seed}.vtp")
        writer.SetFileName(os.path.join(folder, pieces[-1]))
        writer.SetDataModeToBinary()  # appended data is not for every libexpat
        writer.SetInputData(support.fetch(support.scan(4000 * seed, Seed=seed)))
        writer.Write()
    path = os.path.join(folder, "cloud.pvtp")
    with open(path, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="PPolyData"><PPolyData GhostLevel="0"><PPoints>')
        file.write('<PDataArray type="Float32" NumberOfComponents="3"/></PPoints>')
        file.writelines(f'<Piece Source="{piece}"/>' for piece in pieces)
        file.write("</PPolyData></VTKFile>")
    return path


def reconstruct(path):
    """The points of the mesh of the cloud and what its normals are, as bytes."""
    mesh = simple.NeuralMesh(
        Input=simple.XMLPartitionedPolydataReader(FileName=path),
        NumberOfVertices=800,
        MaximumPoints=9000,
    )
    data = support.fetch(mesh)
    arrays = [data.GetPoints().GetData(), data.GetPointData().GetNormals()]
    arrays.append(data.GetPolys().GetConnectivityArray())
    return mesh, [memoryview(array).tobytes() for array in arrays]


class OnParallelServer(unittest.TestCase):
    # Promise: the mesh of a cloud that the processes of a server share is that of the same cloud on
    # one process, to the byte, and is one.
    def test_same_as_here(self):
        support.load_plugin()
        with tempfile.TemporaryDirectory() as folder:
            path = write_cloud(folder)
            _, here = reconstruct(path)
            self.connect()
            mesh, there = reconstruct(path)
            self.assertEqual(there, here)
            information = support.information_of(mesh)
            self.assertEqual(information.GetNumberOfPoints(), 800)
            self.assertEqual(mesh.FieldData["Genus"].GetRange(), (0.0, 0.0))
            # The parts of the cloud were on both processes.
            process = simple.ProcessIdScalars(Input=mesh.Input)
            process.UpdatePipeline()
            (ids,) = [a for a in process.PointData.values() if "Process" in a.Name]
            self.assertEqual(ids.GetRange(), (0.0, 1.0))
            self.assertEqual(support.fetch(mesh, 1).GetColumnName(0), "Iteration")

    # The server ends when this process does.
    def connect(self):
        port = free_port()
        # This process is one of MPI, too; what it has put there would be meant for its children.
        environment = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("OMPI_", "PMIX_"))
        }
        self.server = subprocess.Popen(
            [os.environ["NEURALMESH_MPIRUN"], "--allow-run-as-root", "--oversubscribe", "-np", "2",
             os.environ["NEURALMESH_PVSERVER"], f"--server-port={port}"],
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )
        for line in self.server.stdout:
            if "Accepting connection" in line:
                break
        simple.Connect("localhost", port)
        self.assertEqual(servermanager.ActiveConnection.GetNumberOfDataPartitions(), 2)
        support.load_plugin()


if __name__ == "__main__":
    unittest.main()
