# SPDX-License-Identifier: BSD-3-Clause
"""Recipes: what they mean, and that a bad one is refused as a whole."""

import contextlib
import io
import json
import sys
import unittest

from batch_testing import BatchTest, write_scan
from neuralmesh.batch.command import main
from neuralmesh.batch.recipe import read_recipe

# Python, from 3.13 on, names the place of a comma too many, not that behind it.
COMMA = 20 if sys.version_info >= (3, 13) else 21
BAD = {
    # The text of the recipe, and what its message says.
    "": ("jobs.json, line 1, column 1", "no JSON"),
    '{"scans": ["a.xyz"],}': (f"line 1, column {COMMA}", "no JSON"),
    "[]": ("the recipe: must be an object, not []",),
    "{}": ("scans: must be a list",),
    '{"scans": []}': ("scans: must be a list",),
    '{"scans": "a.xyz"}': ("scans: must be a list",),
    '{"scans": ["a.xyz", 5]}': ("scans[1]: must be a path, not 5",),
    '{"scans": ["a.xyz", "none/*.ply"]}': ("scans[1]: no file matches none/*.ply",),
    '{"scan": ["a.xyz"]}': ('there is no "scan"', "scans"),
    '{"scans": ["a.xyz"], "scans": ["a.xyz"]}': ('"scans" stands there twice',),
    '{"scans": ["a.xyz"], "format": "doc"}': ("format: must be one of vtp, ply, obj, stl",),
    '{"scans": ["a.xyz"], "format": ["ply"]}': ("format: must be one of",),
    '{"scans": ["a.xyz"], "time_limit": 0}': ("time_limit: must be seconds, above 0, not 0",),
    '{"scans": ["a.xyz"], "time_limit": true}': ("time_limit: must be seconds",),
    '{"scans": ["a.xyz"], "time_limit": "1 h"}': ("time_limit: must be seconds",),
    '{"scans": ["a.xyz"], "time_limit": 1e999}': ("time_limit: must be seconds",),
    '{"scans": ["a.xyz"], "gallery": 1}': ("gallery: must be true or false",),
    '{"scans": ["a.xyz"], "shift": "automatic"}': ('shift: must be "auto" or three numbers',),
    '{"scans": ["a.xyz"], "shift": [1, 2]}': ("shift: must be",),
    '{"scans": ["a.xyz"], "shift": [1, true, 3]}': ("shift: must be",),
    '{"scans": ["a.xyz"], "view": {"up": "w"}}': ('view.up: must be x, y or z, not "w"',),
    '{"scans": ["a.xyz"], "view": {"up": ["x"]}}': ("view.up: must be x, y or z",),
    '{"scans": ["a.xyz"], "view": {"azimuth": true}}': ("view.azimuth: must be degrees",),
    '{"scans": ["a.xyz"], "view": {"zoom": 2}}': ('view: there is no "zoom"',),
    '{"scans": ["a.xyz"], "matrix": [1]}': ("matrix: must be an object",),
    '{"scans": ["a.xyz"], "matrix": {"vertice": 100}}': ('there is no "vertice"', "vertices"),
    '{"scans": ["a.xyz"], "matrix": {"progress": 1}}': ('matrix: there is no "progress"',),
    '{"scans": ["a.xyz"], "matrix": {"xyzzy": 1}}': (
        'matrix: there is no "xyzzy"; help(neuralmesh.reconstruct) lists them all\n',
    ),
    '{"scans": ["a.xyz"], "matrix": {"vertices": []}}': ("matrix.vertices: the list is empty",),
    '{"scans": ["a.xyz"], "matrix": {"vertices": [100, 3]}}': (
        'matrix.vertices[1]: vertices must be an integer from 4 to 1000000000, or 0, or "auto", not 3',
    ),
    '{"scans": ["a.xyz"], "matrix": {"vertices": "many"}}': ("matrix.vertices: vertices must be",),
    '{"scans": ["a.xyz"], "matrix": {"vertices": [[100]]}}': ("matrix.vertices[0]: vertices",),
    '{"scans": ["a.xyz"], "matrix": {"winner_rate": NaN}}': ("NaN is no number of JSON",),
    '{"scans": ["a.xyz"], "matrix": {"winner_rate": 1e999}}': ("matrix.winner_rate: winner_rate",),
    '{"scans": ["a.xyz"], "matrix": {"seed": [1, 2, 1]}}': ("matrix.seed[2]: 1 stands there twice",),
    '{"scans": ["a.xyz"], "matrix": {"variant": "best"}}': ("matrix.variant: variant must be",),
    '{"scans": ["a.xyz"], "matrix": {"weights": 1}}': ("matrix.weights: must be the name",),
    '{"scans": ["a.xyz"], "matrix": {"weights": ["a/b", "a b"]}}': ("the same name, a_weights-a_b",),
    '{"scans": ["a.xyz"], "matrix": {"first_mesh": 1}}': ("matrix.first_mesh: must be the path",),
    '{"scans": ["a.xyz"], "matrix": {"first_mesh": [null, ""]}}': ("matrix.first_mesh[1]: must be",),
    '{"scans": ["a.xyz"], "matrix": {"first_mesh": "b.ply", "ensemble": 3}}': (
        "do not go together: ensemble and first_mesh exclude each other",
    ),
    '{"scans": ["a.xyz"], "matrix": {"order": ["exact", "list"], "jump": "area_change"}}': (
        'matrix: {"order": "exact", "jump": "area_change"} do not go together',
    ),
    '{"scans": ["a.xyz"], "matrix": {"compute_uncertainty": true, "fit_rounds": [1, 0]}}': (
        "Error bars need the fit",
    ),
}


