# SPDX-License-Identifier: BSD-3-Clause
"""Levels of detail in a batch."""

import unittest

import neuralmesh
import numpy as np
import support
from batch_testing import HAS_VTK, BatchTest, write_scan
from neuralmesh.batch.meshes import DEFAULT_FORMAT, read_points
from test_gallery import Page


class Levels(BatchTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        write_scan(cls.folder / "ball.xyz")
        cls.write_recipe(scans=["ball.xyz"], matrix={"levels": [100, 200, 400]}, gallery=True)
        cls.output, cls.errors, cls.status = cls.run_batch(DISPLAY="")

    # Promise: levels are a job; its mesh is the largest, the others lie beside it, with the bytes of
    # reconstruct(), and the report tells of each.
    def test_files(self):
        self.assertEqual(self.status, 0, self.errors)
        self.assertIn("jobs       1 done, 0 failed", self.output)
        self.assertEqual(set(self.times()), {"ball", "ball_100", "ball_200"})
        wanted = neuralmesh.reconstruct(
            np.loadtxt(self.folder / "ball.xyz"), levels=(100, 200, 400)
        )
        for name, mesh in zip(("ball_100", "ball_200", "ball"), wanted):
            there = read_points(self.results / f"{name}.{DEFAULT_FORMAT}")
            if HAS_VTK:
                self.assertEqual(support.arrays_of(there), support.arrays_of(mesh))
        report = self.report("ball")
        self.assertEqual(report["result"]["vertices"], 400)
        self.assertEqual([level["result"]["vertices"] for level in report["levels"]], [100, 200])
        for level in report["levels"]:
            path = self.results / level["result"]["file"]
            self.assertEqual(path.stat().st_size, level["result"]["size"])
            self.assertGreater(level["quality"]["residual"], report["quality"]["residual"])

    # Promise: the gallery has a card for each level, with a way to its file.
    def test_gallery(self):
        page = Page(self.results / "index.html")
        for name in ("ball", "ball_100", "ball_200"):
            self.assertIn(f"{name}.{DEFAULT_FORMAT}", page.addresses)
        self.assertIn("level of 100", page.text)
        for address in page.addresses:
            if not address.startswith("#"):
                self.assertTrue((self.results / address).exists(), address)

    # Promise: a job is done again if one of its levels is not there any more, and only then.
    def test_again(self):
        self.assertIn("1 of 1 jobs were done before", self.run_batch(DISPLAY="")[0])
        (self.results / f"ball_100.{DEFAULT_FORMAT}").unlink()
        self.assertNotIn("were done before", self.run_batch(DISPLAY="")[0])
        self.assertTrue((self.results / f"ball_100.{DEFAULT_FORMAT}").exists())


class Recipes(BatchTest):
    # Promise: several lists of levels are tried in turn, and are in the names.
    def test_tried(self):
        write_scan(self.folder / "ball.xyz")
        self.write_recipe(scans=["ball.xyz"], matrix={"levels": [[50, 100], [200, 400], None]})
        output, errors, status = self.run_batch()
        self.assertEqual((errors, status), ("", 0))
        self.assertIn("jobs       3 done, 0 failed", output)
        self.assertEqual(len(self.times()), 5)

    # Promise: what are no levels is refused before anything runs, and so is what they exclude.
    def test_refused(self):
        write_scan(self.folder / "ball.xyz")
        write_scan(self.folder / "ball_100.xyz")
        for scans, matrix, words in (
            (["ball.xyz"], {"levels": [200, 100]}, "matrix.levels: levels must ascend"),
            (["ball.xyz"], {"levels": 100}, "matrix.levels: must be numbers of vertices, in a list"),
            (["ball.xyz"], {"levels": []}, "matrix.levels: must be numbers of vertices"),
            (["ball.xyz"], {"levels": [[100, 200], [3, 200]]}, "matrix.levels[1]: a level must be"),
            (["ball.xyz"], {"levels": [100, 200], "vertices": 100}, "take the place of vertices"),
            (["*.xyz"], {"levels": [100, 200]}, "would have the name of another job"),
        ):
            with self.subTest(matrix):
                self.write_recipe(scans=scans, matrix=matrix)
                _, errors, status = self.run_batch()
                self.assertEqual(status, 2, errors)
                self.assertIn(words, errors)
                self.assertFalse(self.results.exists())


if __name__ == "__main__":
    unittest.main()
