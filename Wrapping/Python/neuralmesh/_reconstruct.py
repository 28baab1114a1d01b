# SPDX-License-Identifier: BSD-3-Clause
"""The function reconstruct()."""

from __future__ import annotations

import numbers
import os
from typing import Any, Iterable, Literal, Sequence, overload

from . import _world
from ._parameters import assign, parameters_of, refuse_unknown, with_table
from ._places import direction, places
from ._types import (
    ArrayLike,
    MadeMesh,
    Mesh,
    OfPyVista,
    Progress,
    PyVistaMesh,
    vtkCompositeDataSet,
    vtkPointSet,
    vtkPolyData,
)

_USUAL_VERTICES = 20000
# Those that have names or places of their own in the signature.
_NAMED = ("number_of_vertices", "seed", "variant", "order", "preset")
# Time steps are for pipelines: a function gives the finished mesh. What gives more outputs are flags.
_OF_PIPELINES = ("growth_as_time", "number_of_snapshots", "explain_points", "compute_feature_lines")
PARAMETERS = {
    name: parameter
    for name, parameter in parameters_of(_world.NeuralMesh).items()
    if name not in _NAMED + _OF_PIPELINES
}

ENSEMBLE_PARAMETERS = {
    name: parameter
    for name, parameter in parameters_of(_world.NeuralMeshEnsemble).items()
    if name not in (*_NAMED, *_OF_PIPELINES, "number_of_members")
}


