# SPDX-License-Identifier: BSD-3-Clause
"""The command of the package that pip installs: python -m neuralmesh, with VTK or without.

Where NEURALMESH_COMMAND is the path of the program of the same name, both are compared: what they print, how
they end, and the meshes.
"""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import neuralmesh
import numpy as np
import support

if neuralmesh.VTK_VERSION:
    print("skipped: this package was built with VTK, where a program has the command")
    sys.exit()

from neuralmesh.batch.meshes import DEFAULT_FORMAT

HAS_VTK = DEFAULT_FORMAT == "vtp"
PROGRAM = os.environ.get("NEURALMESH_COMMAND", "")
COMMAND = [sys.executable, "-m", "neuralmesh"]


class CommandTest(unittest.TestCase):
    """Tests with a folder, in which ball.xyz lies, and mesh.ply, a mesh of it."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        np.savetxt(cls.folder / "ball.xyz", support.sphere(3000), fmt="%.9f")
        cls.run_command("reconstruct", "ball.xyz", "mesh.ply", "--vertices", 200, "--quiet")
        (cls.folder / "line.obj").write_text("v 0 0 0\nv 1 0 0\nf 1 2 2\n")

    @classmethod
    def run_command(cls, *arguments, command=None):
        """Its output, its errors and its exit status."""
        done = subprocess.run(
            [*(command or COMMAND), *map(str, arguments)],
            capture_output=True, text=True, cwd=cls.folder, timeout=support.HANGING,
        )  # fmt: skip
        return done.stdout, done.stderr, done.returncode


class Alone(CommandTest):
    # Promise: the mesh is that of reconstruct(), in each format, and what is printed tells of it.
    def test_reconstruct(self):
        points = np.loadtxt(self.folder / "ball.xyz")
        wanted = neuralmesh.reconstruct(neuralmesh.Mesh(points, np.empty((0, 3), int)), 200)
        for extension in ("ply", "obj", "off", "stl", "glb") + (("vtp", "vtk") if HAS_VTK else ()):
            output, errors, status = self.run_command(
                "reconstruct", "--vertices", 200, "ball.xyz", f"a.{extension}"
            )
            self.assertEqual((errors, status), ("", 0))
            self.assertIn("points     3000 (0 dropped)\nvertices   200\ntriangles  396\n", output)
            if extension != "glb":
                mesh = neuralmesh.read(self.folder / f"a.{extension}")
                self.assertEqual(len(mesh.triangles), 396)
                if extension != "stl":
                    self.assertLess(np.abs(mesh.points - wanted.points).max(), 1e-7)
                    self.assertTrue((mesh.triangles == wanted.triangles).all())

    # Promise: parameters arrive: by options of their own and by --set, also negative places.
    def test_parameters(self):
        points = np.loadtxt(self.folder / "ball.xyz")
        cloud = neuralmesh.Mesh(points, np.empty((0, 3), int))
        wanted = neuralmesh.reconstruct(
            cloud, 150, 7, variant="basic", winner_rate=0.05, boundaries="close",
            maximum_iterations=20000, viewpoints=(-5, 0, 0),
        )  # fmt: skip
        output, errors, status = self.run_command(
            "reconstruct", "ball.xyz", "a.obj", "--vertices", 150, "--seed=7", "--method", "basic",
            "--set", "WinnerRate=0.05", "--set", "MaximumIterations=2e4", "--boundaries", "close",
            "--viewpoint", "-5,0,0", "--quiet",
        )  # fmt: skip
        self.assertEqual((output, errors, status), ("", "", 0))
        mesh = neuralmesh.read(self.folder / "a.obj")
        self.assertTrue((mesh.points == wanted.points).all())

    # Promise: wrong use ends with status 2, bad files with 1, each with words and without a file.
    def test_wrong(self):
        for arguments, status, text in (
            (["reconstruct"], 2, "INPUT is required"),
            (["reconstruct", "ball.xyz"], 2, "OUTPUT is required"),
            (["reconstruct", "ball.xyz", "b.ply", "--vertices", "3"], 2, "no integer from 4 to"),
            (["reconstruct", "ball.xyz", "b.ply", "--vertices"], 2, "--vertices: 1 required N|auto missing"),
            (["reconstruct", "ball.xyz", "b.ply", "--vertex", "3"], 2, "not expected: --vertex"),
            (["reconstruct", "ball.xyz", "b.ply", "--vertexes=3"], 2, "--vertexes: did you mean --vertices"),
            (["reconstruct", "ball.xyz", "b.ply", "--set", "WinerRate=1"], 2, "did you mean WinnerRate"),
            (["reconstruct", "ball.xyz", "b.ply", "--set", "WinnerRate=nan"], 2, "a number from 0 to 1"),
            (["reconstruct", "ball.xyz", "b.ply", "--up", "0,0,0"], 2, "is no direction"),
            (["reconstruct", "ball.xyz", "b.ply", "--shift", "1,2"], 2, "neither auto nor X,Y,Z"),
            (["reconstruct", "ball.xyz", "ball.xyz"], 2, "is the file of INPUT, too"),
            (["reconstruct", "ball.xyz", "./ball.xyz", "b.ply"], 2, "./ball.xyz is given twice"),
            (["reconstruct", "ball.xyz", "b.ply", "--features"], 2, "must be a .vtp or .vtk"),
            (["reconstruct", "ball.xyz", "b.ply", "--uncertainty"], 2, "must be a .vtp or .vtk"),
            (["reconstruct", "ball.xyz", "b.vtp", "--uncertainty", "--set", "FitRounds=0"], 2,
             "Error bars need the fit"),
            (["reconstruct", "ball.xyz", "ball.xyz", "b"], 2, "no extension of a mesh"),
            (["reconstruct", "none.xyz", "b.ply"], 1, "none.xyz: there is no such file"),
            (["reconstruct", "ball.xyz", "b.doc"], 1, "writable are .vtp .ply"),
            (["reconstruct", "ball.xyz", "none/b.ply"], 1, "none"),
            (["reconstruct", "ball.xyz", "b.ply", "--weights", "Trust"], 1, "called Trust"),
            (["compare", "mesh.ply", "ball.xyz"], 1, "no mesh is read from this extension"),
            (["info", "none.ply"], 1, "there is no such file"),
            (["nothing"], 2, "no such subcommand: nothing\n\nTriangle meshes"),
            (["ball.xyz", "b.ply"], 2, "  reconstruct  "),
            (["recontruct", "ball.xyz", "b.ply"], 2, "recontruct: did you mean reconstruct?"),
            (["batch", "none.json"], 2, "none.json"),
        ):
            with self.subTest(arguments):
                output, errors, found = self.run_command(*arguments)
                self.assertEqual((output, found), ("", status))
                self.assertIn(text, errors)
                self.assertNotIn("Traceback", errors)
                self.assertEqual(list(self.folder.glob("b*.ply")) + list(self.folder.glob(".*")), [])

    # Promise: where there is no VTK, the formats that need it are refused with what to install.
    @unittest.skipIf(HAS_VTK, "there is VTK")
    def test_without_vtk(self):
        for arguments in (
            ["reconstruct", "ball.xyz", "b.vtp"],
            ["reconstruct", "ball.xyz", "b.ply", "--explain", "b.vtp"],
            ["explain", "ball.xyz", "mesh.ply", "b.vtp"],
        ):
            _, errors, status = self.run_command(*arguments)
            self.assertEqual(status, 1)
            self.assertIn("pip install vtk", errors)

    # Promise: whatever a damaged file makes of VTK's readers, the command ends with one line that names it.
    @unittest.skipUnless(HAS_VTK, "there is no VTK")
    def test_damaged(self):
        random = np.random.default_rng(3)
        for extension in ("vtk", "vtp"):
            neuralmesh.read(self.folder / "mesh.ply").save(self.folder / f"whole.{extension}")
            whole = (self.folder / f"whole.{extension}").read_bytes()
            for i in range(6):
                damaged = bytearray(whole)
                for place in random.integers(0, 300 if i % 2 else len(whole), 4):
                    damaged[place] = random.integers(0, 256)
                (self.folder / f"damaged.{extension}").write_bytes(damaged[: len(whole) - 7 * i])
                _, errors, status = self.run_command("info", f"damaged.{extension}")
                self.assertIn(status, (0, 1))
                if status == 1:
                    self.assertRegex(errors, rf"^neuralmesh: damaged\.{extension}: [^\n]*\n$")

    # Promise: warnings are told, and with --strict the status tells of them; the mesh is there.
    def test_strict(self):
        for strict, wanted in (([], 0), (["--strict"], 3)):
            _, errors, status = self.run_command(
                "reconstruct", "ball.xyz", "c.ply", "--vertices", 3000, *strict
            )
            self.assertEqual(status, wanted)
            self.assertIn("neuralmesh: warning: The mesh is finer than its data", errors)
        self.assertEqual(len(neuralmesh.read(self.folder / "c.ply").points), 3000)
        names = "Easting Northing Height\n"
        (self.folder / "named.xyz").write_text(names + (self.folder / "ball.xyz").read_text())
        _, errors, status = self.run_command(
            "reconstruct", "named.xyz", "c.ply", "--vertices", 500, "--strict"
        )
        self.assertEqual(status, 3, errors)

    # Promise: after Ctrl-C the mesh learnt so far is written, the status is 130, and a checkpoint is there
    # from which the same command goes on. SIGTERM does the same, and the status is 143.
    def test_interrupted(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                self.interrupt_by(number)

    # Promise: what cannot be printed on a full disk fails with words.
    @unittest.skipUnless(os.path.exists("/dev/full"), "there is no full disk")
    def test_full_disk(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run(
                [*COMMAND, "info", "mesh.ply"], stdout=full, stderr=subprocess.PIPE, text=True,
                cwd=self.folder, timeout=support.HANGING,
            )  # fmt: skip
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "^neuralmesh: .*(output cannot be written|No space left)")
        self.assertNotIn("Exception", done.stderr)

    def interrupt_by(self, number):
        arguments = ["reconstruct", "ball.xyz", "d.ply", "--vertices", "2000000", "--checkpoint", "state"]
        process = subprocess.Popen(
            [*COMMAND, *arguments, "--checkpoint-interval", "0.1"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder,
        )  # fmt: skip
        deadline = time.monotonic() + support.HANGING
        while not (self.folder / "state").exists():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        process.send_signal(number)
        output, _ = process.communicate(timeout=support.HANGING)
        self.assertEqual(process.returncode, 128 + number)
        self.assertIn("ended by: cancelled", output)
        self.assertIn("checkpoint state: the same command goes on from there", output)
        self.assertGreater(len(neuralmesh.read(self.folder / "d.ply").points), 100)
        (self.folder / "state").unlink()

    # Promise: --dry-run writes nothing, and tells what a run takes; --statistics is a table.
    def test_figures(self):
        output, errors, status = self.run_command("reconstruct", "ball.xyz", "e.ply", "--dry-run")
        self.assertEqual((errors, status), ("", 0))
        for line in ("points     3000", "vertices   20000", "samples    about", "memory     about"):
            self.assertIn(line, output)
        self.assertFalse((self.folder / "e.ply").exists())
        self.run_command("reconstruct", "ball.xyz", "e.ply", "--vertices", 500, "--statistics", "e.csv")
        with open(self.folder / "e.csv", encoding="ascii") as file:
            self.assertTrue(file.readline().startswith('"Iteration","Vertices","Seconds"'))
            self.assertGreater(len(file.readlines()), 1)

    # Promise: --help lists all options with their ranges, and all parameters.
    def test_help(self):
        output, _, status = self.run_command("reconstruct", "--help")
        self.assertEqual(status, 0)
        self.assertIn("4 to 1000000000 (default 20000)", " ".join(output.split()))
        self.assertRegex(output, r"WinnerRate +0.1 +0 to 1 +how far the winner moves to the sample")
        for name in ("tune", "compare", "explain", "info", "batch"):
            output, _, status = self.run_command(name, "--help")
            self.assertEqual(status, 0)
            self.assertIn("Exit status: 0", output)
        self.assertEqual(self.run_command(), self.run_command("--help"))
        self.assertEqual(self.run_command("--version")[0], neuralmesh.__version__ + "\n")

    # Promise: several files are one cloud, and a first mesh is learnt from.
    def test_inputs(self):
        points = np.loadtxt(self.folder / "ball.xyz")
        np.savetxt(self.folder / "north.xyz", points[points[:, 2] > 0], fmt="%.9f")
        np.save(self.folder / "south.npy", points[points[:, 2] <= 0])
        output, errors, status = self.run_command(
            "reconstruct", "north.xyz", "south.npy", "f.ply", "--vertices", 400, "--initial", "mesh.ply"
        )
        self.assertEqual((errors, status), ("", 0))
        self.assertIn("points     3000 (0 dropped)\nvertices   400\n", output)


@unittest.skipUnless(PROGRAM, "NEURALMESH_COMMAND is not set")
class Beside(CommandTest):
    """The program and the package, with the same arguments."""

    def both(self, *arguments):
        found = self.run_command(*arguments)
        wanted = self.run_command(*arguments, command=[PROGRAM])
        return [self.comparable(one) for one in (found, wanted)]

    @staticmethod
    def comparable(outcome):
        """Without times."""
        output, errors, status = outcome
        output = re.sub(r"^(phases|time ).*$", r"\1", output, flags=re.MULTILINE)
        return output, errors, status

    # Promise: what is printed and how it ends are the same.
    def test_output(self):
        self.run_command("reconstruct", "ball.xyz", "coarse.ply", "--vertices", 20, "--quiet")
        for arguments in (
            ["reconstruct", "ball.xyz", "out.ply", "--vertices", "300"],
            ["reconstruct", "ball.xyz", "out.ply", "--vertices", "300", "--shift", "auto"],
            ["reconstruct", "ball.xyz", "out.ply", "--vertices", "300", "--shift", "1,2,3"],
            ["reconstruct", "ball.xyz", "out.ply", "--vertices", "3000", "--strict"],
            ["reconstruct", "ball.xyz", "out.ply", "--vertices", "2"],
            ["reconstruct", "ball.xyz", "out.ply", "--set", "Start=nothing"],
            ["reconstruct", "ball.xyz", "out.ply", "--initial", "a", "--ensemble", "3"],
            ["reconstruct", "ball.xyz", "out.ply", "--checkpoint-interval", "3"],
            ["reconstruct", "ball.xyz"],
            ["reconstruct", "ball.xyz", "out.doc"],
            ["reconstruct", "none.ply", "out.ply"],
            ["tune", "ball.xyz", "--vertices", "500"],
            ["tune", "ball.xyz", "--vertices", "500", "--json", "--close"],
            ["compare", "mesh.ply", "mesh.ply", "--samples", "2000"],
            ["compare", "coarse.ply", "mesh.ply", "--samples", "2000"],
            ["compare", "coarse.ply", "mesh.ply", "--json"],
            ["compare", "mesh.ply", "mesh.ply", "--json"],
            ["info", "mesh.ply", "none.ply", "line.obj"],
            ["info", "mesh.ply", "--json"],
        ):
            with self.subTest(arguments):
                found, wanted = self.both(*arguments)
                self.assertEqual(found, wanted)

    # Promise: meshes have the same coordinates, normals and triangles, to the last byte.
    def test_meshes(self):
        self.run_command("reconstruct", "ball.xyz", "coarse.stl", "--vertices", 100, "--quiet")
        for options in (
            [],
            ["--seed", "7", "--method", "normal"],
            ["--method", "basic", "--order", "list", "--jump", "area=0.5", "--preset", "thesis"],
            ["--ensemble", "3", "--set", "GridResolution=32", "--set", "VerticesPerMember=500"],
            ["--automatic", "--topology", "on", "--keep-pieces", "0"],
            ["--viewpoint", "-5,0,0", "--viewpoint", "5,0,0", "--up", "0,0,1"],
            ["--initial", "coarse.stl"],
            ["--boundaries", "close", "--threads", "1", "--shift", "5,6,7"],
        ):
            with self.subTest(options):
                arguments = ["--vertices", "300", "--quiet", *options]
                self.assertEqual(
                    self.run_command("reconstruct", "ball.xyz", "p.ply", *arguments),
                    self.run_command("reconstruct", "ball.xyz", "c.ply", *arguments, command=[PROGRAM]),
                )
                # VTK adds a comment of its own to the header.
                found, wanted = (
                    (self.folder / name).read_bytes().partition(b"end_header\n")
                    for name in ("p.ply", "c.ply")
                )
                self.assertEqual(found[2], wanted[2])
                lines = [line for line in wanted[0].split(b"\n") if b"VTK" not in line and b"vtk" not in line]
                self.assertEqual(sorted(found[0].split(b"\n")), sorted(lines))

    # Promise: normals that are named, or off, are the same ones, whatever the active ones are called.
    @unittest.skipUnless(HAS_VTK, "a .vtp needs VTK")
    def test_normals(self):
        points = np.loadtxt(self.folder / "ball.xyz")
        normals = "".join(
            f'<DataArray type="Float64" Name="{name}" NumberOfComponents="3" format="ascii">'
            + " ".join(map(str, (sign * points).ravel())) + "</DataArray>"
            for name, sign in (("Inwards", -1), ("Outwards", 1))
        )  # fmt: skip
        (self.folder / "ball.vtp").write_text(
            '<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="3000">'
            f'<PointData Normals="Inwards">{normals}</PointData><Points>'
            '<DataArray type="Float64" NumberOfComponents="3" format="ascii">'
            + " ".join(map(str, points.ravel()))
            + "</DataArray></Points></Piece></PolyData></VTKFile>"
        )
        meshes = []
        for name in ("Inwards", "Outwards", "off", ""):
            options = ["--vertices", 300, *(["--normals", name] if name else [])]
            found = self.run_command("reconstruct", "ball.vtp", "p.stl", *options)
            wanted = self.run_command("reconstruct", "ball.vtp", "c.stl", *options, command=[PROGRAM])
            self.assertEqual(self.comparable(found), self.comparable(wanted))
            self.assertIn("sides      by " + ("volume" if name == "off" else "normals"), found[0])
            meshes.append((self.folder / "p.stl").read_bytes()[80:])
            self.assertEqual(meshes[-1], (self.folder / "c.stl").read_bytes()[80:])
        self.assertNotEqual(meshes[0], meshes[1])
        self.assertEqual(meshes[0], meshes[3])
        found, wanted = self.both("reconstruct", "ball.vtp", "p.stl", "--normals", "Upwards")
        self.assertEqual(found, wanted)
        self.assertIn("Arrays with three components: Inwards, Outwards.", found[1])
        self.assertEqual(found[2], 1)

    # Promise: text and triangles in .obj are the same, and the triangles of .stl.
    def test_formats(self):
        for name, command in (("p", COMMAND), ("c", [PROGRAM])):
            for extension in ("obj", "stl", "glb"):
                self.run_command(
                    "reconstruct", "ball.xyz", f"{name}.{extension}", "--vertices", 300, command=command
                )
        found, wanted = ((self.folder / f"{name}.obj").read_text() for name in "pc")
        for kind in ("v ", "f "):
            lines = [[one for one in text.split("\n") if one.startswith(kind)] for text in (found, wanted)]
            self.assertEqual(*lines)
        found, wanted = ((self.folder / f"{name}.stl").read_bytes()[80:] for name in "pc")
        self.assertEqual(found, wanted)
        found, wanted = ((self.folder / f"{name}.glb").read_bytes() for name in "pc")
        self.assertEqual(found, wanted)

    # Promise: all options and parameters of the program are there, with the same ranges.
    def test_help(self):
        (found, _, _), (wanted, _, _) = self.both("reconstruct", "--help")
        options = set(re.findall(r"^  (--[a-z-]+)", wanted, re.MULTILINE))
        self.assertLessEqual(options, set(re.findall(r"^  (--[a-z-]+)", found, re.MULTILINE)))
        table = wanted[wanted.index("Parameters of learning") : wanted.index("For example")]
        self.assertIn(table, found)
        (found, _, _), (wanted, _, _) = self.both("compare", "--help")
        for help_text in (found, wanted):
            self.assertIn("(Knapitsch et al. 2017)", help_text)
        figures = wanted[wanted.index("Points are drawn evenly") : wanted.index("Exit status")]
        self.assertIn(figures, found)

    # Promise: figures are the same, digit by digit.
    def test_json(self):
        self.run_command("reconstruct", "ball.xyz", "other.off", "--vertices", 100, "--quiet")
        arguments = ("compare", "mesh.ply", "other.off", "--json", "--seed", "5")
        found, wanted = (json.loads(outcome[0]) for outcome in self.both(*arguments))
        self.assertEqual(found, wanted)


if __name__ == "__main__":
    unittest.main()
