# SPDX-License-Identifier: BSD-3-Clause
"""The activity list: what it costs and saves, what its meshes are, and large ones."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from .experiment import Case, Claim, Experiment, Finding, Judge, Run, Scale
from .judging import alike, exponent, larger
from .models import SPARSITY
from .plots import bars, curves
from .table import COLUMNS, Table

SEARCH, LIST, HEAPS = "original search", "list", "exact in heaps"
_ORDERS = {SEARCH: "search", LIST: "list", HEAPS: "heaps"}
_STEPS = ("basic", "addition", "removal", "topology")
_LIST_RATE, _EXACT_RATE = 0.2, 0.05  # the thesis's α_L with the list and without


def _steps(
    scale: Scale, model: str, order: str, vertices: int, seed: int, topology: bool, points: int
) -> Case:
    run = Run(
        model,
        scale.points(points),
        scale.list_vertices(vertices),
        seed,
        {"order": _ORDERS[order], "topology": topology},
        "steps",
    )
    return Case({"order": order, "topology": "on" if topology else "off"}, run)


# --- Table 13.1 ----------------------------------------------------------------------------------

# The search through all counters takes minutes beyond.
_LARGEST = {SEARCH: 50000, LIST: 200000, HEAPS: 200000}
_FIRST_SIZE = 2000  # below, what does not depend on the size weighs most
_COUNTS = {"basic": "iterations", "addition": "additions", "removal": "removed",
           "topology": "topology_calls"}  # fmt: skip
# Up to which power of n a cost passes for O(log n), as memory gets slower with n, too; and from which
# one it passes for O(n).
_LOGARITHMIC, _LINEAR = 0.5, 0.7


def _cost_cases(scale: Scale) -> list[Case]:
    return [
        _steps(scale, "torus", order, vertices, 1, True, 1000000)
        for order, vertices in _LARGEST.items()
    ]


def cost_of_calls(row: dict[str, Any], step: str) -> tuple[np.ndarray, np.ndarray]:
    """Sizes of a growing mesh, and microseconds of a call there, in Node Removal of a vertex removed:
    early on, many are in one call."""
    curve = {name: np.array(values) for name, values in row["curve"].items()}
    # Over several rows, so that there are calls.
    calls = curve[_COUNTS[step]][4:] - curve[_COUNTS[step]][:-4]
    seconds = curve[f"{step}_seconds"][4:] - curve[f"{step}_seconds"][:-4]
    kept = calls > 0
    return curve["vertices"][2:-2][kept], 1e6 * seconds[kept] / calls[kept]


def _exponent_of(table: Table, order: str, step: str) -> float:
    sizes, costs = cost_of_calls(table.where(order=order).rows[0], step)
    large = sizes >= min(_FIRST_SIZE, sizes[-1] / 4)
    return exponent(sizes[large], costs[large])


def _total_exponent(table: Table, order: str, is_quadratic: bool) -> float:
    """In the last two doublings where it is said to be quadratic, as what is not shrinks beside that;
    else over all sizes, as steps come where a mesh gets too large for a cache."""
    curve = table.where(order=order).rows[0]["curve"]
    sizes = np.array(curve["vertices"])
    first = sizes[-1] / 4 if is_quadratic else min(_FIRST_SIZE, sizes[-1] / 4)
    return exponent(sizes[sizes >= first], np.array(curve["seconds"])[sizes >= first])


def _is_quadratic(power: float) -> bool:
    return 1.7 <= power <= 2.3


def _is_nearly_linear(power: float) -> bool:
    return 0.9 <= power <= 1.4


def _grows(step: str, orders: tuple[str, ...], linear: bool) -> Judge:
    """That it costs O(n), or O(log n), as far as that is told by the power of n."""

    def judge(table: Table) -> Finding:
        powers = {order: _exponent_of(table, order, step) for order in orders}
        cases = {
            order: power >= _LINEAR if linear else power <= _LOGARITHMIC
            for order, power in powers.items()
        }
        words = "; ".join(f"{order} n^{power:.2f}" for order, power in powers.items())
        return Finding(cases, f"it costs in proportion to: {words}")

    return judge


def _grows_in_all(order: str, quadratic: bool) -> Judge:
    holds = _is_quadratic if quadratic else _is_nearly_linear
    where = "in the last two doublings" if quadratic else f"from {_FIRST_SIZE:,} vertices on"

    def judge(table: Table) -> Finding:
        cases, words = {}, []
        for (topology,), part in table.where(order=order).groups("topology"):
            power = _total_exponent(part, order, quadratic)
            cases[topology] = holds(power)
            words.append(f"topology learning {topology}: n^{power:.2f}")
        return Finding(cases, f"the time in all grows, {where}, with {'; '.join(words)}")

    return judge


def _calls_are_logarithmic(table: Table) -> Finding:
    """Calls rise by about as many with each doubling."""
    cases, words = {}, []
    for (order,), part in table.groups("order"):
        curve = part.rows[0]["curve"]
        sizes, calls = np.array(curve["vertices"]), np.array(curve["topology_calls"])
        kept = sizes >= sizes[-1] / 16
        correlation = float(np.corrcoef(np.log(sizes[kept]), calls[kept])[0, 1])
        cases[order] = correlation > 0.98
        slope = np.polyfit(np.log2(sizes[kept]), calls[kept], 1)[0]
        words.append(f"{order} {slope:.1f} (correlation {correlation:.3f})")
    return Finding(cases, f"calls for each doubling: {'; '.join(words)}")


def _plot_costs(table: Table, path: Path) -> None:
    """A panel for each step: what a call costs by the size of the mesh."""
    rows = []
    for row in table.rows:
        for step in _STEPS:
            sizes, costs = cost_of_calls(row, step)
            curve = {"vertices": sizes.tolist(), "cost": costs.tolist()}
            title = COLUMNS[f"{step}_seconds"].title
            rows.append({"order": row["order"], "step": title, "curve": curve})
    curves(("cost",), "order", over="step", log=True)(Table(rows), path)


COST = Experiment(
    name="cost",
    figures="Table 13.1",
    title="How the cost of a step grows",
    setting="A torus of a million points, the noise-filtering variant with topology learning, to "
    f"{_LARGEST[SEARCH]:,} vertices with the search through all counters, and to "
    f"{_LARGEST[LIST]:,} with the activity list and with exact counters in heaps (the thesis's future "
    "work, 14.2). A cost that grows as n^0.5 or less passes for O(log n): memory gets slower, too, "
    "as a mesh gets larger.",
    cases=_cost_cases,
    claims=(
        Claim(
            "Basic Step: O(log n) with all orders.",
            _grows("basic", tuple(_ORDERS), linear=False),
        ),
        Claim(
            "Node Addition: O(n) by the original search.",
            _grows("addition", (SEARCH,), linear=True),
        ),
        Claim(
            "Node Removal: O(n) by the original search, for each vertex removed.",
            _grows("removal", (SEARCH,), linear=True),
        ),
        Claim("Node Addition: O(log n) by the list.", _grows("addition", (LIST,), linear=False)),
        Claim("Node Removal: O(log n) by the list.", _grows("removal", (LIST,), linear=False)),
        Claim("Topology learning: O(n) a call.", _grows("topology", tuple(_ORDERS), linear=True)),
        Claim("... called O(log n) times.", _calls_are_logarithmic),
        Claim("In all: O(n²) by the original search.", _grows_in_all(SEARCH, quadratic=True)),
        Claim("In all: O(n log n) by the list.", _grows_in_all(LIST, quadratic=False)),
        Claim(
            "(Future work) Exact learning can have that, too: Node Addition in O(log n).",
            _grows("addition", (HEAPS,), linear=False),
        ),
        Claim(
            "(Future work) ... Node Removal in O(log n), too.",
            _grows("removal", (HEAPS,), linear=False),
        ),
        Claim(
            "(Future work) ... and O(n log n) in all.",
            _grows_in_all(HEAPS, quadratic=False),
        ),
    ),
    columns=("vertices", "seconds", *(f"{step}_us" for step in _STEPS)),
    groups=("order",),
    plot=_plot_costs,
    note="The normal-based variant and ensembles are made of the same steps. The heap of the laziest "
    "vertices is put in order only when a removal asks for it, and then takes the vertices that have won "
    "since: its cost grows until a removal is as far from the next one as there are vertices, and then "
    "falls.",
)

# --- Figure 13.1 ---------------------------------------------------------------------------------


def _step_cases(scale: Scale) -> list[Case]:
    return [
        _steps(scale, model, order, 20000, seed, True, 200000)
        for model in scale.some_models(1)
        for order in _ORDERS
        for seed in scale.seeds(2)
    ]


def _faster(step: str, by: float, order: str = LIST, than: str = SEARCH) -> Judge:
    return larger(f"{step}_seconds", "order", than, than=order, by=by)


STEPS = Experiment(
    name="steps",
    figures="Figure 13.1",
    title="Time of each step",
    setting="The first model to 20,000 vertices with topology learning, two runs each.",
    cases=_step_cases,
    claims=(
        Claim(
            "The Basic Step takes almost the same time with the list: within a tenth.",
            alike("basic_seconds", "order", LIST, SEARCH, within=0.1),
        ),
        Claim(
            "Topology learning takes almost the same time: within a tenth.",
            alike("topology_seconds", "order", LIST, SEARCH, within=0.1),
        ),
        Claim("Node Removal takes some less time with the list.", _faster("removal", by=1.1)),
        Claim(
            "Node Addition takes drastically less: a tenth of it at most.",
            _faster("addition", by=10),
        ),
        Claim(
            "(Future work) Exact counters in heaps are as fast in all as the list: a tenth slower at most.",
            larger("seconds", "order", LIST, than=HEAPS, by=0.9),
        ),
    ),
    columns=(*(f"{step}_seconds" for step in _STEPS), "seconds"),
    groups=("model", "order"),
    plot=bars(tuple(f"{step}_seconds" for step in _STEPS), "order"),
    note="The winner is found by an octree there and by a grid here, in the Basic Step. The original "
    "search takes counters through the cache that the mesh is in.",
)

# --- Table 13.2 ----------------------------------------------------------------------------------

_WITH, _WITHOUT = "with L", "without L"
_WITH_LESS = "with L, α_L 0.05"
_WITHOUT_MORE = "without L, α_L 0.2"
_WAYS = {
    _WITHOUT: {"order": "exact", "smoothing_rate": _EXACT_RATE},
    _WITH: {"order": "list", "smoothing_rate": _LIST_RATE},
    _WITHOUT_MORE: {"order": "exact", "smoothing_rate": _LIST_RATE},
    _WITH_LESS: {"order": "list", "smoothing_rate": _EXACT_RATE},
}


def _distance_cases(scale: Scale) -> list[Case]:
    return [
        Case(
            {"way": way},
            Run(model, scale.points(), scale.list_vertices(20000), seed, parameters),
        )
        for model in scale.models
        for way, parameters in _WAYS.items()
        for seed in scale.seeds()
    ]


DISTANCE = Experiment(
    name="distance",
    figures="Table 13.2",
    title="Distance to the model with the list and without",
    setting="The noise-filtering variant to 20,000 vertices, with the thesis's α_L: 0.2 with the "
    "list, 0.05 without; and, as the thesis has not, each with the other α_L.",
    cases=_distance_cases,
    claims=(
        Claim(
            "With the list the Hausdorff distance is larger (3 of 4 models: brain 3.46 against 2.65, "
            "bunny 0.007 against 0.006, hand 8.30 against 6.60; but Max Planck 3.86 against 5.23).",
            larger("hausdorff", "way", _WITH, than=_WITHOUT),
        ),
        Claim("So is the distance on average (RMS).", larger("rms", "way", _WITH, than=_WITHOUT)),
        Claim(
            "It can be put down to α_L 0.2: without the list the RMS distance is larger, too, with "
            "0.2 than with 0.05.",
            larger("rms", "way", _WITHOUT_MORE, than=_WITHOUT),
        ),
        Claim(
            "... and with the same α_L the list makes no difference: RMS distances within a "
            "twentieth.",
            alike("rms", "way", _WITH, _WITHOUT_MORE, within=0.05),
        ),
        Claim(
            "(6.1.1) α_L 0.2 gives more regular vertices than 0.05, here without the list.",
            larger("regular", "way", _WITHOUT_MORE, than=_WITHOUT),
        ),
    ),
    columns=("hausdorff", "rms", "normal_angle", "regular", "seconds"),
    groups=("model", "way"),
    plot=bars(("hausdorff", "rms", "regular"), "way"),
)

# --- Figure 13.2 ---------------------------------------------------------------------------------


def _boundary_cases(scale: Scale) -> list[Case]:
    return [
        _steps(scale, model, order, 50000, 1, topology, 300000)
        for model in scale.some_models(1)
        for order in _ORDERS
        for topology in (False, True)
    ]


def _topology_is_free(table: Table) -> Finding:
    table = table.where(order=LIST)
    off, on = (table.where(topology=value).mean("seconds") for value in ("off", "on"))
    return Finding({"list": on <= 1.1 * off}, f"{off:.1f} s without, {on:.1f} s with")


BOUNDARIES = Experiment(
    name="boundaries",
    figures="Figure 13.2",
    title="With and without topology learning to 50,000 vertices",
    setting="The first model to 50,000 vertices; with the list and with the original search, each "
    "with the thesis's α_L.",
    cases=_boundary_cases,
    claims=(
        Claim("The original takes quadratic time.", _grows_in_all(SEARCH, quadratic=True)),
        Claim("With the list it takes n log n.", _grows_in_all(LIST, quadratic=False)),
        Claim(
            "With the new handling of boundaries topology learning takes no time to speak of: a tenth "
            "at most.",
            _topology_is_free,
        ),
        Claim(
            "More vertices are regular with the list.",
            larger("regular", "order", LIST, than=SEARCH, over="topology"),
        ),
    ),
    columns=("seconds", "regular", "topology_seconds"),
    groups=("model", "order", "topology"),
    plot=curves(("seconds", "regular"), "order", over="topology"),
    note="That topology learning slows the original down is not tested: the boundaries that it kept "
    "by looking through the whole mesh are no part of this engine; both ways keep them as loops.",
)

# --- Figure 13.3 ---------------------------------------------------------------------------------


def _model_cases(scale: Scale) -> list[Case]:
    return [
        _steps(scale, model, order, 20000, seed, False, 200000)
        for model in scale.models
        for order in _ORDERS
        for seed in scale.seeds()
    ]


MODELS_COMPARED = Experiment(
    name="models",
    figures="Figure 13.3",
    title="Time and valence on four models",
    setting="To 20,000 vertices, with the original search and with the list, each with the thesis's "
    "α_L; and with exact counters in heaps.",
    cases=_model_cases,
    claims=(
        Claim("The list is faster on all models.", larger("seconds", "order", SEARCH, than=LIST)),
        Claim(
            "More vertices are regular with the list on all models.",
            larger("regular", "order", LIST, than=SEARCH),
        ),
        Claim(
            "(Future work) Exact counters in heaps are as fast as the list, and faster than the search "
            "by as much: half of its time at most.",
            larger("seconds", "order", SEARCH, than=HEAPS, by=2.0),
        ),
    ),
    columns=("seconds", "regular"),
    groups=("model", "order"),
    plot=curves(("seconds", "regular"), "order"),
)

# --- Table 13.3 ----------------------------------------------------------------------------------

_PLAIN = {"order": "list"}
_EXTRA = {"order": "list", "smoothing_rate": _EXACT_RATE, "smoothing_iterations": 5}
# Vertices, the thesis's seconds, and how its mesh was smoothed.
_LARGE = {
    "270,000 (Atlas: 3 h 46 min)": (270000, 13560, _PLAIN),
    "160,000, extra smoothing (Awakening: 7 h 43 min)": (160000, 27780, _EXTRA),
    "330,000, extra smoothing (Youthful: 31 h 2 min)": (330000, 111720, _EXTRA),
}


def _large_cases(scale: Scale) -> list[Case]:
    return [
        Case(
            {"size": size, "list": "with the list", "thesis_seconds": seconds},
            Run(
                scale.models[i % len(scale.models)],
                scale.points(1000000),
                scale.list_vertices(vertices),
                1,
                parameters,
            ),
        )
        for i, (size, (vertices, seconds, parameters)) in enumerate(_LARGE.items())
    ]


def _of_all_vertices(table: Table) -> Finding:
    cases, words = {}, []
    for (size,), part in table.groups("size"):
        row = part.rows[0]
        cases[size] = row["stop"] == "vertices"
        faster = row["thesis_seconds"] / row["seconds"]
        words.append(f"{row['vertices']:,} vertices of {row['model']} in {row['seconds']:.1f} s, "
                     f"{faster:.0f} times as fast as there")  # fmt: skip
    return Finding(cases, "; ".join(words))


def _costs(table: Table) -> list[float]:
    """CPU time for each vertex, by the rows of the thesis's table."""
    parts = [table.where(size=size).rows[0] for size in _LARGE]
    return [row["seconds"] / row["vertices"] for row in parts]


