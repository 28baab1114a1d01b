# SPDX-License-Identifier: BSD-3-Clause
"""How the plugin gets into a process of ParaView, and what is said where it does not."""

import os
import re
import subprocess
import tempfile
import unittest

import support

SCRIPT = """
from paraview.simple import *
mesh = NeuralMesh(Input=NeuralMeshScan(Input=Sphere(), NumberOfPoints=1000), NumberOfVertices=50)
mesh.UpdatePipeline()
print(mesh.GetDataInformation().GetNumberOfPoints(), "vertices")
"""


def run(script, **variables):
    """Run a script in a process of its own; its output, and what it says besides."""
    process = subprocess.run(
        [os.environ["NEURALMESH_PVPYTHON"], "-c", script],
        capture_output=True,
        text=True,
        timeout=support.HANGING,
        env={**os.environ, **variables},
    )
    return process.stdout, process.stderr


class Loading(unittest.TestCase):
    # Promise: with the file of configuration, or the folder in the path of plugins, the filters are
    # there from the start, in any script, without LoadPlugin.
    def test_by_themselves(self):
        folder = os.path.dirname(support.CONFIGURATION)
        for variables in (
            {"PV_PLUGIN_CONFIG_FILE": support.CONFIGURATION},
            {"PV_PLUGIN_PATH": folder},
        ):
            with self.subTest(**variables):
                output, errors = run(SCRIPT, **variables)
                self.assertEqual(output, "50 vertices\n", errors)

    # Promise: without either there is no plugin, so that the test above tells of them.
    def test_not_by_chance(self):
        _, errors = run(SCRIPT)
        self.assertIn("'NeuralMesh' is not defined", errors)

    # Promise: another version of ParaView, whose libraries have other names, says which it looked
    # for, and goes on.
    def test_other_version(self):
        with open(support.PLUGIN, "rb") as plugin:
            library = plugin.read()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "NeuralMesh.so")
            with open(path, "wb") as other:
                other.write(re.sub(rb"-pv\d\.\d\d\.so", b"-pv9.99.so", library))
            output, errors = run(
                "from paraview.simple import *\n"
                "try:\n"
                f"    LoadPlugin({path!r}, ns=globals())\n"
                "except RuntimeError as error:\n"
                "    print(error)\n"
            )
        self.assertIn("Problem loading plugin", output)
        self.assertRegex(errors, r"libvtk\w+-pv9\.99\.so\.1: cannot open shared object file")


if __name__ == "__main__":
    unittest.main()
