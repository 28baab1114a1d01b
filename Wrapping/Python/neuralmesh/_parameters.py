# SPDX-License-Identifier: BSD-3-Clause
"""The properties of a VTK class as keyword parameters, found in the class itself."""

from __future__ import annotations

import difflib
import functools
import inspect
import numbers
import re
import textwrap
from dataclasses import dataclass
from typing import Any, Callable, Mapping

import numpy as np

# What other libraries call it, PyVista, Open3D, PyMeshLab and Trimesh among them: in lower case, without
# underscores.
_WORDS_OF_OTHERS = {
    "vertices": (
        "nvertices", "npoints", "nverts", "numvertices", "numpoints", "numberofvertices",
        "numberofpoints", "vertexcount", "targetvertices", "targetpoints", "targetnumberofvertices",
        "targetnumberofpoints", "targetvertnum", "targetverts", "nclus",
    ),
    "seed": ("randomstate", "randomseed", "rng"),
    "ensemble": ("numberofmembers", "nmembers", "members"),
    "progress": ("progressbar", "callback", "progresscallback"),
    "number_of_threads": ("threads", "nthreads", "numthreads", "njobs", "workers"),
    "time_limit": ("timeout", "maxtime", "maxseconds", "seconds"),
    "first_mesh": ("initialmesh", "init", "template", "initmesh"),
    "viewpoints": (
        "viewpos", "cameralocation", "cameraposition", "sensororigin",
    ),
    "up": ("updirection", "orientationreference", "viewup"),
    "weights": ("confidence", "weightarray"),
    "close_holes_below": ("holesize", "maxholesize", "fillholes"),
    "fit_smoothness": ("smooth", "smoothing"),
    "carry_point_data": ("passpointdata",),
}  # fmt: skip
_WORDS_FOR_TRIANGLES = (
    "nfaces", "ncells", "ntriangles", "numtriangles", "numfaces", "targetfaces", "targetfacenum",
    "targettriangles", "targetnumberoftriangles", "numberoftriangles", "facecount", "triangles", "faces",
)  # fmt: skip


@dataclass(frozen=True)
class Number:
    """A property with a range: SetX, GetXMinValue and GetXMaxValue."""

    setter: str
    default: float
    minimum: float
    maximum: float
    takes_zero: bool = False  # 0 is a value, too, and below the range

    @property
    def integral(self) -> bool:
        return isinstance(self.default, int)

    def accepts(self, value: Any) -> bool:
        is_number = isinstance(value, numbers.Real) and not isinstance(value, bool)
        return (
            is_number
            and bool(
                self.minimum <= value <= self.maximum or (self.takes_zero and value == 0)
            )
            and (not self.integral or value == int(value))
        )

    def assign(self, vtk_object: Any, value: Any) -> None:
        getattr(vtk_object, self.setter)(int(value) if self.integral else float(value))

    def __str__(self) -> str:
        kind = "an integer" if self.integral else "a number"
        zero = ", or 0" if self.takes_zero else ""
        return f"{kind} from {_plain(self.minimum)} to {_plain(self.maximum)}{zero}"


@dataclass(frozen=True)
class Switch:
    """A property with SetX, XOn and XOff."""

    setter: str
    default: bool

    def accepts(self, value: Any) -> bool:
        return isinstance(value, (numbers.Integral, np.bool_)) and value in (0, 1)

    def assign(self, vtk_object: Any, value: Any) -> None:
        getattr(vtk_object, self.setter)(int(value))

    def __str__(self) -> str:
        return "True or False"


@dataclass(frozen=True)
class Choice:
    """A property with SetXToA, SetXToB and so on; its values are "a", "b" and so on."""

    setters: Mapping[str, str]
    default: str

    def accepts(self, value: Any) -> bool:
        return isinstance(value, str) and len(self._meant(value)) == 1

    def assign(self, vtk_object: Any, value: Any) -> None:
        (name,) = self._meant(value)
        getattr(vtk_object, self.setters[name])()

    def _meant(self, value: str) -> list[str]:
        """The value itself, or those that begin so."""
        if value in self.setters:
            return [value]
        return [name for name in self.setters if name.startswith(value)]

    def __str__(self) -> str:
        return " or ".join(repr(name) for name in self.setters)


Parameter = Number | Switch | Choice


@functools.lru_cache(maxsize=None)
def parameters_of(vtk_class: type) -> dict[str, Parameter]:
    """The parameters that the classes of this package add to those of VTK: names in snake case."""
    found = {}
    for method in _own_methods(vtk_class):
        name = method[len("Set") :]
        if method.startswith("Set") and hasattr(vtk_class, "Get" + name):
            parameter = _parameter(vtk_class, name)
            if parameter is not None:
                found[snake_case(name)] = parameter
    return found


