# SPDX-License-Identifier: BSD-3-Clause
"""The classes in Python over the engine beside the C++ classes, each in a process of its own."""

import json
import os
import subprocess
import sys
import unittest

import support

SCRIPT = os.path.join(os.path.dirname(__file__), "worlds.py")


def start(path):
    """worlds.py with the package in this folder."""
    return subprocess.Popen(
        [sys.executable, SCRIPT],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": path},
    )


def everything(process):
    """What it has seen."""
    output, errors = process.communicate(timeout=support.HANGING)
    if process.returncode != 0:
        raise AssertionError(errors)
    return json.loads(output)


def difference(one, other, place=""):
    """The first place where two outcomes are not the same, and what is there; None if there is none."""
    if type(one) is type(other) and isinstance(one, (dict, list)) and len(one) == len(other):
        keys = one if isinstance(one, dict) else range(len(one))
        if isinstance(one, list) or one.keys() == other.keys():
            found = (difference(one[key], other[key], f"{place}/{key}") for key in keys)
            return next((text for text in found if text), None)
    return None if one == other else f"{place}: {one} in C++, {other} in Python"


def texts_of(outcome):
    return [text for _, text in outcome["said"] + outcome.get("before", [])]


class Worlds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        processes = [start(os.environ[f"NEURALMESH_{name}_PATH"]) for name in ("WRAPPED", "ENGINE")]
        cls.wrapped, cls.engine = (everything(process) for process in processes)

    # Promise: the same input, properties and seed give the same points, triangles, arrays of all kinds,
    # field data and tables, to the byte, and the same errors and warnings, by the C++ classes and by those
    # that pip installs.
    def test_same(self):
        self.assertEqual(list(self.wrapped), list(self.engine))
        for name, expected in self.wrapped.items():
            if name == "methods":
                continue
            with self.subTest(name):
                self.assertIsNone(difference(expected, self.engine[name]))

    # Promise: whatever the C++ classes can be asked, so can those in Python.
    def test_methods(self):
        for name, expected in self.wrapped["methods"].items():
            with self.subTest(name):
                self.assertLess(100 if name == "" else 5, len(expected))
                self.assertLessEqual(set(expected), set(self.engine["methods"][name]))

    # Promise: that would be noticed if it were not so: what is compared depends on what goes in, and what
    # is bad input says so.
    def test_not_by_chance(self):
        meshes = [self.engine[name]["outputs"][0]["places"]
                  for name in ("floats", "doubles", "blocks", "weights", "basic", "first", "ensemble")]
        self.assertEqual(len({json.dumps(mesh) for mesh in meshes}), len(meshes))
        arrays = dict(self.engine["rich"]["outputs"][0]["points"])
        names = {"Color", "RGBA", "Class", "Number", "Flag", "Byte", "Pair", "Activity_Input", "Name"}
        self.assertLessEqual(names, arrays.keys())
        self.assertNotIn("Ids", arrays)
        lines = self.engine["lines"]["outputs"][3]
        self.assertEqual([name for name, _ in lines["cells"]], ["Angle", "Chain", "Length"])
        self.assertGreaterEqual(lines["Lines"][0], 12)
        mesh = dict(self.engine["lines"]["outputs"][0]["points"])
        self.assertLessEqual({"Crease", "Crease_Input"}, mesh.keys())
        for name in ("first_bad", "first_beyond", "no_weights", "no_views", "exclusive", "nothing",
                     "both", "one_place", "comparison_bad", "explanation_bad", "scan_bad"):
            with self.subTest(name):
                self.assertTrue(texts_of(self.engine[name]))
        clamped = [text for text in texts_of(self.engine["clamped"]) if text.endswith(" is used.")]
        self.assertEqual(len(clamped), 8)
        for name in ("empty", "empty_blocks", "comparison_empty", "scan_empty"):
            with self.subTest(name):
                self.assertEqual(texts_of(self.engine[name]), [])
        stop, is_whole, flag, _ = self.engine["aborted"]
        self.assertEqual((stop[0], is_whole, flag), ("cancelled", True, 0))


if __name__ == "__main__":
    unittest.main()
