#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The site of the documentation in a browser, opened from the disk: test_site.py SITE"""

import json
import pathlib
import re
import shutil
import sys
import tempfile
import time
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import WebDriverWait
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader
except ImportError as error:
    print(f"skipped: {error}; Utilities/build.sh names the packages of the night")
    sys.exit(0)

CHROMIUM = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")
SITE = pathlib.Path(sys.argv.pop(1)).resolve()
# Seconds after which a page must have hung, however busy the machine is.
HANGING = 900
# Without a graphics card, and as root; nothing but files can be reached.
ARGUMENTS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--window-size=1200,900",
    "--proxy-server=127.0.0.1:9",
)


def start_browser(folder):
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in (*ARGUMENTS, f"--user-data-dir={folder}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    # Debian's Selenium cannot look for the driver itself.
    return webdriver.Chrome(options=options, service=Service(DRIVER))


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(folder.cleanup)
        cls.picture = pathlib.Path(folder.name, "picture.png")
        cls.browser = start_browser(pathlib.Path(folder.name, "browser"))
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.set_width(1200)
        self.open("index.html")
        self.browser.get_log("performance")

    # Promise: whatever a test opens, nothing is asked for but what lies in the site.
    def tearDown(self):
        asked = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        addresses = [one["params"]["request"]["url"] for one in asked if one["method"] == "Network.requestWillBeSent"]
        self.assertTrue(addresses)
        for address in addresses:
            self.assertRegex(address, r"^(file|data|blob):")

    def open(self, page):
        self.browser.get((SITE / page).as_uri())

    def set_width(self, width):
        size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600}
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)

    def find(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def wait_until(self, holds):
        """Until the condition holds, which may take long on a busy machine."""
        WebDriverWait(self.browser, HANGING).until(lambda _: holds())

    def search(self, word):
        (field,) = (one for one in self.find("input[name=q]") if one.is_displayed())
        field.send_keys(word)
        field.submit()
        said = re.compile("finished|did not match")
        self.wait_until(lambda: any(said.search(one.text) for one in self.find("#search-results .search-summary")))
        return self.find("#search-results ul.search > li > a")

    # Promise: the search finds pages by a word in them, of the gallery, the guide and the reference; and nothing
    # for what is no word.
    def test_search(self):
        found = self.search("asteroid")
        titles = [link.text for link in found]
        self.assertIn("A noisy closed scan", titles)
        found[titles.index("A noisy closed scan")].click()
        self.wait_until(lambda: self.find("h1") and self.find("h1")[0].text.startswith("A noisy closed scan"))
        self.assertIn("asteroid", self.find("article")[0].text)
        self.open("index.html")
        self.assertIn("Python", " ".join(link.text for link in self.search("smallest_piece")))
        self.open("index.html")
        self.assertEqual(self.search("xyzzyplugh"), [])

    # Promise: on a telephone one reads every page without moving it sideways, and no page makes the browser
    # complain. What Doxygen writes is for wider screens.
    def test_pages(self):
        self.set_width(400)
        pages = [path for path in sorted(SITE.rglob("*.html"))
                 if path.relative_to(SITE).parts[0] not in ("classes", "views", "_static", "search.html")]
        self.assertGreater(len(pages), 20)
        self.browser.get_log("browser")
        for page in pages:
            with self.subTest(page.relative_to(SITE)):
                self.open(page.relative_to(SITE))
                script = "return [document.documentElement.scrollWidth, innerWidth]"
                width, seen = self.browser.execute_script(script)
                self.assertEqual(seen, 400)
                self.assertLessEqual(width, 400)
                self.assertTrue(self.find("article")[0].text)
                self.assertEqual([entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"], [])

    def pixels(self, element):
        """What is to be seen of it, an array of shape (height, width, 3)."""
        self.picture.write_bytes(element.screenshot_as_png)
        reader = vtkPNGReader()
        reader.SetFileName(str(self.picture))
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
        return pixels[..., :3].astype(int)

    # Promise: a view in 3D shows its scene, and a drag turns it.
    def test_views(self):
        pages = [path for path in sorted((SITE / "Gallery").glob("*.html")) if path.stem != "index"]
        self.assertGreaterEqual(len(pages), 4)
        for page in pages:
            with self.subTest(page.stem):
                self.open(page.relative_to(SITE))
                self.assertTrue(self.find("article img"))
                self.assertNotIn("Warning", self.find("article")[0].text)
                self.turn(self.find("details.view")[0])

    def show(self, element):
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", element)

    def turn(self, view):
        summary, frame = (view.find_element(By.TAG_NAME, name) for name in ("summary", "iframe"))
        self.show(summary)
        summary.click()
        self.show(frame)
        self.browser.switch_to.frame(frame)
        self.wait_until(lambda: any(one.size["height"] > 0 for one in self.find("canvas")))
        canvas = self.find("canvas")[0]
        self.wait_until(lambda: (self.pixels(canvas) < 250).any(axis=2).mean() > 0.01)
        before = [self.pixels(canvas)]

        def is_still():
            time.sleep(0.3)
            before.append(self.pixels(canvas))
            return (before[-1] == before[-2]).all()

        self.wait_until(is_still)

        def is_turned():
            # A hand moves in many small steps: vtk.js takes one after a rest for the first of them. On a busy
            # machine there are rests.
            actions = webdriver.ActionChains(self.browser, duration=20)
            actions.move_to_element(canvas).click_and_hold()
            for _ in range(10):
                actions.move_by_offset(8, 3)
            actions.release().perform()
            return (self.pixels(canvas) != before[-1]).any(axis=2).mean() > 0.02

        self.wait_until(is_turned)
        self.browser.switch_to.default_content()


if __name__ == "__main__":
    if not CHROMIUM or not DRIVER:
        print("skipped: there is no chromium, or no chromedriver; Utilities/build.sh names the packages of the night")
    elif not (SITE / "index.html").exists():
        print("skipped: there is no site; cmake --build build --target site makes it")
    else:
        unittest.main()
