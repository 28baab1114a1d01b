# SPDX-License-Identifier: BSD-3-Clause
"""The batch command: what comes out, what fails, and what is warned of."""

import csv
import unittest

import neuralmesh
import numpy as np
import support
from batch_testing import HAS_VTK, BatchTest, write_scan
from neuralmesh.batch.meshes import DEFAULT_FORMAT, read_points

QUALITY = ("residual", "noise", "regular_ratio", "triangle_quality", "components", "genus")


class Example(BatchTest):
    """The example of the documentation, with two scans that are sound and one that is not."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.write_example()
        cls.output, cls.errors, cls.status = cls.run_batch("--processes", 2)

    # Promise: each scan is reconstructed with each set of parameters, with the bytes of
    # reconstruct(); a scan that is broken fails alone; the message on stderr and the exit status tell.
    def test_results(self):
        self.assertEqual(self.status, 1)
        self.assertEqual(len(self.failed()), 4)
        self.assert_told(self.errors, self.failed())
        self.assertIn("jobs       8 done, 4 failed", self.output)
        self.assertEqual(len(self.times()), 8)
        for scan in ("ball", "egg"):
            points = np.loadtxt(self.folder / "scans" / f"{scan}.xyz")
            for vertices in (200, 800):
                for seed in (1, 2):
                    name = f"{scan}_vertices-{vertices}_seed-{seed}"
                    with self.subTest(name):
                        wanted = neuralmesh.reconstruct(points, vertices, seed)
                        mesh = read_points(self.results / f"{name}.{DEFAULT_FORMAT}")
                        if HAS_VTK:
                            self.assertEqual(support.arrays_of(mesh), support.arrays_of(wanted))
                        # Other formats have the coordinates as floats, and fewer arrays.
                        floats = support.coordinates(wanted).astype(np.float32)
                        self.assertTrue((support.coordinates(mesh).astype(np.float32) == floats).all())
                        self.assertTrue((support.triangles(mesh) == support.triangles(wanted)).all())

    # Promise: each result has a report, with its parameters, times and quality.
    def test_reports(self):
        report = self.report("egg_vertices-800_seed-2")
        self.assertEqual(report["status"], "done")
        self.assertEqual(report["scan"]["path"], str(self.folder / "scans" / "egg.xyz"))
        self.assertEqual(report["parameters"], {"vertices": 800, "seed": 2, "variant": "noise"})
        self.assertEqual(report["version"], neuralmesh.__version__)
        self.assertEqual(report["result"]["file"], f"egg_vertices-800_seed-2.{DEFAULT_FORMAT}")
        self.assertEqual(report["result"]["points"], 2000)
        self.assertEqual(report["result"]["vertices"], 800)
        self.assertEqual(set(report["seconds"]), {"reading", "reconstruction", "writing"})
        self.assertEqual(set(report["phases"]), {"cloud", "start", "learning", "finish"})
        self.assertGreater(report["seconds"]["reconstruction"], 0)
        mesh = neuralmesh.reconstruct(np.loadtxt(self.folder / "scans" / "egg.xyz"), 800, 2)
        residual = support.field(mesh, "Residual")
        self.assertEqual(report["quality"]["residual"], residual)
        for name in QUALITY:
            self.assertIn(name, report["quality"])
        self.assertEqual(report["warnings"], [])

        failed = self.report("broken_vertices-200_seed-1")
        self.assertEqual(failed["status"], "failed")
        self.assertIn("ends before its last vertex", failed["error"])
        self.assertNotIn("result", failed)

    # Promise: the summary has a row for each job, with its parameters, figures and its error.
    def test_summary(self):
        with open(self.results / "summary.csv", encoding="utf-8", newline="") as file:
            rows = {row["job"]: row for row in csv.DictReader(file)}
        self.assertEqual(len(rows), 12)
        row = rows["ball_vertices-200_seed-2"]
        columns = ("scan", "vertices", "seed", "variant", "status", "result", "points", "triangles",
                   "reconstruction_seconds", "learning_cpu_seconds", *QUALITY, "error")  # fmt: skip
        self.assertLessEqual(set(columns), set(row))
        self.assertEqual((row["vertices"], row["seed"], row["variant"]), ("200", "2", "noise"))
        self.assertEqual((row["status"], row["points"], row["error"]), ("done", "2000", ""))
        report = self.report("ball_vertices-200_seed-2")
        self.assertEqual(float(row["residual"]), report["quality"]["residual"])
        failed = rows["broken_vertices-800_seed-1"]
        self.assertEqual((failed["status"], failed["vertices"], failed["seed"]), ("failed", "800", "1"))
        self.assertEqual(failed["error"], self.report("broken_vertices-800_seed-1")["error"])


class Strict(BatchTest):
    # Promise: warnings stand in the report; a strict recipe ends with status 3 if there are any, also when
    # the jobs were done before, and the meshes are there. Progress and the summary have their tags.
    def test_warnings(self):
        write_scan(self.folder / "scans" / "few.xyz", 300)
        for strict, status in ((False, 0), (True, 3)):
            self.write_recipe(scans=["scans/few.xyz"], matrix={"vertices": 200}, strict=strict)
            output, errors, found = self.run_batch()
            self.assertEqual((errors, found), ("", status))
            self.assertIn("jobs       1 done, 0 failed, 1 with warnings", output)
            progress = "[1/1] few: done, 1 warning: finer-than-data\n"
            self.assertIn("were done before" if strict else progress, output)
            with open(self.results / "summary.csv", encoding="utf-8", newline="") as file:
                (row,) = csv.DictReader(file)
            self.assertEqual(row["warnings"], "finer-than-data")
        (warning,) = self.report("few")["warnings"]
        self.assertIn("finer than its data", warning)
        self.assertNotIn("warnings", self.report("few")["quality"])
        self.write_recipe(scans=["scans/few.xyz"], matrix={"vertices": 100}, strict=True)
        output, errors, found = self.run_batch()
        self.assertEqual((errors, found), ("", 0))

    # Promise: --strict makes any recipe strict.
    def test_option(self):
        write_scan(self.folder / "scans" / "few.xyz", 300)
        self.write_recipe(scans=["scans/few.xyz"], matrix={"vertices": 200})
        output, errors, found = self.run_batch("--strict")
        self.assertEqual((errors, found), ("", 3))
        self.assertIn("1 done, 0 failed, 1 with warnings", output)


if __name__ == "__main__":
    unittest.main()