def assign(
    vtk_object: Any, name: str, value: Any, shown_name: str = "", or_else: str = ""
) -> None:
    """Set a property by the name of its parameter; ValueError says what it may be.

    In the message shown_name is what the parameter is called, where that differs, and or_else a word that
    the caller takes, too.
    """
    parameter = parameters_of(vtk_object.__class__)[name]
    if not parameter.accepts(value):
        other = f', or "{or_else}"' if or_else else ""
        raise ValueError(f"{shown_name or name} must be {parameter}{other}, not {value!r}")
    parameter.assign(vtk_object, value)


def refuse_unknown(function: Callable[..., Any], names: Any, known: Any) -> None:
    """Raise TypeError for the first of the names that is not known, with those that are near."""
    for name in names:
        if name not in known:
            near = hint(name, [*_named(function), *known])
            advice = f"{near} help(neuralmesh.{function.__name__}) lists them all".lstrip()
            raise TypeError(
                f"{function.__name__}() got an unexpected keyword argument '{name}'; {advice}"
            )


def _named(function: Callable[..., Any]) -> list[str]:
    """The names of its arguments, except for the one that takes all others."""
    parameters = inspect.signature(function).parameters.values()
    return [
        parameter.name for parameter in parameters if parameter.kind is not parameter.VAR_KEYWORD
    ]


def hint(name: str, known: Any) -> str:
    """A question with the known names that are similar to this one, or are other words for it. Empty if
    there are none.
    """
    word = name.lower().replace("_", "")
    if word in _WORDS_FOR_TRIANGLES and "vertices" in known:
        return "did you mean vertices? They are about half as many as triangles."
    meant = [other for other in known if word in _WORDS_OF_OTHERS.get(other, ())]
    if meant:
        return f"did you mean {' or '.join(meant)}?"
    by_lower_case = {other.lower(): other for other in known}
    near = difflib.get_close_matches(name.lower(), by_lower_case)
    return f"did you mean {' or '.join(by_lower_case[other] for other in near)}?" if near else ""


def with_table(documentation: str, parameters: Mapping[str, Parameter]) -> str:
    """A docstring that has the table in the place of {table}. From Python 3.13 on, docstrings come without
    the indentation that their lines share.
    """
    return re.sub(
        r"^( *)\{table\}\n",
        lambda found: textwrap.indent(_table(parameters), found[1]),
        documentation,
        flags=re.MULTILINE,
    )


def _table(parameters: Mapping[str, Parameter]) -> str:
    """A line for each parameter: its name, its default, and what it may be."""
    width = max(map(len, parameters))
    return "".join(
        f"            {name:{width}}  {_plain(parameter.default):12}  {parameter}\n"
        for name, parameter in parameters.items()
    )


def _own_methods(vtk_class: type) -> list[str]:
    """The methods of a class and of its superclasses up to those of VTK."""
    ours = [
        cls
        for cls in vtk_class.__mro__
        if cls.__name__.removeprefix("vtk").startswith("NeuralMesh")
    ]
    return [method for cls in ours for method in vars(cls)]


def _parameter(vtk_class: type, name: str) -> Parameter | None:
    prototype = vtk_class()
    beginning = f"Set{name}To"
    choosers = [method for method in _own_methods(vtk_class) if method.startswith(beginning)]
    if choosers:
        setters = {snake_case(method[len(beginning) :]): method for method in choosers}
        return Choice(setters, _chosen(vtk_class, name, setters))
    if hasattr(vtk_class, name + "On"):
        return Switch("Set" + name, bool(getattr(prototype, "Get" + name)()))
    if hasattr(vtk_class, f"Get{name}MinValue"):
        minimum = getattr(prototype, f"Get{name}MinValue")()
        maximum = getattr(prototype, f"Get{name}MaxValue")()
        default = getattr(prototype, "Get" + name)()
        takes_zero = hasattr(vtk_class, f"Get{name}TakesZero")
        return Number("Set" + name, default, minimum, maximum, takes_zero)
    return None


def _chosen(vtk_class: type, name: str, setters: Mapping[str, str]) -> str:
    """Which of the values a new object has."""
    getter = "Get" + name
    for value, setter in setters.items():
        other = vtk_class()
        getattr(other, setter)()
        if getattr(other, getter)() == getattr(vtk_class(), getter)():
            return value
    raise AssertionError(f"{vtk_class.__name__}: no Set{name}To... gives the default")


def snake_case(name: str) -> str:
    """MeanOfRMS99 as mean_of_rms_99."""
    words = re.findall(r"[A-Z]+(?![a-z])|[A-Z][a-z]+|[0-9]+", name)
    return "_".join(words).lower()


def _plain(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)
