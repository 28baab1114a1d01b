# SPDX-License-Identifier: BSD-3-Clause
"""NeuralMesh beside PyVista: what goes in as PyVista comes out so, by functions and by the accessor.

For any Python that has both, whatever VTK they take: python test_pyvista.py. Where there is no PyVista it is
skipped.
"""

import gc
import importlib.util
import inspect
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
import warnings
from importlib.metadata import entry_points

import numpy as np

import neuralmesh

try:
    import pyvista
except ImportError as error:
    print(f"skipped: there is no PyVista for {sys.executable}: {error}")
    sys.exit()

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIGURES = {"reference_to_result", "result_to_reference", "both_ways"}


def sphere(count=3000):
    """Points on the unit sphere, 4-byte floats of shape (count, 3)."""
    points = np.random.default_rng(1).normal(size=(count, 3))
    return (points / np.linalg.norm(points, axis=1, keepdims=True)).astype(np.float32)


def coloured(points):
    """A cloud with colours, which are the active scalars, a float array and labels."""
    cloud = pyvista.PolyData(points)
    cloud["RGB"] = (127 * (1 + points)).astype(np.uint8)
    cloud["Height"] = points[:, 2].astype(np.float64)
    cloud["Half"] = (points[:, 0] > 0).astype(np.int32)
    cloud.set_active_scalars("RGB")
    return cloud


def grid(points):
    cells = np.arange(len(points))
    return pyvista.UnstructuredGrid(
        np.column_stack((np.ones(len(points), dtype=int), cells)).ravel(),
        np.full(len(points), pyvista.CellType.VERTEX),
        points,
    )


def clouds():
    """The same points as every kind of dataset that has points."""
    points = sphere()
    return {
        "PolyData": pyvista.PolyData(points),
        "PointSet": pyvista.PointSet(points),
        "UnstructuredGrid": grid(points),
        "StructuredGrid": pyvista.StructuredGrid(
            *(points.reshape(50, 60, 1, 3)[..., i] for i in range(3))
        ),
        "MultiBlock": pyvista.MultiBlock([pyvista.PolyData(points[:1000]), grid(points[1000:])]),
    }


def faces(mesh):
    return mesh.faces.reshape(-1, 4)[:, 1:]


def run_script(script):
    """Run it in this interpreter; its output."""
    process = subprocess.run(
        [sys.executable, "-W", "error::RuntimeWarning", "-c", textwrap.dedent(script)],
        capture_output=True, text=True,
    )  # fmt: skip
    if process.returncode != 0:
        raise AssertionError(process.stderr)
    return process.stdout


