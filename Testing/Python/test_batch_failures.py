# SPDX-License-Identifier: BSD-3-Clause
"""The batch command where processors, memory or the disk end: what it takes, says and leaves."""

import argparse
import csv
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import time
import unittest

import support
from batch_testing import BatchTest, start, write_scan
from neuralmesh._command import add_processes_option
from neuralmesh._world import NeuralMesh
from neuralmesh.batch.words import heading_of, tag_of, without_tag, words_of_process

LOGGED = (
    "\x1b[0m\x1b[31m2026-01-02 07:01:04.704 (   1.593s) [        3E444040]"
    "vtkGenericDataArray.txx:389    ERR| vtkFloatArray (0x3f1c08e0): {}\x1b[0m\n"
)


class Words(unittest.TestCase):
    # Promise: a lack of memory has the same words however a library says it; of other messages the colours
    # and what VTK's logger puts before them are taken away, and nothing else.
    def test_processes(self):
        for status, said in (
            (-signal.SIGABRT, LOGGED.format("Unable to allocate 9000000 elements of size 4 bytes.")),
            (-signal.SIGABRT, "terminate called after throwing an instance of 'std::bad_alloc'\n"),
            (1, "a.ply: MemoryError"),
        ):
            self.assertRegex(words_of_process(status, said, "a.ply"), "^a.ply: there is not enough memory")
        self.assertEqual(
            words_of_process(-signal.SIGSEGV, LOGGED.format("Bad [1] point."), "a.ply"),
            "a.ply: the process was ended by SIGSEGV. vtkFloatArray (0x3f1c08e0): Bad [1] point.",
        )
        self.assertEqual(words_of_process(1, "a.ply: no points\n", "a.ply"), "a.ply: no points")
        self.assertIn("use fewer processes", words_of_process(-signal.SIGKILL, "", "a.ply"))

    # Promise: a warning is taken apart at its tag; one of other libraries has none.
    def test_warnings(self):
        warning = "A part [of it] is missing. [part-is-missing]"
        self.assertEqual(tag_of(warning), "part-is-missing")
        self.assertEqual(without_tag(warning), "A part [of it] is missing.")
        self.assertEqual(heading_of("part-is-missing"), "Part is missing")
        for warning in ("Some file is odd [1]", "It is old."):
            self.assertEqual((tag_of(warning), without_tag(warning)), ("other", warning))


class Processors(unittest.TestCase):
    # Promise: jobs and their threads are as many as the processors of this process: by its affinity.
    def test_affinity(self):
        allowed = os.sched_getaffinity(0)
        self.addCleanup(os.sched_setaffinity, 0, allowed)
        self.assertLessEqual(NeuralMesh.GetNumberOfAvailableProcessors(), len(allowed))
        os.sched_setaffinity(0, {min(allowed)})
        self.assertEqual(NeuralMesh.GetNumberOfAvailableProcessors(), 1)
        parser = argparse.ArgumentParser()
        add_processes_option(parser, "jobs")
        self.assertEqual(parser.parse_args([]).processes, 1)

    # Promise: and by the quota of its control group, as containers have one: here one of half a processor.
    def test_quota(self):
        group = re.search("^0::(/.*)$", pathlib.Path("/proc/self/cgroup").read_text("ascii"), re.M)
        folder = "/sys/fs/cgroup" + (group[1] if group else "/")
        # Where only this command sees it.
        prepare = f"mount -t tmpfs none /sys/fs/cgroup && mkdir -p {folder} && "
        command = ["unshare", "--map-root-user", "--mount", "sh", "-c"]
        if subprocess.run([*command, prepare + "true"], capture_output=True, check=False).returncode:
            self.skipTest("no file systems can be mounted here")
        available = NeuralMesh.GetNumberOfAvailableProcessors()
        for quota, processors in (("50000 100000", 1), ("max 100000", available)):
            script = f"echo {quota} > {folder}/cpu.max && exec $0 -m neuralmesh batch --help"
            told = subprocess.run([*command, prepare + script, sys.executable], capture_output=True,
                                  text=True, check=True).stdout  # fmt: skip
            self.assertRegex(told, rf"as many as there\s+are\s+processors,\s+{processors}\)")


class Killed(BatchTest):
    # Promise: a job whose process the system kills has failed, in words that name the usual reason.
    def test_killed(self):
        write_scan(self.folder / "ball.xyz", 20000)
        self.write_recipe(scans=["ball.xyz"], matrix={"vertices": 3000000})
        process = start(["jobs.json"], self.folder)
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        deadline = time.monotonic() + support.HANGING
        while not children.read_text(encoding="ascii"):
            self.assertLess(time.monotonic(), deadline, "no job begins")
            time.sleep(0.05)
        os.kill(int(children.read_text(encoding="ascii").split()[0]), signal.SIGKILL)
        _, errors = process.communicate(timeout=support.HANGING)
        self.assertEqual(process.returncode, 1)
        self.assertIn("by SIGKILL (perhaps for lack of memory: use fewer processes)", errors)
        self.assert_told(errors, ["ball"])


class FullDisk(BatchTest):
    # Promise: where a result finds no room, its job fails in plain words that name it, and leaves nothing
    # that takes the room of others, which go on; what became of the jobs is said first.
    def test_full(self):
        write_scan(self.folder / "ball.xyz", 20000)
        matrix = {"vertices": [4000, 100]}
        self.write_recipe(scans=["ball.xyz"], matrix=matrix, format="stl", gallery=True)
        # A checkpoint has room, a mesh of 4,000 vertices has none, as on a disk that is nearly full.
        limit = 350000
        output, errors, status = self.run_batch(
            before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
            DISPLAY="",
            PATH=str(self.folder),
        )
        self.assertEqual(status, 1)
        lines = errors.splitlines()
        name = "ball_vertices-4000"
        begin = f"neuralmesh: {name}: {self.results}/{name}.stl: cannot be written: "
        self.assertTrue(lines[0].startswith(begin), errors)
        for word in (".part", "Errno", "Traceback", "\x1b"):
            self.assertNotIn(word, errors)
        self.assertLess(output.index("jobs       1 done, 1 failed"), output.index("summary "))
        self.assertEqual([path.name for path in self.results.glob(".*.checkpoint")], [])
        self.assertEqual([path.name for path in self.results.glob("*.stl")], ["ball_vertices-100.stl"])
        with open(self.results / "summary.csv", encoding="utf-8", newline="") as file:
            rows = {row["job"]: row for row in csv.DictReader(file)}
        self.assertIn("cannot be written", rows[name]["error"])

    # Promise: a folder that cannot be made is said in plain words, without the numbers of the system.
    def test_no_folder(self):
        write_scan(self.folder / "ball.xyz")
        self.write_recipe(scans=["ball.xyz"])
        (self.folder / "file").write_text("", encoding="ascii")
        _, errors, status = self.run_batch("--output", "file/results")
        self.assertEqual(status, 1)
        self.assertEqual(errors, f"neuralmesh: {self.folder}/file/results: not a directory\n")


if __name__ == "__main__":
    unittest.main()
