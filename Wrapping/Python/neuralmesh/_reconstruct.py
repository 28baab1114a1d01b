# SPDX-License-Identifier: BSD-3-Clause
"""The function reconstruct()."""

from __future__ import annotations

import numbers
import os
from typing import Any, Sequence

from . import _world
from ._parameters import assign, parameters_of, refuse_unknown, table
from ._places import direction, places
from ._types import (
    ArrayLike,
    MadeMesh,
    Mesh,
    Progress,
    vtkCompositeDataSet,
    vtkPointSet,
    vtkPolyData,
)

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


def reconstruct(
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet | Mesh | str | os.PathLike,
    vertices: int | str = 20000,
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
            points: The cloud: an array of shape (N, 3) of floats or integers of any kind and layout, a
                row for a point, in any unit of length; or a vtkPointSet, of which points and point
                data count; or a vtkCompositeDataSet, of which all point sets are taken as one cloud. No
                normals are needed. Points with NaN or infinity are dropped. Or the path of a binary .ply,
                or of a .vtp appended raw, from which maximum_points are drawn where they lie: it may be
                larger than the memory.
            vertices: The number of vertices of the mesh, from 4 to 1000000000; or "auto", which is 0: as
                many as the points have something to tell for. With a tolerance it does not count. Field
                data `Choice` of the mesh says in words why it has as many as it has.
            seed: Seed of the random numbers, from 0 to 2147483647. The same points and seed give the
                same bytes; another seed gives another mesh of the same quality.
            variant: "noise_filtering", by which points far from the mesh pull less; "basic"; or
                "normal_based", dense where the surface bends. Names may be shortened.
            order: How it is known where to grow: "exact" by counters, or "list" by the activity list.
            preset: "default", what measures best; or "thesis", the values of the thesis.
            first_mesh: Triangles to start from, instead of what `start` says, in the coordinates of the
                points: an oriented 2-manifold, with or without boundary, whose topology the result then
                has. One of as many vertices as are asked for, or more, comes out as it is.
            ensemble: The number of members, from 1 to 255, to start from the average of so many coarse
                meshes, as vtkNeuralMeshEnsemble does: for shapes with handles. Topology is learnt then,
                unless topology_learning is False. Its other properties are parameters, too.
            weights: How much each point is trusted: an array of shape (N,), or the name of a point
                array of the dataset. Numbers from 0 on, of which only the ratios count; 0, what is
                negative and what is not finite leave the point out. An array arrives on the mesh as
                `Weights`.
            viewpoints: Where the scanner stood: numbers of shape (3,), or (V, 3) for several places. The
                surface is turned to look there.
            views: Which of the viewpoints each point was seen from: an array of shape (N,) of numbers from
                0 on, or the name of a point array of the dataset. Without it, what nothing hides from a
                viewpoint was seen from there. An array arrives on the mesh as `View`.
            normals: Normals of the points, of shape (N, 3), if the dataset has none, or the name of a point
                array that has them in place of the active ones. They may be noisy: they tell which side of
                the surface is the outer one, and of noisy points the fit uses them. "off", which is
                use_normals=False, has those of a dataset or a file count for nothing.
            up: Where up is, three numbers: most of an open surface looks there.
            checkpoint: The path of a file in which the run leaves its state, every checkpoint_interval
                seconds and when it is ended early. If the file exists, the run goes on from there: the
                same call ends with the same bytes, however often it was killed. Once the mesh is done,
                the file is removed, unless keep_checkpoint is True.
            explain: Whether the points are explained: then the result is the mesh and, as a second
                vtkPolyData, the points with `Distance` and `Reason` as the run decided them, see
                neuralmesh.explain(). It has no points if progress ended the run.
            feature_lines: Whether the edges of the shape that are sharper than feature_angle, and that the
                points confirm, are found: then they are one more result, the last one, as a vtkPolyData of
                lines and corners, and the mesh has the point data `Crease`. It has no points if progress
                ended the run.
            levels: Levels of detail: numbers of vertices, in ascending order, in place of `vertices`. Then
                the meshes of all, in that order, are a list in place of the mesh, made in one run that takes
                up to twice as long as that of the largest. If progress ended the run, the list ends with the
                mesh learnt so far. What explain and feature_lines give is that of the largest.
            progress: A function that is called now and then with the fraction that is done, from 0 to
                1. If it returns False, the mesh learnt so far is the result. An exception that it
                raises ends the run and comes out of this function.
            **parameters: Any other property of vtkNeuralMesh, in snake case: winner_rate=0.1 for
                SetWinnerRate(0.1). Each is described there. Names, defaults and ranges:

    {table}

        Returns:
            vtkPolyData with triangles, in the units of the input: an oriented 2-manifold without
            unused points. The type of the points is that of the input: 4-byte floats stay so, anything
            else in an array becomes 8-byte floats. Point data: `Normals`, float of shape (M, 3), of
            length 1; `Activity`, double of shape (M,), in wins, or the place in the list, up to 1; and
            the point data of a dataset, unless carry_point_data is False. Field data, one value each:
            `NumberOfVertices`, `Iterations`, `Seed`, `StopReason`, `DroppedPoints`, and the report on
            the quality: `Residual`, `Noise`, `SharedNoise`, `OutlierShare`, `RegularRatio`, `TriangleQuality`,
            `Components`, `Genus`, `BoundaryLoops`, `FoldedEdges`,
            `IntersectingTriangles`, `NarrowHandles`, `FitRoundsTakenBack`. How the surface came to its
            outer side is told by `OrientedBy`, `UnorientedPieces`, `UnorientedShare` and `GuessedShare`; what was left
            out by `OutlierPoints`, `SmallPiecePoints`, `UnreachablePoints`, `UnexplainedPoints` and
            `UnexplainedShare`. `Warnings` has a string for each thing that was warned of. No pipeline is
            behind it.

        Raises:
            ValueError: A parameter is out of its range, which the message names; parameters do not go
                together, and the message tells what does; or there are no
                points, none that is finite, or none that differs from the others; or first_mesh is no
                vtkPolyData, or its triangles are no oriented manifold: the message names the points; or
                the checkpoint cannot be written, or is damaged, or that of another run: then the message
                tells what differs.
            TypeError: There is no such parameter.
            RuntimeError: Anything else that VTK finds wrong.
            KeyboardInterrupt: Ctrl-C was pressed. To keep the mesh learnt so far, cancel by progress,
                or set time_limit.

        Warns:
            RuntimeWarning: What must be known of the mesh, each with what can be done: parts of the cloud
                that it misses, triangles that intersect, more vertices than points, and so on. The strings
                of `Warnings`.

        Example:
            >>> points = numpy.loadtxt("scan.xyz")[:, :3]
            >>> mesh = neuralmesh.reconstruct(points, 5000, winner_rate=0.05, time_limit=60)
            >>> mesh.GetNumberOfPoints()
            5000
    """
    if vertices == "auto" and levels is not None:
        raise ValueError('vertices="auto" and levels exclude each other: levels are numbers of vertices.')
    mesh = make_filter(
        vertices,
        seed,
        variant=variant,
        order=order,
        preset=preset,
        ensemble=ensemble,
        viewpoints=viewpoints,
        up=up,
        **parameters,
    )
    if checkpoint is not None:
        mesh.SetCheckpointFileName(os.fspath(checkpoint))
    require_one_start(ensemble, first_mesh)
    cloud = take_input(mesh, points, weights, views, normals)
    first = None if first_mesh is None else _world.take_surface(first_mesh, "first_mesh")
    mesh.SetExplainPoints(bool(explain))
    mesh.SetComputeFeatureLines(bool(feature_lines))
    sizes = [] if levels is None else list(levels)
    for level in sizes:
        _add_level(mesh, level)
    result, explained, lines, smaller = _world.learn(mesh, cloud, first, progress, points)
    require_points(result)
    meshes = [*smaller, result] if sizes else result
    more = ([explained] if explain else []) + ([lines] if feature_lines else [])
    return (meshes, *more) if more else meshes


if reconstruct.__doc__:
    reconstruct.__doc__ = reconstruct.__doc__.replace("    {table}\n", table(PARAMETERS))


def make_filter(
    vertices: int | str = 20000,
    seed: int = 1,
    *,
    variant: str = "noise",
    order: str = "exact",
    preset: str = "default",
    ensemble: int | None = None,
    viewpoints: ArrayLike | None = None,
    up: ArrayLike | None = None,
    **parameters: float | bool | str,
) -> Any:
    """The filter that reconstruct() executes, without input; the same errors."""
    known = PARAMETERS if ensemble is None else ENSEMBLE_PARAMETERS
    refuse_unknown(reconstruct, parameters, known)
    mesh = _world.NeuralMesh() if ensemble is None else _world.NeuralMeshEnsemble()
    if ensemble is not None:
        assign(mesh, "number_of_members", ensemble, shown_name="ensemble")
    assign(
        mesh, "number_of_vertices", 0 if vertices == "auto" else vertices, shown_name="vertices"
    )
    assign(mesh, "seed", seed)
    # A preset sets parameters, and to what depends on variant and order.
    assign(mesh, "variant", variant)
    assign(mesh, "order", order)
    assign(mesh, "preset", preset)
    for name, value in parameters.items():
        assign(mesh, name, value)
    set_outer_side(mesh, viewpoints, up)
    return mesh


def _add_level(mesh: Any, level: object) -> None:
    # The range of a level is that of the number of vertices.
    low, high = mesh.GetNumberOfVerticesMinValue(), mesh.GetNumberOfVerticesMaxValue()
    is_whole = isinstance(level, numbers.Integral) and not isinstance(level, bool)
    if not (is_whole and low <= level <= high):  # type: ignore[operator]
        raise ValueError(f"a level must be a whole number from {low} to {high}, not {level!r}")
    mesh.AddLevel(int(level))  # type: ignore[call-overload]


def set_outer_side(mesh: Any, viewpoints: ArrayLike | None, up: ArrayLike | None) -> None:
    """Tell a filter which side of the surface is the outer one, as reconstruct() is told."""
    for place in places(viewpoints, "viewpoints") if viewpoints is not None else ():
        mesh.AddViewpoint(place)
    if up is not None:
        mesh.SetUpDirection(direction(up, "up"))


def require_one_start(ensemble: object, first_mesh: object) -> None:
    """Raise ValueError if both say what learning starts from."""
    if ensemble is not None and first_mesh is not None:
        raise ValueError("ensemble and first_mesh exclude each other: it makes its first mesh")


def take_input(
    mesh: Any,
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet | Mesh | str | os.PathLike,
    weights: ArrayLike | str | None = None,
    views: ArrayLike | str | None = None,
    normals: ArrayLike | str | None = None,
) -> Any:
    """The points with what is known of each, as reconstruct() takes them; None for those in a file, which
    the filter is told.
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
