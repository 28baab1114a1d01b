# SPDX-License-Identifier: BSD-3-Clause
"""Points as people have them, as NumPy arrays for the engine."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Iterator

import numpy as np

from .._arrays import as_points
from .mesh import Mesh
from .vtk_arrays import to_numpy

_GHOSTS = "vtkGhostType"
_SKIPPED = 1 | 2  # duplicate and hidden points


@dataclass
class Block:
    """The points of one array or point set, and what is known of each."""

    points: np.ndarray  # of shape (N, 3), 4- or 8-byte floats, contiguous
    data: dict[str, np.ndarray] = field(default_factory=dict)  # that the mesh gets, too
    normals: np.ndarray | None = None
    normals_name: str = "Normals"
    scalars: str = ""  # the name of the active ones
    # Of a point set of VTK: itself, which of its points these are (None: all), and its arrays.
    dataset: Any = None
    kept: np.ndarray | None = None
    vtk_data: dict[str, Any] = field(default_factory=dict)
    triangles: np.ndarray | None = None  # of a Mesh: its own
    is_double: bool | None = None  # whether they were 8-byte floats; None: as they are

    @property
    def has_doubles(self) -> bool:
        return self.points.dtype == np.float64 if self.is_double is None else self.is_double

    def of_points(self, array: Any) -> np.ndarray:
        """The values that an array of the point set has for the points."""
        values = to_numpy(array)
        return values if self.kept is None else values[self.kept]

    def values(self, name: str) -> np.ndarray | None:
        """Those of any array of that name, whether the mesh gets it or not."""
        if name in self.data or self.dataset is None:
            return self.data.get(name)
        array = self.dataset.GetPointData().GetArray(name)
        return self.of_points(array) if array and _fits(array, self.dataset) else None

    def vectors(self, name: str) -> np.ndarray | None:
        """Those of an array that may be the normals, and that the mesh then does not get."""
        is_plain = self.dataset is None and name == self.normals_name
        return self.normals if is_plain else self.values(name)

    def names(self) -> list[str]:
        """All that vectors() may be asked for."""
        if self.dataset is None:
            return [self.normals_name, *self.data]
        data = self.dataset.GetPointData()
        names = (data.GetArrayName(i) for i in range(data.GetNumberOfArrays()))
        return [name for name in names if name]


@dataclass
class Cloud:
    """All points of an input."""

    blocks: list[Block] = field(default_factory=list)
    viewpoints: np.ndarray | None = None  # that come with the points, of shape (V, 3)
    other_blocks: int = 0  # that are no point sets
    is_in_blocks: bool = False  # of a composite dataset, however many they are
    # What was left out, in words: of viewpoints, and of normals.
    viewpoint_problems: list[str] = field(default_factory=list)
    normal_problems: list[str] = field(default_factory=list)

    def __len__(self) -> int:
        return sum(len(block.points) for block in self.blocks)

    @property
    def has_doubles(self) -> bool:
        return any(block.has_doubles for block in self.blocks)

    def values(self, name: str) -> np.ndarray | None:
        """The data of that name of all points, one number each; None if a block has none."""
        return numbers_of([block.values(name) for block in self.blocks])

    def normals(self, name: str = "") -> np.ndarray | None:
        """Normals of all points, 0 in blocks that have none; None if no block has some.

        Those of the array of that name, where one is given: ValueError if there is none.
        """
        found = [block.vectors(name) if name else block.normals for block in self.blocks]
        if name and self.blocks and (all(one is None for one in found) or _are_odd(found)):
            raise ValueError(
                f"There is no numeric point array of three components called {name} for the normals. "
                + _tell_vectors(self.blocks)
            )
        if all(one is None for one in found):
            return None
        parts = [
            np.zeros((len(block.points), 3)) if one is None else one
            for block, one in zip(self.blocks, found)
        ]
        return np.ascontiguousarray(np.concatenate(parts), dtype=np.float64)

    def carried(self) -> Iterator[tuple[str, np.ndarray]]:
        """The data that all blocks have alike, with its name."""
        for name, first in self.blocks[0].data.items() if self.blocks else ():
            arrays = [block.data[name] for block in self.blocks if name in block.data]
            is_alike = len(arrays) == len(self.blocks) and all(
                array.dtype == first.dtype and array.shape[1:] == first.shape[1:]
                for array in arrays
            )
            if is_alike:
                yield name, arrays[0] if len(arrays) == 1 else np.concatenate(arrays)

    @property
    def vtk_data(self) -> dict[str, Any]:
        """The arrays of VTK whose kind the data has."""
        return self.blocks[0].vtk_data if self.blocks else {}

    @property
    def scalars(self) -> str:
        return self.blocks[0].scalars if self.blocks else ""


def _tell_vectors(blocks: list[Block]) -> str:
    """Which point arrays could be named as normals, as a sentence."""
    names = {
        name
        for block in blocks
        for name in block.names()
        if (found := block.vectors(name)) is not None and not _are_odd([found])
    }
    if not names:
        return "None has three components."
    return f"Arrays with three components: {', '.join(sorted(names))}."


def _are_odd(arrays: list[np.ndarray | None]) -> bool:
    """Whether one of them is not three numbers for each point."""
    return any(
        a is not None and (a.shape[1:] != (3,) or a.dtype.kind not in "fiub") for a in arrays
    )


def numbers_of(arrays: list[np.ndarray | None]) -> np.ndarray | None:
    """The arrays of all blocks as one; None if there is none or one is not a number for each point."""
    found = [array for array in arrays if array is not None]
    if len(found) < len(arrays) or any(a.ndim != 1 or a.dtype.kind not in "fiub" for a in found):
        return None
    return np.concatenate(found).astype(np.float64) if found else None


def as_cloud(points: object, blocks: bool = True) -> Cloud:
    """The cloud that an array, a Mesh, a vtkPointSet or, with blocks, a vtkCompositeDataSet is.

    Arrays of 4- and 8-byte floats are referred to where they are contiguous; all other numbers become
    8-byte floats. ValueError for anything but those and numbers of shape (N, 3).
    """
    if isinstance(points, Cloud):
        return points
    if isinstance(points, Mesh):
        return _of_mesh(points)
    if hasattr(points, "IsA") and points.IsA("vtkPointSet"):
        return _of_datasets([points], points)
    if blocks and hasattr(points, "IsA") and points.IsA("vtkCompositeDataSet"):
        return _of_datasets(list(_leaves(points)), points)
    return Cloud([Block(as_points(points))])


def _of_mesh(mesh: Mesh) -> Cloud:
    points = as_points(mesh.points)
    data = {name: np.asarray(values) for name, values in mesh.point_data.items()}
    for name, values in data.items():
        if values.shape[:1] != (len(points),) or (name == "Normals" and values.shape[1:] != (3,)):
            raise ValueError(
                f"point data {name} must have a row for each of {len(points)} points, and is of shape "
                f"{values.shape}"
            )
    block = Block(points, data, data.pop("Normals", None), mesh.normals_name, mesh.scalars)
    block.triangles = mesh.triangles
    cloud = Cloud([block] if len(block.points) > 0 else [])
    viewpoints = mesh.field_data.get("Viewpoints")
    if viewpoints is not None:
        cloud.viewpoints = np.asarray(viewpoints, dtype=np.float64).reshape(-1, 3)
    return cloud


def _leaves(composite: Any) -> Iterator[Any]:
    iterator = composite.NewIterator()
    iterator.SkipEmptyNodesOn()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator.GetCurrentDataObject()
        iterator.GoToNextItem()


def _of_datasets(leaves: list[Any], whole: Any) -> Cloud:
    cloud = Cloud(is_in_blocks=not whole.IsA("vtkPointSet"))
    for leaf in leaves:
        if not leaf.IsA("vtkPointSet"):
            cloud.other_blocks += 1
        elif leaf.GetNumberOfPoints() > 0:
            block = _block_of(leaf, cloud.normal_problems)
            if len(block.points) > 0:
                cloud.blocks.append(block)
    for source in [whole, *(block.dataset for block in cloud.blocks[:1])]:
        array = source.GetFieldData().GetArray("Viewpoints")
        if array and array.GetNumberOfComponents() != 3:
            cloud.viewpoint_problems.append(
                "The field data Viewpoints of the input has not 3 components and was left out."
            )
            break
        if array:
            cloud.viewpoints = to_numpy(array).reshape(-1, 3).astype(np.float64)
            break
    return cloud


def _block_of(leaf: Any, problems: list[str]) -> Block:
    coordinates = to_numpy(leaf.GetPoints().GetData())
    is_plain = coordinates.dtype in (np.float32, np.float64)
    points = np.ascontiguousarray(coordinates, dtype=coordinates.dtype if is_plain else np.float64)
    data = leaf.GetPointData()
    ghosts = data.GetArray(_GHOSTS)
    block = Block(points, dataset=leaf, is_double=coordinates.dtype == np.float64)
    if ghosts and ghosts.IsA("vtkUnsignedCharArray"):
        block.kept = (to_numpy(ghosts) & _SKIPPED) == 0
        block.points = points[block.kept]
        if len(block.points) == 0:
            return block
    normals = data.GetNormals() or data.GetArray("Normals")
    if normals and (normals.GetNumberOfComponents() != 3 or not _fits(normals, leaf)):
        problems.append(
            "The normals of the input are not 3 components for each point and were left out."
        )
    elif normals:
        block.normals = block.of_points(normals)
        block.normals_name = normals.GetName() or "Normals"
    ids = (data.GetNormals(), data.GetGlobalIds(), data.GetPedigreeIds())
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        name = array.GetName() or "Scalars"
        is_left_out = any(array is other for other in ids) or name == _GHOSTS
        if not is_left_out and array.GetNumberOfComponents() > 0 and _fits(array, leaf):
            block.data[name] = block.of_points(array)
            block.vtk_data[name] = array
            if array is data.GetAbstractAttribute(0):
                block.scalars = name
    return block


def _fits(array: Any, leaf: Any) -> bool:
    return array.GetNumberOfTuples() == leaf.GetNumberOfPoints()
