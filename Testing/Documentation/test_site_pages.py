#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What goes into the site of the documentation, without what makes it: test_site_pages.py ROOT"""

import ast
import pathlib
import re
import sys
import tempfile
import unittest

from markdown_pages import Page

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "Documentation" / "Site"))
import make_site  # noqa: E402


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.sources = pathlib.Path(folder.name, "source")
        make_site.gather_pages(cls.sources)
        index = Page(cls.sources / "index.md", "index.md")
        cls.contents = [block.text.split() for block in index.blocks if block.language == "{toctree}"]

    # Promise: each page stands in the contents of the site once, and no other does.
    def test_contents(self):
        made = ["Gallery/index", "Reference/Cpp", "Reference/Python"]
        pages = [path.relative_to(self.sources).as_posix() for path in self.sources.rglob("*.md")]
        pages.remove("index.md")
        listed = [word for words in self.contents for word in words if re.search(r"\.md$|^[A-Z]\w*/\w+$", word)]
        self.assertGreater(len(pages), 10)
        self.assertEqual(sorted(listed), sorted([*pages, *made]))

    # Promise: the order of the pages is that of the index.
    def test_order(self):
        index = (ROOT / "Documentation" / "README.md").read_text(encoding="utf-8")
        sections = index[index.index("\n## ") :]
        # The page on the site itself is for who works on it.
        links = [link for link in re.findall(r"\]\((\w[^)#]*)", sections) if not link.startswith("Site/")]
        wanted = [f"Documentation/{link}" for link in links]
        listed = [word for words in self.contents for word in words]
        places = [listed.index(page) for page in dict.fromkeys(wanted) if page.endswith(".md")]
        self.assertEqual(places, sorted(places))

    # Promise: the first page is the README of the repository.
    def test_first_page(self):
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        self.assertTrue((self.sources / "index.md").read_text(encoding="utf-8").startswith(readme))


class Sources(unittest.TestCase):
    # Promise: the same packages make the site everywhere.
    def test_versions(self):
        lines = make_site.REQUIREMENTS.read_text().splitlines()
        packages = [line for line in lines if line and not line.startswith("#")]
        for package in packages:
            self.assertRegex(package, r"^[\w.-]+==[\w.]+$")
        for name in ("Sphinx", "myst-parser", "furo", "sphinx-gallery", "pyvista"):
            self.assertIn(name, [package.partition("==")[0] for package in packages])

    # Promise: a script of the gallery has a title, draws, and makes its cloud itself.
    def test_gallery(self):
        scripts = sorted((ROOT / "Documentation" / "Gallery").glob("*.py"))
        self.assertGreaterEqual(len(scripts), 4)
        for script in scripts:
            with self.subTest(script.name):
                text = script.read_text(encoding="utf-8")
                self.assertRegex(ast.get_docstring(ast.parse(text)), r"^.+\n=+\n\n.")
                self.assertIn("plotter.show()", text)
                self.assertNotRegex(text, r"\b(open|read|download\w*)\(")


if __name__ == "__main__":
    unittest.main()
