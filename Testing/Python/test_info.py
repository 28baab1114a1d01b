# SPDX-License-Identifier: BSD-3-Clause
"""info(): the figures of vtkNeuralMeshInformation, and of the command, in a dict."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import neuralmesh
import support
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYWriter


def output_of(source):
    source.Update()
    return source.GetOutput()


class Info(unittest.TestCase):
    # Promise: it tells what the command prints, under the same names and in the same order; the valences
    # are numbers.
    def test_same_as_command(self):
        closed = neuralmesh.reconstruct(support.sphere(5000), 200)
        for mesh in (closed, output_of(vtkCylinderSource()), output_of(vtkSphereSource())):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "mesh.ply"
                writer = vtkPLYWriter()
                writer.SetFileName(str(path))
                writer.SetInputData(mesh)
                writer.Write()
                printed = subprocess.run(
                    [os.environ["NEURALMESH_COMMAND"], "info", "--json", str(path)],
                    check=True,
                    capture_output=True,
                    text=True,
                ).stdout
            wanted = json.loads(printed)
            del wanted["file"]
            wanted["valences"] = {int(name): count for name, count in wanted["valences"].items()}
            figures = neuralmesh.info(mesh)
            self.assertEqual(list(figures), list(wanted))
            for name, value in wanted.items():
                self.assertIs(type(figures[name]), type(value), name)
                if isinstance(value, float):
                    # The file has 4-byte floats.
                    self.assertAlmostEqual(figures[name], value, places=5)
                else:
                    self.assertEqual(figures[name], value, name)

    # Promise: what a mesh brings along of an earlier report counts for nothing, and it stays as it is.
    def test_fresh(self):
        mesh = neuralmesh.reconstruct(support.sphere(5000), 200)
        mesh.GetFieldData().GetArray("Genus").SetValue(0, 7)
        before = mesh.GetFieldData().GetNumberOfArrays()
        self.assertEqual(neuralmesh.info(mesh)["genus"], 0)
        self.assertEqual(mesh.GetFieldData().GetNumberOfArrays(), before)
        self.assertEqual(mesh.GetFieldData().GetArray("Genus").GetValue(0), 7)

    # Promise: a cloud without triangles is not said to be closed, and its points are counted.
    def test_cloud(self):
        cloud = vtkPolyData()
        cloud.SetPoints(support.point_set(support.sphere(30)).GetPoints())
        figures = neuralmesh.info(cloud)
        self.assertIs(figures["closed"], False)
        self.assertEqual((figures["vertices"], figures["unused_points"]), (0, 30))

    # Promise: an empty mesh has figures of 0; what is no mesh is a ValueError that says so.
    def test_bad_input(self):
        figures = neuralmesh.info(vtkPolyData())
        self.assertEqual(
            (figures["vertices"], figures["surface_area"], figures["valences"]), (0, 0.0, {})
        )
        for mesh, kind in ((vtkUnstructuredGrid(), vtkUnstructuredGrid().__class__.__name__), (None, "NoneType")):
            with self.assertRaises(ValueError) as caught:
                neuralmesh.info(mesh)
            self.assertEqual(str(caught.exception), f"mesh must be a vtkPolyData, not {kind}")
        broken = support.point_set(support.sphere(3))
        broken.AllocateExact(1, 3)
        broken.InsertNextCell(5, 3, (0, 1, 9))
        with self.assertRaisesRegex(ValueError, "point 9"):
            neuralmesh.info(broken)


if __name__ == "__main__":
    unittest.main()
