# SPDX-License-Identifier: BSD-3-Clause
"""The 3D view of the gallery in a browser, opened from the disk."""

import shutil
import time
import unittest

import numpy as np
import support
from batch_testing import BatchTest, write_scan
from neuralmesh.batch.meshes import write_mesh
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader

# Without a graphics card, and as root; nothing but files can be reached.
ARGUMENTS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--window-size=900,700",
    "--proxy-server=127.0.0.1:9",
)


def start_browser(folder):
    options = webdriver.ChromeOptions()
    for argument in (*ARGUMENTS, f"--user-data-dir={folder}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    # Debian's Selenium cannot look for the driver itself.
    return webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))


def red_cloud(far_away):
    cloud = vtkPolyData()
    cloud.ShallowCopy(support.point_set(support.sphere() + far_away))
    colors = numpy_to_vtk(np.tile(np.uint8([230, 30, 20]), (2000, 1)), deep=True)
    colors.SetName("RGB")
    cloud.GetPointData().SetScalars(colors)
    return cloud


class Viewer(BatchTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        write_scan(cls.folder / "ball 1+1.xyz")
        # Coordinates of a map: floats of 4 bytes would leave steps of half a metre.
        write_mesh(red_cloud((0, 0, 5e6)), cls.folder / "red.vtp")
        cls.write_recipe(
            scans=["ball 1+1.xyz", "red.vtp", "none.ply"], matrix={"vertices": [300]}, gallery=True
        )
        cls.run_batch(DISPLAY="")
        cls.browser = start_browser(cls.folder / "browser")
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.open("")
        self.browser.refresh()

    def open(self, fragment):
        self.browser.get((self.results / "index.html").as_uri() + fragment)

    def wait_for(self, name):
        """Until the view of that name has been drawn."""
        viewer = self.browser.find_element(By.ID, "viewer")
        self.wait_until(lambda: viewer.get_attribute("data-ready") == name)
        # What is to be seen then has been drawn when it does not change any more.
        seen = [self.pixels()]

        def is_still():
            time.sleep(0.3)
            seen.append(self.pixels())
            return (seen[-1] == seen[-2]).all()

        self.wait_until(is_still)

    def wait_until(self, holds):
        """Until the condition holds, which may take long on a busy machine."""
        WebDriverWait(self.browser, support.HANGING).until(lambda _: holds())

    def pixels(self):
        """What is to be seen in the middle of the view, an array of shape (height, width, 3)."""
        path = self.folder / "screen.png"
        path.write_bytes(self.browser.get_screenshot_as_png())
        reader = vtkPNGReader()
        reader.SetFileName(str(path))
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
        return pixels[60:-40, 50:-50, :3].astype(int)

    def differ(self, before):
        """Which part of the view is another one than it was."""
        return (self.pixels() != before).any(axis=2).mean()

    def press(self, button):
        self.browser.find_element(By.ID, button).click()

    def is_open(self):
        return self.browser.find_element(By.ID, "viewer").is_displayed()

    # Promise: scans with one mesh each stand side by side.
    def test_side_by_side(self):
        first, second, *_ = self.browser.find_elements(By.TAG_NAME, "section")
        self.assertEqual(first.rect["y"], second.rect["y"])
        self.assertGreater(second.rect["x"], first.rect["x"])

    # Promise: one click on a picture opens a view in which the mesh is to be seen, shaded, in the
    # middle; nothing is fetched but files beside the page, and the browser has nothing to complain of.
    def test_opens(self):
        self.assertFalse(self.is_open())
        pictures = self.browser.find_elements(By.CSS_SELECTOR, "a.view")
        self.assertEqual(len(pictures), 2)
        pictures[0].click()
        self.wait_for("ball_1+1_vertices-300")
        self.assertTrue(self.is_open())
        state = self.browser.find_element(By.ID, "state").text
        self.assertEqual(state, "300 vertices, 596 triangles")
        pixels = self.pixels()
        colors = np.unique(pixels.reshape(-1, 3), axis=0)
        self.assertGreater(len(colors), 50)
        self.assertTrue((pixels[0, 0] == 255).all())
        self.assertTrue((pixels[pixels.shape[0] // 2, pixels.shape[1] // 2] < 255).any())
        drawn = (pixels < 250).any(axis=2).mean()
        self.assertGreater(drawn, 0.2)
        self.assertLess(drawn, 0.8)

        script = "return performance.getEntriesByType('resource').map((entry) => entry.name)"
        for address in self.browser.execute_script(script):
            self.assertTrue(address.startswith("file:"), address)
        self.assertEqual(self.browser.get_log("browser"), [])

    # Promise: a drag rotates, the wheel zooms, Reset goes back.
    def test_moves(self):
        self.open("#red_vertices-300")
        self.wait_for("red_vertices-300")
        surface = self.pixels()
        self.press("edges")
        self.wait_until(lambda: self.differ(surface) > 0)
        start = self.pixels()
        scene = self.browser.find_element(By.ID, "scene")
        actions = webdriver.ActionChains(self.browser)
        actions.move_to_element(scene).click_and_hold().move_by_offset(80, 40).release().perform()
        self.wait_until(lambda: self.differ(start) > 0.02)
        rotated = self.pixels()
        origin = webdriver.common.actions.wheel_input.ScrollOrigin.from_element(scene)
        webdriver.ActionChains(self.browser).scroll_from_origin(origin, 0, 300).perform()
        self.wait_until(lambda: self.differ(rotated) > 0.02)
        self.press("reset")
        self.wait_until(lambda: self.differ(start) < 0.01)

    # Promise: wireframe and edges are other looks, by buttons and by keys.
    def test_styles(self):
        self.open("#ball_1%2B1_vertices-300")
        self.wait_for("ball_1+1_vertices-300")
        surface = self.pixels()
        # Through a wireframe one sees what is behind it.
        white, dark = self.white(), self.dark()
        self.press("wireframe")
        self.wait_until(lambda: self.white() > white + 0.1)
        self.press("edges")
        self.wait_until(lambda: self.white() < white + 0.1 and self.dark() > dark + 0.01)
        self.browser.find_element(By.TAG_NAME, "body").send_keys("s")
        self.wait_until(lambda: self.differ(surface) < 0.01)

    def white(self):
        return (self.pixels() == 255).all(axis=2).mean()

    def dark(self):
        return (self.pixels().sum(axis=2) < 200).mean()

    # Promise: colours of the scan are those of the view, and large coordinates leave the mesh round.
    def test_colors(self):
        self.open("#red_vertices-300")
        self.wait_for("red_vertices-300")
        pixels = self.pixels()
        red = pixels[..., 0] > 3 * pixels[..., 1] + 20
        self.assertGreater(red.mean(), 0.2)
        height, width = (np.ptp(places) for places in np.nonzero(red))
        self.assertAlmostEqual(height / width, 1, delta=0.05)

    # Promise: one goes from view to view, and back to the page.
    def test_walk(self):
        self.open("#ball_1%2B1_vertices-300")
        self.wait_for("ball_1+1_vertices-300")
        self.press("next")
        self.wait_for("red_vertices-300")
        self.browser.find_element(By.TAG_NAME, "body").send_keys(Keys.ARROW_LEFT)
        self.wait_for("ball_1+1_vertices-300")
        self.browser.find_element(By.TAG_NAME, "body").send_keys(Keys.ESCAPE)
        self.wait_until(lambda: not self.is_open())

    # Promise: where a mesh is not there any more, the view says so.
    def test_missing(self):
        path = self.results / "gallery" / "red_vertices-300.js"
        text = path.read_text(encoding="utf-8")
        self.addCleanup(path.write_text, text, encoding="utf-8")
        path.unlink()
        self.open("#red_vertices-300")
        state = self.browser.find_element(By.ID, "state")
        self.wait_until(lambda: "There is no 3D view" in state.text)
        self.browser.get_log("browser")


if __name__ == "__main__":
    unittest.main()
