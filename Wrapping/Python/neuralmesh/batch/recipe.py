# SPDX-License-Identifier: BSD-3-Clause
"""What a recipe says: which scans are reconstructed, and with which parameters."""

from __future__ import annotations

import glob
import inspect
import itertools
import json
import math
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterator

from .._world import check_parameters
from .._parameters import hint
from .._reconstruct import (
    ENSEMBLE_PARAMETERS,
    PARAMETERS,
    make_filter,
    reconstruct,
    require_one_start,
)
from .meshes import DEFAULT_FORMAT, FORMATS, problem_of_format

KEYS = ("scans", "matrix", "format", "shift", "time_limit", "gallery", "view", "strict")
VIEW = {"up": "y", "azimuth": 30.0, "elevation": 15.0}

_SIGNATURE = inspect.signature(make_filter).parameters.values()
_NAMED = {parameter.name for parameter in _SIGNATURE if parameter.kind != parameter.VAR_KEYWORD}
# Those that the filter is not given as properties.
_OF_INPUT = ("weights", "first_mesh")
_KNOWN = {*_NAMED, *_OF_INPUT, *PARAMETERS, *ENSEMBLE_PARAMETERS}


# Arguments of reconstruct() that a recipe cannot give, or that the batch gives itself.
NOT_IN_RECIPES = tuple(
    parameter.name
    for parameter in inspect.signature(reconstruct).parameters.values()
    if parameter.name not in _KNOWN and parameter.kind != parameter.VAR_KEYWORD
)


class RecipeError(ValueError):
    """An error of a recipe; the message begins with the place."""


@dataclass(frozen=True, eq=False)
class Job:
    """One scan and one set of parameters. The name is that of its files, unique in the recipe.

    first_mesh is the path of the first mesh, if there is one. shift is subtracted from the coordinates
    of the mesh: "auto", three numbers, or None.
    """

    name: str
    scan: Path
    parameters: dict[str, Any]
    first_mesh: Path | None = None
    shift: str | list[float] | None = None

    @property
    def smaller_levels(self) -> list[int]:
        """All levels but the largest, which is the mesh of the job itself."""
        return (self.parameters.get("levels") or [])[:-1]

    def level_name(self, level: int) -> str:
        """The name of the files of a smaller level."""
        return f"{self.name}_{level}"


@dataclass(frozen=True)
class Recipe:
    """A recipe that is sound: every parameter is known, in its range, and goes with the others."""

    jobs: list[Job]
    parameter_names: list[str]
    format: str
    time_limit: float | None
    gallery: bool
    view: dict[str, Any]
    is_strict: bool


