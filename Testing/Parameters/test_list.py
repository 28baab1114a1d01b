# SPDX-License-Identifier: BSD-3-Clause
"""The list of parameters: what is wrong with a bad one, and what follows from a new entry."""

import copy
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).parents[2]
SCRIPT = ROOT / "CMake" / "Parameters" / "generate.py"
sys.path.insert(0, str(SCRIPT.parent))
sys.dont_write_bytecode = True

import generate
from parameter_list import ListError

LIST = generate.LIST
GOOD = json.loads((ROOT / LIST).read_text(encoding="utf-8"))

NEW = {
    "name": "TestedShare", "type": "double", "default": 0.25, "thesis": 0, "range": [0, 1],
    "symbol": "alpha_t of (1.2)", "variants": ["NoiseFiltering"], "when": ["EdgeFlips is on"],
    "unit": "part", "short": "how much of it is tested",
    "text": "How much of it is tested. RemovalLimit counts, too.", "why": "it does",
}


def entry_of(content, name):
    """The entry of a parameter in a list."""
    return next(entry for group in content["groups"] for entry in group["parameters"]
                if entry["name"] == name)


class ListTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.sources = pathlib.Path(folder.name, "sources")
        self.build = pathlib.Path(folder.name, "build")
        for template in [LIST, *generate.COMMAND, *generate.TEMPLATES]:
            (self.sources / template).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / template, self.sources / template)

    def generate(self, sources):
        command = [sys.executable, "-B", SCRIPT, sources, self.build]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def write(self, content):
        text = content if isinstance(content, str) else json.dumps(content)
        (self.sources / LIST).write_text(text, encoding="utf-8")

    def written(self, name):
        return (self.build / name).read_text(encoding="utf-8")


