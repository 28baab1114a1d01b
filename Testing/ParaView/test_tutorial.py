# SPDX-License-Identifier: BSD-3-Clause
"""The page for ParaView does what it says: every block of Documentation/Guide/ParaView.md is run."""

import os
import pathlib
import re
import stat
import subprocess
import tempfile
import unittest

import support
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOPLY import vtkPLYReader

ROOT = pathlib.Path(__file__).parents[2]
PAGE = (ROOT / "Documentation" / "Guide" / "ParaView.md").read_text(encoding="utf-8")
PLAYER = ROOT / "Documentation" / "Pictures" / "tutorial.py"
BUILD = pathlib.Path(support.CONFIGURATION).parents[2]
LARGEST_PICTURE = 150000  # bytes


def shell_blocks():
    return re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL)


def pixels_of(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)


def vertices_of(path):
    reader = vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput().GetNumberOfPoints()


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        (cls.folder / "build").symlink_to(BUILD)
        process = subprocess.run(
            [os.environ["NEURALMESH_PVPYTHON"], PLAYER, cls.folder],
            capture_output=True,
            text=True,
            env={**os.environ, "PV_PLUGIN_CONFIG_FILE": support.CONFIGURATION},
        )
        cls.output, cls.errors, cls.status = process.stdout, process.stderr, process.returncode

    def shell(self, block, **variables):
        # This process belongs to MPI, too, whose variables are not for another one; nor are those that
        # lead to what was built, but for what the block itself sets.
        environment = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("OMPI_", "PMIX_"))
            and name not in ("PYTHONPATH", "PV_PLUGIN_CONFIG_FILE")
        }
        return subprocess.run(
            ["bash", "-e", "-c", block],
            cwd=self.folder,
            capture_output=True,
            text=True,
            env={**environment, **variables},
        )

    # Promise: the Python runs, and prints the figures of a good mesh.
    def test_python(self):
        self.assertEqual(self.status, 0, self.errors)
        self.assertNotIn("ERR|", self.errors)
        figures = dict(line.split(" ", 1) for line in self.output.splitlines())
        self.assertEqual(float(figures["NumberOfVertices"]), 5000)
        self.assertEqual(float(figures["Components"]), 1)
        self.assertLess(float(figures["Residual"]), 0.005)
        self.assertLess(float(figures["MeanPercent"]), 0.1)

    # Promise: what is saved is there: the mesh, the state, and a picture for each time step.
    def test_files(self):
        self.assertEqual(vertices_of(self.folder / "bunny.ply"), 5000)
        self.assertIn("NeuralMesh", (self.folder / "bunny.pvsm").read_text(encoding="utf-8"))
        self.assertEqual(len(list(self.folder.glob("growth.*.png"))), 24)

    # Promise: each picture of the page can be drawn anew, shows something, and no two are alike;
    # those that are in the repository are small.
    def test_pictures(self):
        names = re.findall(r"!\[[^]]+\]\(\.\./Pictures/(\w+\.png)\)", PAGE)
        drawn = [name for name in names if name != "tutorial_window.png"]
        self.assertGreaterEqual(len(drawn), 7)
        seen = set()
        for name in drawn:
            pixels = pixels_of(self.folder / name)
            self.assertGreater((pixels != pixels[0]).any(axis=1).mean(), 0.05, name)
            seen.add(pixels.tobytes())
        self.assertEqual(len(seen), len(drawn))
        for name in names:
            size = (ROOT / "Documentation" / "Pictures" / name).stat().st_size
            self.assertLess(size, LARGEST_PICTURE, name)

    # Promise: the command of the start makes ParaView load the plugin. The window is stood in for.
    def test_start(self):
        instead = self.folder / "bin"
        instead.mkdir()
        paraview = instead / "paraview"
        paraview.write_text(
            f'#!/bin/sh\nexec {os.environ["NEURALMESH_PVPYTHON"]} -c '
            '"from paraview.simple import *; print(NeuralMesh)"\n',
            encoding="utf-8",
        )
        paraview.chmod(paraview.stat().st_mode | stat.S_IXUSR)
        process = self.shell(shell_blocks()[0], PATH=f"{instead}:{os.environ['PATH']}")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("function", process.stdout)

    # Promise: the script without a window gives the same vertices, on two processes.
    def test_without_window(self):
        (block,) = shell_blocks()[1:]
        process = self.shell(
            block,
            OMPI_ALLOW_RUN_AS_ROOT="1",
            OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
            OMPI_MCA_rmaps_base_oversubscribe="1",
        )
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        self.assertEqual(vertices_of(self.folder / "mesh.ply"), 5000)


if __name__ == "__main__":
    unittest.main()