def _smoothing_doubles(table: Table) -> Finding:
    atlas, awakening, _ = _costs(table)
    ratio = awakening / atlas
    return Finding(
        {"cost": ratio >= 1.5}, f"a vertex costs {ratio:.2f} times as much (there 3.5 times)"
    )


def _grows_with_size(table: Table) -> Finding:
    _, awakening, youthful = _costs(table)
    ratio = youthful / awakening
    return Finding(
        {"cost": ratio <= 1.5},
        f"a vertex costs {ratio:.2f} times as much (there 2.0 times) at twice the size",
    )


LARGE = Experiment(
    name="large",
    figures="Table 13.3",
    title="Large meshes",
    setting="A million points each; the list, with α_L 0.2 for the first one, and with α_L 0.05 and "
    "C_L 5 for the others, as in the thesis, whose scans cannot be had.",
    cases=_large_cases,
    claims=(
        Claim("Meshes of that size can be learnt.", _of_all_vertices),
        Claim(
            "Extra smoothing costs a lot: half as much again for each vertex at least.",
            _smoothing_doubles,
        ),
        Claim(
            "The time grows as n log n: a vertex of the largest mesh costs half as much again at most "
            "as one of the smallest.",
            _grows_with_size,
        ),
    ),
    columns=("vertices", "seconds", "regular", "rms", "hausdorff"),
    groups=("size", "model"),
    plot=curves(("seconds", "regular"), "model", over="list"),
)

