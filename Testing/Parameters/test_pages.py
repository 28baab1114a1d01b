# SPDX-License-Identifier: BSD-3-Clause
"""Tables of parameters, those that are written from the list and any that stand in pages by hand, and options of
the command: what they say is that of the list."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "CMake" / "Parameters"))
sys.dont_write_bytecode = True

import generate
import parameter_list

LIST = parameter_list.read(ROOT / "Filters" / "Parameters.json")
BY_NAME = {parameter.name: parameter for parameter in LIST.parameters}
NAME = re.compile("`([A-Z][A-Za-z]+)`")


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def rows(text):
    """The rows of tables with the columns property and unit, as dictionaries."""
    columns = None
    for line in text.splitlines():
        if not line.startswith("|"):
            columns = None
        elif columns is None:
            columns = cells(line)
        elif {"property", "unit"} <= set(columns) and NAME.fullmatch(cells(line)[0]):
            yield dict(zip(columns, cells(line), strict=True))


def page_of_parameters():
    """The page with its tables, as the build has it."""
    return generate.written(ROOT)["Documentation/Guide/Parameters.md"]


class Pages(unittest.TestCase):
    # Promise: a unit is that of the list, on every page. Defaults and values of the thesis are held against
    # the classes, by Python.python3.documentation.
    def test_units(self):
        pages = [(path.name, path.read_text(encoding="utf-8"))
                 for path in sorted((ROOT / "Documentation").rglob("*.md"))]
        seen = set()
        for name, text in [*pages, ("Parameters.md, with its tables", page_of_parameters())]:
            for row in rows(text):
                parameter = BY_NAME[NAME.fullmatch(row["property"])[1]]
                seen.add(parameter.name)
                with self.subTest(f"{name}: {parameter.name}"):
                    self.assertEqual(row["unit"], parameter.unit or "")
        self.assertEqual(seen, set(BY_NAME))

    # Promise: the command has no default and no range of its own: a changed list changes it.
    def test_command(self):
        figures = set()
        for parameter in (p for p in LIST.parameters if p.command and p.range):
            figures.update((parameter.default, parameter.low, parameter.high))
        # Small ones stand for many things.
        figures = {str(int(figure)) for figure in figures if abs(figure) >= 20}
        self.assertGreater(figures, {"20000", "60", "255", "1024", "1000000000"})
        for name in ("ReconstructCommand.cxx", "TuneCommand.cxx"):
            text = (ROOT / "Applications" / name).read_text(encoding="utf-8")
            code = re.sub(r'"[^"]*For example[^"]*"|".*--vertices \d+\\n"', "", text)
            self.assertEqual(set(re.findall(r"\b\d+\b", code)) & figures, set(), name)
            # Of words: defaults are those of a filter, never set here.
            self.assertNotRegex(code, r"\(default\)[:;]|, the default|[^=!]= vtkNeuralMesh::[A-Z_]+;")


if __name__ == "__main__":
    unittest.main()