# One mesh has the kind of its points. With explain, feature_lines or levels there are several.
# fmt: off
@overload
def reconstruct(
    points: OfPyVista,
    vertices: int | Literal["auto"] = ..., seed: int = ..., *,
    variant: str = ..., order: str = ..., preset: str = ..., first_mesh: vtkPolyData | Mesh | None = ...,
    ensemble: int | None = ..., weights: ArrayLike | str | None = ..., viewpoints: ArrayLike | None = ...,
    views: ArrayLike | str | None = ..., normals: ArrayLike | str | None = ..., up: ArrayLike | None = ...,
    checkpoint: str | os.PathLike[str] | None = ..., explain: Literal[False] = ...,
    feature_lines: Literal[False] = ..., levels: None = ..., progress: Progress | None = ...,
    **parameters: float | bool | str,
) -> PyVistaMesh: ...
@overload
def reconstruct(
    points: Mesh,
    vertices: int | Literal["auto"] = ..., seed: int = ..., *,
    variant: str = ..., order: str = ..., preset: str = ..., first_mesh: vtkPolyData | Mesh | None = ...,
    ensemble: int | None = ..., weights: ArrayLike | str | None = ..., viewpoints: ArrayLike | None = ...,
    views: ArrayLike | str | None = ..., normals: ArrayLike | str | None = ..., up: ArrayLike | None = ...,
    checkpoint: str | os.PathLike[str] | None = ..., explain: Literal[False] = ...,
    feature_lines: Literal[False] = ..., levels: None = ..., progress: Progress | None = ...,
    **parameters: float | bool | str,
) -> Mesh: ...
@overload
def reconstruct(
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet | str | os.PathLike,
    vertices: int | Literal["auto"] = ..., seed: int = ..., *,
    variant: str = ..., order: str = ..., preset: str = ..., first_mesh: vtkPolyData | Mesh | None = ...,
    ensemble: int | None = ..., weights: ArrayLike | str | None = ..., viewpoints: ArrayLike | None = ...,
    views: ArrayLike | str | None = ..., normals: ArrayLike | str | None = ..., up: ArrayLike | None = ...,
    checkpoint: str | os.PathLike[str] | None = ..., explain: Literal[False] = ...,
    feature_lines: Literal[False] = ..., levels: None = ..., progress: Progress | None = ...,
    **parameters: float | bool | str,
) -> vtkPolyData: ...
@overload
def reconstruct(
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet | Mesh | OfPyVista | str | os.PathLike,
    vertices: int | Literal["auto"] = ..., seed: int = ..., *,
    variant: str = ..., order: str = ..., preset: str = ..., first_mesh: vtkPolyData | Mesh | None = ...,
    ensemble: int | None = ..., weights: ArrayLike | str | None = ..., viewpoints: ArrayLike | None = ...,
    views: ArrayLike | str | None = ..., normals: ArrayLike | str | None = ..., up: ArrayLike | None = ...,
    checkpoint: str | os.PathLike[str] | None = ..., explain: bool = ...,
    feature_lines: bool = ..., levels: Sequence[int] | None = ..., progress: Progress | None = ...,
    **parameters: float | bool | str,
) -> MadeMesh: ...
# fmt: on
def reconstruct(
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet | Mesh | OfPyVista | str | os.PathLike,
    vertices: int | Literal["auto"] = _USUAL_VERTICES,
    seed: int = 1,
    *,
    variant: str = "noise",
    order: str = "exact",
    preset: str = "default",
    first_mesh: vtkPolyData | Mesh | None = None,
    ensemble: int | None = None,
    weights: ArrayLike | str | None = None,
    viewpoints: ArrayLike | None = None,
    views: ArrayLike | str | None = None,
    normals: ArrayLike | str | None = None,
    up: ArrayLike | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    explain: bool = False,
    feature_lines: bool = False,
    levels: Sequence[int] | None = None,
    progress: Progress | None = None,
    **parameters: float | bool | str,
) -> MadeMesh:
    """Make a triangle mesh from a point cloud.

        Args:
            points: The cloud: an array of shape (N, 3) of floats or integers of any kind and layout, in any
                unit of length. Or a vtkPointSet, whose points and point data count. Or a vtkCompositeDataSet,
                whose point sets are one cloud. Or the path of a binary .ply or of a .vtp with appended raw
                data, which may be larger than the memory: maximum_points are drawn from it. Points with NaN
                or infinity are dropped. No normals are needed.
            vertices: The number of vertices of the mesh, from 4 to 1000000000. Or "auto", which is 0: as
                many as the points support. Field data `Choice` of the mesh has the reasons. A tolerance or
                levels determine the size instead.
            seed: Seed of the random numbers, from 0 to 2147483647. The same points and seed give the same
                bytes. Another seed gives another mesh of the same quality.
            variant: "noise_filtering", in which points far from the mesh move vertices less; "basic"; or
                "normal_based", dense where the surface bends. Names may be shortened.
            order: How the program measures where to grow: "exact" by counters, or "list" by the activity
                list.
            preset: "default", the values with the best measured results; or "thesis", those of the thesis.
            first_mesh: Triangles from which learning starts, instead of `start`, in the coordinates of the
                points: an oriented 2-manifold, with or without boundary. The result has its topology. A mesh
                with at least the given number of vertices is fitted, but does not grow.
            ensemble: The number of coarse meshes, from 1 to 255, whose average is the start, as in
                vtkNeuralMeshEnsemble: for shapes with handles. Topology is learnt then, unless
                topology_learning is False. Its other properties are parameters, too.
            weights: The weight of each point: an array of shape (N,), or the name of a point array of the
                dataset. Weights are from 0 on; only their ratios count. Points whose weight is 0, negative or
                not finite are left out. The mesh gets an array as `Weights`.
            viewpoints: Positions of the scanner: numbers of shape (3,), or (V, 3) for several. The surface is
                turned to look there.
            views: The number of the viewpoint of each point, from 0 on: an array of shape (N,), or the name
                of a point array of the dataset. Without it, a viewpoint sees what nothing hides. The mesh
                gets an array as `View`.
            normals: Normals of the points, of shape (N, 3), or the name of the point array that has them.
                They determine the outer side, and help to fit noisy points. They may be noisy. "off", which
                is use_normals=False, ignores those of a dataset or a file.
            up: The up direction, three numbers: most of an open surface looks there.
            checkpoint: The path of a file to which the run saves its state, every checkpoint_interval seconds
                and when it is ended early. If the file exists, the run resumes from it. The mesh is the same,
                byte for byte, however often the call was killed. The file is removed after the run, unless
                keep_checkpoint is True.
            explain: Whether the result is the mesh and, as a second vtkPolyData, the points with `Distance`
                and `Reason`, see neuralmesh.explain(). It has no points if progress ended the run.
            feature_lines: Whether there is one more result, the last one: the edges of the shape that are
                sharper than feature_angle and that the points confirm. It is a vtkPolyData of lines and
                corners, and the mesh has the point data `Crease`. It has no points if progress ended the run.
            levels: Levels of detail: numbers of vertices, in ascending order, instead of `vertices`. The
                result is a list of meshes in that order. It takes 1.3 to 3 times as long as the largest mesh. If
                progress ended the run, the list ends with the mesh learnt so far. explain and feature_lines
                are for the largest.
            progress: A function that is called with the fraction that is done, from 0 to 1. If it returns
                False, the mesh learnt so far is the result. An exception that it raises ends the run and
                leaves this function.
            **parameters: Any other property of vtkNeuralMesh, in snake case: winner_rate=0.1 for
                SetWinnerRate(0.1). Names, defaults and ranges:

    {table}

        Returns:
            vtkPolyData with triangles, in the units of the input: an oriented 2-manifold without unused
            points. Points of 4-byte floats give 4-byte floats, other arrays 8-byte floats. Point data:
            `Normals`, float of shape (M, 3), of length 1; `Activity`, double of shape (M,), in wins, or the
            place in the list, up to 1; and the point data of a dataset, unless carry_point_data is False.
            Field data, one value each: `NumberOfVertices`, `Iterations`, `Seed`, `StopReason`,
            `DroppedPoints`. The report on the quality: `Residual`, `Noise`, `SharedNoise`, `OutlierShare`,
            `RegularRatio`, `TriangleQuality`, `Components`, `Genus`, `BoundaryLoops`, `FoldedEdges`,
            `IntersectingTriangles`, `NarrowHandles`, `FitRoundsTakenBack`. The outer side: `OrientedBy`,
            `UnorientedPieces`, `UnorientedShare` and `GuessedShare`. Points that are left out:
            `OutlierPoints`, `SmallPiecePoints`, `UnreachablePoints`, `UnexplainedPoints` and
            `UnexplainedShare`. `Warnings` has a string for each warning.

        Raises:
            ValueError: A parameter is out of its range, or parameters cannot be used together. There are no
                points, no finite ones, or all coincide. first_mesh is no vtkPolyData or no oriented manifold.
                The checkpoint cannot be written, is damaged, or belongs to another run. The message names
                the parameter, the points or the difference.
            TypeError: There is no such parameter.
            RuntimeError: Anything else that VTK finds wrong.
            KeyboardInterrupt: Ctrl-C was pressed. To keep the mesh learnt so far, cancel by progress,
                or set time_limit.

        Warns:
            RuntimeWarning: For each string of `Warnings`. It says what is wrong with the mesh, where, why,
                and what helps. It ends with a tag in brackets: a heading of
                Documentation/Guide/Failures.md.

        Example:
            >>> points = numpy.loadtxt("scan.xyz")[:, :3]
            >>> mesh = neuralmesh.reconstruct(points, 5000, winner_rate=0.05, time_limit=60)
            >>> mesh.GetNumberOfPoints()
            5000
    """
    mesh = make_filter(
        vertices,
        seed,
        variant=variant,
        order=order,
        preset=preset,
        ensemble=ensemble,
        viewpoints=viewpoints,
        up=up,
        levels=levels,
        **parameters,
    )
    if checkpoint is not None:
        mesh.SetCheckpointFileName(os.fspath(checkpoint))
    require_one_start(ensemble, first_mesh)
    cloud = take_input(mesh, points, weights, views, normals)
    first = None if first_mesh is None else _world.take_surface(first_mesh, "first_mesh")
    mesh.SetExplainPoints(bool(explain))
    mesh.SetComputeFeatureLines(bool(feature_lines))
    result, explained, lines, smaller = _world.learn(mesh, cloud, first, progress, points)
    require_points(result)
    meshes = [*smaller, result] if mesh.GetNumberOfLevels() > 0 else result
    more = ([explained] if explain else []) + ([lines] if feature_lines else [])
    return (meshes, *more) if more else meshes


