# SPDX-License-Identifier: BSD-3-Clause
"""What the core has of the list: enumerations, the fields of the structs, the table."""

from parameter_list import CLASSES, first_small, snake_case
from text import cpp_double, packed, wrapped

ENSEMBLE = CLASSES[2]
TYPES = {"bool": "bool", "int": "int", "count": "std::uint64_t", "double": "double"}


def choices_of(found):
    """Those that the core knows."""
    return [choice for choice in found.choices if choice.in_engine]


def choices(found):
    """The enumerations, with the words for their values."""
    lines = []
    for choice in choices_of(found):
        lines += ["", *wrapped(choice.title + ".", "/// "), f"enum class {choice.name}", "{"]
        for value in choice.values:
            comma = "," if value is not choice.values[-1] else ""
            lines += [*wrapped(value.text, "  /// "), f"  {value.name}{comma}"]
        lines += ["};", ""]
        words = ", ".join(f'"{snake_case(value.name)}"' for value in choice.values)
        name = f"{first_small(choice.name)}Words"
        lines += wrapped(f"inline constexpr std::array {name}{{ {words} }};", "  ", "")
    return lines[1:]


def engine_type(parameter):
    return parameter.engine or (parameter.choice.name if parameter.choice else TYPES[parameter.type])


def literal(parameter, value):
    """A value in C++."""
    if parameter.choice:
        return f"{parameter.choice.name}::{value}"
    if parameter.type == "double":
        return cpp_double(value)
    return str(value).lower()


def struct_of(parameter):
    return "EnsembleParameters" if parameter.owner == ENSEMBLE else "Parameters"


def fields(found, struct):
    """The fields of a struct, in the sections of the list."""
    lines = []
    for group in found.groups:
        section = [p for p in group.parameters if p.in_engine and struct_of(p) == struct]
        if not section:
            continue
        lines += ["", f"// {group.title}"]
        for parameter in section:
            symbol = f"{parameter.symbol}: " if parameter.symbol else ""
            lines += wrapped(symbol + parameter.short, "/// ")
            value = literal(parameter, parameter.default)
            lines.append(f"{engine_type(parameter)} {parameter.field} = {value};")
    return lines[1:]


def table(found):
    """An entry for each parameter of a run."""
    lines = []
    for parameter in found.parameters:
        if not parameter.in_engine or struct_of(parameter) != "Parameters":
            continue
        values = [
            f'.name = "{parameter.name}"',
            f".place = &Parameters::{parameter.field}",
            f".thesis = {literal(parameter, parameter.thesis)}",
            f".range = {{ {cpp_double(parameter.low)}, {cpp_double(parameter.high)} }}",
        ]
        if parameter.fuzz:
            low, high = (cpp_double(end) for end in parameter.fuzz)
            values.append(f".tried = ParameterRange{{ {low}, {high} }}")
        if parameter.in_preset:
            values.append(".isInPreset = true")
        if parameter.result is False:
            values.append(".changesResult = false")
        lines += packed(f"use(ParameterEntry<{engine_type(parameter)}>{{", values, "});")
    return lines