def read_recipe(path: Path) -> Recipe:
    """Read a recipe, or raise RecipeError with the place that is wrong."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise RecipeError(f"{path}: cannot be read: {error}") from None
    try:
        content = json.loads(text, object_pairs_hook=_without_twins, parse_constant=_no_number)
    except json.JSONDecodeError as error:
        place = f"{path}, line {error.lineno}, column {error.colno}"
        raise RecipeError(f"{place}: this is no JSON: {error.msg}") from None
    except (RecipeError, RecursionError) as error:
        raise RecipeError(f"{path}: {error}") from None
    try:
        return _recipe(content, path.absolute().parent)
    except RecipeError as error:
        raise RecipeError(f"{path}: {error}") from None


def _recipe(content: Any, folder: Path) -> Recipe:
    _require_object(content, "the recipe", KEYS)
    scans = _scans(content.get("scans"), folder)
    matrix = _matrix(content.get("matrix", {}))
    mesh_format = content.get("format", DEFAULT_FORMAT)
    if mesh_format not in FORMATS:
        raise RecipeError(f"format: must be one of {', '.join(FORMATS)}, not {_shown(mesh_format)}")
    problem = problem_of_format(mesh_format)
    if problem:
        raise RecipeError(f"format: {problem}")
    shift = _shift(content.get("shift"))
    time_limit = content.get("time_limit")
    if time_limit is not None and not (_is_number(time_limit) and 0 < time_limit < math.inf):
        raise RecipeError(f"time_limit: must be seconds, above 0, not {_shown(time_limit)}")
    gallery, strict = content.get("gallery", True), content.get("strict", False)
    for name, value in (("gallery", gallery), ("strict", strict)):
        if not isinstance(value, bool):
            raise RecipeError(f"{name}: must be true or false, not {_shown(value)}")
    jobs = _jobs(scans, matrix, content.get("matrix", {}), folder, shift)
    view = _view(content.get("view", {}))
    return Recipe(jobs, list(matrix), mesh_format, time_limit, gallery, view, strict)


def _scans(patterns: Any, folder: Path) -> list[Path]:
    """The files that are meant, each once, in the order of the recipe."""
    if not isinstance(patterns, list) or not patterns:
        raise RecipeError("scans: must be a list of paths, with wildcards or without")
    found: dict[Path, None] = {}
    for i, pattern in enumerate(patterns):
        if not isinstance(pattern, str) or not pattern:
            raise RecipeError(f"scans[{i}]: must be a path, not {_shown(pattern)}")
        paths = [pattern]
        # A file whose name looks like a pattern is meant itself.
        if glob.has_magic(pattern) and not (folder / pattern).exists():
            paths = sorted(glob.glob(pattern, root_dir=folder, recursive=True))
            if not paths:
                raise RecipeError(f"scans[{i}]: no file matches {pattern}")
        found.update((Path(os.path.normpath(folder / path)), None) for path in paths)
    return list(found)


def _matrix(content: Any) -> dict[str, list]:
    """The values of each parameter."""
    _require_object(content, "matrix", _KNOWN, "help(neuralmesh.reconstruct) lists them all")
    matrix = {}
    for name, value in content.items():
        is_tried = _is_tried(name, value)
        values = value if is_tried else [value]
        if not values:
            raise RecipeError(f"matrix.{name}: the list is empty")
        for i, single in enumerate(values):
            place = f"matrix.{name}[{i}]" if is_tried else f"matrix.{name}"
            _check_value(place, name, single)
            if any(single == other and type(single) is type(other) for other in values[:i]):
                raise RecipeError(f"{place}: {_shown(single)} stands there twice")
        matrix[name] = values
    return matrix


def _is_tried(name: str, value: Any) -> bool:
    """Whether a value is a list of those to try in turn. Levels are a list themselves."""
    if name == "levels":
        return isinstance(value, list) and any(isinstance(one, list) for one in value)
    return isinstance(value, list)


def _check_value(place: str, name: str, value: Any) -> None:
    if name == "weights":
        if not isinstance(value, str):
            raise RecipeError(f"{place}: must be the name of a point array, not {_shown(value)}")
        return
    if name == "first_mesh":
        if value is not None and not (isinstance(value, str) and value):
            raise RecipeError(f"{place}: must be the path of a mesh, or null, not {_shown(value)}")
        return
    if name == "levels":
        _check_levels(place, value)
    alone = name in _NAMED or name in PARAMETERS
    try:
        make_filter(**{"ensemble": None if alone else 1, name: value})
    except ValueError as error:
        raise RecipeError(f"{place}: {error}") from None


def _check_levels(place: str, value: Any) -> None:
    if value is None:
        return
    if not isinstance(value, list) or not value:
        raise RecipeError(f"{place}: must be numbers of vertices, in a list, not {_shown(value)}")
    if all(map(_is_number, value)) and any(b <= a for a, b in zip(value, value[1:])):
        raise RecipeError(f"{place}: levels must ascend, not {_shown(value)}")


def _jobs(
    scans: list[Path],
    matrix: dict[str, list],
    content: dict[str, Any],
    folder: Path,
    shift: str | list[float] | None,
) -> list[Job]:
    """Each scan with each combination of the values, of which those in lists are in the names."""
    jobs: dict[str, Job] = {}
    combinations = [dict(zip(matrix, values)) for values in itertools.product(*matrix.values())]
    endings = []
    for parameters in combinations:
        _check_combination(parameters)
        listed = [name for name in matrix if _is_tried(name, content[name])]
        endings.append("".join(f"_{name}-{_in_name(parameters[name])}" for name in listed))
    for scan, scan_name in zip(scans, _names(scans)):
        for parameters, ending in zip(combinations, endings):
            first_mesh = parameters.get("first_mesh")
            path = first_mesh and Path(os.path.normpath(folder / first_mesh))
            job = Job(scan_name + ending, scan, parameters, path, shift)
            if job.name in jobs:
                raise RecipeError(f"matrix: two jobs would have the same name, {job.name}")
            jobs[job.name] = job
    for job in jobs.values():
        for level in job.smaller_levels:
            if job.level_name(level) in jobs:
                raise RecipeError(
                    f"matrix.levels: that of {level} vertices of {job.name} would have the name of another job"
                )
    return list(jobs.values())


def _check_combination(parameters: dict[str, Any]) -> None:
    if parameters.get("levels") is not None and "vertices" in parameters:
        raise RecipeError(f"matrix: {_shown(parameters)}: levels take the place of vertices")
    properties = {name: v for name, v in parameters.items() if name not in _OF_INPUT}
    try:
        check_parameters(make_filter(**properties))
        require_one_start(parameters.get("ensemble"), parameters.get("first_mesh"))
    except (TypeError, ValueError) as error:
        raise RecipeError(f"matrix: {_shown(parameters)} do not go together: {error}") from None


def _names(scans: list[Path]) -> list[str]:
    """The name of each without the extension. Those of one name get what tells them apart."""
    alike: dict[str, list[Path]] = {}
    for scan in scans:
        alike.setdefault(_in_name(scan.stem), []).append(scan)
    short = {scan: name for group in alike.values() for scan, name in _names_of_alike(group)}
    common = os.path.commonpath([scan.parent for scan in scans])
    whole = {scan: "_".join(scan.relative_to(common).parts) for scan in scans}
    for chosen in (short, whole):
        names = [_in_name(chosen[scan]) for scan in scans]
        if len(set(names)) == len(names):
            return names
    raise RecipeError("scans: their names are equal")


def _names_of_alike(scans: list[Path]) -> Iterator[tuple[Path, str]]:
    """Names for scans whose files have one name: with the folder in which they differ, before it, and
    with the extension, behind it, where there are several in one folder.
    """
    parents = [scan.parent for scan in scans]
    common = os.path.commonpath(parents)
    paths = [parent.relative_to(common).parts for parent in parents]
    different = len(set(parents))
    folders = ["-".join(path) for path in paths]
    for level in range(max(map(len, paths))):
        single = ["".join(path[level : level + 1]) for path in paths]
        if len(set(single)) == different:
            folders = single
            break
    for scan, folder in zip(scans, folders):
        name = f"{folder}-{scan.stem}" if folder else scan.stem
        yield scan, name if parents.count(scan.parent) == 1 else f"{name}-{scan.suffix[1:]}"


def _in_name(value: Any) -> str:
    """A value or a file's name as a part of names of files; no word begins with a dot."""
    if isinstance(value, list):
        return "-".join(map(_in_name, value))
    text = value if isinstance(value, str) else json.dumps(value)
    return re.sub(r"[^\w.+-]|^\.", "_", text)


