# SPDX-License-Identifier: BSD-3-Clause
"""What all classes that learn have in common: vtkNeuralMeshAlgorithm without VTK."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .. import _engine
from .._list import PROPERTIES
from .._property import Property, new_values, with_properties
from .cloud import Cloud

_NO_VIEW = 2**32 - 1


def of_class(*owners: str) -> list[Property]:
    """The properties of the list that classes have."""
    return [one for one in PROPERTIES if one.owner in owners]


def of_name(*names: str) -> list[Property]:
    """The properties of the list with these names."""
    return [one for one in PROPERTIES if one.name in names]


@with_properties(*of_class("vtkNeuralMeshAlgorithm"))
class NeuralMeshAlgorithm:
    """The parameters of learning, and what a user knows of the outer side.

    A class that is none of VTK has no Modified() of its own: then nothing is behind it.
    """

    PROPERTIES: dict[str, Property]
    DEFAULT, THESIS = 0, 1  # presets

    def __init__(self) -> None:
        self._values = new_values(type(self))
        self._preset = self.DEFAULT
        self._viewpoints: list[tuple[float, float, float]] = []
        self._view_array_name = ""
        self._normal_array_name = ""
        self._up_direction = (0.0, 0.0, 0.0)

    def Modified(self) -> None:
        """Called when a property changes. The classes for pipelines have that of VTK."""

    def _warn(self, text: str) -> None:
        """Called with a warning about a property."""

    def SetPreset(self, preset: int) -> None:
        """Set all properties that a preset has to its values for the Variant and Order as they are."""
        self._preset = min(max(int(preset), self.DEFAULT), self.THESIS)
        if preset != self._preset:
            self._warn(
                f"Preset must be DEFAULT or THESIS: not {preset} but {self._preset} is used."
            )
        variant, order = int(self._values["Variant"]), int(self._values["Order"])
        values = _engine.preset(self._preset, variant, order)
        if any(self._values[name] != value for name, value in values.items()):
            self._values.update(
                {name: self.PROPERTIES[name].clamped(v) for name, v in values.items()}
            )
            self.Modified()

    def GetPreset(self) -> int:
        """The preset that was set last."""
        return self._preset

    def SetPresetToDefault(self) -> None:
        """What measures best."""
        self.SetPreset(self.DEFAULT)

    def SetPresetToThesis(self) -> None:
        """The thesis's own values."""
        self.SetPreset(self.THESIS)

    def SetViewpoint(self, *place: Any) -> None:
        """Where the scanner stood, three numbers: the only viewpoint."""
        if self._viewpoints != [three(place)]:
            self._viewpoints = [three(place)]
            self.Modified()

    def AddViewpoint(self, *place: Any) -> None:
        """One more place where it stood."""
        self._viewpoints.append(three(place))
        self.Modified()

    def RemoveAllViewpoints(self) -> None:
        """No viewpoint is known."""
        if self._viewpoints:
            self._viewpoints.clear()
            self.Modified()

    @staticmethod
    def GetNumberOfAvailableProcessors() -> int:
        """How many threads can run at the same time, by the affinity and the CPU quota of this process."""
        return _engine.available_processors()

    def GetNumberOfViewpoints(self) -> int:
        """How many there are."""
        return len(self._viewpoints)

    def GetViewpoint(self, number: int, place: Any = None) -> Any:
        """One of them, written into `place` where that is given; NaN for numbers that there are not."""
        is_there = 0 <= number < len(self._viewpoints)
        found = self._viewpoints[number] if is_there else (math.nan,) * 3
        if place is None:
            return found
        place[:] = found
        return None

    def SetViewArrayName(self, name: str | None) -> None:
        """The point array that names the viewpoint of each point, from 0 on."""
        if self._view_array_name != (name or ""):
            self._view_array_name = name or ""
            self.Modified()

    def GetViewArrayName(self) -> str:
        """Empty if there is none: then it is `View`, if there is one."""
        return self._view_array_name

    def SetNormalArrayName(self, name: str | None) -> None:
        """The point array of three components that has the normals."""
        if self._normal_array_name != (name or ""):
            self._normal_array_name = name or ""
            self.Modified()

    def GetNormalArrayName(self) -> str:
        """Empty if there is none: then they are the active ones, or `Normals`, if there are some."""
        return self._normal_array_name

    def SetUpDirection(self, *direction: Any) -> None:
        """Where up is, three numbers; zeros if that is not known."""
        if self._up_direction != three(direction):
            self._up_direction = three(direction)
            self.Modified()

    def GetUpDirection(self) -> tuple[float, float, float]:
        """Three numbers."""
        return self._up_direction

    def parameter_errors(self) -> list[str]:
        """What in the parameters excludes each other, a text each."""
        return _engine.errors(self._engine_values())

    def _engine_values(self) -> dict[str, int | float]:
        """Those of the properties that the engine knows."""
        return {name: value for name, value in self._values.items() if self.PROPERTIES[name].engine}

    def _tells_sides(self) -> bool:
        """Whether the caller gives the outer side, or turns normals off."""
        names = self._view_array_name or self._normal_array_name
        return bool(
            self._viewpoints or names or any(self._up_direction) or not self._values["UseNormals"]
        )

    def _sides(self, cloud: Cloud | None, problems: list[str]) -> dict[str, Any]:
        """What tells the outer side, as the engine takes it. ValueError if an array is not there."""
        viewpoints = np.array(self._viewpoints, dtype=np.float64).reshape(-1, 3)
        if not self._viewpoints and cloud is not None:
            viewpoints = viewpoints if cloud.viewpoints is None else cloud.viewpoints
            problems += cloud.viewpoint_problems
        normals = None
        if cloud is not None and self._values["UseNormals"]:
            normals = cloud.normals(self._normal_array_name)
            problems += [] if self._normal_array_name else cloud.normal_problems[:1]
        views = None
        # Of a single viewpoint that is given the array of the input tells nothing: it may count others.
        is_own = not self._viewpoints and len(viewpoints) > 0
        if cloud is not None and (self._view_array_name or is_own or len(viewpoints) > 1):
            name = self._view_array_name or "View"
            views = cloud.values(name)
            if views is None and self._view_array_name:
                raise ValueError(
                    f"There is no numeric point array of one component called {name} for the views."
                )
        up = np.array(self._up_direction)
        return {
            "viewpoints": np.ascontiguousarray(viewpoints),
            "views": None if views is None else _view_numbers(views),
            "normals": normals,
            "up": up if up.any() else None,
        }


def _view_numbers(views: np.ndarray) -> np.ndarray:
    """Whole numbers from 0 on; what is none is no view."""
    # All false for NaN.
    is_view = (views >= 0) & (views < _NO_VIEW) & (views == np.floor(views))
    return np.where(is_view, views, _NO_VIEW).astype(np.uint32)


def three(numbers: tuple[Any, ...]) -> tuple[float, float, float]:
    given = numbers[0] if len(numbers) == 1 else numbers
    x, y, z = (float(number) for number in given)
    return (x, y, z)
