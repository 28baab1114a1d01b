# SPDX-License-Identifier: BSD-3-Clause
"""The batch command: formats, texts, point data, first meshes and limits."""

import csv
import os
import pathlib
import unittest

import neuralmesh
import numpy as np
import support
from batch_testing import HAS_VTK, BatchTest, write_scan
from neuralmesh.batch.meshes import DEFAULT_FORMAT, arrays_of, read_points, write_mesh

FORMATS = ("ply", "obj", "stl", "off") + (("vtp", "vtk") if HAS_VTK else ())


class Files(BatchTest):
    """The formats of scans and of meshes."""

    def setUp(self):
        self.clear()

    # Promise: each format of meshes can be had, in the folder that is named.
    def test_formats(self):
        write_scan(self.folder / "ball.xyz")
        for mesh_format in FORMATS:
            with self.subTest(mesh_format):
                self.write_recipe(
                    scans=["ball.xyz"], matrix={"vertices": 100}, format=mesh_format
                )
                _, errors, status = self.run_batch("--output", f"in/{mesh_format}")
                self.assertEqual((errors, status), ("", 0))
                mesh = read_points(self.folder / "in" / mesh_format / f"ball.{mesh_format}")
                self.assertEqual(len(support.coordinates(mesh)), 100)
                self.assertTrue(support.is_closed_manifold(mesh))
        self.assertFalse(self.results.exists())

    # Promise: files of scanners are scans, whose viewpoints turn the mesh unasked; and a .glb can be had.
    def test_scanners(self):
        points = support.sphere(500)
        points = points[points[:, 2] < 0.5]
        lines = "".join("{} {} {}\n".format(*point) for point in points)
        count = len(points)
        header = f"FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH {count}\nHEIGHT 1\n"
        grid = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
        files = {
            "a.pcd": f"{header}VIEWPOINT 0 0 0.1 1 0 0 0\nDATA ascii\n{lines}",
            "b.ptx": f"{count}\n1\n{grid}{lines}",
            "c.pwn": f"{count}\n{lines}{lines}",
            "d.off": f"OFF\n{count} 0 0\n{lines}",
        }
        for name, text in files.items():
            (self.folder / name).write_text(text, encoding="utf-8")
            self.assertTrue((support.coordinates(read_points(self.folder / name)) == points).all())
        self.write_recipe(scans=[*files], matrix={"vertices": 100}, format="glb")
        _, errors, status = self.run_batch()
        self.assertEqual((errors, status), ("", 0))
        for name in ("a", "b", "c", "d"):
            self.assertEqual((self.results / f"{name}.glb").read_bytes()[:4], b"glTF")
        for name in ("a.pcd", "b.ptx"):
            mesh = neuralmesh.reconstruct(read_points(self.folder / name), 100)
            self.assertEqual(support.field(mesh, "OrientedBy"), "viewpoints")
        (self.folder / "e.laz").write_bytes(b"LASF")
        with self.assertRaisesRegex(ValueError, "pip install 'neuralmesh.lidar.'"):
            read_points(self.folder / "e.laz")

    # Promise: coordinates far from the origin keep their digits, from a .ply and into one; an .stl of
    # them is refused in words, or shifted, which is told and undone.
    def test_digits(self):
        points = support.sphere(2000) + [500000, 5400000, 100]
        header = "ply\nformat binary_little_endian 1.0\nelement vertex 2000\n"
        header += "".join(f"property double {axis}\n" for axis in "xyz") + "end_header\n"
        (self.folder / "utm.ply").write_bytes(header.encode() + points.astype("<f8").tobytes())
        self.assertTrue((support.coordinates(read_points(self.folder / "utm.ply")) == points).all())
        wanted = support.coordinates(neuralmesh.reconstruct(points, 100))
        for mesh_format, shift in (("ply", None), ("stl", None), ("stl", "auto"), ("ply", [5e5, 0, 1])):
            with self.subTest(mesh_format, shift=shift):
                self.clear()
                (self.folder / "utm.ply").write_bytes(header.encode() + points.astype("<f8").tobytes())
                self.write_recipe(scans=["utm.ply"], matrix={"vertices": 100}, format=mesh_format,
                                  shift=shift)  # fmt: skip
                _, _, status = self.run_batch()
                report = self.report("utm")
                if mesh_format == "stl" and shift is None:
                    self.assertEqual(status, 1)
                    self.assertIn(".stl has floats only", report["error"])
                    self.assertFalse((self.results / "utm.stl").exists())
                    continue
                self.assertEqual((status, report["shift"]), (0, shift))
                if shift is not None:
                    told = [5e5, 54e5, 100] if shift == "auto" else shift
                    self.assertEqual(report["result"]["shift"], told)
                found = support.coordinates(read_points(self.results / f"utm.{mesh_format}"))
                # An .stl has the vertices in another order.
                for of in (np.min, np.max, np.mean):
                    self.assertLess(np.abs(of(found, 0) - of(wanted, 0)).max(), 1e-6)

    # Promise: text is read with blanks, commas or semicolons between numbers, with names of columns, a
    # count or comments before them, and more numbers behind them.
    def test_text(self):
        points = support.sphere(5)
        lines = {
            "blanks.xyz": ("", "{} {} {}\n"),
            "count.pts": ("5\n", "{}\t{} {} 7 8 9\n"),
            "names.csv": ("# a comment\nx,y,z\n", "{}, {},{}\n"),
            "semicolons.txt": ("// x; y; z\n\n", "{};{};{};1\n"),
        }
        for name, (head, line) in lines.items():
            with self.subTest(name):
                path = self.folder / name
                path.write_text(head + "".join(line.format(*point) for point in points), "utf-8")
                read = support.coordinates(read_points(path))
                self.assertTrue((read == points).all())

    # Promise: what is no scan fails with words that say why.
    def test_no_scans(self):
        (self.folder / "folder.ply").mkdir()
        os.mkfifo(self.folder / "pipe.ply")
        files = {"empty.xyz": "", "words.txt": "these are no points\n", "a.doc": "",
                 "rows.csv": "1,2,3\n4,5\n", "one.xyz": "1 2 3\n", "half.vtp": "<VTKFile",
                 "cut.csv": "1,2,3,4\n4,5,6,7\n7,8,9", "fewer.pts": "9\n1 2 3\n4 5 6\n",
                 "open.stl": "solid\nfacet normal 0 0 1\n"}  # fmt: skip
        for name, text in files.items():
            (self.folder / name).write_text(text, encoding="utf-8")
        stl = b"a title".ljust(80, b"\0") + (100).to_bytes(4, "little") + bytes(60)
        (self.folder / "half.stl").write_bytes(stl)
        names = [*files, "folder.ply", "pipe.ply", "none.ply", "half.stl"]
        self.write_recipe(scans=names, matrix={"vertices": 50})
        output, errors, status = self.run_batch()
        self.assertEqual(status, 1)
        self.assert_told(errors, self.failed())
        self.assertIn(f"jobs       0 done, {len(names)} failed", output)
        wanted = {
            "empty": "there are no points",
            "words": "there are no points",
            "a": "unknown extension",
            "rows": "rows.csv",
            "one": "one.xyz",
            "half.vtp": "half.vtp",
            "folder": "no regular file",
            "pipe": "no regular file",
            "none": "no such file",
            "half.stl": "damaged",
            "cut": "ends in the middle of it",
            "fewer": "before its last point",
            "open": "before its endsolid",
        }
        for job in (path.stem for path in self.results.glob("[!.]*.json")):
            report = self.report(job)
            scan = pathlib.Path(report["scan"]["path"])
            self.assertIn(wanted.get(scan.name) or wanted[scan.stem], report["error"])

    # Promise: colours of a scan are those of the mesh, in .ply, too, and weights are arrays of it.
    @unittest.skipUnless(HAS_VTK, "there is no VTK")
    def test_point_data(self):
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonDataModel import vtkPolyData

        cloud = vtkPolyData()
        cloud.ShallowCopy(support.point_set(support.sphere()))
        colors = numpy_to_vtk(np.tile(np.uint8([250, 20, 10]), (2000, 1)), deep=True)
        colors.SetName("RGB")
        cloud.GetPointData().SetScalars(colors)
        trust = numpy_to_vtk(np.ones(2000), deep=True)
        trust.SetName("Trust")
        cloud.GetPointData().AddArray(trust)
        write_mesh(cloud, self.folder / "red.vtp")
        matrix = {"vertices": 100, "weights": ["Trust", "Mistrust"]}
        self.write_recipe(scans=["red.vtp"], matrix=matrix, format="ply")
        self.assertEqual(self.run_batch()[2], 1)
        mesh = read_points(self.results / "red_weights-Trust.ply")
        _, _, colors = arrays_of(mesh)
        self.assertEqual(tuple(colors[7]), (250, 20, 10))
        self.assertIn("Mistrust", self.report("red_weights-Mistrust")["error"])

    # Promise: a first mesh is read by its path from the recipe, and the result is that of reconstruct().
    # One that cannot be read fails its jobs alone, and names itself.
    def test_first_mesh(self):
        write_scan(self.folder / "ball.xyz")
        points = support.sphere(2000)
        coarse = neuralmesh.reconstruct(points, 100, seed=7)
        (self.folder / "meshes").mkdir()
        exact = f"coarse.{'vtp' if HAS_VTK else 'off'}"  # with all digits
        for name in (exact, "coarse.obj"):
            write_mesh(coarse, self.folder / "meshes" / name)
        (self.folder / "meshes" / "points.ply").write_text("ply\n", encoding="ascii")
        names = (exact, "coarse.obj", "points.ply", "none.ply")
        matrix = {"vertices": 300, "first_mesh": [None, *(f"meshes/{name}" for name in names)]}
        self.write_recipe(scans=["ball.xyz"], matrix=matrix)
        output, errors, status = self.run_batch()
        self.assertEqual(status, 1)
        self.assert_told(errors, self.failed())
        self.assertIn("jobs       3 done, 2 failed", output)
        wanted = neuralmesh.reconstruct(
            np.loadtxt(self.folder / "ball.xyz"), 300, first_mesh=coarse
        )
        mesh = read_points(self.results / f"ball_first_mesh-meshes_{exact}.{DEFAULT_FORMAT}")
        if HAS_VTK:
            self.assertEqual(support.arrays_of(mesh), support.arrays_of(wanted))
        self.assertTrue((support.triangles(mesh) == support.triangles(wanted)).all())
        # As an .obj it has coordinates of fewer digits, and normals.
        mesh = read_points(self.results / f"ball_first_mesh-meshes_coarse.obj.{DEFAULT_FORMAT}")
        self.assertTrue(support.is_closed_manifold(mesh))
        for name, message in (("points.ply", "first mesh"), ("none.ply", "no such file")):
            error = self.report(f"ball_first_mesh-meshes_{name}")["error"]
            self.assertIn(str(self.folder / "meshes" / name), error)
            self.assertIn(message, error)

    # Promise: a job that takes longer than the recipe allows is ended and has failed, in clear words;
    # the others go on.
    def test_time_limit(self):
        write_scan(self.folder / "ball.xyz", 20000)
        matrix = {"vertices": [3000000, 100, 200]}
        self.write_recipe(scans=["ball.xyz"], matrix=matrix, time_limit=10.5)
        output, errors, status = self.run_batch("--processes", 2)
        self.assertEqual(status, 1)
        self.assert_told(errors, ["ball_vertices-3000000"])
        self.assertIn("jobs       2 done, 1 failed", output)
        self.assertEqual(set(self.times()), {"ball_vertices-100", "ball_vertices-200"})
        report = self.report("ball_vertices-3000000")
        self.assertEqual(report["status"], "failed")
        error = f"{self.folder}/ball.xyz: ended after 10.5 s, the time_limit of the recipe"
        self.assertEqual(report["error"], error)


if __name__ == "__main__":
    unittest.main()