def _shift(content: Any) -> str | list[float] | None:
    is_vector = isinstance(content, list) and len(content) == 3 and all(map(_is_number, content))
    if content is None or content == "auto" or (is_vector and all(map(math.isfinite, content))):
        return content
    raise RecipeError(f"shift: must be \"auto\" or three numbers, not {_shown(content)}")


def _view(content: Any) -> dict[str, Any]:
    _require_object(content, "view", VIEW)
    view = {**VIEW, **content}
    if view["up"] not in ("x", "y", "z"):
        raise RecipeError(f"view.up: must be x, y or z, not {_shown(view['up'])}")
    for name in ("azimuth", "elevation"):
        if not (_is_number(view[name]) and abs(view[name]) <= 360):
            wrong = _shown(view[name])
            raise RecipeError(f"view.{name}: must be degrees from -360 to 360, not {wrong}")
    return view


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _require_object(content: Any, place: str, known: Any, otherwise: str = "") -> None:
    """otherwise is what to say, in place of all the known names, where none is like a wrong one."""
    if not isinstance(content, dict):
        raise RecipeError(f"{place}: must be an object, not {_shown(content)}")
    for name in content:
        if name not in known:
            advice = hint(name, known) or otherwise or f"there are {', '.join(known)}"
            raise RecipeError(f"{place}: there is no {_shown(name)}; {advice}")


def _without_twins(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    content = dict(pairs)
    if len(content) < len(pairs):
        names = [name for name, _ in pairs]
        twin = next(name for name in names if names.count(name) > 1)
        raise RecipeError(f"{_shown(twin)} stands there twice")
    return content


def _no_number(text: str) -> None:
    raise RecipeError(f"{text} is no number of JSON")


def _shown(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 200 else text[:200] + "..."
