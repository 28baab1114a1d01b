# SPDX-License-Identifier: BSD-3-Clause
"""Folders with scans and recipes, and the batch command as people use it."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import support
from neuralmesh.batch.meshes import DEFAULT_FORMAT

# Without VTK there are no .vtp files, and no pictures.
HAS_VTK = DEFAULT_FORMAT == "vtp"
DOCUMENTATION = pathlib.Path(__file__).parents[2] / "Documentation"
BROKEN_PLY = """ply
format ascii 1.0
element vertex 100
property float x
property float y
property float z
end_header
0 0 0
"""


def write_scan(path, count=2000, size=1):
    path.parent.mkdir(exist_ok=True)
    np.savetxt(path, support.sphere(count) * (1, 1, size), fmt="%.9f")


def start(arguments, folder, before=None, **environment):
    """Start the command, in a folder; before is called in its process, before it begins."""
    return subprocess.Popen(
        [sys.executable, "-m", "neuralmesh", "batch", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=folder,
        env={**os.environ, **environment},
        preexec_fn=before,
    )


def run(arguments, folder, before=None, **environment):
    """Run it; its output, its errors and its exit status."""
    process = start(arguments, folder, before, **environment)
    output, errors = process.communicate(timeout=support.HANGING)
    return output, errors, process.returncode


class BatchTest(unittest.TestCase):
    """Tests with a folder, and a recipe in it."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name).resolve()
        cls.recipe = cls.folder / "jobs.json"
        cls.results = cls.folder / "jobs-results"

    @classmethod
    def write_example(cls, **changes):
        """The recipe of the documentation, with two scans that are sound and one that is not."""
        text = (DOCUMENTATION / "Guide" / "CommandLine.md").read_text(encoding="utf-8")
        example = json.loads(re.search(r"```json[^\n]*\n(.*?)```", text, re.DOTALL).group(1))
        example["format"] = DEFAULT_FORMAT
        cls.write_recipe(**{**example, **changes})
        write_scan(cls.folder / "scans" / "ball.xyz")
        write_scan(cls.folder / "scans" / "egg.xyz", size=1.5)
        (cls.folder / "scans" / "broken.ply").write_text(BROKEN_PLY, encoding="ascii")

    @classmethod
    def write_recipe(cls, **content):
        cls.recipe.write_text(json.dumps({"gallery": False, **content}), encoding="utf-8")

    @classmethod
    def run_batch(cls, *arguments, before=None, **environment):
        return run(["jobs.json", *arguments], cls.folder, before, **environment)

    def clear(self):
        """Leave nothing in the folder."""
        for path in self.folder.iterdir():
            shutil.rmtree(path) if path.is_dir() else path.unlink()

    def report(self, name):
        return json.loads((self.results / f"{name}.json").read_text(encoding="utf-8"))

    def assert_told(self, errors, jobs):
        """The errors are those of the reports on these jobs, a line each, and no others."""
        lines = {f"neuralmesh: {name}: {self.report(name)['error']}" for name in jobs}
        self.assertEqual(set(errors.splitlines()), lines)

    def failed(self):
        """The names of the jobs whose reports say that they failed."""
        names = [path.stem for path in self.results.glob("[!.]*.json")]
        return [name for name in names if self.report(name)["status"] == "failed"]

    def times(self):
        """When each mesh was written, by its name."""
        return {path.stem: path.stat().st_mtime_ns for path in self.results.glob(f"[!.]*.{DEFAULT_FORMAT}")}