class Registration(unittest.TestCase):
    # Promise: the accessor is there in whatever order the packages are imported, once.
    def test_orders(self):
        for imports in (
            "import pyvista, neuralmesh",
            "import neuralmesh, pyvista",
            "import neuralmesh; from pyvista import examples; import pyvista",
            "import pyvista, neuralmesh.pyvista_accessor as a; a.register()",
        ):
            with self.subTest(imports):
                output = run_script(f"""
                    {imports}
                    print(pyvista.Sphere().neuralmesh.info()["closed"])
                    """)
                self.assertEqual(output, "True\n")

    # Promise: neuralmesh alone imports no PyVista, also where somebody asks whether it is there.
    def test_not_imported(self):
        output = run_script("""
            import sys, neuralmesh, importlib.util
            importlib.util.find_spec("pyvista")
            print("pyvista" in sys.modules)
            import pyvista
            print(hasattr(pyvista.PolyData, "neuralmesh"))
            """)
        self.assertEqual(output, "False\nTrue\n")

    # Promise: what pip has installed is found by PyVista alone, from 0.48 on.
    def test_entry_point(self):
        names = [entry.name for entry in entry_points(group="pyvista.accessors")]
        if "neuralmesh" not in names:
            self.skipTest("neuralmesh was not installed by pip here, so it has no entry points")
        if not hasattr(pyvista, "register_dataset_accessor"):
            self.skipTest(f"PyVista {pyvista.__version__} has no entry points yet")
        output = run_script("""
            import sys, pyvista
            print("neuralmesh" in sys.modules)
            print(pyvista.Sphere().neuralmesh.info()["closed"])
            """)
        self.assertEqual(output, "False\nTrue\n")

    # Promise: the methods have signature and documentation of the functions, less what they know.
    def test_signatures(self):
        surface = pyvista.PolyData.neuralmesh
        for name, own in (
            ("reconstruct", "points"),
            ("explain", "points"),
            ("compare", "result"),
            ("info", "mesh"),
            ("remesh", "surface"),
        ):
            with self.subTest(name):
                function, method = getattr(neuralmesh, name), getattr(surface, name)
                wanted = list(inspect.signature(function).parameters.values())
                found = list(inspect.signature(method).parameters.values())[1:]
                self.assertEqual(found, [one for one in wanted if one.name != own])
                told = inspect.getdoc(method)
                self.assertNotRegex(told, rf"(?m)^    {own}: ")
                self.assertIn("Returns:", told)
                self.assertEqual("Args:" in told, bool(found))
                for parameter in found:
                    self.assertIn(f"{parameter.name}: ", told)

    # Promise: words of other libraries are answered by the parameter that is meant.
    def test_hints(self):
        cloud = pyvista.PolyData(sphere(100))
        for word, meant in {
            "n_vertices": "vertices",
            "n_points": "vertices",
            "target_vertices": "vertices",
            "targetfacenum": "vertices? They are about half",
            "n_cells": "vertices? They are about half",
            "random_state": "seed",
            "progress_bar": "progress",
            "n_threads": "number_of_threads",
            "camera_location": "viewpoints",
            "hole_size": "close_holes_below",
            "verticess": "vertices",
        }.items():
            for function in (
                cloud.neuralmesh.reconstruct,
                lambda **parameters: neuralmesh.reconstruct(cloud, **parameters),
            ):
                with self.subTest(word), self.assertRaises(TypeError) as caught:
                    function(**{word: 100})
                self.assertIn(f"did you mean {meant}", str(caught.exception))

    # Promise: volumes have no accessor, and clouds none of surfaces but advice.
    def test_others(self):
        self.assertFalse(hasattr(pyvista.PointSet(sphere(10)).neuralmesh, "info"))
        with self.assertRaisesRegex(
            AttributeError, r"extract_surface\(\)\.neuralmesh\.compare\(\)"
        ):
            grid(sphere(10)).neuralmesh.compare
        with self.assertRaises(AttributeError):
            pyvista.Sphere().neuralmesh.reconstrct