if reconstruct.__doc__:
    reconstruct.__doc__ = with_table(reconstruct.__doc__, PARAMETERS)


def make_filter(
    vertices: int | Literal["auto"] = _USUAL_VERTICES,
    seed: int = 1,
    *,
    variant: str = "noise",
    order: str = "exact",
    preset: str = "default",
    ensemble: int | None = None,
    viewpoints: ArrayLike | None = None,
    up: ArrayLike | None = None,
    levels: Sequence[int] | None = None,
    **parameters: float | bool | str,
) -> Any:
    """The filter that reconstruct() executes, without input; the same errors."""
    known = PARAMETERS if ensemble is None else ENSEMBLE_PARAMETERS
    refuse_unknown(reconstruct, parameters, known)
    is_surface = parameters.get("input_is") == "surface"
    mesh = _world.NeuralMesh() if ensemble is None else _world.NeuralMeshEnsemble()
    if ensemble is not None:
        assign(mesh, "number_of_members", ensemble, shown_name="ensemble")
    assign(
        mesh,
        "number_of_vertices",
        0 if vertices == "auto" else vertices,
        shown_name="vertices",
        or_else="" if is_surface else "auto",
    )
    assign(mesh, "seed", seed)
    # A preset sets parameters, and to what depends on variant and order.
    assign(mesh, "variant", variant)
    assign(mesh, "order", order)
    assign(mesh, "preset", preset)
    for name, value in parameters.items():
        assign(mesh, name, value)
    set_outer_side(mesh, viewpoints, up)
    if levels is not None and not isinstance(levels, Iterable):
        raise ValueError(f"levels must be several numbers of vertices, not {levels!r}")
    for level in () if levels is None else levels:
        _add_level(mesh, level)
    _require_one_size(vertices, parameters.get("tolerance"), levels)
    return mesh