# --- Figures 13.4 and 13.5 -----------------------------------------------------------------------

_DEFAULT, _ALTERED, _LESS = "α_L 0.2, C_L 1", "α_L 0.05, C_L 5", "α_L 0.05, C_L 1"
_SMOOTHINGS = {
    _DEFAULT: {"smoothing_rate": 0.2, "smoothing_iterations": 1},
    _ALTERED: {"smoothing_rate": 0.05, "smoothing_iterations": 5},
    _LESS: {"smoothing_rate": 0.05, "smoothing_iterations": 1},
}


def _sparse_cases(scale: Scale) -> list[Case]:
    return [
        Case(
            {"smoothing": smoothing},
            Run(
                plate,
                scale.points(),
                scale.list_vertices(5000),
                seed,
                {"order": "list", **parameters},
                keeps_mesh=seed == 1 and plate == "plate-10",
            ),
        )
        for plate in SPARSITY
        for smoothing, parameters in _SMOOTHINGS.items()
        for seed in scale.seeds()
    ]


def _misses(smoothing: str, at_least: bool) -> Judge:
    """Whether the sparse plates are missed by a twentieth of the diagonal."""

    def judge(table: Table) -> Finding:
        cases, words = {}, []
        for (model,), part in table.where(smoothing=smoothing).groups("model"):
            if SPARSITY[model] > 1:
                missing = part.mean("missing")
                cases[model] = missing >= 5 if at_least else missing < 5
                words.append(f"{model} {missing:.1f}")
        return Finding(cases, f"farthest that is missed, % of the diagonal: {'; '.join(words)}")

    return judge


