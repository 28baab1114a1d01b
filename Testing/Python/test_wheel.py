# SPDX-License-Identifier: BSD-3-Clause
"""What pip installs, with whatever VTK is beside it, or none. NEURALMESH_WORLD tells what is (none, vtk, pyvista,
cvista, old, source).
"""

import ast
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import textwrap
import threading
import unittest
from pathlib import Path

import numpy as np

import neuralmesh

SETTINGS = Path(__file__).resolve().parents[2] / "pyproject.toml"
WORLD = os.environ.get("NEURALMESH_WORLD", "none")
HAS_VTK = WORLD not in ("none", "source")


def ball(count=4000, dtype=np.float64):
    """Points on a sphere."""
    points = np.random.default_rng(1).normal(size=(count, 3))
    return (points / np.linalg.norm(points, axis=1)[:, None]).astype(dtype)


def points_of(mesh):
    """The points of a mesh, whatever it is."""
    if isinstance(mesh, neuralmesh.Mesh):
        return mesh.points
    from neuralmesh.engine.vtk_arrays import to_numpy

    return to_numpy(mesh.GetPoints().GetData())


def run(script, status=0):
    """What a script prints, in a process of its own."""
    result = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, check=False
    )
    assert result.returncode == status, result.stderr
    return (result.stdout if status == 0 else result.stderr).strip()


class Import(unittest.TestCase):
    # Promise: neither VTK nor PyVista is imported by the way, so that the import is quick.
    def test_alone(self):
        loaded = run("""
            import sys, neuralmesh
            print(*sorted({"vtkmodules", "cvista", "pyvista"} & set(sys.modules)))
        """)
        self.assertEqual(loaded, "")

    # Promise: it was built without a VTK, and its world is what the test takes it for.
    def test_world(self):
        self.assertEqual(neuralmesh.VTK_VERSION, "")
        names = ("vtkmodules", "cvista")
        self.assertEqual(any(importlib.util.find_spec(name) for name in names), HAS_VTK)

    # Promise: without NumPy, without its engine, with one of another version it says what to do, in a line.
    def test_broken(self):
        for broken, wanted in (
            ("sys.modules['numpy'] = None", "pip install numpy"),
            ("sys.modules['neuralmesh._engine'] = None", "compiles it"),
            ("import types; e = types.ModuleType('e'); e.version, e.__file__ = '0.0.1', 'here';"
             "sys.modules['neuralmesh._engine'] = e", "two versions lie in one folder"),
        ):  # fmt: skip
            with self.subTest(broken):
                last = run(f"import sys; {broken}; import neuralmesh", 1).splitlines()[-1]
                self.assertRegex(last, f"^ImportError: neuralmesh .*{wanted}")

    # Promise: the classes for pipelines are there with a VTK, and else say what to install.
    def test_classes(self):
        if WORLD == "cvista":
            return  # they derive from classes of vtkmodules
        if HAS_VTK:
            self.assertEqual(neuralmesh.vtkNeuralMesh().GetNumberOfVertices(), 20000)
        else:
            with self.assertRaisesRegex(ImportError, "pip install vtk"):
                neuralmesh.vtkNeuralMesh()
        with self.assertRaises(AttributeError):
            neuralmesh.vtkNothing()

    # Promise: completion proposes the classes where they work, and whoever lists all names finds each.
    def test_completion(self):
        self.assertIn("reconstruct", dir(neuralmesh))
        if WORLD != "cvista":
            self.assertEqual("vtkNeuralMesh" in dir(neuralmesh), HAS_VTK)
            for name in dir(neuralmesh):
                getattr(neuralmesh, name)


