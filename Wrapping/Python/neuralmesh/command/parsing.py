# SPDX-License-Identifier: BSD-3-Clause
"""Options as the program neuralmesh has them: what they take, and what is said where they are wrong."""

from __future__ import annotations

import argparse
import re
import sys
from typing import Any, Callable, NoReturn, Sequence

from .._list import PROPERTIES
from .._parameters import hint, snake_case
from .._property import Property

WRONG_USE = 2
_LARGEST_INT = 2**31 - 1
_LARGEST_COUNT = 2**63 - 1
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?inf(inity)?", re.IGNORECASE)
_INTEGER = re.compile(r"[+-]?\d+")

_BY_NAME = {one.name: one for one in PROPERTIES}


class UsageError(Exception):
    """Wrong use that the parser cannot see."""


def property_of(name: str) -> Property:
    """A property by its name."""
    return _BY_NAME[name]


class Parser(argparse.ArgumentParser):
    """The options of a subcommand."""

    def __init__(self, name: str, description: str, usage: str, footer: str = "") -> None:
        super().__init__(
            prog=f"neuralmesh {name}",
            usage=f"neuralmesh {name} [OPTIONS] {usage}",
            description=description,
            epilog=footer,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )

    def parse(self, arguments: Sequence[str]) -> argparse.Namespace:
        """The arguments; names and options may be in any order."""
        return self.parse_intermixed_args(self._joined(arguments))

    def _joined(self, arguments: Sequence[str]) -> list[str]:
        """Options with their values in one word, as a value may begin with a minus."""
        with_value = {
            option: action
            for action in self._actions
            for option in action.option_strings
            if action.nargs is None
        }
        joined: list[str] = []
        rest = list(arguments)
        while rest:
            word = rest.pop(0)
            if word == "--":
                return [*joined, word, *rest]
            is_followed = (
                bool(rest) and rest[0].partition("=")[0] not in self._option_string_actions
            )
            if word in with_value and is_followed:
                word += "=" + rest.pop(0)
            joined.append(word)
        return joined

    def error(self, message: str) -> NoReturn:
        text = message.removeprefix("argument ")
        names = text.removeprefix("the following arguments are required: ")
        if names != text:
            text = f"{names.split(', ')[0]} is required"
        unknown = text.removeprefix("unrecognized arguments: ")
        if unknown != text:
            text = f"The following argument was not expected: {unknown}{self._hints(unknown)}"
        option, expected, _ = text.partition(": expected one argument")
        if expected:
            metavar = self._option_string_actions[option].metavar
            text = f"{option}: 1 required {metavar} missing"
        print(f"{text}\nRun with --help for more information.", file=sys.stderr)
        sys.exit(WRONG_USE)

    def _hints(self, unknown: str) -> str:
        """A line for each option that does not exist, with those that have a name like that."""
        known = [option for option in self._option_string_actions if option.startswith("--")]
        lines = ""
        for word in unknown.split():
            name = word.partition("=")[0]
            question = hint(name, known) if name.startswith("--") else ""
            lines += f"\n{name}: {question}" if question else ""
        return lines

    def add_number(self, option: str, name: str, text: str, metavar: str, **more: Any) -> None:
        """An option for a property, with its default."""
        self.add_argument(
            option,
            type=number_within(property_of(name)),
            default=property_of(name).default,
            metavar=metavar,
            help=text.replace("%", "%%"),
            **more,
        )

    def add_choice(self, option: str, words: Sequence[str], default: Any, text: str) -> None:
        """An option that takes a word for a number from 0 on."""

        def value_of(word: str) -> int:
            if word not in words:
                raise argparse.ArgumentTypeError(f"{word} is none of {'|'.join(words)}")
            return list(words).index(word)

        self.add_argument(
            option, type=value_of, default=default, metavar="|".join(words), help=text
        )

    def add_text(self, option: str, text: str, metavar: str, **more: Any) -> None:
        """An option that takes anything."""
        more.setdefault("default", "")
        self.add_argument(option, metavar=metavar, help=text, **more)

    def add_flag(self, option: str, text: str) -> None:
        """A switch."""
        self.add_argument(option, action="store_true", help=text)


def number_within(one: Property) -> Callable[[str], Any]:
    """What makes a number of a property of a text."""
    return number_from(one.low, one.high, one.kind != "double")


def number_from(low: float, high: float, is_integer: bool) -> Callable[[str], Any]:
    """What makes a number of a text, within both ends."""

    def convert(text: str) -> Any:
        value = parsed(text, is_integer)
        if value is None or not low <= value <= high:
            kind = "integer" if is_integer else "number"
            raise argparse.ArgumentTypeError(
                f"{text} is no {kind} from {plain(low)} to {plain(high)}"
            )
        return value

    return convert


def parsed(text: str, is_integer: bool) -> Any:
    """All of a text as a number; None if it is none."""
    if is_integer:
        return int(text) if _INTEGER.fullmatch(text) else None
    return float(text) if _NUMBER.fullmatch(text) else None


def plain(value: float) -> str:
    """A number in full where that is short."""
    return str(value) if isinstance(value, int) else f"{value:.10g}"


def range_text(one: Property) -> str:
    """From where to where."""
    is_open = (one.kind == "int" and one.high == _LARGEST_INT) or one.high == _LARGEST_COUNT
    low, high = (plain(end) for end in (one.low, one.high))
    return f"from {low} on" if is_open else f"{low} to {high}"


def described(name: str) -> str:
    """What tells the range of an option for a property, and what holds without it."""
    one = property_of(name)
    return f"{range_text(one)} (default {plain(one.default)})"


def words_of(name: str) -> list[str]:
    """The words of a choice in the command: the first ones of its names."""
    return [snake_case(value).split("_")[0] for value, _ in property_of(name).values]


def described_words(texts: dict[str, str], default: str) -> str:
    """Words, and what each stands for."""
    # A word may say itself that it is the default.
    return "; ".join(
        word
        + (" (default)" if word == default != "default" else "")
        + (f": {text}" if text else "")
        for word, text in texts.items()
    )


def three_numbers(text: str) -> tuple[float, float, float] | None:
    """X,Y,Z as options have it; None for anything else."""
    numbers = [parsed(word, False) for word in text.split(",")]
    if len(numbers) != 3 or any(one is None or abs(one) == float("inf") for one in numbers):
        return None
    x, y, z = numbers
    return (x, y, z)
