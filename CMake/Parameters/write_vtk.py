# SPDX-License-Identifier: BSD-3-Clause
"""What the VTK module has of the list: properties with their documentation, members, macros."""

from parameter_list import CLASSES, snake_case
from text import (
    WIDTH, begun_small, condition_words, default_sentence, variant_words, vtk_number, wrapped,
)
from write_core import choices_of

TYPES = {"bool": "vtkTypeBool", "int": "int", "count": "vtkIdType", "double": "double"}


def vtk_type(parameter):
    return "int" if parameter.choice else TYPES[parameter.type]


def enumeration(found, name):
    """The constants of a choice."""
    choice = found.choice(name)
    constants = [value.constant for value in choice.values]
    return [f"/** {choice.title}, for Set{name}(). */", f"enum {name}Type", "{",
            *(f"  {constant}," for constant in constants[:-1]), f"  {constants[-1]}", "};"]


def choosers(found, name):
    """A function for each value of a choice."""
    choice = found.choice(name)
    lines = []
    for value in choice.values:
        lines.append(f"void Set{name}To{value.name}() {{ this->Set{name}({value.constant}); }}")
    return lines


def introduced(found, parameter):
    """The text behind its symbol and what it goes with: "alpha_r of (7.4), with TopologyLearning: ..."."""
    beginnings = [parameter.symbol] if parameter.symbol else []
    if parameter.variants:
        beginnings.append(variant_words(parameter))
    beginnings += [condition_words(condition, found) for condition in parameter.when or ()]
    if not beginnings:
        return parameter.text
    beginning = ", ".join(beginnings)
    if not parameter.symbol:
        beginning = beginning[0].upper() + beginning[1:]
    return f"{beginning}: {begun_small(parameter.text)}"


def items(parameter):
    """The values of a choice, with what they mean."""
    for value in parameter.choice.values:
        mark = ""
        if value.name == parameter.default:
            mark = " (default)"
        elif value.name == parameter.thesis:
            mark = " (thesis)"
        yield f"- {value.constant}{mark}: {value.text}."


def documentation(found, parameter):
    """The comment at a property."""
    text = introduced(found, parameter)
    more = parameter.details or []
    more = more if isinstance(more, list) else [more]
    if parameter.choice:
        paragraphs = [text, *items(parameter), *([""] if more else []), *more]
    else:
        paragraphs = [" ".join([text, *more[:1]]), *more[1:]]
        ending = default_sentence(parameter)
        if len(paragraphs) == 1:
            paragraphs[0] += " " + ending
        else:
            paragraphs += ["", ending]
    lines = []
    for paragraph in paragraphs:
        prefix = " *   " if paragraph.startswith("- ") else " * "
        lines += wrapped(paragraph, prefix, " * ") or [" *"]
    return ["/**", *lines, " */"]


def one_property(found, parameter):
    """A property as VTK declares it."""
    name, kind = parameter.name, vtk_type(parameter)
    lines = []
    is_own = parameter.choice and not parameter.choice.owner
    if is_own:
        lines += [*enumeration(found, parameter.type), ""]
    lines += ["///@{", *documentation(found, parameter)]
    low, high = (vtk_number(parameter, end) for end in (parameter.low, parameter.high))
    macro_name = "SetClampOrZero" if parameter.zero else "SetClamp"
    lines += wrapped(f"vtkNeuralMesh{macro_name}Macro({name}, {kind}, {low}, {high});", "  ", "")
    lines.append(f"vtkGetMacro({name}, {kind});")
    if parameter.type == "bool":
        lines.append(f"vtkBooleanMacro({name}, {kind});")
    if parameter.choice:
        lines += choosers(found, parameter.type)
    return [*lines, "///@}"]


def of_class(found, arguments):
    """The parameters of a class, or those that are named."""
    if arguments[0] in CLASSES:
        return [parameter for parameter in found.parameters if parameter.owner == arguments[0]]
    return [found.parameter(name) for name in arguments]


def properties(found, *arguments):
    """The properties of a class, or those that are named."""
    lines = []
    for parameter in of_class(found, arguments):
        lines += ["", *one_property(found, parameter)]
    return lines[1:]


def members(found, *arguments):
    """The members behind them, with their defaults."""
    lines = []
    for parameter in of_class(found, arguments):
        if parameter.choice:
            value = vtk_number(parameter, parameter.number(parameter.default))
        elif parameter.type == "bool":
            value = str(int(parameter.default))
        else:
            value = vtk_number(parameter, parameter.default)
        lines.append(f"{vtk_type(parameter)} {parameter.name} = {value};")
    return lines


def macro(name, uses):
    """A macro that calls `use` for each."""
    lines = [f"#define {name}(use)", *("  " + use for use in uses)]
    width = min(max(map(len, lines)) + 1, WIDTH + 1)
    return [line.ljust(width) + " " * (len(line) >= width) + "\\" for line in lines[:-1]] + [lines[-1]]


def pairs(found, name, kind):
    """A macro for the names of properties, with those in the core."""
    algorithm, mesh, ensemble = CLASSES
    wanted = {
        "choices": lambda p: p.owner == algorithm and not p.in_preset and p.in_engine,
        "preset": lambda p: p.in_preset,
        "run": lambda p: p.owner == mesh and p.in_engine,
        "ensemble": lambda p: p.owner == ensemble,
    }[kind]
    uses = [f"use({p.name}, {p.field})" for p in found.parameters if wanted(p)]
    return macro(name, uses)


def names(found, name, owner):
    """A macro for the properties of a class that the core does not know."""
    wanted = [p for p in of_class(found, [owner]) if not p.in_engine]
    return macro(name, [f"use({p.name})" for p in wanted])


def settings(found, name):
    """A macro for what --set of the command line sets."""
    uses = []
    for p in found.parameters:
        if p.command is None:
            low, high = (str(e) if p.choice else vtk_number(p, e) for e in (p.low, p.high))
            words = [snake_case(value.name) for value in p.choice.values] if p.choice else []
            words += ["off", "on"] if p.type == "bool" else []
            quoted = ", ".join(f'"{text}"' for text in [p.short, *words])
            uses.append(f"use({p.name}, {low}, {high}, {quoted})")
    return macro(name, uses)


def conversions(found):
    """Constants of VTK beside the values of the core."""
    lines = []
    for choice in choices_of(found):
        owner = next((p.owner for p in found.parameters if p.type == choice.name), CLASSES[0])
        values = [
            f"{{ {owner}::{v.constant}, neuralmesh::{choice.name}::{v.name} }}"
            for v in choice.values
        ]
        lines += ["", "template <>", f"struct vtkNeuralMeshChoice<neuralmesh::{choice.name}>", "{",
                  f"  static constexpr std::pair<int, neuralmesh::{choice.name}> Values[] = {{",
                  *(f"    {value}," for value in values), "  };", "};"]
    return lines[1:]
