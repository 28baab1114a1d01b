# SPDX-License-Identifier: BSD-3-Clause
"""What the Python package has of the list: the properties, as entries of a tuple."""

import write_paraview

LONGEST = 100


def entry(found, group, parameter):
    """A call of Property() with what it must know."""
    values = {
        "name": parameter.name,
        "kind": "choice" if parameter.choice else parameter.type,
        "default": parameter.number(parameter.default),
        "low": end(parameter, parameter.low),
        "high": end(parameter, parameter.high),
        "takes_zero": bool(parameter.zero),
        "owner": parameter.owner,
        "engine": parameter.in_engine,
        "in_preset": parameter.in_preset,
        "values": tuple((value.name, value.constant) for value in parameter.choice.values)
        if parameter.choice else (),
        "panel": group.panel or "",
        "is_shown": parameter.panel == "shown",
        "conditions": tuple(write_paraview.conditions(found, parameter)),
        "option": parameter.command if parameter.command is not None else None,
        "short": parameter.short,
        "text": write_paraview.plain_sentences(found, parameter),
    }
    return ["Property(", *(line for name, value in values.items() for line in one(name, value)), "),"]


def end(parameter, value):
    """An end of the range, an integer where the property is one."""
    return value if parameter.type == "double" else int(value)


def one(name, value):
    """A line for an argument, or several where a text is long."""
    line = f"    {name}={value!r},"
    if len(line) <= LONGEST or not isinstance(value, str):
        return [line]
    words, parts = value.split(" "), [""]
    for word in words:
        if len(repr(parts[-1] + word)) > LONGEST - 12:
            parts.append("")
        parts[-1] += word + " "
    parts[-1] = parts[-1][:-1]
    return [f"    {name}=(", *(f"        {part!r}" for part in parts), "    ),"]


def properties(found):
    """All of the list, in its order."""
    return [
        line for group in found.groups for parameter in group.parameters
        for line in entry(found, group, parameter)
    ]
