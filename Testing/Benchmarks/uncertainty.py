# SPDX-License-Identifier: BSD-3-Clause
"""Prints how often the truth lies within the error bars of the vertices, as tables in Markdown.

    uncertainty.py COMMAND [--seeds 1,2,3] [--vertices N] [--set NAME=VALUE] [--picture FILE] [ROW...]

Noise is in percent of the diagonal, on each coordinate. Of a cloud with a gradient the density falls to a tenth from
one end to the other. The error of a vertex is its distance from the surface of which the cloud was made. A row is
excused where the errors on the same cloud without noise (root of the mean square) are more than half of the error bars
(likewise): there the mesh is too coarse for its points, whatever they say.
"""

import argparse
import fnmatch
import functools
import math
import os
import resource
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, reference
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import clouds
import files
import made
import shapes

POINTS = 200000
VERTICES = 20000
NOISES = (0.05, 0.1, 0.2, 0.5)
SHAPES = ("sphere", "torus", "bunny", "fandisk")
SCANS = {"scan_bunny_r01": ("bunny", 10, 0.1), "scan_armadillo_r025": ("armadillo", 14, 0.25)}
REFERENCES = {"scan_bunny_r01": "bunny_pmp_reference", "scan_armadillo_r025": "armadillo_reference"}
TUBE = 0.4
# What is to be reached: the least and the most within one and two error bars, in percent.
GOALS = ((60, 75), (90, 98))
LEAST_OF_SCANS = 85
DEVIATIONS = (0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3)


def torus_unit():
    """What takes clouds.torus() to a diagonal of 1."""
    side = 2 * (1 + TUBE)
    return 1 / np.sqrt(2 * side ** 2 + (2 * TUBE) ** 2)


@functools.cache
def surface(shape):
    """Points of the shape, evenly, more than are needed, and how far others are from it."""
    if shape == "sphere":
        radius = 1 / np.sqrt(12)
        points = np.random.default_rng(1).normal(size=(3 * POINTS, 3))
        return (points / np.linalg.norm(points, axis=1)[:, None] * radius,
                lambda places: np.linalg.norm(places, axis=1) - radius)
    if shape == "torus":
        unit = torus_unit()

        def distances(places):
            x, y, z = places.T / unit
            return unit * (np.hypot(np.hypot(x, y) - 1, z) - TUBE)
        return clouds.torus(3 * POINTS, TUBE) * unit, distances
    mesh = made.model(shape)
    return clouds.sample(*mesh, 3 * POINTS), distance_to(*mesh)


def distance_to(points, triangles):
    """How far places are from these triangles."""
    locator = vtkStaticCellLocator()
    data = files.poly_data(points, triangles)
    locator.SetDataSet(data)
    locator.BuildLocator()

    def distances(places, _keep=data):
        closest, cell, part, squared = [0.0] * 3, reference(0), mutable(0), mutable(0.0)
        found = np.empty(len(places))
        for index, place in enumerate(places):
            locator.FindClosestPoint(place, closest, cell, part, squared)
            found[index] = np.sqrt(float(squared))
        return found
    return distances


