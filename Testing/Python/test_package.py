# SPDX-License-Identifier: BSD-3-Clause
"""What the package shows of itself: its version, its VTK, documentation, types and stubs."""

import ast
import builtins
import inspect
import pathlib
import typing
import unittest

import neuralmesh
import support
from vtkmodules.vtkCommonCore import vtkVersion

FOLDER = pathlib.Path(neuralmesh.__file__).parent
FUNCTIONS = [member for member in vars(neuralmesh).values() if inspect.isfunction(member)]
CLASSES = [member for member in vars(neuralmesh).values() if inspect.isclass(member)]


class Versions(unittest.TestCase):
    # Promise: the package knows its version and that of its VTK.
    def test_versions(self):
        self.assertRegex(neuralmesh.__version__, r"^\d+\.\d+\.\d+$")
        self.assertEqual(neuralmesh.VTK_VERSION, vtkVersion.GetVTKVersion())

    # Promise: with another VTK the import says what is there, what is needed and what to do, before
    # any library is loaded.
    def test_other_vtk(self):
        output, errors, status = support.run_script(
            """
            import sys, types
            sys.modules["vtkmodules"] = types.ModuleType("vtkmodules")
            sys.modules["vtkmodules"].__file__ = "/elsewhere/vtkmodules/__init__.py"
            other = types.ModuleType("vtkmodules.vtkCommonCore")
            other.vtkVersion = type("vtkVersion", (), {"GetVTKVersion": lambda: "8.9.7"})
            sys.modules["vtkmodules.vtkCommonCore"] = other
            try:
                import neuralmesh
            except ImportError as error:
                print(error)
            print("vtk" in open("/proc/self/maps").read().lower().replace("vtkpython", ""))
            """
        )
        self.assertEqual((errors, status), ("", 0))
        message, loaded = output.splitlines()
        for part in (neuralmesh.VTK_VERSION, "8.9.7", "/elsewhere/vtkmodules", "PYTHONPATH"):
            self.assertIn(part, message)
        self.assertNotIn("libvtkFiltersNeuralMesh", loaded)

    # Promise: without any VTK the import says what is needed.
    def test_no_vtk(self):
        output, errors, status = support.run_script(
            """
            import sys
            sys.modules["vtkmodules"] = None
            try:
                import neuralmesh
            except ImportError as error:
                print(error)
            """
        )
        self.assertEqual((errors, status), ("", 0))
        self.assertIn(f"needs VTK {neuralmesh.VTK_VERSION}", output)


class Functions(unittest.TestCase):
    # Promise: every function says what each parameter is, what comes out and what is raised, and
    # its types can be read.
    def test_documentation(self):
        self.assertEqual(FUNCTIONS, [
            neuralmesh.compare, neuralmesh.explain, neuralmesh.info, neuralmesh.reconstruct,
            neuralmesh.remesh, neuralmesh.stream,
        ])
        for function in FUNCTIONS:
            with self.subTest(function.__name__):
                documentation = inspect.getdoc(function)
                for section in ("Args:", "Returns:", "Raises:", "Example:"):
                    self.assertIn(section, documentation)
                hints = typing.get_type_hints(function)
                for name in inspect.signature(function).parameters:
                    self.assertIn(f"{name}: ", documentation)
                    self.assertIn(name, hints)
                self.assertIn("return", hints)
        self.assertIn("(N, 3)", neuralmesh.reconstruct.__doc__)
        # Promise: whichever Python it is, and whether or not it strips docstrings.
        for function in (neuralmesh.reconstruct, neuralmesh.stream):
            self.assertRegex(function.__doc__, "winner_rate +0.1 +a number from 0 to 1")


class Stubs(unittest.TestCase):
    """The stubs of the classes beside the classes themselves."""

    def setUp(self):
        self.text = (FOLDER / "vtkFiltersNeuralMesh.pyi").read_text(encoding="utf-8")
        self.classes = {
            node.name: node for node in ast.parse(self.text).body if isinstance(node, ast.ClassDef)
        }

    # Promise: type checkers look at the package.
    def test_marked(self):
        self.assertTrue((FOLDER / "py.typed").exists())

    # Promise: every class and every member of it has a stub, and there are no others.
    def test_complete(self):
        self.assertEqual(set(self.classes), {wrapped.__name__ for wrapped in CLASSES})
        for wrapped in CLASSES:
            stub = self.classes[wrapped.__name__]
            self.assertEqual([base.id for base in stub.bases], [wrapped.__base__.__name__])
            names = {getattr(node, "name", None) or node.target.id for node in stub.body}
            members = {name for name in vars(wrapped) if not name.startswith("_")}
            self.assertEqual(names, members)

    # Promise: the stubs are valid, and every name in them is defined.
    def test_names_defined(self):
        namespace = {}
        exec(compile("from __future__ import annotations\n" + self.text, "stubs", "exec"), namespace)
        known = set(namespace) | set(dir(builtins))
        for stub in self.classes.values():
            inner = {node.name for node in stub.body if isinstance(node, ast.ClassDef)}
            used = {node.id for node in ast.walk(stub) if isinstance(node, ast.Name)}
            inside = {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
            self.assertEqual(used - known - inner - inside, set())

    # Promise: the getters return what the stubs say.
    def test_getters(self):
        types = {"int": int, "float": float, "str": str}
        checked = 0
        mesh_class = neuralmesh.vtkNeuralMesh
        for wrapped in CLASSES:
            # Its superclass is abstract.
            instance = mesh_class() if issubclass(mesh_class, wrapped) else wrapped()
            for node in self.classes[wrapped.__name__].body:
                if not isinstance(node, ast.FunctionDef) or not node.name.startswith("Get"):
                    continue
                arguments = [argument.arg for argument in node.args.args]
                wanted = types.get(ast.unparse(node.returns))
                if arguments == ["self"] and wanted:
                    self.assertIsInstance(getattr(instance, node.name)(), wanted, node.name)
                    checked += 1
        self.assertGreater(checked, 50)


if __name__ == "__main__":
    unittest.main()