def _require_one_size(vertices: object, tolerance: object, levels: object) -> None:
    if tolerance == 0:
        raise ValueError("tolerance must be larger than 0; without it the number of vertices counts.")
    sizes = {
        "vertices": vertices != _USUAL_VERTICES,  # the default, if given, does no harm
        "tolerance": bool(tolerance),
        "levels": levels is not None,
    }
    given = [name for name, is_given in sizes.items() if is_given]
    if len(given) > 1:
        raise ValueError(f"{given[0]} and {given[1]} exclude each other: each determines the size of the mesh.")


def _add_level(mesh: Any, level: object) -> None:
    # The range of a level is that of the number of vertices.
    low, high = mesh.GetNumberOfVerticesMinValue(), mesh.GetNumberOfVerticesMaxValue()
    is_whole = isinstance(level, numbers.Integral) and not isinstance(level, bool)
    if not (is_whole and low <= level <= high):  # type: ignore[operator]
        raise ValueError(f"a level must be a whole number from {low} to {high}, not {level!r}")
    mesh.AddLevel(int(level))  # type: ignore[call-overload]


def set_outer_side(mesh: Any, viewpoints: ArrayLike | None, up: ArrayLike | None) -> None:
    """Set the outer side of a filter, as the arguments of reconstruct() do."""
    for place in places(viewpoints, "viewpoints") if viewpoints is not None else ():
        mesh.AddViewpoint(place)
    if up is not None:
        mesh.SetUpDirection(direction(up, "up"))


def require_one_start(ensemble: object, first_mesh: object) -> None:
    """Raise ValueError if both are given as the start."""
    if ensemble is not None and first_mesh is not None:
        raise ValueError("ensemble and first_mesh exclude each other: it makes its first mesh")


def take_input(
    mesh: Any,
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet | Mesh | OfPyVista | str | os.PathLike,
    weights: ArrayLike | str | None = None,
    views: ArrayLike | str | None = None,
    normals: ArrayLike | str | None = None,
) -> Any:
    """The points with their properties, as reconstruct() takes them. None for points in a file: the filter
    gets its name.
    """
    if isinstance(normals, str):
        if normals == "off":
            mesh.UseNormalsOff()
        else:
            mesh.SetNormalArrayName(normals)
        normals = None
    if isinstance(points, (str, os.PathLike)):
        for name, values in (("weights", weights), ("views", views), ("normals", normals)):
            if values is not None:
                raise ValueError(f"{name} cannot be given for points in a file")
        mesh.SetPointFileName(os.fspath(points))
        return None
    cloud = _world.take_points(points)
    if weights is not None:
        cloud, name = _world.with_array(cloud, weights, "weights", "Weights")
        mesh.SetWeightArrayName(name)
    if views is not None:
        if mesh.GetNumberOfViewpoints() == 0:
            raise ValueError("views tell nothing without viewpoints")
        cloud, name = _world.with_array(cloud, views, "views", "View")
        mesh.SetViewArrayName(name)
    if normals is not None:
        cloud = _world.with_normals(cloud, normals)
    return cloud


def require_points(mesh: Any) -> None:
    """Raise ValueError for a mesh without points."""
    count = mesh.GetNumberOfPoints() if hasattr(mesh, "GetNumberOfPoints") else len(mesh.points)
    if count == 0:
        raise ValueError("points: there are none")
