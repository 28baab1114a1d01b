# SPDX-License-Identifier: BSD-3-Clause
"""Writes the type stubs of a module of wrapped VTK classes, from the signatures in their docstrings.

python3 make_stubs.py MODULE STUBS.pyi
"""

import ast
import importlib
import inspect
import re
import sys

# Names in VTK's signatures that no module defines.
NO_TYPES = {"Buffer", "Callback", "Pointer", "Template", "unknown"}


class Annotations(ast.NodeTransformer):
    """Annotations as Python has them, from those of VTK: (x, y) for tuples, [x, y] for lists."""

    def visit_Tuple(self, node):
        inner = ", ".join(ast.unparse(self.visit(element)) for element in node.elts)
        return ast.parse(f"tuple[{inner or '()'}]", mode="eval").body

    def visit_List(self, node):
        inner = " | ".join(sorted({ast.unparse(self.visit(element)) for element in node.elts}))
        return ast.parse(f"MutableSequence[{inner or 'Any'}]", mode="eval").body

    def visit_Name(self, node):
        return ast.Name("Any") if node.id in NO_TYPES else node


def signatures(method):
    """The signatures of a method: one for each "C++:" in its docstring."""
    pattern = rf"^({re.escape(method.__name__)}\(.*?\)\s+-> .*?)\nC\+\+: "
    for match in re.finditer(pattern, method.__doc__ or "", re.MULTILINE | re.DOTALL):
        # Long ones are broken into lines.
        function = ast.parse(f"def {' '.join(match[1].split())}: ...").body[0]
        for argument in function.args.args:
            if argument.annotation:
                argument.annotation = Annotations().visit(argument.annotation)
        function.returns = Annotations().visit(function.returns)
        yield function


def method_stub(method):
    found = list(signatures(method))
    for function in found:
        if [argument.arg for argument in function.args.args][:1] != ["self"]:
            function.decorator_list.append(ast.Name("staticmethod"))
        if len(found) > 1:
            function.decorator_list.insert(0, ast.Name("overload"))
    return "\n".join(ast.unparse(ast.fix_missing_locations(function)) for function in found)


def property_stub(name, member, wrapped):
    """The stub of what VTK, after 9.3, makes of a getter and a setter: its docstring names them."""
    access, methods = re.match(r"(\S+), Calls (\S+)", member.__doc__).groups()
    found = list(signatures(getattr(wrapped, methods.split("/")[0])))
    if not found:
        kind = ast.Name("Any")
    elif access == "write-only":
        kind = found[0].args.args[-1].annotation
    else:
        kind = found[0].returns
    kind = ast.unparse(ast.fix_missing_locations(kind))
    if access == "read-only":
        return f"@property\ndef {name}(self) -> {kind}: ..."
    return f"{name}: {kind}"


def member_stub(name, member, wrapped):
    if inspect.isclass(member):
        return f"class {name}(int): ..."
    if inspect.isgetsetdescriptor(member):
        return property_stub(name, member, wrapped)
    if isinstance(member, int):
        return f"{name}: {type(member).__name__}"
    return method_stub(member)


def class_stub(wrapped):
    members = [(name, member) for name, member in vars(wrapped).items() if not name.startswith("_")]
    # Enumerations first, for their constants name them.
    members.sort(key=lambda item: (not inspect.isclass(item[1]), not isinstance(item[1], int)))
    stubs = [member_stub(name, member, wrapped) for name, member in members]
    body = "\n".join(stub for stub in stubs if stub) or "..."
    indented = "\n".join("    " + line for line in body.splitlines())
    return f"class {wrapped.__name__}({wrapped.__base__.__name__}):\n{indented}\n"


def imports(text, own):
    """Import statements for the VTK classes of other modules that the text names."""
    names = set(re.findall(r"\bvtk\w+", text)) - set(own)
    modules = [(name, module) for name, module in sys.modules.items() if "vtkmodules.vtk" in name]
    for name in sorted(names):
        home = next(path for path, module in modules if hasattr(module, name))
        yield f"from {home} import {name}\n"


def main(module_name, path):
    module = importlib.import_module(module_name)
    classes = {name: value for name, value in vars(module).items() if inspect.isclass(value)}
    # Superclasses first, for the others name them.
    ordered = sorted(classes.values(), key=lambda value: len(value.__mro__))
    text = "\n\n".join(class_stub(value) for value in ordered)
    with open(path, "w", encoding="utf-8") as stubs:
        stubs.write("from typing import Any, MutableSequence, overload\n")
        stubs.writelines(imports(text, classes))
        stubs.write("\n\n" + text)


if __name__ == "__main__":
    main(*sys.argv[1:])