class BadLists(ListTest):
    def check_refused(self, content, message):
        """One line says what is wrong."""
        self.write(content)
        with self.assertRaises(ListError) as caught:
            generate.written(self.sources)
        text = str(caught.exception)
        self.assertIn(message, text)
        self.assertEqual(text.count("\n"), 0, text)
        self.assertTrue(text.startswith(str(self.sources / LIST)), text)

    # Promise: what is wrong with an entry is said in a line, with its name.
    def test_entries(self):
        wrong = {
            "RemovalLimit: there is no key 'defualt'": {"defualt": 1},
            "RemovalLimit: short is missing": {"short": ""},
            "RemovalLimit: text is missing": {"text": None},
            "RemovalLimit: short cannot be 3": {"short": 3},
            "RemovalLimit: preset cannot be 1": {"preset": 1},
            "RemovalLimit: there is no type float": {"type": "float"},
            "RemovalLimit: range is missing": {"range": None},
            "RemovalLimit: range must have two ends": {"range": [0]},
            "RemovalLimit: range [5, 1] is empty": {"range": [5, 1], "default": 2, "thesis": 2},
            "RemovalLimit: range of a double must have two numbers": {"range": [0, None]},
            "RemovalLimit: fuzz must have two ends": {"fuzz": ["a", 2]},
            "RemovalLimit: default 2000 is outside the range 0 to 1000": {"default": 2000},
            "RemovalLimit: thesis -1 is outside the range 0 to 1000": {"thesis": -1},
            "RemovalLimit: default True is no double": {"default": True},
            "RemovalLimit: default '1/0' is no double": {"default": "1/0"},
            "RemovalLimit: no preset sets it": {"preset": False},
            "RemovalLimit: class is none that has parameters": {"class": "vtkPoints", "thesis": None},
            "RemovalLimit: engine is no type": {"engine": "long"},
            "RemovalLimit: the engine must know what a preset sets": {"engine": False},
            "RemovalLimit: the engine must know what vtkNeuralMeshEnsemble has": {
                "engine": False, "class": "vtkNeuralMeshEnsemble", "preset": False, "thesis": None},
            "RemovalLimit: a preset sets nothing of vtkNeuralMesh": {"class": "vtkNeuralMesh", "preset": True},
            "RemovalLimit: panel can only be 'shown'": {"panel": "hidden"},
            "RemovalLimit: short has more than": {"short": "x" * 100},
            "RemovalLimit: text must end with a full stop": {"text": "Some limit"},
            "RemovalLimit: short has a |, which ends a cell": {"short": "this | that"},
            "RemovalLimit: short has a \", which ends text": {"short": "this \"that\""},
            "RemovalLimit: short has a @ or \\": {"short": "this \\ that"},
            "RemovalLimit: short has a control character or a new line": {"short": "this\nthat"},
            "RemovalLimit: text must begin with a word": {"text": '"Some" limit.'},
            "SmoothingRate: text must begin with a word": {"NAME": "SmoothingRate", "text": "(Some) limit."},
            "SmoothingRate: text has a @ or \\": {"NAME": "SmoothingRate", "text": "Some @limit."},
            "RemovalLimit: text has a control character": {"text": "Some \u0001 limit."},
            "RemovalLimit: why has a control character": {"why": "this\nthat"},
            "RemovalLimit: why has a |": {"why": "this | that"},
            "RemovalLimit: unit has a control character": {"unit": "this\nthat"},
            "RemovalLimit: unit has a |": {"unit": "this | that"},
            "RemovalLimit: */ in symbol ends a comment": {"symbol": "alpha */"},
            "RemovalLimit: */ in thesis_text ends a comment": {"thesis_text": "*/"},
            "RemovalLimit: details must be text": {"details": [3]},
            "RemovalLimit: */ in details ends a comment": {"details": "All */ of it."},
            "RemovalLimit: default is beyond the type double": {"default": "9" * 400 + "/1"},
            "RemovalLimit: range is beyond any type": {"range": [0, 10**400]},
            "SmoothingIterations: range is beyond any type": {"NAME": "SmoothingIterations",
                "range": [0, 10**400]},
            "RemovalLimit: a double has no engine type": {"engine": "unsigned"},
            "SmoothingIterations: unsigned does not hold the range": {"NAME": "SmoothingIterations",
                "engine": "unsigned", "range": [-1, 100]},
            "MaximumIterations: unsigned does not hold the range": {"NAME": "MaximumIterations",
                "engine": "unsigned"},
            "Double: the core cannot call it double, a word of C++": {"name": "Double"},
            "MTime: VTK has SetMTime() or GetMTime() already": {"name": "MTime"},
            "CheckpointFileName: Filters/vtkNeuralMesh.h.in has something of that name already": {
                "name": "CheckpointFileName"},
            "Of: Filters/Core/learn/Parameters.h.in has something of that name already": {"name": "Of"},
            "FitRounds: fuzz [0, 4000] is outside the range": {"NAME": "FitRounds", "fuzz": [0, 4000]},
            "RemovalLimit: the command has no option '--nonsense'": {"command": "--nonsense"},
            "RemovalLimit: variants must be a list of texts": {"variants": [["Basic"]]},
            "RemovalLimit: when must be a list of texts": {"when": []},
            "RemovalLimit: when has something twice": {"when": ["Order is List", "Order is List"]},
            "RemovalLimit: 'RemovalLimit is 0' is a condition of itself": {"when": ["RemovalLimit is 0"]},
            "RemovalLimit: 5000 in 'FitRounds is not 5000' is no value": {"when": ["FitRounds is not 5000"]},
            "RemovalLimit: vtkNeuralMeshAlgorithm has no Seed, as 'Seed is 1' needs": {"when": ["Seed is 1"]},
            "SmoothingIterations: range [0, 3000000000] is beyond": {"NAME": "SmoothingIterations",
                "range": [0, 3000000000]},
            "RemovalLimit: there is no variant 'Noisy'": {"variants": ["Noisy"]},
            "RemovalLimit: the condition 'Oder is List' names no parameter": {"when": ["Oder is List"]},
            "RemovalLimit: Lost in 'Order is Lost' is no value": {"when": ["Order is Lost"]},
            "parameters: EdgeFlips is there twice": {"name": "EdgeFlips"},
            "parameters: 'Removal-Limit' is no name": {"name": "Removal-Limit"},
        }
        for message, change in wrong.items():
            content = copy.deepcopy(GOOD)
            change = dict(change)
            entry = entry_of(content, change.pop("NAME", "RemovalLimit"))
            entry.update(change)
            for key in [key for key, value in change.items() if value is None]:
                del entry[key]
            with self.subTest(message):
                self.check_refused(content, message)

    # Promise: so it is with values of other types, and with choices.
    def test_choices(self):
        wrong = [
            ("SamplesPerAddition", {"default": 1.5}, "SamplesPerAddition: default 1.5 is no int"),
            ("EdgeFlips", {"default": 1}, "EdgeFlips: default 1 is no bool"),
            ("EdgeFlips", {"range": [0, 1]}, "EdgeFlips: a bool has no range"),
            ("Order", {"default": "Random"}, "Order: default 'Random' is none of Exact, List"),
            ("Order", {"fuzz": [0, 1]}, "Order: a Order has no fuzz"),
            ("EdgeFlips", {"fuzz": [0, 1]}, "EdgeFlips: a bool has no fuzz"),
            ("EdgeFlips", {"engine": "unsigned"}, "EdgeFlips: a bool has no engine type"),
            ("Start", {"type": "OutputPointsPrecision", "default": "Single", "thesis": "Single"},
             "Start: the engine does not know the choice OutputPointsPrecision"),
        ]
        for name, change, message in wrong:
            content = copy.deepcopy(GOOD)
            entry_of(content, name).update(change)
            with self.subTest(message):
                self.check_refused(content, message)
        content = copy.deepcopy(GOOD)
        start = next(choice for choice in content["choices"] if choice["name"] == "Start")
        start["values"][0]["name"] = "Exact"
        entry_of(content, "Start")["default"] = "Exact"
        self.check_refused(content, "choices: EXACT is the constant of two values")
        content = copy.deepcopy(GOOD)
        content["choices"][0]["values"][0]["words"] = "b"
        self.check_refused(content, "Variant: there is no key 'words'")
        for change, message in (({"title": "a */ b"}, "Variant: */ in title ends a comment"),
                                ({"title": "a\nb"}, "Variant: title has a control character")):
            content = copy.deepcopy(GOOD)
            content["choices"][0].update(change)
            self.check_refused(content, message)
        content = copy.deepcopy(GOOD)
        content["choices"][0]["values"][0]["text"] = "a */ b"
        self.check_refused(content, "Variant: */ in text ends a comment")
        content = copy.deepcopy(GOOD)
        content["choices"][1]["values"][0]["name"] = "Null"
        self.check_refused(content, "choices: C++ has a macro NULL already")

    # Promise: what templates name must be there, and each group must be named by them, under one label
    # of the panel.
    def test_templates(self):
        content = copy.deepcopy(GOOD)
        content["groups"] = [group for group in content["groups"] if group["key"] != "moves"]
        self.check_refused(content, "there is no group 'moves', which a template names")
        content = copy.deepcopy(GOOD)
        entry_of(content, "NumberOfVertices")["name"] = "VertexCount"
        self.check_refused(content, "there is no parameter 'NumberOfVertices', which a template names")
        content = copy.deepcopy(GOOD)
        content["groups"].append({"key": "new", "title": "New", "panel": None, "parameters": [NEW]})
        self.check_refused(content, "new: no template has the group in a table of the documentation")
        content["groups"][-1]["parameters"] = []
        self.check_refused(content, "new: there are no parameters in it")
        content["groups"][-1].update(key="+new", parameters=[NEW])
        self.check_refused(content, "+new: the key must be a word in small letters")
        content = copy.deepcopy(GOOD)
        next(group for group in content["groups"] if group["key"] == "list")["panel"] = "Activity"
        self.check_refused(content, "groups growth, list, end in one, their panel is another")
        content = copy.deepcopy(GOOD)
        content["groups"][0]["panel"] = "Outcome"
        self.check_refused(content, "outcome: no template has the group in a group of the panel")

    # Promise: 0 is a value beside a range only of numbers, and only below the range.
    def test_zero(self):
        for name, low, message in (
            ("NumberOfVertices", 0, "NumberOfVertices: 0 is not below the range"),
            ("Automatic", None, "Automatic: a bool has no zero"),
        ):
            content = copy.deepcopy(GOOD)
            entry_of(content, name)["zero"] = True
            if low is not None:
                entry_of(content, name)["range"][0] = low
            self.check_refused(content, message)

    # Promise: the script ends with the line, whoever finds what is wrong, and writes nothing.
    def test_script(self):
        content = copy.deepcopy(GOOD)
        entry_of(content, "NumberOfVertices")["name"] = "VertexCount"
        for content, message in ((content, "there is no parameter 'NumberOfVertices'"), ("{", "Expecting")):
            self.write(content)
            process = self.generate(self.sources)
            self.assertEqual(process.returncode, 1, process.stderr)
            self.assertIn(message, process.stderr)
            self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
            self.assertFalse(self.build.exists())

    # Promise: a file that is no list is refused, too.
    def test_files(self):
        self.check_refused("{", "Expecting property name")
        self.check_refused({"choices": []}, "there must be lists of choices and groups")


