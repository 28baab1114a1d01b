# SPDX-License-Identifier: BSD-3-Clause
"""What the linter of words reads of sources."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "Utilities" / "textlint"))
sys.dont_write_bytecode = True

import extract_texts


def texts(page):
    """The lines that are not empty, by their number from 1 on."""
    return {number: line for number, line in enumerate(page.lines, 1) if line}


class Texts(unittest.TestCase):
    # Promise: strings of C++ are read on their line, with what is put into them, if they have several words.
    def test_strings(self):
        source = (
            '#include "run/Warnings.h"\n// "in a comment"\nwarn("The mesh has " + count +\n'
            '  " holes, " "and no points.");\nset("Name");\nfail("There is no \\"cloud\\".");\n'
        )
        self.assertEqual(texts(extract_texts.of_cpp(source, is_header=False)), {
            3: "- The mesh has", 4: "  N holes, and no points.", 6: '- There is no "cloud".'})

    # Promise: comments are read in headers alone, each paragraph and each entry of a list as a text.
    def test_comments(self):
        source = "/**\n * @brief   a mesh\n *\n * The mesh\n * grows.\n * - entry\n */\nint a; ///< so many\n"
        self.assertEqual(texts(extract_texts.of_cpp(source, is_header=True)), {
            2: "- a mesh", 4: "- The mesh", 5: "  grows.", 6: "- entry", 8: "- so many"})
        self.assertEqual(texts(extract_texts.of_cpp(source, is_header=False)), {})

    # Promise: of Python docstrings and strings of several words are read.
    def test_python(self):
        source = 'def f(x):\n    """Learn a mesh.\n\n    It takes time.\n    """\n    raise E(f"no {x} is given")\n'
        self.assertEqual(texts(extract_texts.of_python(source)), {
            2: "- Learn a mesh.", 4: "- It takes time.", 6: "- no N is given"})

    # Promise: of the list of parameters the texts are read, not names and values.
    def test_list(self):
        source = '{ "name": "Seed", "short": "seed of the run",\n  "details": [\n  "One.",\n  "- Two."\n  ] }\n'
        self.assertEqual(texts(extract_texts.of_list(source)), {
            1: "- seed of the run", 3: "- One.", 4: "- Two."})

    # Promise: of panels of ParaView what they document is read.
    def test_panels(self):
        source = '<A short_help="A mesh">\n<Documentation>\n  The cloud\n  of points.\n</Documentation>\n</A>\n'
        self.assertEqual(texts(extract_texts.of_xml(source)), {
            1: "- A mesh", 3: "- The cloud", 4: "  of points."})


if __name__ == "__main__":
    unittest.main()
