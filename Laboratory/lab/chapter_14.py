# SPDX-License-Identifier: BSD-3-Clause
"""The questions that the thesis leaves open: what variable jump distances do."""

from __future__ import annotations

from .experiment import Case, Claim, Experiment, Finding, Judge, Run, Scale
from .judging import is_larger, larger
from .plots import bars
from .table import Table

EXACT, CONSTANT = "exact counters", "constant n/3"
_NORMAL = "normal activity"
_FAMILIES = {
    EXACT: {"order": "exact"},
    CONSTANT: {},
    "constant n/10": {"jump_fraction": 0.1},
    _NORMAL: {"jump": "normal_activity"},
    "area change": {"jump": "area_change"},
    "volume change": {"jump": "volume_change"},
    "mean of all": {"jump": "weighted"},
}
_VARIABLE = (_NORMAL, "area change", "volume change", "mean of all")


def _jump_cases(scale: Scale) -> list[Case]:
    return [
        Case(
            {"jump": family},
            Run(
                model,
                scale.points(),
                scale.list_vertices(10000),
                seed,
                {"order": "list", "smoothing_rate": 0.2, **parameters},
                keeps_mesh=model == "cube" and seed == 1,
            ),
        )
        for model in (*scale.models, "cube")
        for family, parameters in _FAMILIES.items()
        for seed in scale.seeds()
    ]


def _best(column: str, families: tuple[str, ...], than: str, sign: int = 1) -> Judge:
    """On which models one of the families is better than another one, and which is best."""

    def judge(table: Table) -> Finding:
        cases, words = {}, []
        for (model,), part in table.groups("model"):
            parts = {family: part.where(jump=family) for family in families}
            best = min(parts, key=lambda family: sign * parts[family].mean(column))
            other = part.where(jump=than)
            pair = (other, parts[best]) if sign > 0 else (parts[best], other)
            cases[model] = is_larger(column, *pair)
            change = 100 * (parts[best].mean(column) / other.mean(column) - 1)
            words.append(f"{model}: {best} {change:+.0f} %")
        return Finding(cases, "; ".join(words))

    return judge


JUMPS = Experiment(
    name="jumps",
    figures="Open question 14.2",
    title="Variable jump distances against each other and against exact learning",
    setting="The noise-filtering variant to 10,000 vertices, α_L 0.2 in all ways, on all models and "
    "on a cube.",
    cases=_jump_cases,
    claims=(
        Claim(
            "(11.2.1) Constant jumps give the density of the points: on the cube, that near edges "
            "differs by a fourth at most.",
            lambda table: _cube_density(table.where(model="cube", jump=CONSTANT)),
        ),
        Claim(
            "(11.2.1) Jumps by normal activity follow the curvature: on the cube, the density near "
            "edges is a fourth larger at least.",
            lambda table: larger("edge_density", "jump", _NORMAL, than=CONSTANT, by=1.25)(
                table.where(model="cube")
            ),
        ),
        Claim(
            "(14.2) Variable jumps are promising: the best of them is closer to the model (RMS) than "
            "constant jumps.",
            _best("rms", _VARIABLE, CONSTANT),
        ),
        Claim(
            "(14.2) ... and closer than exact learning.",
            _best("rms", _VARIABLE, EXACT),
        ),
        Claim(
            "(14.2) ... and has more regular vertices than exact learning.",
            _best("regular", _VARIABLE, EXACT, sign=-1),
        ),
        Claim(
            "(14.2) The original, tried and tested technique remains the best: exact learning is "
            "closer (RMS) than constant jumps of n/3.",
            larger("rms", "jump", CONSTANT, than=EXACT),
        ),
        Claim(
            "(14.2) ... and has more regular vertices.",
            larger("regular", "jump", EXACT, than=CONSTANT),
        ),
        Claim(
            "(Ours) With exact counters in heaps it takes less time, too.",
            larger("seconds", "jump", CONSTANT, than=EXACT),
        ),
    ),
    columns=("rms", "hausdorff", "regular", "edge_density", "seconds"),
    groups=("model", "jump"),
    plot=bars(("rms", "regular", "seconds"), "jump"),
    pictures={family: {"jump": family} for family in (EXACT, CONSTANT, _NORMAL, "area change")},
)


def _cube_density(table: Table) -> Finding:
    density = table.mean("edge_density")
    return Finding(
        {"cube": 0.8 <= density <= 1.25}, f"density near edges over that of points: {density:.2f}"
    )


EXPERIMENTS = (JUMPS,)