class Functions(unittest.TestCase):
    # Promise: arrays in give a mesh out: a vtkPolyData where there is a VTK, else a neuralmesh.Mesh.
    def test_kinds(self):
        mesh, explained = neuralmesh.reconstruct(ball(), 300, explain=True)
        for one in (mesh, explained, neuralmesh.explain(ball(), mesh)):
            self.assertEqual(isinstance(one, neuralmesh.Mesh), not HAS_VTK)
        self.assertEqual(len(points_of(mesh)), 300)
        self.assertEqual(len(points_of(explained)), 4000)
        self.assertTrue(neuralmesh.info(mesh)["closed"])
        figures = neuralmesh.compare(mesh, mesh)
        self.assertLess(figures["reference_to_result"]["rms_percent"], 1e-9)

    # Promise: error bars are positive floats of the vertices; without a fit there are none, but words.
    def test_uncertainty(self):
        mesh = neuralmesh.reconstruct(ball(), 300, compute_uncertainty=True)
        if HAS_VTK:
            from neuralmesh.engine.vtk_arrays import to_numpy

            bars = to_numpy(mesh.GetPointData().GetArray("Uncertainty"))
        else:
            bars = mesh.point_data["Uncertainty"]
        self.assertEqual((bars.dtype, bars.shape), (np.float32, (300,)))
        self.assertGreater(bars.min(), 0)
        with self.assertRaisesRegex(ValueError, "Error bars need the fit"):
            neuralmesh.reconstruct(ball(), 300, compute_uncertainty=True, fit_rounds=0)

    # Promise: what makes one cloud gives one mesh, however the array lies; numbers of 4 bytes stay so.
    def test_layouts(self):
        cloud = ball()
        wanted = points_of(neuralmesh.reconstruct(cloud, 300))
        self.assertEqual(wanted.dtype, np.float64)
        read_only = cloud.copy()
        read_only.flags.writeable = False
        wide = np.zeros((4000, 5))
        wide[:, :3] = cloud
        for layout in (np.asfortranarray(cloud), read_only, wide[:, :3], cloud.tolist()):
            given = points_of(neuralmesh.reconstruct(layout, 300))
            self.assertEqual(given.tobytes(), wanted.tobytes())
        self.assertEqual(points_of(neuralmesh.reconstruct(ball(dtype="f4"), 300)).dtype, np.float32)

    # Promise: arrays that are laid out as the engine takes them are not copied.
    def test_no_copies(self):
        from neuralmesh.engine.cloud import as_cloud

        for dtype in (np.float32, np.float64):
            cloud = ball(dtype=dtype)
            self.assertTrue(np.shares_memory(as_cloud(cloud).blocks[0].points, cloud))

    # Promise: anything but numbers of shape (N, 3) is told in words.
    def test_bad_arrays(self):
        for bad in (ball()[:, :2], ball()[0], [["a", "b", "c"]], None, 3, ball().astype(complex)):
            with self.assertRaisesRegex(ValueError, r"shape \(N, 3\)"):
                neuralmesh.reconstruct(bad, 300)
        for empty in (np.empty((0, 3)), np.full((9, 3), np.nan), np.ones((9, 3))):
            with self.assertRaises(ValueError):
                neuralmesh.reconstruct(empty, 300)

    # Promise: a Mesh whose arrays do not go together is told in words, and no foreign memory is read.
    def test_bad_meshes(self):
        empty = np.empty((0, 3), dtype=np.int64)
        for data in ({"Normals": ball()[:9]}, {"Normals": ball()[:, :2]}, {"w": np.ones(9)}):
            with self.assertRaisesRegex(ValueError, "must have a row for each of 4000 points"):
                neuralmesh.reconstruct(neuralmesh.Mesh(ball(), empty, data), 300)
        for triangles in ([[0, 1, 2, 3]], [[0.0, 1.0, 2.0]], [0, 1, 2], np.empty((0, 4), dtype=int)):
            with self.assertRaisesRegex(ValueError, r"triangles of a mesh .* shape \(N, 3\)"):
                neuralmesh.info(neuralmesh.Mesh(ball(), np.array(triangles)))

    # Promise: masked points are not there.
    def test_masked(self):
        cloud = np.ma.array(np.vstack((ball(), [[9.0, 9.0, 9.0]])))
        cloud[-1] = np.ma.masked
        mesh = neuralmesh.reconstruct(cloud, 300)
        self.assertEqual(
            points_of(mesh).tobytes(), points_of(neuralmesh.reconstruct(ball(), 300)).tobytes()
        )

    # Promise: every way of learning works: variants, orders, ensembles, boundaries, weights, a first mesh.
    def test_ways(self):
        cloud = ball()
        first = neuralmesh.reconstruct(cloud, 100)
        for ways in (
            {"variant": "basic"},
            {"variant": "normal_based"},
            {"order": "list"},
            {"preset": "thesis"},
            {"ensemble": 2},
            {"boundaries": "close"},
            {"weights": np.arange(4000.0)},
            {"first_mesh": first},
            {"automatic": True},
            {"viewpoints": [0, 0, 5], "up": [0, 0, 1]},
        ):
            with self.subTest(str(list(ways))):
                self.assertEqual(len(points_of(neuralmesh.reconstruct(cloud, 200, **ways))), 200)

    # Promise: a run is cancelled by progress, ended by what that raises, and goes on from its checkpoint.
    def test_interrupted(self):
        cloud, calls = ball(20000), []

        def cancel(fraction):
            calls.append(fraction)
            return len(calls) < 3

        self.assertLess(len(points_of(neuralmesh.reconstruct(cloud, 5000, progress=cancel))), 5000)
        with self.assertRaises(ZeroDivisionError):
            neuralmesh.reconstruct(cloud, 5000, progress=lambda fraction: 1 / 0)
        with tempfile.TemporaryDirectory() as folder:
            checkpoint = Path(folder) / "state"
            calls.clear()
            neuralmesh.reconstruct(cloud, 5000, checkpoint=checkpoint, progress=cancel)
            self.assertTrue(checkpoint.exists())
            resumed = neuralmesh.reconstruct(cloud, 5000, checkpoint=checkpoint)
            self.assertFalse(checkpoint.exists())
        wanted = neuralmesh.reconstruct(cloud, 5000)
        self.assertEqual(points_of(resumed).tobytes(), points_of(wanted).tobytes())

    # Promise: points in a file are drawn where they lie.
    def test_file_in_place(self):
        cloud = ball(dtype="<f4")
        header = "ply\nformat binary_little_endian 1.0\nelement vertex 4000\n" + "".join(
            f"property float {name}\n" for name in "xyz"
        )
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scan.ply"
            path.write_bytes((header + "end_header\n").encode() + cloud.tobytes())
            mesh = neuralmesh.reconstruct(path, 300)
            drawn = neuralmesh.reconstruct(path, 300, maximum_points=1000)
            self.assertEqual(len(points_of(drawn)), 300)
        self.assertEqual(
            points_of(mesh).tobytes(), points_of(neuralmesh.reconstruct(cloud, 300)).tobytes()
        )
        with self.assertRaisesRegex(ValueError, "missing.ply"):
            neuralmesh.reconstruct("missing.ply", 300)

    # Promise: normals are given as an array, by the name of one of a Mesh, or by that of a file, and are
    # left out when they are "off": then the mesh is that of the points alone.
    def test_normals(self):
        cloud = ball() * np.random.default_rng(2).uniform(0.95, 1.05, (4000, 1))
        none = np.empty((0, 3), np.int64)
        given = neuralmesh.Mesh(cloud, none, {"Normals": -ball(), "Slope": ball()})

        def learnt(points, normals=None):
            return points_of(neuralmesh.reconstruct(points, 300, normals=normals)).tobytes()

        self.assertEqual(learnt(given, "Slope"), learnt(cloud, ball()))
        self.assertEqual(learnt(given, "Normals"), learnt(given))
        self.assertEqual(learnt(given, "off"), learnt(cloud))
        self.assertNotEqual(learnt(given), learnt(cloud))
        message = "called Up for the normals. Arrays with three components: Normals, Slope."
        with self.assertRaisesRegex(ValueError, message):
            neuralmesh.reconstruct(given, 300, normals="Up")

        header = "ply\nformat binary_little_endian 1.0\nelement vertex 4000\n" + "".join(
            f"property double {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz")
        )
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scan.ply"
            path.write_bytes((header + "end_header\n").encode() + np.c_[cloud, -ball()].tobytes())
            self.assertEqual(learnt(path, "off"), learnt(cloud))
            self.assertEqual(learnt(path, "Normals"), learnt(path))
            self.assertNotEqual(learnt(path), learnt(cloud))
            with self.assertRaisesRegex(ValueError, "Arrays with three components: Normals."):
                neuralmesh.reconstruct(path, 300, normals="Slope")
            with self.assertRaisesRegex(ValueError, "normals cannot be given for points in a file"):
                neuralmesh.reconstruct(path, 300, normals=ball())

    # Promise: a stream learns while points arrive.
    def test_stream(self):
        stream = neuralmesh.stream(300)
        stream.add_points(ball(), viewpoint=[0, 0, 9])
        self.assertEqual(stream.learn(60000), 60000)
        self.assertEqual((stream.points, stream.samples), (4000, 60000))
        self.assertGreater(len(points_of(stream.mesh())), 200)

    # Promise: a stream may be fed by one thread while another one learns.
    def test_stream_in_two_threads(self):
        stream, cloud = neuralmesh.stream(1000), ball(20000)
        stream.add_points(cloud)
        feeding = threading.Thread(target=lambda: [stream.add_points(cloud) for _ in range(20)])
        feeding.start()
        for _ in range(20):
            stream.learn(5000, progress=lambda _fraction: stream.points > 0)
        feeding.join()
        self.assertEqual((stream.points, stream.samples), (21 * 20000, 20 * 5000))