def _is_difficult(table: Table) -> Finding:
    cases, words = {}, []
    for (model,), part in table.where(smoothing=_ALTERED).groups("model"):
        cases[model] = part.mean("normal_angle") >= 10
        words.append(f"{model} {part.mean('normal_angle'):.1f}")
    return Finding(cases, f"angle between normals, degrees: {'; '.join(words)}")


SPARSE = Experiment(
    name="sparse",
    figures="Figures 13.4 and 13.5",
    title="Thin parts with sparse data",
    setting="A pillar on a thin plate (1/50 of the height), which is scanned as densely as the pillar, "
    "and 10 and 50 times as sparsely; to 5,000 vertices with the list.",
    cases=_sparse_cases,
    claims=(
        Claim(
            "With α_L 0.2 and C_L 1 learning goes wrong where data are sparse: the mesh misses the "
            "plate by a twentieth of the diagonal.",
            _misses(_DEFAULT, at_least=True),
        ),
        Claim(
            "With α_L 0.05 and C_L 5 that is cured: less than that is missed.",
            _misses(_ALTERED, at_least=False),
        ),
        Claim(
            "... and it is the better mesh: its RMS distance is less.",
            larger("rms", "smoothing", _DEFAULT, than=_ALTERED),
        ),
        Claim(
            "The thin plate stays difficult even then: normals are off by ten degrees at least.",
            _is_difficult,
        ),
        Claim(
            "(Ours) What helps is less smoothing: with α_L 0.05 and C_L 1 the RMS distance is less than "
            "with the default.",
            larger("rms", "smoothing", _DEFAULT, than=_LESS),
        ),
    ),
    columns=("missing", "excess", "rms", "normal_angle", "inverted", "regular", "seconds"),
    groups=("model", "smoothing"),
    plot=bars(("missing", "rms", "normal_angle"), "smoothing"),
    pictures={smoothing: {"smoothing": smoothing} for smoothing in _SMOOTHINGS},
)

EXPERIMENTS = (COST, STEPS, DISTANCE, BOUNDARIES, MODELS_COMPARED, LARGE, SPARSE)
