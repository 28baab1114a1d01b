# SPDX-License-Identifier: BSD-3-Clause
"""A run over a cloud, as vtkNeuralMesh and vtkNeuralMeshEnsemble do it, without VTK."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any, Callable

import numpy as np

from .. import _engine
from .._property import with_properties
from .._types import Progress
from .algorithm import NeuralMeshAlgorithm, of_class
from .carrying import carry
from .cloud import Block, Cloud
from .mesh import Mesh
from .surface import sampled

# Of the progress: then feature lines are looked for, and point data is carried over.
_BEGIN_OF_LINES, _BEGIN_OF_CARRYING = 0.9, 0.95
_SINGLE, _DOUBLE = 0, 1
_SURFACE = 1  # InputIs


@dataclass
class Outcome:
    """What a run gives."""

    mesh: Mesh
    curve: dict[str, np.ndarray] = field(default_factory=dict)
    explained: Mesh | None = None
    feature_lines: Mesh | None = None
    smaller_levels: list[Mesh] = field(default_factory=list)  # all but the mesh itself
    average: Mesh | None = None  # of an ensemble
    votes: dict[str, Any] | None = None  # likewise
    warnings: list[str] = field(default_factory=list)
    is_drawn: bool = True  # whether there were points: drawing them may be ended


@with_properties(*of_class("vtkNeuralMesh"))
class NeuralMesh(NeuralMeshAlgorithm):
    """The properties of vtkNeuralMesh, and its run."""

    IS_ENSEMBLE = False

    def __init__(self) -> None:
        super().__init__()
        self._point_file_name = ""
        self._weight_array_name = ""
        self._checkpoint_file_name = ""
        self._levels: list[int] = []
        self._stop_reason = "none"
        self._resumed_iterations = 0
        self._times: dict[str, float] = {}

    def SetPointFileName(self, name: str | None) -> None:
        """A file to draw points from in place of an input."""
        if self._point_file_name != (name or ""):
            self._point_file_name = name or ""
            self.Modified()

    def GetPointFileName(self) -> str:
        """Empty if there is none."""
        return self._point_file_name

    def GetUsedMaximumPoints(self) -> int:
        """MaximumPoints, or what stands for 0."""
        wanted = int(self._values["MaximumPoints"])
        return wanted or _engine.usual_points(self._vertices_of_largest())

    def AddLevel(self, vertices: int) -> None:
        """One more level of detail, of more vertices than those before."""
        allowed = self.PROPERTIES["NumberOfVertices"]
        if not allowed.low <= vertices <= allowed.high:
            self._warn(f"A level of {vertices} vertices is out of range and is left out.")
            return
        self._levels.append(int(vertices))
        self.Modified()

    def RemoveAllLevels(self) -> None:
        """One mesh of NumberOfVertices is wanted."""
        if self._levels:
            self._levels.clear()
            self.Modified()

    def GetNumberOfLevels(self) -> int:
        """How many there are."""
        return len(self._levels)

    def GetLevel(self, number: int) -> int:
        """The number of vertices of a level, from 0 on; -1 if there is none."""
        return self._levels[number] if 0 <= number < len(self._levels) else -1

    def _vertices_of_largest(self) -> int:
        return self._levels[-1] if self._levels else int(self._values["NumberOfVertices"])

    def is_size_to_be_found(self) -> bool:
        """Whether there is no number of vertices, or a tolerance takes its place."""
        return self._values["Tolerance"] > 0 or self._vertices_of_largest() == 0

    def why_no_size(self, has_first_mesh: bool, has_checkpoint: bool) -> str:
        """A sentence that says what excludes a search for the number of vertices; empty if nothing does."""
        return _engine.why_no_size(
            self._engine_values(), has_first_mesh, has_checkpoint, bool(self._values["Automatic"])
        )

    def most_vertices(self, points: int) -> int:
        """Number of vertices of the largest possible mesh of this number of points."""
        return max(4, points // 2) if self.is_size_to_be_found() else self._vertices_of_largest()

    def SetWeightArrayName(self, name: str | None) -> None:
        """The point array of weights."""
        if self._weight_array_name != (name or ""):
            self._weight_array_name = name or ""
            self.Modified()

    def GetWeightArrayName(self) -> str:
        """Empty if there is none."""
        return self._weight_array_name

    def SetCheckpointFileName(self, name: str | None) -> None:
        """The file in which the run leaves its state."""
        if self._checkpoint_file_name != (name or ""):
            self._checkpoint_file_name = name or ""
            self.Modified()

    def GetCheckpointFileName(self) -> str:
        """Empty if there is none."""
        return self._checkpoint_file_name

    def RemoveCheckpoint(self) -> None:
        """Remove the file, with what an interrupted write may have left beside it."""
        if self._checkpoint_file_name:
            _engine.remove_file(self._checkpoint_file_name)

    def GetResumedIterations(self) -> int:
        """Iterations of the checkpoint from which the last run went on."""
        return self._resumed_iterations

    def GetStopReason(self) -> str:
        """Why learning has ended."""
        return self._stop_reason

    def _time(self, phase: str) -> float:
        return self._times.get(phase, 0.0)

    def GetDrawingTime(self) -> float:
        """CPU seconds that this took, as the next ones."""
        return self._time("Drawing")

    def GetCloudTime(self) -> float:
        return self._time("Cloud")

    def GetChoiceTime(self) -> float:
        return self._time("Choice")

    def GetStartTime(self) -> float:
        return self._time("Start")

    def GetLearningTime(self) -> float:
        return self._time("Learning")

    def GetFinishTime(self) -> float:
        return self._time("Finish")

    def run_on_file(
        self, first_mesh: Mesh | None, progress: Progress | None, **more: Any
    ) -> Outcome:
        """The same as run() with points that are drawn from PointFileName."""
        if self._values["InputIs"] == _SURFACE:
            self._require_remeshing(first_mesh is not None)
        drawn = _engine.draw_points(
            self._point_file_name, self.GetUsedMaximumPoints(), int(self._values["Seed"]),
            (lambda _fraction: progress(0.0)) if progress else None,
        )  # fmt: skip
        if drawn is None:
            self._stop_reason = "cancelled"
            return Outcome(_empty_mesh(), is_drawn=False)
        outcome = self.run(Cloud([block_of_file(drawn)]), first_mesh, progress, **more)
        self._times["Drawing"] = drawn["seconds"]
        return outcome

    def run(
        self,
        cloud: Cloud,
        first_mesh: Mesh | None = None,
        progress: Progress | None = None,
        take_snapshot: Callable[[Mesh], None] | None = None,
        tell: Callable[[str, str], None] | None = None,
    ) -> Outcome:
        """Learn a mesh of the cloud. ValueError tells why that cannot be.

        `tell` is called with what is said meanwhile, its kind first: "warning" (all of which are in the
        outcome, too), "step" or "choice".
        """
        self._stop_reason, self._resumed_iterations, self._times = "none", 0, {}
        problems = self.parameter_errors()
        if problems:
            raise ValueError(" ".join(problems))
        if self._values["GrowthAsTime"] and self._checkpoint_file_name:
            raise ValueError(
                "CheckpointFileName and GrowthAsTime exclude each other: a checkpoint holds no snapshots."
            )
        if self._levels and self._values["GrowthAsTime"]:
            raise ValueError("Levels and growth as time exclude each other.")
        if self.is_size_to_be_found() and self._values["GrowthAsTime"]:
            raise ValueError(
                "A number of vertices that is to be found, by itself or by a tolerance, and growth as "
                "time exclude each other."
            )
        warnings: list[str] = []

        def warn(*texts: str) -> None:
            warnings.extend(texts)
            for text in texts:
                if tell is not None:
                    tell("warning", text)

        if cloud.other_blocks:
            warn(f"{cloud.other_blocks} blocks are no point sets and were left out.")
        if len(cloud) == 0 and self._values["InputIs"] != _SURFACE:
            return Outcome(_empty_mesh(), warnings=warnings)
        warning_of_surface = None
        if self._values["InputIs"] == _SURFACE:
            self._require_remeshing(first_mesh is not None)
            cloud, first_mesh, warning_of_surface = sampled(cloud, self._engine_values())
        weights = self._weights(cloud)
        problems = []
        sides = self._sides(cloud, problems)
        warn(*problems)
        carried = dict(cloud.carried()) if self._values["CarryPointData"] else {}
        explains = bool(self._values["ExplainPoints"])
        run = _engine.Run(
            [block.points for block in cloud.blocks],
            weights,
            **sides,
            keeps_origins=bool(carried) or explains,
            threads=_threads(int(self._values["NumberOfThreads"])),
        )
        precision = self._values["OutputPointsPrecision"]
        is_double = precision == _DOUBLE or (
            precision != _SINGLE
            and (cloud.has_doubles or run.needs_doubles(self.most_vertices(len(cloud))))
        )
        finds_lines = bool(self._values["ComputeFeatureLines"])
        end_of_mesh = _BEGIN_OF_CARRYING if carried else 1.0
        if finds_lines:
            end_of_mesh = _BEGIN_OF_LINES
        run.learn(
            self._engine_values(),
            self._ensemble_values(),
            (
                None
                if first_mesh is None
                else np.ascontiguousarray(first_mesh.points, dtype=np.float64)
            ),
            (
                None
                if first_mesh is None
                else np.ascontiguousarray(first_mesh.triangles, dtype=np.int64)
            ),
            float(self._values["Tolerance"]),
            bool(self._values["ToleranceIsPercent"]),
            int(self._values["ToleranceMeasure"]),
            bool(self._values["Automatic"]),
            explains,
            end_of_mesh,
            self._checkpoint_file_name,
            float(self._values["CheckpointInterval"]),
            int(self._values["NumberOfSnapshots"]) - 1 if take_snapshot else 0,
            self._levels,
            warning_of_surface,
            _snapshot_taker(take_snapshot, is_double),
            tell,
            progress,
        )
        self._stop_reason = run.stop_reason
        self._resumed_iterations = run.resumed_iterations
        self._times = run.times()
        outcome = Outcome(
            Mesh(**run.mesh(is_double)), run.curve(), warnings=warnings + run.warnings
        )
        for level in range(run.smaller_levels):
            run.show(level)
            smaller = Mesh(**run.mesh(is_double))
            if carried:
                carry(run, cloud, carried, smaller, None)
            outcome.smaller_levels.append(smaller)
        run.show(run.smaller_levels)
        if explains:
            outcome.explained = explained_points(cloud, run.explained())
        if self.IS_ENSEMBLE:
            outcome.average, outcome.votes = _average_of(run, is_double), run.votes()
        is_complete = run.is_complete
        if finds_lines and run.stop_reason != "cancelled":
            angle = float(self._values["FeatureAngle"])
            found = run.feature_lines(
                angle, is_double, _BEGIN_OF_LINES, _BEGIN_OF_CARRYING, progress
            )
            is_complete = bool(found) and is_complete
            if found:
                outcome.mesh.point_data["Crease"] = found.pop("creases")
                outcome.feature_lines = _lines_of(found)
        if carried and run.stop_reason != "cancelled":
            is_complete = carry(run, cloud, carried, outcome.mesh, progress) and is_complete
        if is_complete and not self._values["KeepCheckpoint"]:
            self.RemoveCheckpoint()
        return outcome

    def _ensemble_values(self) -> dict[str, int | float] | None:
        return None

    def remeshing_error(self, beside: dict[str, bool]) -> str:
        """Why a surface is not remeshed with these properties, and with what is true beside them; empty if it is."""
        own = {
            "points": bool(self._point_file_name),
            "first_mesh": self.IS_ENSEMBLE,
            "weights": bool(self.GetWeightArrayName()),
            "sides": self._tells_sides(),
            "size": self.is_size_to_be_found(),
            "levels": bool(self._levels),
            "checkpoint": bool(self._checkpoint_file_name),
            "snapshots": bool(self._values["GrowthAsTime"]),
            "automatic": bool(self._values["Automatic"]),
            "explanation": bool(self._values["ExplainPoints"]),
        }
        told = {name: own.get(name, False) or beside.get(name, False) for name in {**own, **beside}}
        return _engine.remeshing_error(self._engine_values(), told)

    def _require_remeshing(self, has_first_mesh: bool) -> None:
        problem = self.remeshing_error({"first_mesh": has_first_mesh})
        if problem:
            raise ValueError(problem)

    def _weights(self, cloud: Cloud) -> np.ndarray | None:
        name = self._weight_array_name
        if not name:
            return None
        weights = cloud.values(name)
        if weights is None:
            raise ValueError(
                f"There is no numeric point array of one component called {name} for the weights."
            )
        return weights


@with_properties(*of_class("vtkNeuralMeshEnsemble"))
class NeuralMeshEnsemble(NeuralMesh):
    """The properties of vtkNeuralMeshEnsemble, and its run."""

    IS_ENSEMBLE = True

    def __init__(self) -> None:
        super().__init__()
        self._values["TopologyLearning"] = 1

    def _engine_values(self) -> dict[str, int | float]:
        own = {one.name for one in of_class("vtkNeuralMeshEnsemble")}
        return {name: value for name, value in super()._engine_values().items() if name not in own}

    def _ensemble_values(self) -> dict[str, int | float] | None:
        own = {one.name: self._values[one.name] for one in of_class("vtkNeuralMeshEnsemble")}
        return {**own, "Seed": self._values["Seed"]}


def block_of_file(drawn: dict[str, Any]) -> Block:
    """The points that the engine has drawn from a file."""
    block = Block(drawn["points"], normals=drawn.get("normals"))
    if "RGB" in drawn:
        block.data["RGB"], block.scalars = drawn["RGB"], "RGB"
    return block


def explained_points(cloud: Cloud, explained: dict[str, Any]) -> Mesh:
    """The points of a cloud with `Distance` and `Reason`; none where nothing is explained."""
    if not explained:
        return _empty_mesh()
    kind = np.float64 if cloud.has_doubles else np.float32
    points = np.concatenate([block.points for block in cloud.blocks]).astype(kind, copy=False)
    fields = explained.pop("field_data")
    return Mesh(points, np.empty((0, 3), dtype=np.int64), explained, fields, "Reason")


def _lines_of(found: dict[str, Any]) -> Mesh:
    ends, points = found.pop("line_ends"), found.pop("line_points")
    lines = np.split(points, ends[:-1]) if len(ends) > 0 else []
    return Mesh(**found, triangles=np.empty((0, 3), dtype=np.int64), lines=lines)


def _snapshot_taker(take: Callable[[Mesh], None] | None, is_double: bool) -> Any:
    if take is None:
        return None

    def taker(snapshot: dict[str, Any]) -> None:
        mesh = Mesh(**snapshot)
        if not is_double:
            mesh.points = mesh.points.astype(np.float32)
        take(mesh)

    return taker


def _average_of(run: Any, is_double: bool) -> Mesh | None:
    average = run.average(is_double)
    return Mesh(**average) if average else None


def _empty_mesh() -> Mesh:
    return Mesh(np.empty((0, 3), dtype=np.float32), np.empty((0, 3), dtype=np.int64))


def _threads(wanted: int) -> int:
    """How many, if 0 stands for as many as there are; VTK's limit counts for us, too."""
    if wanted > 0:
        return wanted
    available: int = _engine.available_processors()
    most = os.environ.get("VTK_SMP_MAX_THREADS", "")
    return min(available, int(most)) if most.isdecimal() and int(most) > 0 else available