def thinned(points, ratio=10):
    """So many of them, whose density falls to 1 / ratio from one end of the longest side to the other."""
    axis = np.ptp(points, axis=0).argmax()
    along = points[:, axis] - points[:, axis].min()
    share = ratio ** (-along / along.max())
    random = np.random.default_rng(7)
    chosen = np.argsort(random.random(len(points)) ** (1 / share))[::-1][:min(POINTS, len(points) // 3)]
    return points[np.sort(chosen)]


class Cloud:
    """A row: its points, and how far its mesh is from the truth."""

    def __init__(self, name, shape, noise=0.0, gradient=False, scan=False, views=False):
        self.name, self.shape, self.noise, self.gradient = name, shape, noise, gradient
        self.scan, self.views = scan, views

    def make(self, noise, folder):
        """Writes the cloud; returns the words that the command takes for it."""
        if self.scan:
            points, view, eyes = self.scanned()
            data = files.poly_data(points, np.empty((0, 3)))
            words = [f"{folder}/cloud.vtp"]
            if self.views:
                array = numpy_to_vtk(np.ascontiguousarray(view, np.int32), deep=True)
                array.SetName("View")
                data.GetPointData().AddArray(array)
                np.savetxt(f"{folder}/eyes.xyz", eyes, fmt="%.9g")
                words += ["--views", f"{folder}/eyes.xyz"]
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(f"{folder}/cloud.vtp")
            writer.SetInputData(data)
            writer.Write()
            return words
        points = surface(self.shape)[0]
        points = thinned(points) if self.gradient else points[:POINTS]
        points = points + np.random.default_rng(2).normal(0, noise / 100, points.shape)
        clouds.write_ply(f"{folder}/cloud.ply", np.random.default_rng(3).permutation(points))
        return [f"{folder}/cloud.ply"]

    def scanned(self):
        path = os.path.join(os.environ.get("NEURALMESH_SCANS", ""), self.shape)
        if os.path.isfile(f"{path}.ply") and os.path.isfile(f"{path}.npz"):
            known = np.load(f"{path}.npz")
            eyes = known["eyes"].reshape(-1, 3)
            return files.read_points(f"{path}.ply"), known["view"].astype(int) % len(eyes), eyes
        content = made.scanned(*SCANS[self.shape])
        return content["points"], content["view"], content["eyes"]

    def distances(self, places):
        if not self.scan:
            return np.abs(surface(self.shape)[1](places))
        folder = os.environ.get("NEURALMESH_SCANS", "")
        path = os.path.join(folder, REFERENCES[self.shape] + ".ply")
        has_scan = os.path.isfile(os.path.join(folder, self.shape + ".ply"))
        mesh = files.read_mesh(path) if has_scan else made.model(SCANS[self.shape][0])
        return distance_to(*mesh)(places)


def rows():
    for shape in SHAPES:
        for noise in NOISES:
            yield Cloud(f"{shape} {noise}", shape, noise)
        yield Cloud(f"{shape} 0.1 gradient", shape, 0.1, gradient=True)
    for scan in SCANS:
        yield Cloud(scan, scan, scan=True)
        yield Cloud(f"{scan} views", scan, scan=True, views=True)


def reconstruct(command, words, mesh, options):
    """The vertices, their error bars and the CPU seconds of a run."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([command, "reconstruct", words[0], mesh, *words[1:], "--quiet", *options],
                          capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(f"{words[0]}: exit status {done.returncode}: {done.stderr.strip()}")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(mesh)
    reader.Update()
    data = vtkPolyData.SafeDownCast(reader.GetOutput())
    bars = data.GetPointData().GetArray("Uncertainty")
    return (vtk_to_numpy(data.GetPoints().GetData()).astype(float),
            None if bars is None else vtk_to_numpy(bars).astype(float),
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def measure(command, cloud, options, folder):
    """The errors and error bars of the vertices, the root mean square of the errors without noise, and what error bars
    cost against the run without them."""
    mesh = f"{folder}/mesh.vtp"
    words = cloud.make(cloud.noise, folder)
    places, bars, seconds = reconstruct(command, words, mesh, [*options, "--uncertainty"])
    without = reconstruct(command, words, mesh, options)[2]
    errors = cloud.distances(places)
    clean = 0.0
    if not cloud.scan:
        words = cloud.make(0.0, folder)
        clean = root_mean_square(cloud.distances(reconstruct(command, words, mesh, options)[0]))
    return errors, bars, clean, seconds / without


def root_mean_square(values):
    return np.sqrt(np.mean(np.square(values)))


def verdict(cloud, one, two, is_coarse):
    if cloud.scan:
        return "yes" if two >= LEAST_OF_SCANS else "no"
    if GOALS[0][0] <= one <= GOALS[0][1] and GOALS[1][0] <= two <= GOALS[1][1]:
        return "yes"
    return "excused" if is_coarse else "no"


def within_gaussian(deviations):
    return 100 * math.erf(deviations / math.sqrt(2))


def print_curve(ratios):
    """Which part of the truth lies within how many error bars, over all rows but the scans."""
    print("\n| within so many error bars | " + " | ".join(f"{k:g}" for k in DEVIATIONS) + " |")
    print("|---" + "|--:" * len(DEVIATIONS) + "|")
    print("| of a Gaussian, % | " + " | ".join(f"{within_gaussian(k):.0f}" for k in DEVIATIONS) + " |")
    print("| of the vertices, % | " + " | ".join(f"{100 * np.mean(ratios <= k):.0f}" for k in DEVIATIONS) + " |")


def draw_curves(curves, path):
    """The curve of each row over that of a Gaussian: what is on the diagonal is as sure as it says."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(5, 5), layout="constrained")
    steps = np.linspace(0, 3.5, 60)
    expected = [within_gaussian(k) for k in steps]
    named = set()
    for name, ratios in curves:
        shape = name.split()[0]
        axes.plot(expected, [100 * np.mean(ratios <= k) for k in steps], linewidth=0.8, alpha=0.6,
                  color=f"C{SHAPES.index(shape)}", label=None if shape in named else shape)
        named.add(shape)
    axes.plot([0, 100], [0, 100], color="black", linewidth=0.8, linestyle="dashed")
    axes.set_xlabel("of a Gaussian within so many deviations, %")
    axes.set_ylabel("of the vertices within so many error bars, %")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=100, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("--seeds", default="1", type=lambda text: [int(seed) for seed in text.split(",")])
    parser.add_argument("--vertices", default=VERTICES, type=int)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--picture")
    parser.add_argument("rows", nargs="*")
    given = parser.parse_intermixed_args()
    chosen = [cloud for cloud in rows()
              if not given.rows or any(fnmatch.fnmatch(cloud.name, pattern) for pattern in given.rows)]
    print("| cloud | seed | within one, % | within two, % | error | error bar | error without noise | CPU | met |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|---|")
    curves, missed = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for cloud in chosen:
            for seed in given.seeds:
                options = ["--vertices", str(given.vertices), "--seed", str(seed)]
                options += [word for text in given.set for word in ("--set", text)]
                errors, bars, clean, ratio = measure(given.command, cloud, options, folder)
                one, two = 100 * np.mean(errors <= bars), 100 * np.mean(errors <= 2 * bars)
                met = verdict(cloud, one, two, clean > root_mean_square(bars) / 2)
                missed += met == "no"
                if not cloud.scan:
                    curves.append((cloud.name, errors / bars))
                print(f"| {cloud.name} | {seed} | {one:.0f} | {two:.0f} | {100 * root_mean_square(errors):.4f} | "
                      f"{100 * root_mean_square(bars):.4f} | "
                      f"{'' if cloud.scan else format(100 * clean, '.4f')} | {ratio:.2f} | {met} |", flush=True)
    if curves:
        print_curve(np.concatenate([ratios for _, ratios in curves]))
    if given.picture:
        draw_curves(curves, given.picture)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
