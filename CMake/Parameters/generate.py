#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what follows from the list of parameters: generate.py SOURCES BUILD

Each template NAME.in below becomes NAME in the folder of the build, in which a line
  @writer argument...@
is replaced by what that writer says of Filters/Parameters.json, as far to the right. A file that would
not change is left alone. The names of all files that were read are printed, for CMake to look after.
"""

import pathlib
import re
import sys

import parameter_list
import write_core
import write_documentation
import write_paraview
import write_python
import write_vtk

LIST = "Filters/Parameters.json"
# Where options of the command stand. It says nothing else of parameters, so that nothing follows from it.
COMMAND = (
    "Applications/ReconstructCommand.cxx",
    "Applications/OrientationOptions.cxx",
    "Applications/SizeOptions.cxx",
    "Applications/SurfaceInputs.cxx",
)
PLUGIN = "Wrapping/ParaView/NeuralMesh"
CORE = {"choices": write_core.choices, "fields": write_core.fields, "table": write_core.table}
VTK = {
    "choosers": write_vtk.choosers,
    "conversions": write_vtk.conversions,
    "enumeration": write_vtk.enumeration,
    "members": write_vtk.members,
    "names": write_vtk.names,
    "pairs": write_vtk.pairs,
    "properties": write_vtk.properties,
    "settings": write_vtk.settings,
}
PANEL = {
    "override": write_paraview.override,
    "panel": write_paraview.panel,
    "properties": write_paraview.properties,
}
PYTHON = {"properties": write_python.properties}
PAGE = {"table": write_documentation.table}
TEMPLATES = {
    "Filters/Core/base/Choices.h.in": CORE,
    "Filters/Core/learn/Parameters.h.in": CORE,
    "Filters/Core/learn/ParameterTable.h.in": CORE,
    "Filters/Core/run/EnsembleParameters.h.in": CORE,
    "Filters/vtkNeuralMeshAlgorithm.h.in": VTK,
    "Filters/vtkNeuralMesh.h.in": VTK,
    "Filters/vtkNeuralMeshEnsemble.h.in": VTK,
    "Filters/vtkNeuralMeshParameters.h.in": VTK,
    "Filters/vtkNeuralMeshStream.h.in": VTK,
    f"{PLUGIN}/NeuralMeshEnsemble.xml.in": PANEL,
    f"{PLUGIN}/NeuralMeshLearning.xml.in": PANEL,
    f"{PLUGIN}/NeuralMeshSurface.xml.in": PANEL,
    "Wrapping/Python/neuralmesh/_list.py.in": PYTHON,
    # The page itself, which is read in the repository, too.
    "Documentation/Guide/Parameters.md": PAGE,
}


def filled(template, writers, found):
    """A template with what the writers say."""
    lines = []
    for line in template.splitlines():
        place = line.strip()
        if len(place) < 3 or not (place.startswith("@") and place.endswith("@")):
            lines.append(line)
            continue
        writer, *arguments = place.strip("@").split()
        if writer not in writers:
            raise found.error(f"there is no writer {writer!r}, which a template names")
        indent = line[: len(line) - len(line.lstrip())]
        lines += [indent + new if new else "" for new in writers[writer](found, *arguments)]
    return "\n".join(lines) + "\n"


def write(path, text):
    """Writes a file if it would change."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def require_free_names(found, template, text):
    """Raises where a template has by hand what a parameter would bring."""
    struct = re.search(r"@fields (\w+)@", text)
    for parameter in found.parameters:
        if not struct:
            by_hand = rf"\b[GS]et{parameter.name}\(|Macro\({parameter.name},"
        elif write_core.struct_of(parameter) == struct[1]:
            by_hand = rf"^[^(/]*\b{parameter.field}(\(| = [^;,()]*;|;)"
        else:
            continue
        if re.search(by_hand, text, re.MULTILINE):
            raise found.error(f"{parameter.name}: {template} has something of that name already")


def require_options(found, text):
    """Raises where a parameter is said to have an option that the command lacks."""
    for parameter in found.parameters:
        if parameter.command and f'"{parameter.command}"' not in text:
            raise found.error(f"{parameter.name}: the command has no option {parameter.command!r}")


def written(sources):
    """What is to be written, by its name."""
    found = parameter_list.read(sources / LIST)
    require_options(found, "".join((sources / path).read_text(encoding="utf-8") for path in COMMAND))
    files = {}
    for template, writers in TEMPLATES.items():
        text = (sources / template).read_text(encoding="utf-8")
        if template.endswith(".h.in"):
            require_free_names(found, template, text)
        files[template.removesuffix(".in")] = filled(text, writers, found)
    found.require_places()
    return files


def main():
    sources, build = (pathlib.Path(argument) for argument in sys.argv[1:])
    try:
        files = written(sources)
    except parameter_list.ListError as error:
        sys.exit(str(error))
    for name, text in files.items():
        write(build / name, text)
    for path in [sources / LIST, *(sources / template for template in TEMPLATES)]:
        print(path.as_posix())


if __name__ == "__main__":
    main()
