# SPDX-License-Identifier: BSD-3-Clause
"""Prints numbers of vertices that are found beside those of a search, as tables in Markdown.

    how_many.py [--seed N] [--tolerances PERCENT,...] [--measure rms|99|largest] [--no-ladder] [--no-search]
                CLOUD[,REFERENCE]...

The first table is of numbers that the cloud tells: a ladder of runs with 1000, 2000, ... vertices, up to
half as many as points, tells the best error and the smallest number that comes within 1.05 times of it. The
error is that to the reference, root of the mean square of both ways, or where there is none the residual. The
second is of tolerances, in percent of the diagonal: a bisection by runs with given numbers tells the fewest
vertices whose held-out points lie so close. CPU time is that of the process, of the run that finds its number
over a run with that number given.
"""

import argparse
import math
import os
import time
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader

import neuralmesh

MEASURES = {"rms": "root_mean_square", "99": "ninety_nine_percent", "largest": "largest"}
CLOSE_ENOUGH = 1.05


def points_of(path):
    reader = vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPoints().GetData()), reader.GetOutput()


def field(mesh, name):
    return mesh.GetFieldData().GetArray(name).GetValue(0)


class Cloud:
    def __init__(self, text, seed):
        path, _, reference = text.partition(",")
        self.name = os.path.splitext(os.path.basename(path))[0]
        self.points = points_of(path)[0]
        self.reference = points_of(reference)[1] if reference else None
        self.diagonal = float(np.linalg.norm(np.ptp(self.points, axis=0)))
        self.seed = seed

    def run(self, vertices=20000, **more):
        """A mesh, and the CPU seconds that it took."""
        before = time.process_time()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            mesh = neuralmesh.reconstruct(self.points, vertices, self.seed, **more)
        return mesh, time.process_time() - before

    def error(self, mesh):
        """In percent of the diagonal."""
        if self.reference is None:
            return 100 * field(mesh, "Residual") / self.diagonal
        distances = neuralmesh.compare(self.reference, mesh, samples=50000)
        ways = [distances[way]["rms_percent"] for way in ("reference_to_result", "result_to_reference")]
        return math.sqrt((ways[0] ** 2 + ways[1] ** 2) / 2)

    def percent(self, mesh, name):
        return f"{100 * field(mesh, name) / self.diagonal:.4f}"


def sizes_of_ladder(points):
    size = 1000
    while size < points // 2:
        yield size
        size *= 2
    yield points // 2


def row_by_cloud(cloud, has_ladder):
    mesh, seconds = cloud.run(0)
    chosen = mesh.GetNumberOfPoints()
    given, seconds_of_given = cloud.run(chosen)
    cells = [cloud.name, f"{chosen}", cloud.percent(mesh, "PredictedError"), cloud.percent(mesh, "ReachedError"),
             cloud.percent(mesh, "NoiseTakenOff")]
    if has_ladder:
        error = cloud.error(mesh)
        ladder = {size: cloud.error(cloud.run(size)[0]) for size in sizes_of_ladder(len(cloud.points))}
        best = min(ladder.values())
        smallest = min(size for size, of_size in ladder.items() if of_size <= CLOSE_ENOUGH * best)
        cells += [f"{error:.4f} / {best:.4f} ({error / best:.2f})", f"{smallest} ({chosen / smallest:.2f})"]
    return cells + [f"{seconds:.1f} / {seconds_of_given:.1f} ({seconds / seconds_of_given:.2f})"]


def meets(cloud, vertices, length, noise):
    """Whether the root mean square of a run with so many vertices, noise taken off, is at most so much."""
    residual = field(cloud.run(vertices)[0], "Residual")
    return math.sqrt(max(0, residual**2 - noise**2)) <= length


def fewest(cloud, length, noise, near):
    """By a bisection between half and twice as many, to 2 %; nothing if it lies elsewhere."""
    low, high = max(4, near // 2), min(2 * near, len(cloud.points) // 2)
    if meets(cloud, low, length, noise) or not meets(cloud, high, length, noise):
        return None
    while high / low > 1.02:
        middle = round(math.sqrt(low * high))
        if meets(cloud, middle, length, noise):
            high = middle
        else:
            low = middle
    return high


def row_of_tolerance(cloud, tolerance, measure, has_search):
    mesh, seconds = cloud.run(tolerance=tolerance, tolerance_is_percent=True, tolerance_measure=MEASURES[measure])
    chosen = mesh.GetNumberOfPoints()
    _, seconds_of_given = cloud.run(chosen)
    cells = [cloud.name, f"{tolerance:g}", f"{chosen}", cloud.percent(mesh, "PredictedError"),
             cloud.percent(mesh, "ReachedError")]
    if has_search:
        found = fewest(cloud, tolerance / 100 * cloud.diagonal, field(mesh, "NoiseTakenOff"), chosen)
        cells.append("not between half and twice" if found is None else f"{found} ({chosen / found:.2f})")
    return cells + [f"{seconds:.1f} / {seconds_of_given:.1f} ({seconds / seconds_of_given:.2f})"]


def print_head(titles):
    print("| " + " | ".join(titles) + " |")
    print("|---" + "|--:" * (len(titles) - 1) + "|", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tolerances", default="0.1,0.03")
    parser.add_argument("--measure", choices=list(MEASURES), default="rms")
    parser.add_argument("--no-ladder", action="store_true", help="without that of the first table, which takes long")
    parser.add_argument("--no-search", action="store_true", help="without the bisection of the second table")
    parser.add_argument("clouds", nargs="+")
    arguments = parser.parse_args()
    has_ladder = not arguments.no_ladder
    clouds = [Cloud(text, arguments.seed) for text in arguments.clouds]
    more = ["error / best of the ladder, %", "smallest within 1.05"] if has_ladder else []
    print_head(["cloud", "vertices", "predicted, %", "reached, %", "noise, %", *more, "CPU s"])
    for cloud in clouds:
        print("| " + " | ".join(row_by_cloud(cloud, has_ladder)) + " |", flush=True)
    print()
    has_search = not arguments.no_search and arguments.measure == "rms"
    more = ["fewest by bisection"] if has_search else []
    print_head(["cloud", "tolerance, %", "vertices", "predicted, %", "reached, %", *more, "CPU s"])
    for cloud in clouds:
        for tolerance in arguments.tolerances.split(","):
            row = row_of_tolerance(cloud, float(tolerance), arguments.measure, has_search)
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