class Recipes(BatchTest):
    def setUp(self):
        self.clear()
        write_scan(self.folder / "a.xyz")

    def names(self, **content):
        self.write_recipe(**content)
        return [job.name for job in read_recipe(self.recipe).jobs]

    # Promise: a bad recipe is refused before anything is run or written, with the place.
    def test_bad(self):
        for text, parts in BAD.items():
            with self.subTest(text):
                self.recipe.write_text(text, encoding="utf-8")
                errors = io.StringIO()
                with contextlib.redirect_stderr(errors):
                    self.assertEqual(main(["batch", str(self.recipe)]), 2)
                for part in (str(self.recipe), *parts):
                    self.assertIn(part, errors.getvalue())
                self.assertEqual(len(errors.getvalue().splitlines()), 1)
                self.assertFalse(self.results.exists())

    # Promise: so is one that cannot be read, and wrong use; the command's exit status tells.
    def test_unreadable(self):
        output, errors, status = self.run_batch()
        self.assertEqual((output, status), ("", 2))
        self.assertIn("jobs.json: cannot be read", errors)
        self.recipe.write_bytes(b'{"scans": ["\xff"]}')
        self.assertEqual(self.run_batch()[2], 2)
        self.write_recipe(scans=["a.xyz"])
        for count in ("0", "-1", "many"):
            self.assertEqual(self.run_batch("--processes", count)[2], 2)
        _, errors, status = self.run_batch("--proceses", "2")
        self.assertEqual(status, 2)
        # Which options there are.
        self.assertIn("[--processes N]", errors)

    # Promise: so is one whose results would be written over a scan, a first mesh or the recipe; nothing is
    # touched, and in another folder it runs.
    def test_over_scans(self):
        write_scan(self.folder / "summary.csv")
        write_scan(self.folder / "jobs.xyz")
        link = self.folder / "link"
        link.symlink_to(self.folder)
        self.addCleanup(link.unlink)
        cases = (
            ({"scans": ["a.ply"], "format": "ply"}, ".", "the mesh of a would be written there"),
            ({"scans": ["a.ply"], "format": "ply"}, "link", "the mesh of a would be written there"),
            ({"scans": ["summary.csv"]}, ".", "the summary would be written there"),
            ({"scans": ["jobs.xyz"]}, ".", "the report on jobs would be written there"),
            ({"scans": ["a.xyz"], "format": "ply", "matrix": {"first_mesh": "a.ply"}}, ".",
             "the mesh of a would be written there"),
        )
        write_scan(self.folder / "a.ply")
        before = {path: path.read_bytes() for path in self.folder.glob("*.*")}
        for content, output, message in cases:
            with self.subTest(content):
                self.write_recipe(**content)
                before[self.recipe] = self.recipe.read_bytes()
                _, errors, status = self.run_batch("--output", output)
                self.assertEqual(status, 2, errors)
                self.assertIn(message, errors)
                self.assertEqual({path: path.read_bytes() for path in self.folder.glob("*.*")}, before)

    # Promise: all lists of the matrix are crossed, for each scan; they, and not what is fixed, are in
    # the names.
    def test_matrix(self):
        write_scan(self.folder / "b.xyz")
        matrix = {"vertices": [100, 200], "seed": [1, 2, 3], "variant": "basic", "ensemble": [None, 2]}
        names = self.names(scans=["*.xyz"], matrix=matrix)
        self.assertEqual(len(names), 2 * 2 * 3 * 2)
        self.assertEqual(names[0], "a_vertices-100_seed-1_ensemble-null")
        self.assertEqual(names[-1], "b_vertices-200_seed-3_ensemble-2")
        for job in read_recipe(self.recipe).jobs:
            self.assertEqual(list(job.parameters), list(matrix))
            self.assertEqual(job.parameters["variant"], "basic")
        self.assertEqual(self.names(scans=["a.xyz"]), ["a"])

    # Promise: every parameter of reconstruct() and of ensembles is one of recipes.
    def test_parameters(self):
        matrix = {"winner_rate": 0.05, "compute_feature_strength": True, "boundaries": "close"}
        self.assertEqual(len(self.names(scans=["a.xyz"], matrix=matrix)), 1)
        matrix = {"compute_uncertainty": True, "fit_rounds": [1, 2]}
        self.assertEqual(len(self.names(scans=["a.xyz"], matrix=matrix)), 2)
        matrix = {"ensemble": 3, "topology_learning": False, "weights": "Confidence"}
        self.assertEqual(len(self.names(scans=["a.xyz"], matrix=matrix)), 1)

    # Promise: a scan that two patterns match is there once, and scans of the same name in different
    # folders, or with different extensions, are told apart in few words. So are lists of levels.
    def test_names(self):
        self.assertEqual(self.names(scans=["*.xyz", "a.xyz", "./a.xyz"]), ["a"])
        write_scan(self.folder / "b" / "a.xyz")
        self.assertEqual(self.names(scans=["a.xyz", "b/a.xyz"]), ["a", "b-a"])
        self.assertEqual(self.names(scans=["a.xyz", "a.ply"]), ["a-xyz", "a-ply"])
        self.assertEqual(self.names(scans=["**/a.xyz"])[1], "b-a")
        for scans, names in (
            (["b/a.ply", "c/a.obj", "d.ply"], ["b-a", "c-a", "d"]),
            (["b/in/a.ply", "c/in/a.ply"], ["b-a", "c-a"]),
            (["b/in/a.ply", "b/in/a.obj", "c/a.ply"], ["b-a-ply", "b-a-obj", "c-a"]),
            (["b/c/a.ply", "b/d/a.ply", "e/c/a.ply"], ["b-c-a", "b-d-a", "e-c-a"]),
            (["b/a.ply", "c/a.ply", "b-a.ply"], ["b_a.ply", "c_a.ply", "b-a.ply"]),
        ):
            self.assertEqual(self.names(scans=scans), names)
        matrix = {"levels": [[50, 100], [200, 400], None]}
        self.assertEqual(
            self.names(scans=["a.xyz"], matrix=matrix),
            ["a_levels-50-100", "a_levels-200-400", "a_levels-null"],
        )
        write_scan(self.folder / "[1].xyz")
        self.assertEqual(self.names(scans=["[1].xyz"]), ["_1_"])

    # Promise: the help shows a recipe that is sound, fits a terminal, and names what a recipe cannot give.
    def test_help(self):
        output = io.StringIO()
        with contextlib.redirect_stdout(output), self.assertRaises(SystemExit) as ended:
            main(["batch", "--help"])
        self.assertEqual(ended.exception.code, 0)
        text = output.getvalue()
        self.assertLessEqual(max(map(len, text.splitlines())), 100)
        self.assertIn("points, views, normals, checkpoint, explain, feature_lines, progress.\n", text)
        content = json.loads(text[text.index("  {\n") : text.index("\n  }") + 4])
        write_scan(self.folder / "scans" / "c.ply")
        self.assertEqual(len(self.names(**content)), 8)


if __name__ == "__main__":
    unittest.main()
