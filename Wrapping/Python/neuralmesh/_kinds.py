# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of input of a function, and the results that belong to them."""

from __future__ import annotations

import importlib.util
import sys
from typing import Any

_PACKAGES = ("vtkmodules", "cvista")  # of VTK, and of the build of it that PyVista offers


def is_pyvista(data: object) -> bool:
    """Whether it is an object of PyVista."""
    return any(cls.__module__.partition(".")[0] == "pyvista" for cls in type(data).__mro__)


def vtk_package_of(data: object) -> str | None:
    """The package whose class an object of VTK has; None for other objects."""
    for cls in type(data).__mro__:
        if cls.__name__ == "vtkObjectBase":
            return cls.__module__.partition(".")[0]
    return None


def vtk_package() -> str | None:
    """The package to take classes of VTK from where nothing of VTK was given: that of PyVista, if it has
    been imported; None if there is none.
    """
    # PyVista has had the choice since 0.49.
    backend = getattr(sys.modules.get("pyvista"), "vtk_backend", None)
    if backend is not None:
        name = backend()
        return "vtkmodules" if name == "vtk" else name
    return next((name for name in _PACKAGES if importlib.util.find_spec(name) is not None), None)


def as_given(result: Any, given: object) -> Any:
    """A vtkPolyData as it is, or as PyVista has it where that was given."""
    if not is_pyvista(given):
        return result
    import pyvista

    return pyvista.wrap(result)
