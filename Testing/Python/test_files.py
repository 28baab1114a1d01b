# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and meshes by the package that pip installs, with VTK or without."""

import importlib.util
import pathlib
import struct
import sys
import tempfile
import unittest

import neuralmesh
import numpy as np
import support

if neuralmesh.VTK_VERSION:
    print("skipped: this package was built with VTK, and has its readers")
    sys.exit()

from neuralmesh.engine import files

HAS_VTK = importlib.util.find_spec("vtkmodules") is not None
HAS_LASPY = importlib.util.find_spec("laspy") is not None
HAS_PYE57 = importlib.util.find_spec("pye57") is not None
WITH_DIGITS = ("ply", "obj", "off") + (("vtp", "vtk") if HAS_VTK else ())  # all that doubles have
FAR = np.array([5e5, 5.4e6, 100.0])


class FileTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    @classmethod
    def setUpClass(cls):
        found = neuralmesh.reconstruct(neuralmesh.Mesh(support.sphere(), np.empty((0, 3), int)), 200)
        cls.mesh = found

    def written(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path


class Written(FileTest):
    # Promise: what is written reads as it was: triangles, normals, colours, and all digits where a format
    # has room for them.
    def test_again(self):
        colors = np.tile(np.uint8([250, 20, 10]), (200, 1))
        data = {"Normals": self.mesh.point_data["Normals"], "RGB": colors}
        mesh = neuralmesh.Mesh(self.mesh.points + FAR, self.mesh.triangles, data, {}, "RGB")
        for extension in WITH_DIGITS:
            with self.subTest(extension):
                path = self.folder / f"mesh.{extension}"
                mesh.save(path)
                found = neuralmesh.read(path)
                self.assertTrue((found.points == mesh.points).all())
                self.assertTrue((found.triangles == mesh.triangles).all())
                if extension != "off":
                    self.assertTrue((found.point_data["Normals"] == data["Normals"]).all())
                if extension != "obj":
                    self.assertTrue((files.colors_of(found) == colors).all())
        for extension in ("xyz", "npy"):
            mesh.save(self.folder / f"mesh.{extension}")
            found = neuralmesh.read(self.folder / f"mesh.{extension}")
            self.assertTrue((found.points == mesh.points).all())
        self.assertEqual(sorted(path.name[0] for path in self.folder.iterdir())[0], "m")

    # Promise: floats are written as floats, and stay what they are.
    def test_floats(self):
        points = self.mesh.points.astype(np.float32)
        mesh = neuralmesh.Mesh(points, self.mesh.triangles)
        for extension in ("ply", "npy"):
            mesh.save(self.folder / f"mesh.{extension}")
            found = neuralmesh.read(self.folder / f"mesh.{extension}").points
            self.assertEqual(found.dtype, np.float32)
            self.assertTrue((found == points).all())
        content = (self.folder / "mesh.ply").read_bytes()
        self.assertIn(b"property float x", content)
        mesh.save(self.folder / "mesh.glb")
        self.assertEqual((self.folder / "mesh.glb").read_bytes()[:4], b"glTF")

    # Promise: a shift is noted in the file and undone when it is read; without one, a format of floats
    # refuses what these do not hold, in words, and leaves no file.
    def test_shift(self):
        mesh = neuralmesh.Mesh(self.mesh.points + FAR, self.mesh.triangles)
        for extension in (*WITH_DIGITS, "stl", "glb"):
            for shift, taken in (("auto", tuple(FAR)), ((5e5, 0, 1), (5e5, 0.0, 1.0))):
                if extension in ("stl", "glb") and shift != "auto":
                    continue
                path = self.folder / f"mesh.{extension}"
                self.assertEqual(tuple(files.write_mesh(mesh, path, shift)), taken)
                if extension != "glb":
                    found = neuralmesh.read(path).points
                    for of in (np.min, np.max):  # an .stl has the vertices in another order
                        self.assertLess(np.abs(of(found, 0) - of(mesh.points, 0)).max(), 1e-6)
        for extension in ("stl", "glb"):
            path = self.folder / f"none.{extension}"
            with self.assertRaisesRegex(ValueError, "has floats only"):
                mesh.save(path)
            self.assertFalse(path.exists())

    # Promise: what cannot be written is refused with what is wrong, and nothing is left.
    def test_refused(self):
        for name, error, text in (
            ("mesh.doc", ValueError, "unknown extension; writable are .ply"),
            ("none/mesh.ply", OSError, "none"),
        ):
            with self.assertRaisesRegex(error, text):
                self.mesh.save(self.folder / name)
        with self.assertRaisesRegex(ValueError, "no points"):
            files.write_mesh(neuralmesh.Mesh(np.empty((0, 3)), np.empty((0, 3), int)), self.folder / "a.ply")
        broken = neuralmesh.Mesh(self.mesh.points, np.array([[0, 1, 200]]))
        for corner in (200, -1, 2**40):
            broken.triangles[0, 2] = corner
            with self.assertRaisesRegex(ValueError, "point that does not exist"):
                broken.save(self.folder / "a.ply")
        with self.assertRaisesRegex(ValueError, "no place to note a shift"):
            files.write_mesh(self.mesh, self.folder / "a.npy", (1, 2, 3))
        self.assertEqual(list(self.folder.iterdir()), [])


class Read(FileTest):
    # Promise: points come as they stand in text, in binary of both byte orders, and in arrays of NumPy.
    def test_points(self):
        points = support.sphere(50)
        lines = "".join("{} {} {}\n".format(*point) for point in points)
        head = "ply\nformat {} 1.0\nelement vertex 50\n"
        head += "".join(f"property double {axis}\n" for axis in "xyz") + "end_header\n"
        contents = {
            "a.xyz": lines,
            "a.csv": "x,y,z\n" + lines.replace(" ", ","),
            "a.off": f"OFF\n50 0 0\n{lines}",
            "a.pwn": f"50\n{lines}{lines}",
            "a.obj": "".join(f"v {line}\n" for line in lines.splitlines()),
            "text.ply": head.format("ascii") + lines,
            "little.ply": head.format("binary_little_endian").encode() + points.astype("<f8").tobytes(),
            "big.ply": head.format("binary_big_endian").encode() + points.astype(">f8").tobytes(),
        }
        for name, content in contents.items():
            with self.subTest(name):
                self.assertTrue((neuralmesh.read(self.written(name, content)).points == points).all())
        for values in (points, points.astype(">f8"), np.asfortranarray(points)):
            np.save(self.folder / "a.npy", values)
            self.assertTrue((neuralmesh.read(self.folder / "a.npy").points == points).all())

    # Promise: viewpoints of scanners come with the points, and turn the mesh unasked.
    def test_viewpoints(self):
        points = support.sphere(800)
        points = points[points[:, 2] < 0.5]
        lines = "".join("{} {} {}\n".format(*point) for point in points)
        grid = "0 0 {0}\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
        scans = "".join(f"{len(points)}\n1\n{grid.format(z)}{lines}" for z in (0.1, -0.1))
        found = neuralmesh.read(self.written("scans.ptx", scans))
        self.assertTrue((found.field_data["Viewpoints"] == [[0, 0, 0.1], [0, 0, -0.1]]).all())
        self.assertTrue((found.point_data["View"] == np.repeat([0, 1], len(points))).all())
        mesh = neuralmesh.reconstruct(found, 100)
        self.assertEqual(mesh.field_data["OrientedBy"], "viewpoints")
        self.assertIsInstance(mesh, neuralmesh.Mesh)

    # Promise: numbers that a file has of its points are arrays, which weights may be.
    def test_arrays(self):
        points = support.sphere(500)
        names = (*"xyz", "trust")
        head = "ply\nformat binary_little_endian 1.0\nelement vertex 500\n"
        head += "".join(f"property float {name}\n" for name in names) + "end_header\n"
        rows = np.column_stack([points, np.arange(500)]).astype("<f4")
        found = neuralmesh.read(self.written("a.ply", head.encode() + rows.tobytes()))
        self.assertTrue((found.point_data["trust"] == np.arange(500)).all())
        self.assertEqual(len(neuralmesh.reconstruct(found, 50, weights="trust").points), 50)

    # Promise: what cannot be read is refused with its name and what is wrong; what takes a package that is
    # not there tells which to install.
    def test_refused(self):
        self.mesh.save(self.folder / "whole.ply")
        whole = (self.folder / "whole.ply").read_bytes()
        np.save(self.folder / "whole.npy", self.mesh.points)
        array = (self.folder / "whole.npy").read_bytes()
        contents = {
            "cut.ply": whole[:-7],
            "cut.stl": b"a title".ljust(80, b"\0") + struct.pack("<I", 100) + bytes(60),
            "cut.csv": "1,2,3,4\n4,5,6,7\n7,8,9",
            "fewer.pts": "9\n1 2 3\n4 5 6\n",
            "cut.npy": array[:-8],
            "text.npy": "no array",
            "a.doc": "",
            "a.xyz.gz": "",
            "a.las": "LASF",
            "a.e57": "ASTM-E57",
            "a.vtp": "<VTKFile",
        }
        for name, content in contents.items():
            path = self.written(name, content)
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"{name}[:,] "):
                neuralmesh.read(path)
        objects = np.empty(3, object)
        for name, values in (("objects", objects), ("pairs", np.zeros((5, 2))), ("bools", np.ones((2, 3), bool))):
            np.save(self.folder / f"{name}.npy", values)
            with self.assertRaisesRegex(ValueError, f"{name}.npy: "):
                neuralmesh.read(self.folder / f"{name}.npy")
        for content in (b"\x93NUMPY\x01\x00\x10\x00{'descr': [(((", b"PK\x03\x04", b""):
            (self.folder / "damaged.npy").write_bytes(content)
            with self.assertRaisesRegex(ValueError, "damaged.npy: "):
                neuralmesh.read(self.folder / "damaged.npy")
        for extension, package, is_there in (
            ("vtp", "pip install vtk", files.has_vtk_for(".vtp")),
            ("las", r"pip install 'neuralmesh\[lidar\]'", HAS_LASPY),
            ("e57", r"pip install 'neuralmesh\[lidar\]'", HAS_PYE57),
        ):
            if not is_there:
                with self.assertRaisesRegex(ValueError, package):
                    neuralmesh.read(self.folder / f"a.{extension}")
        for path in (self.folder / "none.ply", self.folder):
            with self.assertRaisesRegex(OSError, str(path)):
                neuralmesh.read(path)

    # Promise: the figures of two meshes in files are those of the meshes.
    def test_measured(self):
        path = self.folder / "mesh.off"
        self.mesh.save(path)
        again = neuralmesh.read(path)
        figures = neuralmesh.compare(self.mesh, again, samples=1000)
        self.assertLess(figures["reference_to_result"]["maximum"], 1e-12)
        self.assertEqual(neuralmesh.info(again), neuralmesh.info(self.mesh))


