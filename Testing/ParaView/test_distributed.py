# SPDX-License-Identifier: BSD-3-Clause
"""One cloud on many processes: pvbatch under MPI, see distributed.py."""

import json
import os
import signal
import subprocess
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "distributed.py")
HANGING = 900  # seconds; a run takes a few, however busy the machine is


def play(processes, *arguments):
    """What process 0 has found, and what all have written to stderr."""
    command = [os.environ["NEURALMESH_MPIRUN"], "--allow-run-as-root", "--oversubscribe"]
    command += ["-np", str(processes), os.environ["NEURALMESH_PVBATCH"], "--sym", SCRIPT]
    run = subprocess.Popen(
        command + list(arguments),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        output, errors = run.communicate(timeout=HANGING)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        raise
    if run.returncode != 0:
        raise AssertionError(f"{command} {arguments} ended with {run.returncode}:\n{errors}")
    (line,) = [line for line in output.splitlines() if line.startswith("RESULT ")]
    return json.loads(line.removeprefix("RESULT ")), errors


class Distributed(unittest.TestCase):
    maxDiff = None

    # Promise: the same cloud and seed give the same bytes, points, triangles, all arrays and the
    # report, on any number of processes, however the points are divided and ordered, also where
    # processes have none; whether all points are taken or a part, weighted or not.
    def test_same_bytes(self):
        alone, _ = play(1, "reconstruct", "last")
        for name, result in alone.items():
            self.assertEqual((result["vertices"], result["stop"]), (500, "vertices"), name)
            self.assertEqual((result["genus"], result["dropped"]), (1, 5), name)
            self.assertEqual(result.pop("bytes"), 0)
        self.assertEqual(len({result["digest"] for result in alone.values()}), 3)
        for processes, division in ((2, "last"), (4, "uneven")):
            with self.subTest(processes=processes, division=division):
                results, _ = play(processes, "reconstruct", division)
                for result in results.values():
                    moved = result.pop("bytes")
                    self.assertEqual(moved > 0, processes > 1)
                self.assertEqual(results, alone)


class Others(unittest.TestCase):
    # Promise: a first mesh that lies in pieces is joined to one.
    def test_first_mesh(self):
        result, _ = play(2, "first_mesh", "shuffled")
        self.assertEqual((result["vertices"], result["genus"]), (1000, 1))

    # Promise: without points there is no mesh, and no complaint.
    def test_nothing(self):
        result, errors = play(2, "nothing")
        self.assertEqual(result["vertices"], 0)
        self.assertNotIn("ERR", errors)


class Ensembles(unittest.TestCase):
    # Promise: the same cloud and seed give the same bytes of an ensemble, too, whose members are learnt
    # by all processes, of which some may have none; for that they get the points.
    def test_ensemble(self):
        alone, _ = play(1, "ensemble", "uneven")
        self.assertEqual((alone["vertices"], alone["genus"]), (1000, 1))
        for processes, division in ((2, "shuffled"), (4, "last")):
            with self.subTest(processes=processes, division=division):
                parts, _ = play(processes, "ensemble", division)
                self.assertEqual(parts["digest"], alone["digest"])
                handed_out = (processes - 1) * 20000 * 4 * 8
                self.assertGreater(parts["bytes"], handed_out)

    # Promise: an abort on any process ends the learning of members on all.
    def test_abort_of_members(self):
        for process in ("0", "1"):
            with self.subTest(process=process):
                result, _ = play(2, "abort", process, "ensemble")
                self.assertEqual(result["aborted"]["stop"], "cancelled")
                # That is what was learnt of the first member.
                self.assertTrue(10 < result["aborted"]["vertices"] < 2000, result)
                self.assertEqual(result["next"]["stop"], "vertices")


class Ends(unittest.TestCase):
    # Promise: an abort on any process ends the run on all and keeps the mesh; all are told of
    # progress; the next run is as ever.
    def test_abort(self):
        for process in ("0", "1"):
            with self.subTest(process=process):
                result, _ = play(2, "abort", process)
                self.assertEqual(result["aborted"]["stop"], "cancelled")
                self.assertTrue(10 < result["aborted"]["vertices"] < 20000, result)
                self.assertEqual((result["next"]["stop"], result["next"]["vertices"]),
                                 ("vertices", 500))

    # Promise: points that are not finite on one process are dropped, and counted.
    def test_not_finite_on_one(self):
        result, errors = play(2, "not_finite_here", "1")
        self.assertEqual(result["vertices"], 500)
        self.assertGreater(result["dropped"], 9000)
        self.assertNotIn("ERR", errors)

    # Promise: if no process has finite points, that is an error on all, and nobody waits for ever.
    def test_not_finite_on_all(self):
        result, errors = play(2, "not_finite_here", "-1")
        self.assertEqual(result["vertices"], 0)
        self.assertIn("No point of the input is finite.", errors)
        self.assertIn("Process 0 has an error", errors)

    # Promise: an error in the part of one process is told, and is an error on all.
    def test_no_weights_on_one(self):
        for process in ("0", "1"):
            with self.subTest(process=process):
                result, errors = play(2, "missing_array", "Trust", process)
                self.assertEqual(result["vertices"], 0)
                self.assertIn("There is no numeric point array", errors)
                self.assertIn("Another process has an error", errors)

    # Promise: an array that one part does not have does not arrive; the others do.
    def test_no_array_on_one(self):
        result, _ = play(2, "missing_array", "Color", "1")
        self.assertEqual(result["vertices"], 500)
        self.assertNotIn("Color", result["arrays"])
        self.assertLess({"Height", "Place", "Side", "Trust", "Label"}, set(result["arrays"]))


if __name__ == "__main__":
    unittest.main()
