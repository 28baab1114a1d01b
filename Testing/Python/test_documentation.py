# SPDX-License-Identifier: BSD-3-Clause
"""The tables of properties in the documentation beside the filter itself."""

import os
import pathlib
import re
import sys
import unittest

from neuralmesh import vtkNeuralMesh, vtkNeuralMeshEnsemble
from neuralmesh._parameters import parameters_of, snake_case

ROOT = pathlib.Path(__file__).parents[2]
sys.path.append(str(ROOT / "Testing" / "Documentation"))
from markdown_pages import pages

DOCUMENTATION = ROOT / "Documentation"
# With its tables.
PARAMETERS = pathlib.Path(os.environ["NEURALMESH_PARAMETERS_PAGE"])
WORDS = {"on": 1, "off": 0}
VARIANTS = {"noise filtering": "NoiseFiltering", "basic": "Basic", "normal-based": "NormalBased"}


def rows_of(page):
    """The rows of the tables with a column `default`, as dictionaries by the names of columns."""
    header = None
    for line in page.read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|"):
            header = None
        elif header is None:
            header = cells
        elif "property" in header and "default" in header and not cells[0].startswith("-"):
            yield dict(zip(header, cells))


def columns_of(row):
    """The columns of a row that have a value, with the preset and the variant that they are for."""
    for column, text in row.items():
        preset, _, variant = column.partition(", ")
        if preset in {"default", "thesis"} and text:
            yield column, preset, variant or "noise filtering"


def value_of(mesh, name):
    """The value of a property; of one with SetXToA, SetXToB and so on the word for it."""
    value = getattr(mesh, "Get" + name)()
    choosers = [method for method in dir(mesh) if method.startswith(f"Set{name}To")]
    for chooser in choosers:
        other = type(mesh)()
        getattr(other, chooser)()
        if getattr(other, "Get" + name)() == value:
            return " ".join(re.findall("[A-Z][a-z]*", chooser[len(f"Set{name}To"):])).lower()
    return value


class Tables(unittest.TestCase):
    # Promise: what a page gives as the default of a property, or as its value in the thesis preset of
    # a variant, it is. A column is `default` or `thesis`, with `, VARIANT` behind it if it is not for the
    # noise-filtering one.
    def test_values(self):
        checked, seen = 0, set()
        written = [page.path for page in pages(ROOT) if page.path.is_relative_to(DOCUMENTATION)]
        for page in [*written, PARAMETERS]:
            for row in rows_of(page):
                name = row["property"].strip("`")
                for column, preset, variant in columns_of(row):
                    mesh = vtkNeuralMesh()
                    if not hasattr(mesh, "Get" + name):
                        mesh = vtkNeuralMeshEnsemble()
                    getattr(mesh, "SetVariantTo" + VARIANTS[variant])()
                    getattr(mesh, "SetPresetTo" + preset.capitalize())()
                    with self.subTest(page=page.name, property=name, column=column):
                        value = value_of(mesh, name)
                        shown = WORDS.get(row[column], row[column])
                        if isinstance(value, str):
                            self.assertEqual(shown, value)
                        else:
                            self.assertAlmostEqual(float(shown), value, places=3)
                        checked += 1
                        seen.add(variant)
        self.assertGreater(checked, 50)
        self.assertEqual(seen, set(VARIANTS))

    # Promise: every parameter has a row on the page of parameters, just one.
    def test_parameters(self):
        named = [snake_case(row["property"].strip("`")) for row in rows_of(PARAMETERS)]
        # The preset is many of them.
        parameters = set(parameters_of(vtkNeuralMeshEnsemble)) - {"preset"}
        self.assertEqual(sorted(named), sorted(parameters))


if __name__ == "__main__":
    unittest.main()
