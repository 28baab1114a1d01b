# SPDX-License-Identifier: BSD-3-Clause
"""Properties of the classes of this package, and their methods as in VTK."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable

_NO_END = 10**9  # from there on nobody minds the end of a range


@dataclass(frozen=True)
class Property:
    """A number that is set on a class: SetX, GetX, GetXMinValue and GetXMaxValue."""

    name: str
    kind: str  # "int", "count", "double", "bool", or "choice"
    default: int | float
    low: int | float
    high: int | float
    takes_zero: bool = False  # 0 is a value, too, and below the range
    owner: str = ""  # the class that has it
    engine: bool = True  # whether the engine knows it
    in_preset: bool = False
    values: tuple[tuple[str, str], ...] = ()  # of a choice: names, and names of the constants
    panel: str = ""  # the group of ParaView's panel
    is_shown: bool = True  # there at first
    conditions: tuple[tuple[str, Any, bool], ...] = ()  # when the panel shows it
    option: str | None = None  # of the command; "" for none, None for --set
    short: str = ""
    text: str = ""

    def clamped(self, value: Any, before: int | float | None = None) -> int | float:
        """The value that SetX sets. NaN does not change it."""
        if self.kind == "double":
            number: int | float = float(value)
            if number != number:
                return self.low if before is None else before
            return min(max(number, self.low), self.high)
        number = int(value)
        if number == 0 and self.takes_zero:
            return 0
        return min(max(number, int(self.low)), int(self.high))

    def warning(self, value: Any, used: int | float) -> str:
        """The warning if another value than the given one is used; empty if it is used."""
        if value == used:
            return ""
        shown = "%g" if self.kind == "double" else "%d"
        low, high, given, clamped = (shown % one for one in (self.low, self.high, value, used))
        zero = ", or 0" if self.takes_zero else ""
        return f"{self.name} must be from {low} to {high}{zero}: not {given} but {clamped} is used."

    def documentation(self) -> str:
        """What it does, its default and its range."""
        if self.values:
            return self.text
        number = "%.15g" if self.kind == "double" else "%d"
        low, high, default = (number % one for one in (self.low, self.high, self.default))
        ends = f", at least {low}" if self.high >= _NO_END else f", range {low} to {high}"
        if self.kind == "bool":
            ends, default = "", "on" if self.default else "off"
        return f"{self.text} Default {default}{ends}.".strip()

    def methods(self) -> dict[str, Callable[..., Any]]:
        """The methods, by their names, of a class that has _values, _warn() and Modified()."""
        name = self.name

        def set_value(this: Any, value: Any) -> None:
            clamped = self.clamped(value, this._values[name])
            warning = self.warning(value, clamped)
            if warning:
                this._warn(warning)
            if this._values[name] != clamped:
                this._values[name] = clamped
                this.Modified()

        def get_value(this: Any) -> int | float:
            return this._values[name]

        made: dict[str, Callable[..., Any]] = {f"Set{name}": set_value, f"Get{name}": get_value}
        # The ends of choices and switches are not asked for: they have methods of their own.
        made[f"Get{name}MinValue"] = lambda this: self.low
        made[f"Get{name}MaxValue"] = lambda this: self.high
        if self.takes_zero:
            made[f"Get{name}TakesZero"] = lambda this: True
        if self.kind == "bool":
            made[f"{name}On"] = lambda this: set_value(this, 1)
            made[f"{name}Off"] = lambda this: set_value(this, 0)
        for number, (value_name, _) in enumerate(self.values):
            made[f"Set{name}To{value_name}"] = lambda this, number=number: set_value(this, number)
        for method_name, method in made.items():
            method.__name__ = method_name
            method.__doc__ = self.documentation()
        return made


def with_properties(*properties: Property) -> Callable[[type], type]:
    """A decorator that gives a class the methods of properties, and their constants.

    The class keeps them in _values, of which new_values() makes the first.
    """

    def decorate(cls: type) -> type:
        for one in properties:
            for name, method in one.methods().items():
                setattr(cls, name, method)
            for number, (_, constant) in enumerate(one.values):
                if constant:
                    setattr(cls, constant, number)
        inherited = getattr(cls, "PROPERTIES", {})
        setattr(cls, "PROPERTIES", {**inherited, **{one.name: one for one in properties}})
        return cls

    return decorate


def new_values(cls: type) -> dict[str, int | float]:
    """The defaults of all properties of a class."""
    return {one.name: one.clamped(one.default) for one in getattr(cls, "PROPERTIES").values()}
