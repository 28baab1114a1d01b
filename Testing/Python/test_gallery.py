# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: its pictures and its page, without a browser."""

import html.parser
import unittest
import urllib.parse

import numpy as np
import support
from batch_testing import HAS_VTK, BatchTest, write_scan
from neuralmesh.batch.meshes import DEFAULT_FORMAT


class Page(html.parser.HTMLParser):
    """All addresses of a page, and its text."""

    def __init__(self, path):
        super().__init__()
        self.addresses = []
        self.text = ""
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        self.addresses += [value for name, value in attributes if name in ("href", "src")]

    def handle_data(self, data):
        self.text += data


class Gallery(BatchTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.write_example(gallery=True)
        # What means something in pages and addresses.
        write_scan(cls.folder / "scans" / "a <b> & 50% + \"ü\".xyz")
        cls.output, cls.errors, cls.status = cls.run_batch(DISPLAY="")
        cls.parts = cls.results / "gallery"

    # Promise: there is a picture of each mesh, drawn without a display, and the mesh is to be seen;
    # of what failed there is none.
    @unittest.skipUnless(HAS_VTK, "there is no VTK to draw them")
    def test_pictures(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOImage import vtkPNGReader

        self.assertEqual(self.status, 1)
        self.assertNotIn("pictures", self.errors)
        pictures = {path.stem: path for path in self.parts.glob("*.png")}
        self.assertEqual(set(pictures), set(self.times()))
        for path in pictures.values():
            reader = vtkPNGReader()
            reader.SetFileName(str(path))
            reader.Update()
            image = reader.GetOutput()
            self.assertEqual(image.GetDimensions(), (640, 480, 1))
            pixels = vtk_to_numpy(image.GetPointData().GetScalars())
            drawn = (pixels != pixels[0]).any(axis=1)
            self.assertGreater(drawn.mean(), 0.2)
            self.assertLess(drawn.mean(), 0.8)
            self.assertGreater(len(np.unique(pixels[drawn], axis=0)), 50)

    # Promise: the page names what failed and why, whatever is in the names of files, and leads to
    # nothing that is not there, nor to the network.
    def test_page(self):
        page = Page(self.results / "index.html")
        self.assertIn("16 jobs: 12 done, 4 failed", page.text)
        self.assertIn("ends before its last vertex", page.text)
        self.assertIn("a <b> & 50% + \"ü\".xyz", page.text)
        self.assertIn("vertices 800, seed 2, variant noise", page.text)
        for address in page.addresses:
            parts = urllib.parse.urlparse(address)
            self.assertEqual((parts.scheme, parts.netloc), ("", ""))
            path = self.results / urllib.parse.unquote(parts.path)
            self.assertTrue(path.exists(), address)
        files = {urllib.parse.unquote(address) for address in page.addresses}
        self.assertLessEqual({f"{name}.{DEFAULT_FORMAT}" for name in self.times()}, files)
        self.assertLessEqual({f"{path.stem}.json" for path in self.results.glob("*.json")}, files)

    # Promise: only pictures of new meshes are drawn, or all if they are to show another view.
    @unittest.skipUnless(HAS_VTK, "there is no VTK to draw them")
    def test_again(self):
        before = self.picture_times()
        (self.results / f"egg_vertices-200_seed-1.{DEFAULT_FORMAT}").unlink()
        self.run_batch(DISPLAY="")
        now = self.picture_times()
        changed = {name for name in now if now[name] != before[name]}
        self.assertEqual(changed, {"egg_vertices-200_seed-1"})
        self.write_example(gallery=True, view={"up": "x"})
        self.run_batch(DISPLAY="")
        self.assertFalse(set(now.values()) & set(self.picture_times().values()))

    def picture_times(self):
        return {path.stem: path.stat().st_mtime_ns for path in self.parts.glob("*.png")}


class Views(BatchTest):
    """Scans that are tall, open or too small for their meshes."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        write_scan(cls.folder / "tall.xyz", size=8)
        ball = support.sphere(4000)
        np.savetxt(cls.folder / "bowl.xyz", ball[ball[:, 2] < 0])
        write_scan(cls.folder / "few.xyz", 300)
        x, y = np.meshgrid(np.linspace(0, 8, 60), np.linspace(0, 8, 60))
        np.savetxt(cls.folder / "waves.xyz", np.stack([x, y, np.sin(x) * np.cos(y)], -1).reshape(-1, 3))
        cls.write_recipe(
            scans=["*.xyz"], matrix={"vertices": 200}, gallery=True, view={"up": "z", "elevation": 30}
        )
        cls.output, cls.errors, cls.status = cls.run_batch(DISPLAY="")

    def pixels(self, name):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOImage import vtkPNGReader

        reader = vtkPNGReader()
        reader.SetFileName(str(self.results / "gallery" / f"{name}.png"))
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        return pixels.reshape(480, 640, -1).astype(int)

    # Promise: a mesh fills its picture, and no part of it is cut off, whatever its shape.
    @unittest.skipUnless(HAS_VTK, "there is no VTK to draw them")
    def test_whole(self):
        for name in ("tall", "bowl", "few"):
            with self.subTest(name):
                rows, columns = np.nonzero((self.pixels(name) < 250).any(axis=2))
                self.assertGreater(min(rows.min(), columns.min()), 0)
                self.assertLess(rows.max(), 479)
                self.assertLess(columns.max(), 639)
                shares = (np.ptp(rows) / 480, np.ptp(columns) / 640)
                self.assertGreater(max(shares), 0.85)

    # Promise: the inner side of a mesh has a colour of its own.
    @unittest.skipUnless(HAS_VTK, "there is no VTK to draw them")
    def test_inner_side(self):
        for name, is_open in (("bowl", True), ("few", False)):
            red, _, blue = np.moveaxis(self.pixels(name)[:, :, :3], 2, 0)
            self.assertEqual(bool((red > blue + 60).mean() > 0.05), is_open, name)

    # Promise: the page counts the jobs with warnings, and has each warning behind its heading.
    def test_warnings(self):
        page = Page(self.results / "index.html")
        self.assertIn("4 jobs: 4 done, 0 failed, 1 with warnings", page.text)
        self.assertIn("Finer than data: ", page.text)
        self.assertNotIn("[finer-than-data]", page.text)

    # Promise: the page tells what determines the outer side, and where nothing does.
    def test_sides(self):
        cards = Page(self.results / "index.html").text.split("sides")[1:]
        sides = [card.split("time")[0].strip() for card in cards]
        self.assertEqual(sides.count("by volume"), 3)
        self.assertEqual(len([side for side in sides if side.startswith("unknown, most looks up")]), 1)


class NoScreen(BatchTest):
    # Promise: where nothing can be drawn there is a gallery nevertheless, which says so, as does the
    # command; that is no failure.
    def test_no_screen(self):
        write_scan(self.folder / "ball.xyz")
        self.write_recipe(scans=["ball.xyz"], matrix={"vertices": 100}, gallery=True)
        (self.folder / "empty").mkdir()
        _, errors, status = self.run_batch(DISPLAY="", PATH=str(self.folder / "empty"))
        self.assertEqual(status, 0)
        text = Page(self.results / "index.html").text
        for said in (errors, text):
            self.assertIn(
                "no pictures: there is neither a screen nor xvfb-run"
                if HAS_VTK
                else "no pictures: there is no VTK to draw them (pip install vtk)",
                said,
            )
        self.assertIn("no picture", text)


if __name__ == "__main__":
    unittest.main()