def parameters_of(function):
    """Names of the parameters, and how many have a default."""
    return [one.arg for one in function.args.args], len(function.args.defaults)


def stub_signatures(tree, before=""):
    """What there is, with the parameters of functions; None for other values. So is the next function."""
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            found.update(stub_signatures(node, f"{node.name}."))
        elif isinstance(node, ast.FunctionDef):
            is_property = "property" in map(ast.unparse, node.decorator_list)
            found[before + node.name] = None if is_property else parameters_of(node)
        elif isinstance(node, ast.AnnAssign):
            found[before + node.target.id] = None
    return found


def compiled_signatures(owner, before=""):
    found = {}
    for name, member in vars(owner).items():
        if name.startswith("_") and name != "__init__":
            continue
        if isinstance(member, type):
            found.update(compiled_signatures(member, f"{name}."))
            continue
        found[before + name] = None
        if callable(member):
            signature, brackets = member.__doc__, 1
            while brackets:  # what is in them is not always Python
                signature, brackets = re.subn(r"\[[^\[\]]*\]", "", signature)
            found[before + name] = parameters_of(ast.parse(f"def {signature}: ...").body[0])
    return found


class Types(unittest.TestCase):
    def mypy(self, *arguments, script=""):
        """What mypy says of a script.py, in a folder of its own."""
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("there is no mypy")
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "script.py").write_text(textwrap.dedent(script))
            command = [sys.executable, "-m", "mypy", "--cache-dir", folder, *arguments]
            told = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
        return told.stdout + told.stderr

    # Promise: users of the functions are checked by the hints.
    def test_wrong_use(self):
        script = "import neuralmesh\nneuralmesh.reconstruct([[0.0]], vertices='many')\n"
        told = self.mypy("script.py", script=script)
        self.assertIn('"reconstruct" matches argument types "list[list[float]]", "str"', told)
        self.assertIn("Found 1 error", told)

    # Promise: nothing is said against right use, with meshes of this package, too.
    def test_right_use(self):
        told = self.mypy("script.py", script="""
            import neuralmesh
            from pathlib import Path

            scan = neuralmesh.read(Path("scan.ply"))
            mesh = neuralmesh.reconstruct(scan, 300, first_mesh=scan, winner_rate=0.1)
            mesh.save("mesh.stl")
            print(neuralmesh.reconstruct([[0.0]], variant="basic").GetNumberOfPoints())
            mesh, explained = neuralmesh.reconstruct("scan.ply", explain=True)
            print(neuralmesh.compare(scan, mesh), neuralmesh.info(scan), neuralmesh.explain(scan, scan))
            stream = neuralmesh.stream(300)
            stream.add_points(scan, viewpoint=[0, 0, 9])
            print(stream.learn(1000), stream.mesh())
        """)  # fmt: skip
        self.assertIn("Success", told)

    # Promise: a mesh has the type of its points; for arrays that of VTK, where it is installed.
    def test_results(self):
        mesh = "neuralmesh.engine.mesh.Mesh"
        known = [
            ("neuralmesh.reconstruct(scan, 300, seed=2)", mesh),
            ("neuralmesh.remesh(scan)", mesh),
            ("neuralmesh.remesh(scan, feature_lines=True)", f"tuple[{mesh}, {mesh}]"),
            ("neuralmesh.explain(scan, scan)", mesh),
        ]
        if WORLD in ("vtk", "pyvista"):
            mesh = "vtkmodules.vtkCommonDataModel.vtkPolyData"
            known += [
                ("neuralmesh.reconstruct(array)", mesh),
                ("neuralmesh.remesh((array, array))", mesh),
                ("neuralmesh.explain(array, scan)", mesh),
            ]
        self.assert_types("scan = neuralmesh.read('scan.ply')\narray = [[0.0, 0.0, 0.0]]\n", known)

    # Promise: for datasets of PyVista it is pyvista.PolyData, by the functions and by the accessor.
    def test_results_of_pyvista(self):
        if WORLD != "pyvista":
            self.skipTest("there is no PyVista")
        mesh = "pyvista.core.pointset.PolyData"
        self.assert_types(
            "import pyvista\n"
            "from neuralmesh.pyvista_accessor import CloudAccessor, SurfaceAccessor\n"
            "ball = pyvista.Sphere()\ncloud, surface = CloudAccessor(ball), SurfaceAccessor(ball)\n",
            [
                ("neuralmesh.reconstruct(ball, 300)", mesh),
                ("neuralmesh.reconstruct(pyvista.PointSet())", mesh),
                ("neuralmesh.reconstruct(pyvista.MultiBlock())", mesh),
                ("neuralmesh.remesh(ball)", mesh),
                ("neuralmesh.explain(ball, ball)", mesh),
                ("cloud.reconstruct(300, winner_rate=0.1)", mesh),
                ("cloud.explain(ball)", mesh),
                ("surface.reconstruct()", mesh),
                ("surface.remesh(300, feature_lines=True)", f"tuple[{mesh}, {mesh}]"),
            ],
        )

    def assert_types(self, givens, known):
        """What is known of expressions after the givens."""
        questions = "".join(f"reveal_type({expression})\n" for expression, _ in known)
        told = self.mypy("script.py", script=f"import neuralmesh\n{givens}{questions}")
        found = re.findall('Revealed type is "(.*)"', told)
        self.assertEqual(dict(zip([one for one, _ in known], found)), dict(known), told)
        self.assertIn("Success", told)

    # Promise: the hints within the package are sound.
    def test_package(self):
        if not SETTINGS.exists():
            self.skipTest("the settings are not at hand")
        told = self.mypy("--config-file", str(SETTINGS), "-p", "neuralmesh")
        self.assertIn("Success", told)

    # Promise: the stub of the engine has what is compiled, with the same parameters.
    def test_engine_stub(self):
        from neuralmesh import _engine

        stub = Path(neuralmesh.__file__).with_name("_engine.pyi").read_text(encoding="utf-8")
        self.assertEqual(stub_signatures(ast.parse(stub)), compiled_signatures(_engine))


if __name__ == "__main__":
    unittest.main()
