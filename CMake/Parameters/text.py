# SPDX-License-Identifier: BSD-3-Clause
"""How values and sentences of the list are written down."""

import re
import textwrap

from parameter_list import spaced

# Of a line, less the indentation where templates have places for them.
WIDTH = 98
# As VTK names them.
VTK_ENDS = {2**31 - 1: "VTK_INT_MAX", 2**32 - 1: "VTK_UNSIGNED_INT_MAX", 2**63 - 1: "VTK_ID_MAX"}


def wrapped(text, prefix, first=None):
    """Lines of a paragraph, each with a prefix; the first one may have another."""
    return textwrap.wrap(
        text, WIDTH, initial_indent=prefix if first is None else first, subsequent_indent=prefix,
        break_long_words=False, break_on_hyphens=False,
    )


def packed(begin, items, end):
    """Items with commas between them: on one line, or on the next one, or on one each."""
    whole = f"{', '.join(items)} {end}"
    if len(begin) + len(whole) < WIDTH:
        return [f"{begin} {whole}"]
    if len(whole) + 2 <= WIDTH:
        return [begin, "  " + whole]
    return [f"{begin} {items[0]},", *(f"  {item}," for item in items[1:-1]), f"  {items[-1]} {end}"]


def shown(parameter, value):
    """A value for people."""
    if parameter.type == "bool":
        return "on" if value else "off"
    if parameter.choice:
        return spaced(value).lower()
    if isinstance(value, str):
        return value
    if parameter.type == "double" and abs(value) >= 1e9:
        return f"{value:.0e}".replace("e+0", "e")
    return str(int(value)) if value == int(value) else repr(value)


def cpp_double(value):
    """A literal of the core."""
    if isinstance(value, str):
        over, under = value.split("/")
        return f"{over}. / {under}."
    if value >= 1e6 and re.fullmatch("1e[+]0?(\\d)", f"{value:.0e}") and float(f"{value:.0e}") == value:
        return f"{value:.0e}".replace("e+0", "e")
    return f"{int(value)}." if value == int(value) else repr(value)


def vtk_number(parameter, value):
    """A literal of the headers of VTK."""
    if parameter.choice:
        return parameter.choice.values[value].constant
    if parameter.type != "double":
        return VTK_ENDS.get(value, str(value))
    # As VTK writes them: 1.0, not 1.
    return re.sub(r"\.(?!\d)", ".0", cpp_double(value))


def listed(words, last):
    """Words with commas and a last conjunction."""
    return " ".join([", ".join(words[:-1]), last, words[-1]]) if len(words) > 1 else words[0]


def variant_words(parameter):
    """For which variants it is: "basic and noise-filtering variant"."""
    words = [spaced(name).replace(" ", "-").lower() for name in parameter.variants]
    return listed(words, "and") + " variant"


def condition_words(condition, found):
    """A condition for the reader of a header."""
    name, is_not, value = re.fullmatch(r"(\w+) is (not )?(\w+)", condition).groups()
    if value in ("on", "off"):
        return ("with " if (value == "on") != bool(is_not) else "without ") + name
    choice = found.parameter(name).choice
    shown_value = choice.values[choice.index(value)].constant if choice else value
    return f"unless {name} is {shown_value}" if is_not else f"with {name} {shown_value}"


def begun_small(text):
    """A sentence as it goes on behind a colon; a name like RemovalLimit stays."""
    word = re.match(r"\w+", text)[0]
    return text if word[1:] != word[1:].lower() else text[0].lower() + text[1:]


def range_words(parameter):
    """The range in words; of one that ends with the type, or far off, the beginning comes first."""
    low, high = (shown(parameter, end) for end in (parameter.low, parameter.high))
    if parameter.is_open:
        return f"at least {low}"
    is_far = parameter.type != "double" and parameter.high >= 1e9
    return f"at least {low}, at most {high}" if is_far else f"range {low} to {high}"


def default_sentence(parameter):
    """Default, thesis and range, where the values themselves are not listed."""
    if parameter.choice:
        return ""
    thesis = ""
    if parameter.thesis_text:
        thesis = f" (thesis: {parameter.thesis_text})"
    elif parameter.in_preset:
        thesis = f" (thesis {shown(parameter, parameter.thesis)})"
    ends = "" if parameter.type == "bool" else ", " + range_words(parameter)
    return f"Default {shown(parameter, parameter.default)}{thesis}{ends}."
