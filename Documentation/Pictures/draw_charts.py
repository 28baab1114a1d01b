# SPDX-License-Identifier: BSD-3-Clause
"""Draws the charts and diagrams of the documentation: draw_charts.py FOLDER NAME...

A chart of a sweep has a column for each parameter: above how far the surface is from meshes (`Residual`
of other points of it), below how many of their vertices are regular. Each point is the mean of three
small runs on the Stanford bunny: of 3,000 vertices from 50,000 points, clean or with noise of 0.5 % of
the diagonal and 2 % of outliers; the other parameters have their defaults, but for the start and the fit
of learning alone. What is drawn is printed, too.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import clouds
import draw
import neuralmesh

POINTS, VERTICES, SEEDS = 50000, 3000, (1, 2, 3)
OTHERS = 200000  # other points of the surface, to which meshes are held
NOISE, OUTLIERS = 0.005, 1000
OF_WHOLE_RUNS = {"curvature_density", "fit_rounds", "fit_smoothness", "fit_samples"}
ALONE = {"start": "tetrahedron", "fit_rounds": 0}


class Sweep:
    """Values of a parameter, with words for some; a broad line marks the default, a thin one the thesis."""

    def __init__(self, name, symbol, values, default, thesis=None, words={}, **others):
        self.name, self.symbol, self.values, self.words = name, symbol, values, words
        self.default, self.thesis, self.others = default, thesis, others

    def __call__(self, value):
        return {**self.others, self.name: value}


SWEEPS = {
    "sweep_moves": [
        Sweep("winner_rate", "α_w", (0.01, 0.03, 0.1, 0.2, 0.4, 0.8), 0.1, 0.1),
        Sweep("smoothing_rate", "α_L", (0, 0.05, 0.1, 0.2, 0.4, 0.8), 0.2, 0.05),
        Sweep("smoothing_iterations", "C_L", (0, 1, 2, 5, 10), 1, 1),
        Sweep("counter_half_life", "λ", (0.5, 2, 6, 20, 60), 6, 6),
    ],
    "sweep_growth": [
        Sweep("samples_per_addition", "C_vs", (10, 20, 50, 100, 200), 50, 50),
        Sweep("early_patience", "multiples of C_vs", (0.25, 1, 4, 16), 4, 1),
        Sweep("removal_patience", "C_ec", (3, 5, 10, 20, 40), 10, 10),
        Sweep("additions_per_removal", "C_nr", (3, 10, 40, 125), 10, 125),
    ],
    "sweep_noise": [
        Sweep("noise_tolerance", "α_f", (0, 0.5, 1, 2, 4), 1, 1),
        Sweep("outlier_limit", "multiples of ε_t", (1.5, 3, 5, 10, 0), 5, 0, words={0: "none"}),
        Sweep("edge_flips", "", (False, True), True, False, words={False: "off", True: "on"}),
        Sweep("jump_fraction", "part of n, with the list", (0.03, 0.1, 1 / 3, 0.6, 1), 1 / 3, 1 / 3,
              order="list"),
    ],
    "sweep_fit": [
        Sweep("curvature_density", "exponent", (0, 0.25, 0.5, 0.75, 1), 0.5, 0),
        Sweep("fit_rounds", "rounds", (0, 1, 2, 3, 6, 10), 2, 0),
        Sweep("fit_smoothness", "λ", (0, 0.01, 0.1, 1, 10, 100), 0, words={0: "by data"}),
        Sweep("fit_samples", "samples a vertex", (3, 10, 30), 10),
    ],
}


class Scene:
    """Clouds of the surface, and figures of meshes made of them."""

    def __init__(self):
        surface = draw.bunny()
        clean = clouds.sample(*surface, POINTS)
        self.clouds = {"clean": clean, "noisy": draw.spoilt(clean, NOISE, OUTLIERS)}
        self.others = clouds.sample(*surface, OTHERS, seed=2)
        self.diagonal = np.linalg.norm(np.ptp(surface[0], axis=0))
        self.known = {}

    def figures(self, cloud, **parameters):
        """RMS of the distance to the mesh, in % of the diagonal; and % of regular vertices."""
        key = (cloud, *sorted(parameters.items()))
        if key not in self.known:
            self.known[key] = np.mean([self.figures_of(cloud, seed, parameters) for seed in SEEDS], axis=0)
            print(*key, *self.known[key].round(4), flush=True)
        return self.known[key]

    def figures_of(self, cloud, seed, parameters):
        mesh = neuralmesh.reconstruct(self.clouds[cloud], VERTICES, seed, **parameters)
        # Without the fit, a first mesh of all vertices comes out as it is, with the report on its distance.
        count = mesh.GetNumberOfPoints()
        report = neuralmesh.reconstruct(self.others, count, first_mesh=mesh, fit_rounds=0).GetFieldData()
        residual, regular = (report.GetArray(name).GetTuple1(0) for name in ("Residual", "RegularRatio"))
        return 100 * residual / self.diagonal, 100 * regular


def curves(scene, sweep):
    """Labels, styles, and the figures for each value."""
    for label, style, fixed in (("whole run", "-", {}), ("learning alone", ":", ALONE)):
        if fixed and sweep.name in OF_WHOLE_RUNS:
            continue
        for cloud, color in (("clean", "tab:blue"), ("noisy", "tab:red")):
            figures = [scene.figures(cloud, **sweep(value), **fixed) for value in sweep.values]
            yield f"{label}, {cloud}", {"linestyle": style, "color": color}, np.array(figures)


def draw_sweep(path, scene, sweeps):
    figure, rows = plt.subplots(2, len(sweeps), figsize=(3 * len(sweeps), 4.4), sharey="row", sharex="col")
    for column, sweep in zip(rows.T, sweeps):
        places = range(len(sweep.values))
        for label, style, values in curves(scene, sweep):
            for axes, row in zip(column, values.T):
                axes.plot(places, row, marker=".", label=label, **style)
        for axes in column:
            for value, width in ((sweep.default, 5), (sweep.thesis, 1)):
                if value is not None:
                    axes.axvline(sweep.values.index(value), color="black", linewidth=width, alpha=0.3)
            axes.grid(axis="y", alpha=0.3, which="both")
        column[1].set_xticks(places, [sweep.words.get(value, f"{value:.3g}") for value in sweep.values],
                             fontsize=8)
        column[0].set_title("".join(word.capitalize() for word in sweep.name.split("_")), fontsize=10)
        column[1].set_xlabel(sweep.symbol, fontsize=9)
    scale = rows[0, 0]
    scale.set_yscale("log")
    scale.set_yticks((0.05, 0.1, 0.2, 0.5), ("0.05", "0.1", "0.2", "0.5"))
    scale.set_ylabel("residual, % of diagonal")
    rows[1, 0].set_ylabel("regular vertices, %")
    figure.legend(*scale.get_legend_handles_labels(), loc="upper center", ncol=4, fontsize=9)
    save(figure, path, top=0.94)


def save(figure, path, top=1):
    figure.tight_layout(rect=(0, 0, 1, top))
    figure.savefig(path, dpi=100, metadata={"Software": None})
    plt.close(figure)


# --- The steps of the algorithm -------------------------------------------------------------------

HEXAGON = np.array([[np.cos(angle), np.sin(angle)] for angle in np.pi / 3 * np.arange(6)])


def edges_of(axes, lines, **style):
    for a, b in lines:
        axes.plot(*zip(a, b), **{"color": "tab:blue", "linewidth": 1, **style})


def fan(axes, center, ring, **style):
    edges_of(axes, [(center, corner) for corner in ring], **style)
    edges_of(axes, zip(ring, np.roll(ring, -1, axis=0)), **style)


def arrow(axes, tail, head):
    axes.annotate("", head, tail, arrowprops={"arrowstyle": "->", "color": "tab:red"})


def name(axes, place, text, color="black"):
    axes.annotate(text, place, (4, 5), textcoords="offset points", color=color, fontsize=10)


def draw_steps(path):
    figure, (move, smooth, split, collapse) = plt.subplots(1, 4, figsize=(13, 3.4))
    for axes, title in ((move, "1. The winner moves"), (smooth, "2. Its neighbours are smoothed"),
                        (split, "3. The busiest vertex is split"),
                        (collapse, "4. The laziest one is collapsed away")):
        axes.set_title(title, fontsize=11)
        axes.set_aspect("equal")
        axes.axis("off")

    center, sample = np.zeros(2), np.array([0.75, 0.62])
    fan(move, center, HEXAGON, color="lightgray")
    moved = 0.35 * sample
    fan(move, moved, HEXAGON)
    arrow(move, center, sample)
    move.plot(*sample, "o", color="tab:red")
    name(move, sample, "s", "tab:red")
    name(move, moved, "$v_w$")

    ring = HEXAGON * np.array([[1.0], [0.65], [1.2], [0.8], [1.15], [0.7]])
    fan(smooth, moved, ring, color="lightgray")
    even = 0.6 * ring + 0.4 * HEXAGON * 0.92
    fan(smooth, moved, even)
    for before, after in zip(ring, even):
        arrow(smooth, before, before + 1.7 * (after - before))
    name(smooth, moved, "$v_w$")

    longest = HEXAGON * np.array([[1.5], [1], [1], [1], [1], [1]])
    fan(split, center, longest, color="lightgray")
    added = longest[0] / 2
    edges_of(split, zip(longest, np.roll(longest, -1, axis=0)))
    edges_of(split, [(center, longest[i]) for i in (1, 2, 3, 4, 5)])
    edges_of(split, [(added, longest[i]) for i in (0, 1, 5)] + [(added, center)], color="tab:red")
    split.plot(*added, "o", color="tab:red")
    name(split, center, "$v_s$")
    name(split, added, "$v_n$", "tab:red")

    fan(collapse, center, HEXAGON, color="lightgray")
    edges_of(collapse, zip(HEXAGON, np.roll(HEXAGON, -1, axis=0)))
    edges_of(collapse, [(HEXAGON[0], HEXAGON[i]) for i in (2, 3, 4)], color="tab:red")
    arrow(collapse, center, HEXAGON[0])
    name(collapse, center, "removed")
    name(collapse, HEXAGON[0], "kept")
    save(figure, path)


def main():
    folder, *names = sys.argv[1:]
    scene = Scene() if set(names) & set(SWEEPS) else None
    for picture in names:
        path = f"{folder}/{picture}.png"
        if picture in SWEEPS:
            draw_sweep(path, scene, SWEEPS[picture])
        else:
            {"steps": draw_steps}[picture](path)


if __name__ == "__main__":
    main()