class Kinds(unittest.TestCase):
    # Promise: every kind of dataset with points gives the same mesh, a pyvista.PolyData; so does an array,
    # as a dataset of VTK that PyVista takes.
    def test_reconstruct(self):
        wanted = pyvista.wrap(neuralmesh.reconstruct(sphere(), 300))
        self.assertEqual((wanted.n_points, wanted.n_cells), (300, 596))
        self.assertEqual(wanted.points.dtype, np.float32)
        for kind, cloud in clouds().items():
            for mesh in (neuralmesh.reconstruct(cloud, 300), cloud.neuralmesh.reconstruct(300)):
                with self.subTest(kind):
                    self.assertIs(type(mesh), pyvista.PolyData)
                    self.assertEqual(set(mesh.point_data), set(wanted.point_data))
                    self.assertTrue(mesh.is_manifold)
                    if kind != "StructuredGrid":  # whose points are in another order
                        np.testing.assert_array_equal(mesh.points, wanted.points)
                        np.testing.assert_array_equal(mesh.faces, wanted.faces)

    # Promise: points with reasons come along as PolyData, too, in the order of the cloud.
    def test_explain(self):
        for kind, cloud in clouds().items():
            with self.subTest(kind):
                mesh, explained = cloud.neuralmesh.reconstruct(300, explain=True)
                again = cloud.neuralmesh.explain(mesh)
                for points in (explained, again, neuralmesh.explain(cloud, mesh)):
                    self.assertIs(type(points), pyvista.PolyData)
                    self.assertEqual(points.n_points, 3000)
                    self.assertEqual(points.active_scalars_name, "Reason")
                    self.assertEqual(set(points["Reason"]), {0})
                    self.assertLess(points["Distance"].max(), 0.1)
                if kind == "PolyData":
                    np.testing.assert_array_equal(explained.points, cloud.points)

    # Promise: a stream gives PolyData once it was given such points; the parts may be of any kind.
    def test_stream(self):
        kinds = [pyvista.PolyData, pyvista.PointSet, grid]
        stream = neuralmesh.stream(vertices=200)
        for kind, part in zip(kinds, np.array_split(sphere(), 3)):
            stream.add_points(kind(part))
            stream.learn(20000)
            self.assertIs(type(stream.mesh(finish=False)), pyvista.PolyData)
        mesh = stream.mesh()
        self.assertIs(type(mesh), pyvista.PolyData)
        self.assertEqual(stream.points, 3000)
        self.assertEqual(mesh.n_points, 200)
        plain = neuralmesh.stream(vertices=200)
        self.assertEqual(pyvista.wrap(plain.mesh()).n_points if plain.points else 0, 0)

    # Promise: meshes of PyVista are compared and told of, triangulated or not.
    def test_measures(self):
        reference, result = pyvista.Sphere(radius=1), pyvista.Sphere(radius=1.1)
        figures = result.neuralmesh.compare(reference, 5000)
        # By their texts: what is no number is equal to nothing.
        self.assertEqual(str(figures), str(neuralmesh.compare(reference, result, samples=5000)))
        self.assertEqual(set(figures), FIGURES)
        self.assertAlmostEqual(figures["reference_to_result"]["mean"], 0.1, places=2)
        told = pyvista.Cube().clean().neuralmesh.info()
        self.assertEqual((told["vertices"], told["triangles"], told["genus"]), (8, 12, 0))
        self.assertEqual(sum(told["valences"].values()), 8)
        self.assertIs(told["closed"], True)
        self.assertAlmostEqual(told["volume"], 1.0)
        plane = pyvista.Plane(i_resolution=3, j_resolution=2).neuralmesh.info()
        self.assertEqual(
            (plane["boundary_loops"], plane["volume"], plane["closed"]), (1, None, False)
        )

    # Promise: figures of an empty mesh are 0, and a cell without its points is an error.
    def test_bad_meshes(self):
        told = pyvista.PolyData().neuralmesh.info()
        self.assertEqual((told["vertices"], told["surface_area"], told["valences"]), (0, 0.0, {}))
        broken = pyvista.PolyData()
        broken.points = np.eye(3)
        broken.faces = [3, 0, 1, 9]
        with self.assertRaisesRegex(ValueError, "point 9"):
            broken.neuralmesh.info()

    # Promise: a first mesh may be PyVista's, and what is none is named.
    def test_first_mesh(self):
        cloud = pyvista.PolyData(sphere())
        first = cloud.neuralmesh.reconstruct(100)
        self.assertEqual(cloud.neuralmesh.reconstruct(200, first_mesh=first).n_points, 200)
        for call, parameter in (
            (lambda: cloud.neuralmesh.reconstruct(200, first_mesh=grid(sphere(10))), "first_mesh"),
            (lambda: first.neuralmesh.compare(grid(sphere(10))), "reference"),
            (lambda: cloud.neuralmesh.explain(None), "mesh"),
            (lambda: neuralmesh.info(cloud.cast_to_unstructured_grid()), "mesh"),
            (lambda: pyvista.PolyData().neuralmesh.reconstruct(10), "points"),
            (lambda: pyvista.MultiBlock().neuralmesh.reconstruct(10), "points"),
        ):
            with self.subTest(parameter), self.assertRaisesRegex(ValueError, f"^{parameter}"):
                call()


