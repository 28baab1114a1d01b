# SPDX-License-Identifier: BSD-3-Clause
"""The batch command again: what is done is not done again, however the first run ended."""

import json
import os
import pathlib
import signal
import time
import unittest

import neuralmesh
import support
from batch_testing import BatchTest, start, write_scan
from neuralmesh.batch.meshes import DEFAULT_FORMAT, write_mesh


class Again(BatchTest):
    """The example of the documentation, after it has run."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.write_example()
        cls.scans = cls.folder / "scans"
        cls.run_batch("--processes", 2)

    # Promise: what is done is not done again, unless its scan, its parameters, its mesh or the version
    # has changed; what failed is tried again.
    def test_again(self):
        before = self.times()
        self.assertIn("8 of 12 jobs were done before", self.run_batch()[0])
        self.assertEqual(self.times(), before)

        write_scan(self.scans / "broken.ply")  # still no .ply, and now of another size
        os.utime(self.scans / "egg.xyz", ns=(0, 0))
        self.assertIn("4 of 12 jobs were done before", self.run_batch()[0])
        self.assert_written_again(before, lambda name: name.startswith("egg"))

        before = self.times()
        (self.results / f"ball_vertices-200_seed-1.{DEFAULT_FORMAT}").unlink()
        os.truncate(self.results / f"ball_vertices-200_seed-2.{DEFAULT_FORMAT}", 1000)
        report = self.report("ball_vertices-800_seed-1")
        report["version"] = "0.0.1"
        (self.results / "ball_vertices-800_seed-1.json").write_text(json.dumps(report), "utf-8")
        (self.results / "ball_vertices-800_seed-2.json").write_text("{", "utf-8")
        self.assertIn("4 of 12 jobs were done before", self.run_batch()[0])
        self.assert_written_again(before, lambda name: name.startswith("ball"))

        before = self.times()
        text = self.recipe.read_text("utf-8").replace('"variant": "noise"', '"winner_rate": 0.05')
        self.recipe.write_text(text, encoding="utf-8")
        self.assertNotIn("done before", self.run_batch()[0])
        self.assert_written_again(before, lambda name: True)

    def assert_written_again(self, before, expected):
        now = self.times()
        self.assertEqual(set(now), set(before))
        changed = {name for name in now if now[name] != before[name]}
        self.assertEqual(changed, set(filter(expected, before)))


class Changed(BatchTest):
    """Another recipe in the same folder."""

    def setUp(self):
        self.clear()
        write_scan(self.folder / "ball.xyz")

    # Promise: what belongs to no job of the recipe any more is left alone, and is neither in the
    # summary nor in the gallery.
    def test_removed(self):
        (self.folder / "empty").mkdir()
        for vertices in ([100, 200], [100]):
            self.write_recipe(scans=["ball.xyz"], matrix={"vertices": vertices}, gallery=True)
            # Without pictures, which are not what is asked about.
            output, _, _ = self.run_batch(DISPLAY="", PATH=str(self.folder / "empty"))
        self.assertIn("jobs       1 done, 0 failed", output)
        self.assertEqual(set(self.times()), {"ball_vertices-100", "ball_vertices-200"})
        self.assertEqual(self.report("ball_vertices-200")["status"], "done")
        for name in ("summary.csv", "index.html"):
            text = (self.results / name).read_text(encoding="utf-8")
            self.assertIn("ball_vertices-100", text)
            self.assertNotIn("ball_vertices-200", text)

    # Promise: a job is done again if its first mesh has changed, and only then.
    def test_first_mesh(self):
        first = self.folder / f"first.{DEFAULT_FORMAT}"
        write_mesh(neuralmesh.reconstruct(support.sphere(), 50), first)
        matrix = {"vertices": 100, "first_mesh": [None, first.name]}
        self.write_recipe(scans=["ball.xyz"], matrix=matrix)
        self.run_batch()
        self.assertIn("2 of 2 jobs were done before", self.run_batch()[0])
        os.utime(first, ns=(0, 0))
        self.assertIn("1 of 2 jobs were done before", self.run_batch()[0])


class Ends(BatchTest):
    """Batches that are ended in the middle."""

    def setUp(self):
        self.clear()
        write_scan(self.folder / "ball.xyz", 20000)
        self.write_recipe(scans=["ball.xyz"], matrix={"vertices": 8000, "seed": list(range(1, 9))})
        self.process = start(["jobs.json", "--processes", "2"], self.folder)
        self.addCleanup(self.process.stdout.close)
        self.addCleanup(self.process.stderr.close)
        for _ in range(2):
            self.process.stdout.readline()

    def reports(self):
        return {path.stem for path in self.results.glob("[!.]*.json")}

    def wait_for_the_end_of_jobs(self):
        """No process works in the folder any more."""
        deadline = time.monotonic() + support.HANGING
        while any(os.path.realpath(cwd) == str(self.folder) for cwd in self.working_folders()):
            self.assertLess(time.monotonic(), deadline, "a process of a job is left")
            time.sleep(0.05)

    def working_folders(self):
        for process in pathlib.Path("/proc").glob("[0-9]*/cwd"):
            try:
                yield os.readlink(process)
            except OSError:
                pass  # it has ended, or belongs to somebody else

    # Promise: after SIGKILL the same command does what is missing, and only that; the end of the
    # batch is that of its jobs.
    def test_killed(self):
        self.process.kill()
        self.process.wait()
        self.wait_for_the_end_of_jobs()
        before = self.times()
        done = self.reports()
        self.assertGreaterEqual(len(done), 2)
        self.assertLess(len(done), 8)
        for name in done:
            self.assertEqual(self.report(name)["result"]["vertices"], 8000)
        (self.results / f".ball_seed-8.1.part.{DEFAULT_FORMAT}").write_text("half of a mesh", encoding="utf-8")

        output, errors, status = self.run_batch("--processes", 2)
        self.assertEqual((errors, status), ("", 0))
        self.assertIn(f"{len(done)} of 8 jobs were done before", output)
        self.assertEqual(output.count(": done"), 8 - len(done))
        now = self.times()
        self.assertEqual(len(now), 8)
        for name in done:
            self.assertEqual(now[name], before[name])
        self.assertEqual(list(self.results.glob(".*.part*")), [])
        self.assertEqual(list(self.results.glob(".*.checkpoint")), [])

    # Promise: Ctrl-C and SIGTERM end the batch and its jobs at once, without half files.
    def test_interrupted(self):
        self.process.send_signal(signal.SIGINT)
        errors = self.process.stderr.read()
        self.assertEqual(self.process.wait(support.HANGING), 130)
        self.assertEqual(errors, "neuralmesh: interrupted; the same command does the rest\n")
        self.wait_for_the_end_of_jobs()
        self.assertLess(len(self.reports()), 8)
        self.assertEqual(list(self.results.glob(".*.part*")), [])

        again = start(["jobs.json", "--processes", "2"], self.folder)
        again.stdout.readline()
        again.send_signal(signal.SIGTERM)
        again.communicate(timeout=support.HANGING)
        self.assertEqual(again.returncode, 128 + signal.SIGTERM)
        self.wait_for_the_end_of_jobs()

    # Promise: two batches do not work in one folder at a time.
    def test_two(self):
        # It may not come to its end before the other one has begun.
        self.process.send_signal(signal.SIGSTOP)
        _, errors, status = self.run_batch()
        self.process.send_signal(signal.SIGCONT)
        self.process.terminate()
        self.assertEqual(status, 1)
        self.assertIn("another batch is working there", errors)
        self.process.wait()


if __name__ == "__main__":
    unittest.main()
