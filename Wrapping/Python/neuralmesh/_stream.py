# SPDX-License-Identifier: BSD-3-Clause
"""The function stream()."""

from __future__ import annotations

import numbers
from typing import Any

import numpy as np

from . import _world
from ._parameters import assign, parameters_of, refuse_unknown, with_table
from ._places import direction, place
from ._types import ArrayLike, MadeMesh, Mesh, Progress, vtkPointSet

_NAMED = ("number_of_vertices", "seed", "reservoir_size", "finish_output")
# A stream is learnt in one variant, with one order; so these can have no other value ...
_FIXED = ("variant", "order", "preset", "topology_learning", "compute_feature_strength")
# ... and these count with others only, or with a cloud that is known as a whole.
_WITHOUT_EFFECT = (
    "area_weight", "boundary_merging_factor", "constant_weight", "counter_decay",
    "curvature_density", "feature_memory", "feature_samples", "jump", "jump_fraction",
    "list_vertices", "normal_weight", "topology_patience", "topology_rules",
    "triangle_removal_factor", "volume_weight",
)  # fmt: skip
PARAMETERS = {
    name: parameter
    for name, parameter in parameters_of(_world.NeuralMeshStream).items()
    if name not in _NAMED + _FIXED + _WITHOUT_EFFECT
}


class Stream:
    """A mesh that is learnt while points arrive; made by stream()."""

    def __init__(self, algorithm: Any):
        self._algorithm = algorithm
        self._uses_normals = algorithm.GetUseNormals()
        self._given: object = None  # the points that came last

    def add_points(
        self,
        points: ArrayLike | vtkPointSet | Mesh,
        *,
        viewpoint: ArrayLike | None = None,
        normals: ArrayLike | str | None = None,
    ) -> None:
        """Add points, which count from the next learn() on.

        Args:
            points: An array of shape (N, 3) of numbers, or a vtkPointSet. Points with NaN or infinity
                are dropped. Add them in large pieces: each learn() after that takes time in
                proportion to the reservoir.
            viewpoint: Where the scanner stood that saw these points, of shape (3,): the surface is
                turned to look there.
            normals: As in reconstruct(), of these points. A viewpoint replaces them.

        Raises:
            ValueError: points, viewpoint or normals are something else.
        """
        cloud = _world.take_points(points, blocks=False)
        name = normals if isinstance(normals, str) else ""
        if normals is not None and not name:
            cloud = _world.with_normals(cloud, normals)
        self._algorithm.SetNormalArrayName("" if name == "off" else name)
        self._algorithm.SetUseNormals(int(self._uses_normals and name != "off"))
        self._algorithm.RemoveAllViewpoints()
        if viewpoint is not None:
            self._algorithm.SetViewpoint(place(viewpoint, "viewpoint"))
        _world.add_points(self._algorithm, cloud)
        self._given = points

    def learn(
        self,
        samples: int | None = None,
        *,
        seconds: float | None = None,
        progress: Progress | None = None,
    ) -> int:
        """Learn, and return the number of samples that were learnt.

        Args:
            samples: Number of samples, an integer. The default, None, is 60 for each vertex and 150000
                more, with which a mesh grows to all its vertices.
            seconds: Approximate time of learning, instead. The mesh then depends on the machine.
            progress: As in reconstruct(); if it returns False, learning ends.

        Raises:
            ValueError: samples or seconds are not above 0, samples are no integer, or both are given.
        """
        if samples is not None and seconds is not None:
            raise ValueError("samples and seconds exclude each other")
        if seconds is not None and not (_is_number(seconds) and seconds > 0):
            raise ValueError(f"seconds must be a number above 0, not {seconds!r}")
        is_whole = samples is None or (_is_number(samples) and samples % 1 == 0 and samples > 0)
        if not is_whole:
            raise ValueError(f"samples must be an integer above 0, not {samples!r}")
        if seconds is not None:
            return _world.learn_for_seconds(self._algorithm, float(seconds), progress)
        if samples is None:
            samples = 60 * self._algorithm.GetNumberOfVertices() + 150000
        return _world.learn_samples(self._algorithm, int(samples), progress)

    def mesh(self, finish: bool = True, *, progress: Progress | None = None) -> MadeMesh:
        """The mesh learnt so far. The stream does not change.

        Args:
            finish: Whether the mesh is fitted to the points, as in reconstruct(). False takes no time: use
                it to watch the mesh.
            progress: As in reconstruct(). If it returns False, the fit ends early.

        Returns:
            vtkPolyData as from reconstruct(), in 8-byte floats, without data of the input points. It has no
            points while there are too few for a mesh. Field data as in vtkNeuralMeshStream.
        """
        self._algorithm.SetFinishOutput(bool(finish))
        return _world.learnt_mesh(self._algorithm, progress, self._given)

    @property
    def points(self) -> int:
        """Number of finite points that have arrived."""
        return self._algorithm.GetNumberOfAddedPoints()

    @property
    def samples(self) -> int:
        """Number of samples learnt."""
        return self._algorithm.GetNumberOfLearntSamples()

    @property
    def vertices(self) -> int:
        """Number of vertices of the mesh."""
        return self._algorithm.GetNumberOfLearntVertices()

    @property
    def beginnings(self) -> int:
        """Number of beginnings: the mesh begins again when points arrive that it does not reach."""
        return self._algorithm.GetNumberOfBeginnings()


def _is_number(value: object) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, np.bool_))


def stream(
    vertices: int = 20000,
    seed: int = 1,
    reservoir: int = 500000,
    *,
    up: ArrayLike | None = None,
    **parameters: float | bool | str,
) -> Stream:
    """Begin a mesh that is learnt while points arrive, for example from a scanner.

        The same calls give the same bytes. See Documentation/Guide/Large.md.

        Args:
            vertices: The number of vertices of the mesh, from 4 to 1000000000.
            seed: Seed of the random numbers, from 0 to 2147483647.
            reservoir: Number of points kept as samples, from 100 to 4294967295. All points that arrive have
                the same chance. Each takes about 130 bytes.
            up: As in reconstruct().
            **parameters: Any other property of vtkNeuralMeshStream that counts for a stream, in snake
                case. Names, defaults and ranges:

    {table}

        Returns:
            A Stream, with the methods add_points(), learn() and mesh().

        Raises:
            ValueError: A parameter is out of its range, which the message names.
            TypeError: There is no such parameter.

        Example:
            >>> stream = neuralmesh.stream(vertices=5000)
            >>> for points in scanner:
            ...     stream.add_points(points)
            ...     stream.learn()
            >>> mesh = stream.mesh()
    """
    refuse_unknown(stream, parameters, PARAMETERS)
    algorithm = _world.NeuralMeshStream()
    assign(algorithm, "number_of_vertices", vertices, shown_name="vertices")
    assign(algorithm, "seed", seed)
    assign(algorithm, "reservoir_size", reservoir, shown_name="reservoir")
    for name, value in parameters.items():
        assign(algorithm, name, value)
    if up is not None:
        algorithm.SetUpDirection(direction(up, "up"))
    return Stream(algorithm)


if stream.__doc__:
    stream.__doc__ = with_table(stream.__doc__, PARAMETERS)
