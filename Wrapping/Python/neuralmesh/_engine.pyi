# SPDX-License-Identifier: BSD-3-Clause
"""What type checkers know of the compiled module; Wrapping/Engine/Engine.cpp has what is behind it. Arrays
must be contiguous, and of the type that the engine takes.
"""

from collections.abc import Callable, Sequence
from typing import Any, TypeVar, overload

import numpy as np

_Array = np.ndarray
_Dict = dict[str, Any]
_Three = tuple[float, float, float]
_Call = Callable[[float], bool | None]
_Progress = _Call | None  # of a fraction; False ends the call
_Result = TypeVar("_Result")

version: str
tried_vertices: int

def preset(preset: int, variant: int, order: int) -> dict[str, int | float]: ...
def stream_error(parameters: _Dict) -> str: ...
def errors(parameters: _Dict) -> list[str]: ...
def remeshing_error(parameters: _Dict, beside: dict[str, bool]) -> str: ...
def sample_surface(parameters: _Dict, points: _Array, triangles: _Array) -> _Dict: ...
def empty_curve() -> dict[str, _Array]: ...
def grid_count(resolution: int) -> int: ...

# Of what can be ended, None where it was.
@overload
def draw_points(
    path: str, wanted: int, seed: int, progress: None, raw: str = "", skip: int = 0
) -> _Dict: ...
@overload
def draw_points(
    path: str, wanted: int, seed: int, progress: _Progress, raw: str = "", skip: int = 0
) -> _Dict | None: ...
def read_points(path: str) -> _Dict: ...
def read_guarded(path: str, read: Callable[[str], _Result]) -> _Result: ...
def write_mesh(
    path: str,
    points: _Array,
    triangles: _Array,
    normals: _Array | None,
    colors: _Array | None,
    shift: _Three | None,
    noted: _Three,
) -> _Three: ...
def require_digits(path: str, points: _Array, vertices: int, shift: _Three) -> None: ...
def round_shift(points: _Array) -> _Three: ...
def shift_note(shift: _Three) -> str: ...
def require_place(path: str) -> None: ...
def write_whole(path: str, content: bytes) -> None: ...
def join_views(parts: Sequence[tuple[int, _Array, _Array]]) -> dict[str, _Array]: ...
def usual_points(vertices: int) -> int: ...
def remove_file(path: str) -> None: ...
def compare(
    reference_points: _Array,
    reference_triangles: _Array,
    result_points: _Array,
    result_triangles: _Array,
    samples: int,
    seed: int,
    progress: _Progress,
) -> _Dict | None: ...
def explain(
    points: Sequence[_Array],
    mesh_points: _Array,
    triangles: _Array,
    least_piece: float,
    progress: _Progress,
) -> _Dict | None: ...
def scan(
    points: _Array,
    triangles: _Array,
    options: _Dict,
    viewpoint: _Array | None,
    double: bool,
    progress: _Progress,
) -> _Array: ...
def report(points: _Array, triangles: _Array) -> _Dict: ...
def estimate(
    vertices: float,
    points: float,
    bytes_of_points: float,
    samples_for_features: float,
    is_ensemble: bool,
    growth: _Array,
    seconds_of_trial: float,
) -> _Three: ...
@overload
def tune(points: Sequence[_Array], parameters: _Dict, threads: int, progress: None) -> _Dict: ...
@overload
def tune(
    points: Sequence[_Array], parameters: _Dict, threads: int, progress: _Progress
) -> _Dict | None: ...

def why_no_size(
    parameters: _Dict, first_mesh: bool, checkpoint: bool, automatic: bool
) -> str: ...

class Run:
    def __init__(
        self,
        points: Sequence[_Array],
        weights: _Array | None,
        viewpoints: _Array,
        views: _Array | None,
        normals: _Array | None,
        up: _Array | None,
        keeps_origins: bool,
        threads: int,
    ) -> None: ...
    def needs_doubles(self, vertices: int) -> bool: ...
    def learn(
        self,
        parameters: _Dict,
        ensemble: _Dict | None,
        first_points: _Array | None,
        first_triangles: _Array | None,
        tolerance: float,
        tolerance_is_percent: bool,
        tolerance_measure: int,
        automatic: bool,
        explain: bool,
        end_of_mesh: float,
        checkpoint: str,
        checkpoint_interval: float,
        snapshots: int,
        levels: Sequence[int],
        warning_of_surface: str | None,
        take_snapshot: Callable[[_Dict], object] | None,
        tell: Callable[[str, str], object] | None,
        progress: _Progress,
    ) -> None: ...
    def show(self, level: int) -> None: ...
    def mesh(self, double: bool) -> _Dict: ...
    def average(self, double: bool) -> _Dict: ...
    def votes(self) -> _Dict: ...
    def curve(self) -> dict[str, _Array]: ...
    def explained(self) -> _Dict: ...
    def feature_lines(
        self, angle: float, double: bool, begin: float, end: float, progress: _Progress
    ) -> _Dict: ...
    def times(self) -> dict[str, float]: ...
    def find_places(self, begin: float, end: float, progress: _Progress) -> bool: ...
    def fit(self, values: _Array) -> _Array: ...
    def vote(self, kinds: _Array) -> _Array: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def stop_reason(self) -> str: ...
    @property
    def is_complete(self) -> bool: ...
    @property
    def resumed_iterations(self) -> int: ...
    @property
    def smaller_levels(self) -> int: ...

class Stream:
    def __init__(self, parameters: _Dict, reservoir_size: int) -> None: ...
    def add_points(
        self,
        points: Sequence[_Array],
        viewpoints: _Array,
        views: _Array | None,
        normals: _Array | None,
        up: _Array | None,
    ) -> None: ...
    def learn(self, samples: int, progress: _Progress) -> int: ...
    def learn_for_seconds(self, seconds: float, progress: _Progress) -> int: ...
    def mesh(
        self,
        finished: bool,
        viewpoints: _Array,
        views: _Array | None,
        normals: _Array | None,
        up: _Array | None,
        progress: _Progress,
    ) -> _Dict: ...
    @property
    def points(self) -> int: ...
    @property
    def dropped_points(self) -> int: ...
    @property
    def samples(self) -> int: ...
    @property
    def vertices(self) -> int: ...
    @property
    def beginnings(self) -> int: ...
