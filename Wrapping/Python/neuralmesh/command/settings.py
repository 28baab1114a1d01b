# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of learning, for --set."""

from __future__ import annotations

from typing import Any

from .._list import PROPERTIES
from .._parameters import hint, snake_case
from .._property import Property
from .parsing import UsageError, parsed

_NAME_WIDTH, _DEFAULT_WIDTH, _RANGE_WIDTH = 25, 7, 18  # of the columns of the table
_SWITCH = ("off", "on")
_LARGEST_COUNT = 2**63 - 1
_MOST_EXACT = 2.0**53  # up to there a double has all digits of an integer

SETTINGS = {one.name: one for one in PROPERTIES if one.option is None}


def set_parameter(mesh: Any, assignment: str) -> None:
    """Carry out --set NAME=VALUE. Raises UsageError."""
    name, equals, text = assignment.partition("=")
    if not equals or not name:
        raise UsageError(f"--set {assignment}: expected NAME=VALUE")
    if name not in SETTINGS:
        advice = f"{hint(name, SETTINGS)} 'neuralmesh reconstruct --help' lists them all".lstrip()
        raise UsageError(f"--set: there is no parameter {_one_line(name)}; {advice}")
    one = SETTINGS[name]
    value = _value_of(text, one)
    if value is None or not one.low <= value <= one.high:
        raise UsageError(f"--set {name}={_one_line(text)}: {name} must be {_wanted(one)}")
    if not hasattr(mesh, f"Set{name}"):
        raise UsageError(f"--set {name} goes with --ensemble")
    getattr(mesh, f"Set{name}")(value)


def table() -> str:
    """A line for each parameter."""
    lines = [_line("name", "default", "range", "what it is")]
    for one in SETTINGS.values():
        words = _words(one)
        if words and words != list(_SWITCH):
            text = f"{one.short}: {' or '.join(words)}; {words[int(one.default)]} by default"
            lines.append(f"  {one.name:{_NAME_WIDTH}}{text}\n")
        else:
            default = words[int(one.default)] if words else shown(one.default, one)
            lines.append(_line(one.name, default, f"{_range(one)} ", one.short))
    return "".join(lines)


def shown(value: float, one: Property) -> str:
    """In full, unless a number has more digits than anybody wants to see."""
    if one.kind != "double":
        return str(int(value))
    return f"{value:.15g}" if value == int(value) else f"{value:.4g}"


def _line(name: str, default: str, ends: str, text: str) -> str:
    return f"  {name:{_NAME_WIDTH}}{default:{_DEFAULT_WIDTH}} {ends:{_RANGE_WIDTH - 1}}{text}\n"


def _words(one: Property) -> list[str]:
    if one.kind == "bool":
        return list(_SWITCH)
    return [snake_case(name) for name, _ in one.values]


def _range(one: Property) -> str:
    if one.kind == "bool":
        return " or ".join(_SWITCH)
    if one.kind == "count" and one.high == _LARGEST_COUNT:
        return f"from {shown(one.low, one)} on"
    return f"{shown(one.low, one)} to {shown(one.high, one)}"


def _wanted(one: Property) -> str:
    words = _words(one)
    if words:
        return " or ".join(words)
    kind = "a number" if one.kind == "double" else "an integer"
    return f"{kind} from {shown(one.low, one)} to {shown(one.high, one)}"


def _value_of(text: str, one: Property) -> float | int | None:
    """The value that a text stands for, if it is one of the type."""
    words = _words(one)
    if text in words:
        return words.index(text)
    if one.kind == "bool" and text in ("true", "false"):
        return int(text == "true")
    # The parameters of the program take no plus, either.
    if text.startswith("+"):
        return None
    if one.kind == "double":
        return parsed(text, False)
    whole = parsed(text, True)
    if whole is not None:
        return whole
    # 1e6 is as good as 1000000.
    number = parsed(text, False)
    is_exact = number is not None and abs(number) <= _MOST_EXACT and number == int(number)
    return int(number) if is_exact else None


def _one_line(text: str) -> str:
    return "".join(sign if sign.isprintable() else "?" for sign in text)
