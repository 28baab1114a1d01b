# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment is: runs by their factors, what the thesis says, and how that is judged."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable

from .. import VTK_VERSION, __version__
from .models import model_identity
from .table import Table

HOLDS, HOLDS_IN_PART, DOES_NOT_HOLD = "holds", "holds in part", "does not hold"
NOT_JUDGED = "not judged"


@dataclass(frozen=True)
class Run:
    """One run of the method, in a process of its own.

    kind: "mesh" learns one and measures it; "average" measures the average mesh of an ensemble;
    "steps" has step-times tell what the steps cost, and parameters are its options.
    """

    model: str
    points: int
    vertices: int
    seed: int
    parameters: dict[str, Any]
    kind: str = "mesh"
    keeps_mesh: bool = False

    @property
    def key(self) -> str:
        """The name under which its result is stored: another one wherever that may differ."""
        identity = [self.content(), model_identity(self.model), __version__, VTK_VERSION]
        text = json.dumps(identity, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:20]

    def content(self) -> dict[str, Any]:
        return {
            "model": self.model,
            "points": self.points,
            "vertices": self.vertices,
            "seed": self.seed,
            "parameters": self.parameters,
            "kind": self.kind,
            "keeps_mesh": self.keeps_mesh,
        }

    @property
    def cost(self) -> float:
        """About how long it takes, in any unit: long ones are to begin first."""
        vertices = float(self.vertices)
        if self.parameters.get("order") == "search":
            return vertices + vertices**2 / 4000
        smoothing = self.parameters.get("smoothing_iterations", 1)
        return vertices * (1 + 0.3 * smoothing) + (20000 if self.kind == "average" else 0)


@dataclass(frozen=True)
class Case:
    """A run, and where it stands in the table of its experiment."""

    factors: dict[str, Any]
    run: Run


@dataclass(frozen=True)
class Scale:
    """How large the experiments are: as the thesis has them, or just large enough to be tried."""

    is_quick: bool
    models: tuple[str, ...]

    def vertices(self, count: int) -> int:
        return max(500, count // 10) if self.is_quick else count

    def list_vertices(self, count: int) -> int:
        """Of runs with the activity list, which begins at 1000 vertices."""
        return max(1500, count // 20) if self.is_quick else count

    def points(self, count: int = 200000) -> int:
        return min(count, 20000) if self.is_quick else count

    def seeds(self, count: int = 3) -> range:
        return range(1, 1 + (min(count, 2) if self.is_quick else count))

    def some_models(self, count: int) -> tuple[str, ...]:
        return self.models[: 1 if self.is_quick else count]


@dataclass(frozen=True)
class Finding:
    """In which cases a claim holds, and the figures."""

    cases: dict[str, bool]
    words: str

    @property
    def verdict(self) -> str:
        return verdict_of([HOLDS if holds else DOES_NOT_HOLD for holds in self.cases.values()])

    @property
    def extent(self) -> str:
        """The verdict, and in how many cases the claim holds where there are several."""
        return with_count(self.verdict, list(self.cases.values()))


def with_count(verdict: str, holds: list[bool]) -> str:
    """The verdict, and in how many of the cases it holds where there are several."""
    return verdict if len(holds) < 2 else f"{verdict} ({sum(holds)} of {len(holds)})"


def verdict_of(verdicts: list[str]) -> str:
    """That of a whole by those of its parts."""
    if not verdicts or NOT_JUDGED in verdicts:
        return NOT_JUDGED
    return verdicts[0] if len(set(verdicts)) == 1 else HOLDS_IN_PART


Judge = Callable[[Table], Finding]


@dataclass(frozen=True)
class Claim:
    """What the thesis says, in our words, and how that is judged by the table."""

    says: str
    judge: Judge


@dataclass(frozen=True, eq=False)
class Experiment:
    """An experiment of the thesis, or a new one.

    plot draws the table into a file; pictures are rows of meshes, each by its title and what
    selects its row in the table. columns are those of the summary, over which it takes means.
    """

    name: str
    figures: str
    title: str
    setting: str
    cases: Callable[[Scale], list[Case]]
    claims: tuple[Claim, ...]
    columns: tuple[str, ...]
    groups: tuple[str, ...]
    plot: Callable[[Table, Path], None]
    pictures: dict[str, dict[str, Any]] = field(default_factory=dict)
    note: str = ""
