# SPDX-License-Identifier: BSD-3-Clause
"""The functions as methods of the datasets of PyVista: cloud.neuralmesh.reconstruct(20000).

PyVista finds this module by itself where the package was installed by pip, from version 0.48 on. The package
registers it, too, for other ways of installation and for earlier versions: see _pyvista_hook.py.
"""

from __future__ import annotations

import inspect
from typing import Any, Callable, Literal, TypeVar, overload

import pyvista

from . import _reconstruct, _remesh
from ._compare import compare
from ._explain import explain
from ._info import info
from ._types import Progress

NAME = "neuralmesh"

_Method = TypeVar("_Method", bound=Callable[..., Any])


def _told_as(function: Callable[..., Any], own: str) -> Callable[[_Method], _Method]:
    """Gives a method the signature and the documentation of a function, less its parameter that is the
    dataset of the accessor.
    """

    def tell(method: _Method) -> _Method:
        signature = inspect.signature(function)
        parameters = [one for one in signature.parameters.values() if one.name != own]
        itself = inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)
        method.__signature__ = signature.replace(parameters=[itself, *parameters])  # type: ignore
        method.__doc__ = _without_argument(function.__doc__, own)
        return method

    return tell


def _without_argument(documentation: str | None, name: str) -> str | None:
    """The documentation without what it says of an argument."""
    if documentation is None:
        return None
    lines = documentation.split("\n")
    begin = next(i for i, line in enumerate(lines) if line.strip().startswith(f"{name}: "))
    indent = len(lines[begin]) - len(lines[begin].lstrip())
    end = begin + 1
    while lines[end].startswith(" " * (indent + 1)):
        end += 1
    if lines[begin - 1].strip() == "Args:" and not lines[end].strip():
        # It was the only one.
        begin, end = begin - 1, end + 1
    return "\n".join(lines[:begin] + lines[end:])


class CloudAccessor:
    """The functions of the package neuralmesh for points of PyVista. Results are pyvista.PolyData."""

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    # With explain, feature_lines or levels there are several meshes.
    @overload
    def reconstruct(
        self,
        vertices: int | Literal["auto"] = ...,
        seed: int = ...,
        *,
        explain: Literal[False] = ...,
        feature_lines: Literal[False] = ...,
        levels: None = ...,
        **parameters: Any,
    ) -> pyvista.PolyData: ...
    @overload
    def reconstruct(self, *arguments: Any, **parameters: Any) -> Any: ...
    @_told_as(_reconstruct.reconstruct, "points")
    def reconstruct(self, *arguments: Any, **parameters: Any) -> Any:
        return _reconstruct.reconstruct(self._dataset, *arguments, **parameters)

    @_told_as(explain, "points")
    def explain(
        self, mesh: Any, smallest_piece: float = 0.0005, *, progress: Progress | None = None
    ) -> pyvista.PolyData:
        return explain(self._dataset, mesh, smallest_piece, progress=progress)

    def __getattr__(self, name: str) -> Any:
        advice = ""
        if hasattr(SurfaceAccessor, name):
            advice = f", which is for surfaces: dataset.extract_surface().{NAME}.{name}()"
        raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'{advice}")


class SurfaceAccessor(CloudAccessor):
    """The functions for meshes; their points are a cloud, too."""

    @_told_as(compare, "result")
    def compare(
        self, reference: Any, samples: int = 200000, seed: int = 1
    ) -> dict[str, dict[str, float]]:
        return compare(reference, self._dataset, samples, seed)

    @overload
    def remesh(
        self,
        vertices: int = ...,
        seed: int = ...,
        *,
        feature_lines: Literal[False] = ...,
        **parameters: Any,
    ) -> pyvista.PolyData: ...
    @overload
    def remesh(
        self,
        vertices: int = ...,
        seed: int = ...,
        *,
        feature_lines: Literal[True],
        **parameters: Any,
    ) -> tuple[pyvista.PolyData, pyvista.PolyData]: ...
    @_told_as(_remesh.remesh, "surface")
    def remesh(self, *arguments: Any, **parameters: Any) -> Any:
        return _remesh.remesh(self._dataset, *arguments, **parameters)

    @_told_as(info, "mesh")
    def info(self) -> dict[str, Any]:
        return info(self._dataset)


class _Attached:
    """Gives each dataset its accessor, if PyVista has no register_dataset_accessor()."""

    def __init__(self, accessor: type[CloudAccessor]) -> None:
        self._accessor = accessor

    def __get__(self, dataset: Any, _owner: type | None = None) -> Any:
        return self._accessor if dataset is None else self._accessor(dataset)


def register() -> None:
    """Attach the accessors to the classes of PyVista; a second time nothing happens."""
    classes = {
        pyvista.PolyData: SurfaceAccessor,
        pyvista.PointSet: CloudAccessor,
        pyvista.UnstructuredGrid: CloudAccessor,
        pyvista.StructuredGrid: CloudAccessor,
        pyvista.MultiBlock: CloudAccessor,
    }
    for target, accessor in classes.items():
        if hasattr(pyvista, "register_dataset_accessor"):
            pyvista.register_dataset_accessor(NAME, target)(accessor)
        elif NAME not in vars(target):
            setattr(target, NAME, _Attached(accessor))


register()
