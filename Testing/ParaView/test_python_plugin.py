# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in Python: what it says where it cannot work, and how it goes with the compiled one."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import support

COMPILED = os.path.join(os.path.dirname(support.CONFIGURATION), "NeuralMesh", "NeuralMesh.so")
FOLDER = os.path.dirname(os.path.abspath(__file__))
LOAD = """
from paraview.simple import *
LoadPlugin({!r}, remote=False, ns=globals())
"""
MAKE = """
mesh = NeuralMesh(Input=NeuralMeshScan(Input=Sphere(), NumberOfPoints=2000), NumberOfVertices=50)
mesh.UpdatePipeline()
print(mesh.GetDataInformation().GetNumberOfPoints(), "vertices")
"""
# Run in the folder of the tests, with support.py told of the plugin by the environment.
SAVE = """
import sys
sys.path.insert(0, {folder!r})
import test_state
test_state.setUpModule()
test_state.make_pipeline()
print(test_state.results())
from paraview import simple, smstate
simple.SaveState({path!r} + ".pvsm")
open({path!r} + ".py", "w").write(smstate.get_state())
"""
RESTORE = """
import sys
sys.path.insert(0, {folder!r})
import test_state
from paraview import simple
test_state.setUpModule()
if {path!r}.endswith(".pvsm"):
    simple.LoadState({path!r})
else:
    exec(open({path!r}).read(), vars(simple).copy())
print(test_state.results())
"""


# This process is one of MPI, too; what it has put there would be meant for its children.
ENVIRONMENT = {
    name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))
}


def output_of(command, **variables):
    """What a process writes, with that on stderr."""
    process = subprocess.run(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=support.HANGING,
        env={**ENVIRONMENT, **variables},
    )
    return process.stdout


def run(script, **variables):
    """What a script writes in a process of its own."""
    return output_of([ENVIRONMENT["NEURALMESH_PVPYTHON"], "-c", script], **variables)


def results_in(output):
    """The line with what the pipeline makes: the warnings beside it have times and addresses."""
    (results,) = [line for line in output.splitlines() if line.startswith("[b")]
    return results


class Loading(unittest.TestCase):
    # Promise: with the file alone, and nothing in PYTHONPATH, the filters are there.
    def test_by_file(self):
        self.assertEqual(run(LOAD.format(support.PLUGIN) + MAKE), "50 vertices\n")

    # Promise: a folder without an engine for ParaView's Python says in a sentence what to do, without a
    # traceback, and ParaView goes on.
    def test_no_engine(self):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder) / "neuralmesh"
            shutil.copytree(
                os.path.dirname(support.PLUGIN), package, ignore=shutil.ignore_patterns("*.so")
            )
            output = run(LOAD.format(str(package / "paraview_plugin.py")) + "print('goes on')\n")
        self.assertRegex(output, r"^NeuralMesh for ParaView: .* has no engine for the Python of this ")
        self.assertIn("pip install neuralmesh", output)
        self.assertNotIn("Traceback", output)
        self.assertEqual(len(output.strip().splitlines()), 2)
        self.assertTrue(output.endswith("goes on\n"))

    # Promise: so does one that belongs to another package than that which is in use.
    def test_other_package(self):
        output = run(
            "import neuralmesh\n" + LOAD.format(support.PLUGIN),
            PYTHONPATH=os.pathsep.join(
                [os.environ["NEURALMESH_WRAPPED_PATH"], os.environ["PYTHONPATH"]]
            ),
        )
        self.assertIn("another package neuralmesh is in use", output)
        self.assertNotIn("Traceback", output)

    # Promise: with the compiled plugin it leaves the filters to that, and says so; in the other order the
    # filters are those of the compiled one from then on.
    def test_both(self):
        both = LOAD.format(COMPILED) + MAKE + LOAD.format(support.PLUGIN) + MAKE
        output = run(both).splitlines()
        self.assertEqual(output[0], "50 vertices")
        self.assertIn("the compiled plugin NeuralMesh is loaded", output[1])
        self.assertEqual(output[2:], ["50 vertices"])
        both = LOAD.format(support.PLUGIN) + MAKE + LOAD.format(COMPILED) + MAKE
        self.assertEqual(run(both), "50 vertices\n50 vertices\n")

    # Promise: several processes, each with a part of the points, are refused.
    def test_processes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "script.py")
            with open(path, "w", encoding="utf-8") as script:
                script.write(LOAD.format(support.PLUGIN) + MAKE)
            mpi = [os.environ["NEURALMESH_MPIRUN"], "--allow-run-as-root", "--oversubscribe"]
            output = output_of([*mpi, "-np", "2", os.environ["NEURALMESH_PVBATCH"], "--sym", path])
        self.assertIn("learns in one process, and here are 2", output)
        self.assertIn("0 vertices", output.splitlines())


class States(unittest.TestCase):
    # Promise: a state of one plugin, as a file or as a script, loads with the other one, and gives the same
    # bytes.
    def test_exchanged(self):
        plugins = [COMPILED, support.PLUGIN]
        for saving, loading in (plugins, plugins[::-1]):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "state")
                saved = run(SAVE.format(folder=FOLDER, path=path), NEURALMESH_PLUGIN=saving)
                self.assertNotIn("Traceback", saved)
                for extension in (".pvsm", ".py"):
                    with self.subTest(loading=loading, state=extension):
                        restore = RESTORE.format(folder=FOLDER, path=path + extension)
                        restored = run(restore, NEURALMESH_PLUGIN=loading)
                        self.assertNotIn("Traceback", restored)
                        self.assertEqual(results_in(restored), results_in(saved))


if __name__ == "__main__":
    unittest.main()
