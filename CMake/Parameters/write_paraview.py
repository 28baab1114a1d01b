# SPDX-License-Identifier: BSD-3-Clause
"""What the ParaView plugin has of the list: properties of proxies, and the groups of the panel."""

import re
from xml.sax.saxutils import escape, quoteattr

from parameter_list import spaced
from text import wrapped

# A longer range gives no slider: nobody could aim.
LARGEST_SLIDER = 1000


def number(value):
    """As ParaView shows it."""
    return str(int(value)) if value == int(value) else repr(float(value))


def plain_sentences(found, parameter):
    """The text with the labels of the panel, without numbers of figures and equations of the thesis."""
    text = parameter.text
    if parameter.choice:
        values = (f"{spaced(value.name)}: {value.text}." for value in parameter.choice.values)
        text = " ".join([text, *values])
    for other in found.parameters:
        text = re.sub(rf"\b{other.name}\b", spaced(other.name), text)
    return re.sub(r" \((?:Algorithm |Figure |chapter )?\d+(?:\.\d+)*\)", "", text)


def sentences(found, parameter):
    """The same for XML."""
    return escape(plain_sentences(found, parameter))


def domain(parameter):
    if parameter.type == "bool":
        return ['<BooleanDomain name="bool" />']
    if parameter.choice:
        entries = (
            f'  <Entry value="{i}" text="{spaced(value.name)}" />'
            for i, value in enumerate(parameter.choice.values)
        )
        return ['<EnumerationDomain name="enum">', *entries, "</EnumerationDomain>"]
    kind = "Double" if parameter.type == "double" else "Int"
    high = f' max="{number(parameter.high)}"' if parameter.high <= LARGEST_SLIDER else ""
    low = number(0 if parameter.zero else parameter.low)
    return [f'<{kind}RangeDomain name="range" min="{low}"{high} />']


def decorator(name, value, is_not):
    inverse = ' inverse="1"' if is_not else ""
    return [
        '<PropertyWidgetDecorator type="GenericDecorator" mode="visibility"',
        f'  property="{name}" value="{value}"{inverse} />',
    ]


def conditions(found, parameter):
    """When the panel shows the property: the parameter, the number, and whether it must not be that."""
    variants = found.choice("Variant")
    if len(parameter.variants or ()) == 1:
        yield "Variant", variants.index(parameter.variants[0]), False
    elif parameter.variants:
        # All conditions must hold: so it is none of the others.
        for i, variant in enumerate(variants.values):
            if variant.name not in parameter.variants:
                yield "Variant", i, True
    for condition in parameter.when or ():
        name, is_not, value = re.fullmatch(r"(\w+) is (not )?(\w+)", condition).groups()
        other = found.parameter(name)
        if other.choice:
            yield name, other.choice.index(value), bool(is_not)
        else:
            yield name, {"on": 1, "off": 0}.get(value, value), bool(is_not)


def one_property(found, parameter, default=None):
    """The property of a proxy; with another default it stands in for that of the proxy's base."""
    kind = "Double" if parameter.type == "double" else "Int"
    value = default or number(parameter.number(parameter.default))
    attributes = f'  number_of_elements="1" default_values="{value}"'
    if default:
        attributes += ' override="1"'
    if parameter.panel != "shown":
        attributes += ' panel_visibility="advanced"'
    lines = [
        f'<{kind}VectorProperty name="{parameter.name}" command="Set{parameter.name}"',
        attributes + ">",
        *("  " + line for line in domain(parameter)),
        "  <Documentation>",
        *("    " + line for line in wrapped_text(sentences(found, parameter))),
        "  </Documentation>",
    ]
    hints = [line for condition in conditions(found, parameter) for line in decorator(*condition)]
    if hints:
        lines += ["  <Hints>", *("    " + line for line in hints), "  </Hints>"]
    return [*lines, f"</{kind}VectorProperty>"]


def wrapped_text(text):
    """Lines that have room for the indentation."""
    return [line[10:] for line in wrapped(text, " " * 10)]


def properties(found, *keys):
    """The properties of groups."""
    return [
        line for key in keys for parameter in found.group(key, "properties").parameters
        for line in one_property(found, parameter)
    ]


def override(found, name, default):
    """A property with another default."""
    return one_property(found, found.parameter(name), default)


def panel(found, *words):
    """The group of the panel in which groups of the list stand; +NAME is a property of the template."""
    groups = [found.group(word, "panel") for word in words if not word.startswith("+")]
    labels = {group.panel for group in groups}
    if len(labels) != 1 or None in labels:
        keys = ", ".join(group.key for group in groups)
        raise found.error(f"the template of the panel has the groups {keys} in one, their panel is another")
    by_key = {group.key: group for group in groups}
    names = [
        name for word in words
        for name in ([word[1:]] if word.startswith("+") else [p.name for p in by_key[word].parameters])
    ]
    return [
        f"<PropertyGroup label={quoteattr(labels.pop())}>",
        *(f'  <Property name="{name}" />' for name in names),
        "</PropertyGroup>",
    ]
