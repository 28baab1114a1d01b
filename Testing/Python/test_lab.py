# SPDX-License-Identifier: BSD-3-Clause
"""The laboratory: its quick form, which all tests of the first class share, and what goes wrong."""

import csv
import html
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
import support
from batch_testing import DOCUMENTATION, write_scan
from neuralmesh.batch.meshes import write_mesh
from neuralmesh.lab import judging
from neuralmesh.lab.catalogue import EXPERIMENTS
from neuralmesh.lab.experiment import DOES_NOT_HOLD, HOLDS, HOLDS_IN_PART, Scale
from neuralmesh.lab.models import MODELS
from neuralmesh.lab.table import Table
from vtkmodules.vtkFiltersSources import vtkSphereSource

TIMES = re.compile("seconds|_us$")
SCALE = Scale(is_quick=True, models=MODELS[:2])


def start(folder, *arguments):
    """Start the command with its results in a folder."""
    return subprocess.Popen(
        [sys.executable, "-m", "neuralmesh.lab", *arguments, "--output", str(folder)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def run(folder, *arguments):
    """Run it; its output, its errors and its exit status."""
    process = start(folder, *arguments)
    output, errors = process.communicate(timeout=support.HANGING)
    return output, errors, process.returncode


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def without_times(rows):
    return [{name: text for name, text in row.items() if not TIMES.search(name)} for row in rows]


class FolderTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name).resolve()


class Quick(FolderTest):
    """All experiments, small."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.results = cls.folder / "all"
        cls.output, cls.errors, cls.status = run(cls.results, "all", "--quick")
        cls.report = (cls.results / "index.html").read_text(encoding="utf-8")
        cls.markdown = (cls.results / "verdicts.md").read_text(encoding="utf-8")

    # Promise: the quick form does all runs without errors, and tells how far it is.
    def test_status(self):
        self.assertEqual(self.status, 0, self.errors)
        self.assertRegex(self.errors, r"100 %  \d+ of \d+ runs")

    # Promise: each experiment gives a table with a row for each of its runs, in which no figure that
    # its summary shows is missing.
    def test_tables(self):
        for name, experiment in EXPERIMENTS.items():
            with self.subTest(name):
                rows = rows_of(self.results / f"{name}.csv")
                ends = [row for row in rows if row["moment"] == "end"]
                self.assertEqual(len(ends), len(experiment.cases(SCALE)))
                for row in ends:
                    missing = {column for column in experiment.columns if not row[column]}
                    # Measured on the cube alone, not of average meshes, and where it was called.
                    self.assertLessEqual(
                        missing, {"edge_density", "genus", "openings", "folds", "topology_us"}
                    )

    # Promise: each experiment gives a plot, which stands in the report beside what the thesis says,
    # what was found and a verdict; the report needs no other file.
    def test_report(self):
        for name, experiment in EXPERIMENTS.items():
            with self.subTest(name):
                picture = (self.results / f"{name}.png").read_bytes()
                self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
                section = self.report.split(f'<h2 id="{name}">')[1].split("<h2")[0]
                self.assertIn(html.escape(experiment.figures), section)
                for claim in experiment.claims:
                    self.assertIn(html.escape(claim.says), section)
                verdicts = re.findall(r'<td class="verdict \w+">([^<]*)</td>', section)
                self.assertEqual(len(verdicts), len(experiment.claims))
                for verdict in verdicts:
                    self.assertRegex(verdict, f"^({HOLDS}|{HOLDS_IN_PART}|{DOES_NOT_HOLD})")
                self.assertIn('src="data:image/png;base64,', section)
        self.assertNotRegex(self.report, r'(src|href)="(?!data:|#)')

    # Promise: the verdicts in Markdown are those of the report.
    def test_markdown(self):
        table = self.report.split("<table>")[1].split("</table>")[0]
        found = re.findall(r"\| (.*) \| (.*) \| (.*) \|", self.markdown.split("## ")[0])[1:]
        wanted = re.findall(r'<a href="#.*?">(.*?)</a></td><td>(.*?)</td><td .*?>(.*?)</td>', table)
        self.assertEqual(found, [tuple(map(html.unescape, row)) for row in wanted])
        self.assertEqual(len(found), len(EXPERIMENTS))

    # Promise: they have every experiment, each claim and a verdict on it.
    def test_verdicts(self):
        for experiment in EXPERIMENTS.values():
            self.assertIn(f"## {experiment.figures}: {experiment.title}", self.markdown)
            for claim in experiment.claims:
                row = next((line for line in self.markdown.splitlines() if claim.says in line), "")
                self.assertRegex(row, rf"\| ({HOLDS}|{HOLDS_IN_PART}|{DOES_NOT_HOLD})[^|]* \|$")

    # Promise: exact counters in heaps give the mesh that the search through all counters gives.
    def test_exact(self):
        rows = rows_of(self.results / "models.csv")
        for model in SCALE.models:
            meshes = {
                order: [(row["vertices"], row["regular"]) for row in rows
                        if (row["model"], row["order"]) == (model, order)]
                for order in ("original search", "exact in heaps")
            }  # fmt: skip
            self.assertEqual(meshes["original search"], meshes["exact in heaps"])
            self.assertGreater(len(meshes["exact in heaps"]), 10)

    # Promise: the same command again does no run again, and gives the same tables and verdicts.
    def test_again(self):
        before = {path: path.read_bytes() for path in self.results.glob("*.csv")}
        output, errors, status = run(self.results, "all", "--quick")
        self.assertEqual((errors, status), ("", 0))
        self.assertRegex(output, r"(\d+) of \1 runs were done before")
        self.assertEqual({path: path.read_bytes() for path in self.results.glob("*.csv")}, before)
        self.assertEqual((self.results / "index.html").read_text(encoding="utf-8"), self.report)

    # Promise: a command that was killed goes on where it was, and gives the same tables but for times.
    def test_killed(self):
        results = self.folder / "killed"
        process = start(results, "addition", "cube", "--quick", "--processes", "1")
        deadline = time.monotonic() + support.HANGING
        while len(list(results.glob("runs/*.json"))) < 3 and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        output, _, status = run(results, "addition", "cube", "--quick", "--processes", "1")
        self.assertEqual(status, 0)
        done, count = map(int, re.search(r"(\d+) of (\d+) runs were done before", output).groups())
        self.assertGreaterEqual(done, 3)
        self.assertLess(done, count)
        for name in ("addition", "cube"):
            found, wanted = (rows_of(folder / f"{name}.csv") for folder in (results, self.results))
            self.assertEqual(without_times(found), without_times(wanted))


class Files(FolderTest):
    """Models of the user."""

    # Promise: files that are named take the place of the models: surfaces are scanned, clouds taken as
    # they are; one that cannot be read fails alone, and what needs it is not judged.
    def test_models(self):
        sphere = vtkSphereSource()
        sphere.Update()
        write_mesh(sphere.GetOutput(), self.folder / "surface.ply")
        write_scan(self.folder / "cloud.xyz")
        files = [str(self.folder / name) for name in ("surface.ply", "cloud.xyz")]
        arguments = ("addition", "--quick", "--models", *files)
        output, errors, status = run(self.folder / "results", *arguments)
        self.assertEqual(status, 0, errors)
        rows = [r for r in rows_of(self.folder / "results/addition.csv") if r["moment"] == "end"]
        self.assertEqual({row["model"] for row in rows}, {"surface", "cloud"})
        for row in rows:
            self.assertEqual(row["vertices"], "500")
            self.assertTrue(0 < float(row["rms"]) < 20, row)

        (self.folder / "broken.ply").write_text("ply\nformat ascii 1.0\n", encoding="ascii")
        arguments = ("addition", "cube", "--quick", "--models", str(self.folder / "broken.ply"))
        output, errors, status = run(self.folder / "results", *arguments)
        self.assertEqual(status, 1)
        self.assertIn("broken.ply", errors)
        self.assertRegex(output, "addition +not judged")
        self.assertRegex(output, "cube +(holds|does not hold)")


class WrongUse(FolderTest):
    """What is refused before anything runs."""

    # Promise: a name that does not exist is refused with those that do, a file with its path.
    def test_names(self):
        _, errors, status = run(self.folder / "results", "smothing-rate")
        self.assertEqual(status, 2)
        self.assertIn("smoothing-rate", errors)
        _, errors, status = run(self.folder / "results", "nothing")
        self.assertEqual(status, 2)
        for name in EXPERIMENTS:
            self.assertIn(name, errors)
        _, errors, status = run(self.folder / "results", "jumps", "--models", "none.ply")
        self.assertEqual(status, 2)
        self.assertIn("there is no file", errors)
        for folder in ("one", "two"):
            write_scan(self.folder / folder / "same.xyz")
        files = [str(self.folder / folder / "same.xyz") for folder in ("one", "two")]
        _, errors, status = run(self.folder / "results", "jumps", "--models", *files)
        self.assertEqual((status, errors.count("\n")), (2, 1))
        self.assertIn("two models are called same", errors)
        self.assertFalse((self.folder / "results").exists())

    # Promise: a folder that cannot be one is named in one line.
    def test_folder(self):
        (self.folder / "file").write_text("", encoding="ascii")
        _, errors, status = run(self.folder / "file", "cube", "--quick")
        self.assertEqual((status, errors.count("\n")), (1, 1))
        self.assertIn("file", errors)

    # Promise: without matplotlib nothing runs, and the message says which package has it.
    def test_matplotlib(self):
        script = (
            "import sys; sys.modules['matplotlib'] = None\n"
            "from neuralmesh.lab.command import main\n"
            f"sys.exit(main(['cube', '--output', {str(self.folder / 'none')!r}]))"
        )
        process = subprocess.run(
            [sys.executable, "-c", script], capture_output=True, text=True, check=False
        )
        self.assertEqual(process.returncode, 1)
        self.assertIn("python3-matplotlib", process.stderr)
        self.assertFalse((self.folder / "none").exists())


class Judging(unittest.TestCase):
    """Verdicts come from the data."""

    @staticmethod
    def table(**figures):
        """A table of models with regular vertices by the values 1 and 2 of a factor, three seeds."""
        return Table([
            {"model": model, "way": way, "regular": figure + change}
            for model, means in figures.items()
            for way, figure in zip((1, 2), means)
            for change in (-1, 0, 1)
        ])  # fmt: skip

    # Promise: what is so in all models holds, in some in part, in none not; and a difference that is
    # less than the error of the means is none.
    def test_larger(self):
        judge = judging.larger("regular", "way", 2, than=1)
        for verdict, means in {
            HOLDS: ((30, 40), (20, 25)),
            HOLDS_IN_PART: ((30, 40), (25, 20)),
            DOES_NOT_HOLD: ((40, 30), (30, 30.5)),
        }.items():
            finding = judge(self.table(a=means[0], b=means[1]))
            self.assertEqual(finding.verdict, verdict)
        finding = judge(self.table(a=(30, 40), b=(25, 20)))
        self.assertEqual(finding.extent, "holds in part (1 of 2)")
        self.assertIn("a 30.0 → 40.0 (× 1.33); b 25.0 → 20.0 (× 0.80)", finding.words)

    # Promise: so many times as large, alike within a part, and rising from value to value are judged as
    # they are said.
    def test_others(self):
        table = self.table(a=(30, 40))
        for judge, verdict in (
            (judging.larger("regular", "way", 2, than=1, by=1.3), HOLDS),
            (judging.larger("regular", "way", 2, than=1, by=1.4), DOES_NOT_HOLD),
            (judging.alike("regular", "way", 2, 1, within=0.4), HOLDS),
            (judging.alike("regular", "way", 2, 1, within=0.3), DOES_NOT_HOLD),
            (judging.ordered("regular", "way", (1, 2), rises=True), HOLDS),
            (judging.ordered("regular", "way", (1, 2), rises=False), DOES_NOT_HOLD),
        ):
            self.assertEqual(judge(table).verdict, verdict)

    # Promise: the power by which a cost grows is found.
    def test_exponent(self):
        sizes = np.array([1000.0, 2000.0, 5000.0, 9000.0])
        self.assertAlmostEqual(judging.exponent(sizes, 3 * sizes**1.5), 1.5)


class Documentation(unittest.TestCase):
    # Promise: the page of the laboratory has a row for every experiment, which counts all of its claims.
    def test_verdicts(self):
        text = (DOCUMENTATION / "Research" / "Laboratory.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| (.*?) \| .* \| (\d+) of (\d+) \|$", text, re.MULTILINE)
        for experiment in EXPERIMENTS.values():
            (counts,) = [tuple(map(int, row[1:])) for row in rows if row[0] == experiment.figures]
            self.assertLessEqual(counts[0], counts[1])
            self.assertEqual(counts[1], len(experiment.claims), experiment.figures)
        self.assertEqual(len(rows), len(EXPERIMENTS))


if __name__ == "__main__":
    unittest.main()
