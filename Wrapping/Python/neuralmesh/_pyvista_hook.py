# SPDX-License-Identifier: BSD-3-Clause
"""Registers the accessor of pyvista_accessor.py as soon as PyVista is imported, before this package or after
it, without importing PyVista.

Since version 0.48 PyVista itself finds the accessors of what pip has installed, by its entry points
`pyvista.accessors`. This is for earlier versions, and for the package of Debian and a build tree, which have
no entry points.
"""

from __future__ import annotations

import importlib
import sys
import warnings
from types import ModuleType
from typing import Any

_PYVISTA = "pyvista"


def install() -> None:
    """Register the accessor if PyVista has been imported; else let its import do so."""
    if hasattr(sys.modules.get(_PYVISTA), "PolyData"):
        _register()
    elif _PYVISTA not in sys.modules and not any(isinstance(one, _Finder) for one in sys.meta_path):
        sys.meta_path.insert(0, _Finder())


class _Finder:
    """Finds PyVista as all others do, and has the accessor registered behind its import."""

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        """For other modules None: then Python asks the other finders."""
        if name != _PYVISTA:
            return None
        others = [finder for finder in sys.meta_path if finder is not self]
        specs = (one.find_spec(name, path, target) for one in others if hasattr(one, "find_spec"))
        spec: Any = next((spec for spec in specs if spec is not None), None)
        execute = getattr(spec and spec.loader, "exec_module", None)
        if execute is not None:

            def execute_and_register(module: ModuleType) -> None:
                execute(module)
                if self in sys.meta_path:
                    sys.meta_path.remove(self)
                _register()

            spec.loader.exec_module = execute_and_register
        return spec


def _register() -> None:
    """An error only gives a warning: users of PyVista alone are not disturbed."""
    try:
        importlib.import_module(".pyvista_accessor", __package__)
    except Exception as error:  # of a version of PyVista that we do not know
        warnings.warn(f"neuralmesh has not added its accessor to PyVista: {error}", RuntimeWarning)