class Data(unittest.TestCase):
    # Promise: point data arrive by their names and types, and what was active is: colours stay colours, and
    # labels are labels of the cloud.
    def test_point_data(self):
        cloud = coloured(sphere())
        mesh = cloud.neuralmesh.reconstruct(300)
        self.assertEqual(mesh.active_scalars_name, "RGB")
        self.assertEqual((mesh["RGB"].dtype, mesh["RGB"].shape), (np.uint8, (300, 3)))
        wanted = 127 * (1 + mesh.points / np.linalg.norm(mesh.points, axis=1, keepdims=True))
        self.assertLess(np.abs(mesh["RGB"] - wanted).max(), 12)
        self.assertLess(np.abs(mesh["Height"] - mesh.points[:, 2]).max(), 0.1)
        self.assertEqual(set(np.unique(mesh["Half"])), {0, 1})
        self.assertTrue(np.issubdtype(mesh["Half"].dtype, np.integer))
        self.assertIsNone(
            pyvista.PolyData(sphere()).neuralmesh.reconstruct(300).active_scalars_name
        )

    # Promise: normals are those of PyVista, and look outwards; the report is field data.
    def test_normals_and_report(self):
        mesh = pyvista.PolyData(sphere()).neuralmesh.reconstruct(300)
        self.assertEqual(mesh.active_normals.shape, (300, 3))
        self.assertGreater(np.einsum("ij,ij->i", mesh.active_normals, mesh.points).min(), 0.8)
        self.assertEqual(mesh.field_data["NumberOfVertices"][0], 300)
        self.assertEqual(mesh.field_data["StopReason"][0], "vertices")

    # Promise: blocks of a MultiBlock bring what all of them have.
    def test_blocks(self):
        points = sphere()
        blocks = pyvista.MultiBlock([coloured(points[:1000]), coloured(points[1000:])])
        blocks[1].clear_data()
        blocks[1]["Height"] = points[1000:, 2].astype(np.float64)
        mesh = blocks.neuralmesh.reconstruct(300)
        self.assertIn("Height", mesh.point_data)
        self.assertNotIn("RGB", mesh.point_data)

    # Promise: weights, views and normals are taken with datasets of PyVista; arrays arrive by name.
    def test_what_is_known_of_points(self):
        cloud = coloured(sphere())
        cloud["Trust"] = np.linspace(0.1, 1, cloud.n_points)
        self.assertIn("Trust", cloud.neuralmesh.reconstruct(100, weights="Trust").point_data)
        weights = np.ones(cloud.n_points)
        self.assertIn("Weights", cloud.neuralmesh.reconstruct(100, weights=weights).point_data)
        self.assertNotIn("Weights", cloud.point_data)
        mesh = cloud.neuralmesh.reconstruct(100, normals=-sphere())
        self.assertEqual(mesh.n_points, 100)

    # Promise: the input stays as it was, and a mesh keeps its memory.
    def test_memory(self):
        cloud = coloured(sphere())
        before = cloud.copy()
        mesh, explained = cloud.neuralmesh.reconstruct(300, explain=True)
        self.assertEqual(cloud, before)
        copies = [
            mesh.points.copy(),
            faces(mesh).copy(),
            mesh["Height"].copy(),
            explained["Distance"].copy(),
        ]
        del cloud, before
        gc.collect()
        for array, copy in zip(
            (mesh.points, faces(mesh), mesh["Height"], explained["Distance"]), copies
        ):
            np.testing.assert_array_equal(array, copy)
        mesh.points += 1
        self.assertAlmostEqual(mesh.center[0], 1, places=1)
        self.assertEqual(mesh.compute_normals().n_cells, 596)

    # Promise: what must be known of a mesh is a warning of the line that asked for it, through whatever.
    def test_warnings(self):
        cloud = pyvista.PolyData(sphere(200))
        for call in (
            lambda: neuralmesh.reconstruct(cloud, 400),
            lambda: cloud.neuralmesh.reconstruct(400),
        ):
            # Not assertWarns(), for which PyVista would import its plotting, which cvista need not have.
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call()
            ours = [one for one in caught if one.category is RuntimeWarning]
            self.assertTrue(ours)
            self.assertEqual({one.filename for one in ours}, {__file__})


class Page(unittest.TestCase):
    # Promise: all that the page for Python shows works as it is printed, plots and all.
    def test_page(self):
        if importlib.util.find_spec("vtkmodules") is None:
            self.skipTest("what runs the blocks of a page needs vtkmodules")
        try:
            import pyvista.plotting  # noqa: F401
        except ImportError as error:
            self.skipTest(f"PyVista cannot plot here: {error}")
        with tempfile.TemporaryDirectory() as build:
            runner = [sys.executable, ROOT / "Testing" / "Documentation" / "run_blocks.py"]
            process = subprocess.run(
                [*self.screen(), *runner, ROOT, build, "Documentation/Guide/Python.md"],
                capture_output=True, text=True,
            )  # fmt: skip
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        self.assertIn("all well", process.stdout)
        self.assertNotIn("left out", process.stdout)

    def screen(self):
        """What a command begins with that draws: from version 9.4 on pip's VTK needs no screen."""
        if os.environ.get("DISPLAY") or pyvista.vtk_version_info >= (9, 4):
            return []
        if shutil.which("xvfb-run") is None:
            self.skipTest("there is no screen, and no xvfb-run")
        return ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]


if __name__ == "__main__":
    unittest.main()