class Lidar(FileTest):
    # Promise: a .las gives its points with all digits, colours of 8 bits and its classes.
    @unittest.skipUnless(HAS_LASPY, "there is no laspy")
    def test_las(self):
        import laspy

        points = np.round(support.sphere(500) + FAR, 3)
        for extension in ("las", "laz"):
            header = laspy.LasHeader(point_format=3, version="1.4")
            header.offsets, header.scales = FAR, np.full(3, 0.001)
            scan = laspy.LasData(header)
            scan.x, scan.y, scan.z = points.T
            scan.red = np.full(500, 250 << 8)
            scan.classification = np.arange(500) % 3
            path = self.folder / f"scan.{extension}"
            scan.write(str(path))
            found = neuralmesh.read(path)
            self.assertLess(np.abs(found.points - points).max(), 1e-6)
            self.assertTrue((found.point_data["RGB"] == [250, 0, 0]).all())
            self.assertTrue((found.point_data["Classification"] == np.arange(500) % 3).all())
            cut = self.written(f"cut.{extension}", path.read_bytes()[:-500])
            with self.assertRaisesRegex(ValueError, "damaged"):
                neuralmesh.read(cut)
        mesh = neuralmesh.reconstruct(found, 50)
        self.assertLessEqual(set(mesh.point_data["Classification"]), {0, 1, 2})

    # Promise: the scans of an .e57 are one cloud, whose poses tell which side was seen.
    @unittest.skipUnless(HAS_PYE57, "there is no pye57")
    def test_e57(self):
        import pye57

        points = support.sphere(600)
        points = points[points[:, 2] < 0.5]
        path = self.folder / "scans.e57"
        file = pye57.E57(str(path), mode="w")
        halves = points[::2], points[1::2]
        for half, place in zip(halves, ((0.0, 0.0, 0.1), (0.1, 0.0, 0.0))):
            data = {f"cartesian{axis}": half[:, i] - place[i] for i, axis in enumerate("XYZ")}
            file.write_scan_raw(
                data, translation=np.array(place), rotation=np.array([1.0, 0.0, 0.0, 0.0])
            )
        file.close()
        found = neuralmesh.read(path)
        self.assertLess(np.abs(found.points - np.concatenate(halves)).max(), 1e-6)
        self.assertTrue((found.field_data["Viewpoints"] == [[0, 0, 0.1], [0.1, 0, 0]]).all())
        views = np.repeat([0, 1], [len(half) for half in halves])
        self.assertTrue((found.point_data["View"] == views).all())
        mesh = neuralmesh.reconstruct(found, 100)
        self.assertEqual(mesh.field_data["OrientedBy"], "viewpoints")


if __name__ == "__main__":
    unittest.main()