class NewEntries(ListTest):
    def setUp(self):
        super().setUp()
        content = copy.deepcopy(GOOD)
        group = next(group for group in content["groups"] if group["key"] == "growth")
        group["parameters"].append(NEW)
        self.write(content)
        process = self.generate(self.sources)
        self.assertEqual(process.returncode, 0, process.stderr)

    # Promise: a new entry is all that a parameter takes in the core, VTK, the command and the plugin.
    def test_everywhere(self):
        self.assertIn(
            "  /// alpha_t of (1.2): how much of it is tested\n  double testedShare = 0.25;\n",
            self.written("Filters/Core/learn/Parameters.h"))
        self.assertIn('.name = "TestedShare",\n', self.written("Filters/Core/learn/ParameterTable.h"))
        self.assertIn(
            "  ///@{\n  /**\n"
            "   * alpha_t of (1.2), noise-filtering variant, with EdgeFlips: how much of it is tested.\n"
            "   * RemovalLimit counts, too. Default 0.25 (thesis 0), range 0 to 1.\n   */\n"
            "  vtkNeuralMeshSetClampMacro(TestedShare, double, 0.0, 1.0);\n"
            "  vtkGetMacro(TestedShare, double);\n  ///@}\n",
            self.written("Filters/vtkNeuralMeshAlgorithm.h"))
        self.assertIn("  double TestedShare = 0.25;\n", self.written("Filters/vtkNeuralMeshAlgorithm.h"))
        table = self.written("Filters/vtkNeuralMeshParameters.h")
        self.assertIn("  use(TestedShare, testedShare) ", table)
        self.assertIn('  use(TestedShare, 0.0, 1.0, "how much of it is tested") ', table)
        self.assertIn(
            "| `TestedShare` | α_t of (1.2): how much of it is tested | part | 0.25 | 0 | it does |\n",
            self.written("Documentation/Guide/Parameters.md"))

    # Promise: the panel of ParaView has it in its group, and shows it where it counts.
    def test_panel(self):
        path = self.build / "Wrapping/ParaView/NeuralMesh/NeuralMeshLearning.xml"
        proxy = xml.etree.ElementTree.parse(path)
        (found,) = proxy.iterfind(".//DoubleVectorProperty[@name='TestedShare']")
        self.assertEqual(found.get("default_values"), "0.25")
        self.assertEqual(found.find("DoubleRangeDomain").attrib, {"name": "range", "min": "0", "max": "1"})
        self.assertEqual(" ".join(found.find("Documentation").text.split()),
                         "How much of it is tested. Removal Limit counts, too.")
        deciders = [(e.get("property"), e.get("value")) for e in found.find("Hints")]
        self.assertEqual(deciders, [("Variant", "1"), ("EdgeFlips", "1")])
        names = [e.get("name") for e in proxy.iterfind(".//PropertyGroup[@label='Growth']/Property")]
        self.assertEqual(names[names.index("EdgeFlips") + 1], "TestedShare")

    # Promise: what would not change is not written again, so that nothing is built again.
    def test_unchanged(self):
        files = [path for path in self.build.rglob("*") if path.is_file()]
        self.assertGreater(len(files), 10)
        times = [path.stat().st_mtime_ns for path in files]
        self.generate(self.sources)
        self.assertEqual([path.stat().st_mtime_ns for path in files], times)
        entry = copy.deepcopy(GOOD)
        entry_of(entry, "RemovalLimit")["why"] = "another reason"
        self.write(entry)
        self.generate(self.sources)
        self.assertIn("another reason", self.written("Documentation/Guide/Parameters.md"))

    # Promise: the panel of ParaView calls a group as the list does.
    def test_label(self):
        content = copy.deepcopy(GOOD)
        next(group for group in content["groups"] if group["key"] == "noise")["panel"] = "Dirt & noise"
        self.write(content)
        self.assertEqual(self.generate(self.sources).returncode, 0)
        proxy = xml.etree.ElementTree.parse(
            self.build / "Wrapping/ParaView/NeuralMesh/NeuralMeshSurface.xml")
        names = [e.get("name") for e in proxy.iterfind(".//PropertyGroup[@label='Dirt & noise']/Property")]
        self.assertIn("NoiseTolerance", names)

    # Promise: comments of headers are no wider than their code.
    def test_width(self):
        for path in self.build.rglob("*.h"):
            for line in path.read_text(encoding="utf-8").splitlines():
                if line.lstrip().startswith(("*", "/")):
                    self.assertLessEqual(len(line), 100, f"{path.name}: {line}")

    # Promise: no place of a template is left open.
    def test_places(self):
        for path in self.build.rglob("*"):
            if path.is_file():
                self.assertNotRegex(path.read_text(encoding="utf-8"), r"(?m)^ *@[a-z].*@$")


if __name__ == "__main__":
    unittest.main()
