# SPDX-License-Identifier: BSD-3-Clause
"""Prints how good meshes are: quality.py COMMAND FOLDER [NAME=VALUE...] [CLOUD,REFERENCE,BOUNDARIES...]"""

import json
import os
import re
import subprocess
import sys

import numpy as np

import clouds

VERTICES = 20000
SEEDS = range(1, 6)
MODELS = ("armadillo", "elephant", "eight", "knot1")


def run(*arguments):
    return subprocess.run(arguments, check=True, capture_output=True, text=True).stdout


def own_runs(folder):
    """Clouds of models, clean and with noise and outliers."""
    for model in MODELS:
        points, triangles = clouds.cgal_mesh(model)
        points = (points - points.mean(axis=0)) / np.linalg.norm(np.ptp(points, axis=0))
        reference = f"{folder}/{model}.obj"
        clouds.write_obj(reference, points, triangles)
        clean = clouds.sample(points, triangles, 200000)
        random = np.random.default_rng(1)
        noisy = clean + random.normal(0, 0.005, clean.shape)
        outliers = random.uniform(points.min(axis=0), points.max(axis=0), (4000, 3))
        for name, cloud in (("", clean), ("_noise_outliers", np.vstack((noisy, outliers)))):
            path = f"{folder}/{model}{name}.ply"
            clouds.write_ply(path, cloud)
            yield path, reference, "keep"


def measure(command, options, cloud, reference, boundaries, seed, mesh):
    """The figures of a run, by name."""
    said = run(command, "reconstruct", cloud, mesh, "--vertices", str(VERTICES), "--seed", str(seed),
               "--boundaries", boundaries, *options)
    cuts = re.search(r"(\d+) intersecting", said)
    phases = re.search(r"phases +([\d.]+) CPU s .*learning ([\d.]+),", said)
    distances = json.loads(
        run(command, "compare", reference, mesh, "--json", "--samples", "30000"))
    info = json.loads(run(command, "info", mesh, "--json"))
    to, back = distances["reference_to_result"], distances["result_to_reference"]
    return {
        "topology": (info["closed"], info["components"], info["genus"], info["boundary_loops"]),
        "mean": (to["mean_percent"] + back["mean_percent"]) / 2,
        "to": to["mean_percent"],
        "back": back["mean_percent"],
        "rms": np.sqrt((to["rms_percent"] ** 2 + back["rms_percent"] ** 2) / 2),
        "hausdorff": distances["hausdorff_percent"],
        "normals": distances["normal_angle"],
        "regular": -100 * info["regular_ratio"],
        "quality": -info["triangle_quality"],
        "folds": info["folded_edges"],
        "cuts": int(cuts[1]) if cuts else 0,
        "ratio": float(phases[1]) / float(phases[2]),
        "cpu": float(phases[1]),
    }


def main():
    command, folder, *given = sys.argv[1:]
    options = [word for run in given if "=" in run for word in ("--set", run)]
    runs = [run.split(",") for run in given if "=" not in run] or own_runs(folder)
    print("The worst of the seeds 1 to 5; distances in % of the diagonal of the reference, mean and RMS"
          " of both ways.\nCPU: all, in seconds, and over that of learning.\n")
    print("| cloud | closed / pieces / genus / loops | mean | to result | to reference | RMS | Hausdorff"
          " | normals | regular | 2r/R | folds, cuts | CPU |")
    print("|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    for cloud, reference, boundaries in runs:
        found = [measure(command, options, cloud, reference, boundaries, seed, f"{folder}/mesh.ply")
                 for seed in SEEDS]
        worst = {name: max(figures[name] for figures in found)
                 for name in found[0] if name != "topology"}
        topologies = sorted({figures["topology"] for figures in found})
        topology = ", ".join(
            f"{'yes' if closed else 'no'} / {pieces} / {genus} / {loops}"
            for closed, pieces, genus, loops in topologies)
        name = os.path.splitext(os.path.basename(cloud))[0]
        print(f"| {name}{', close' if boundaries == 'close' else ''} | {topology} | {worst['mean']:.4f} "
              f"| {worst['to']:.4f} | {worst['back']:.4f} | {worst['rms']:.4f} | {worst['hausdorff']:.2f} "
              f"| {worst['normals']:.1f}° | {-worst['regular']:.1f} % | {-worst['quality']:.3f} "
              f"| {worst['folds']}, {worst['cuts']} | {worst['cpu']:.1f}, {worst['ratio']:.1f} × |", flush=True)


if __name__ == "__main__":
    main()
