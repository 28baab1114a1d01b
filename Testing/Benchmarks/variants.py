# SPDX-License-Identifier: BSD-3-Clause
"""Prints what each variant, jump, operation and stopping rule costs: variants.py COMMAND FOLDER"""

import csv
import json
import subprocess
import sys

import clouds

VERTICES = 10000
# Learning by itself is measured.
ALONE = ["--set", "Start=tetrahedron", "--set", "FitRounds=0"]
WAYS = {
    "noise filtering (default)": [],
    "basic": ["--method", "basic"],
    "normal-based": ["--method", "normal"],
    "thesis preset: noise filtering": ["--preset", "thesis"],
    "thesis preset: basic, C_L 5": ["--method", "basic", "--preset", "thesis"],
    "thesis preset: normal-based, C_L 5": ["--method", "normal", "--preset", "thesis"],
    "extra smoothing, C_L 10": ["--set", "SmoothingIterations=10"],
    "topology learning": ["--topology", "on"],
    "feature strength": ["--features"],
    "edge split": ["--set", "AdditionOperation=edge_split"],
    "full-edge collapse": ["--set", "RemovalOperation=full_edge_collapse"],
    "vertex delete": ["--set", "RemovalOperation=vertex_delete"],
    "list": ["--order", "list"],
    "list, jump by normal activity": ["--order", "list", "--jump", "normal"],
    "list, jump by area change": ["--order", "list", "--jump", "area"],
    "list, jump by volume change": ["--order", "list", "--jump", "volume"],
    "list, weighted jump": ["--order", "list", "--jump", "weighted"],
    "normal-based, list": ["--method", "normal", "--order", "list"],
    "until 10^6 iterations": ["--set", "MaximumIterations=1000000"],
    "until the mean distance of s and v_w is 0.5 %": ["--set", "TargetSampleDistance=0.005"],
    "until the cloud is 0.05 % from the mesh": ["--set", "TargetCloudDistance=0.0005"],
    "until M_delta is 0.0005": ["--set", "TargetNormalChange=0.0005"],
    "from a mesh of half the size": None,
}


def run(*arguments):
    return subprocess.run(arguments, check=True, capture_output=True, text=True).stdout


def main():
    command, folder = sys.argv[1:]
    surface, cloud, mesh, curve, half = (
        f"{folder}/{name}" for name in ("s.obj", "c.ply", "m.vtp", "c.csv", "half.vtp"))
    points, triangles = clouds.cgal_mesh("armadillo")
    clouds.write_ply(cloud, clouds.sample(points, triangles, 200000))
    clouds.write_obj(surface, points, triangles)
    run(command, "reconstruct", cloud, half, "--vertices", str(VERTICES // 2), "--quiet", *ALONE)
    print(f"armadillo, {VERTICES} vertices; RMS from the surface to the mesh in % of the diagonal\n")
    print("| way | vertices | ns a sample | RMS | regular |")
    print("|---|--:|--:|--:|--:|")
    for way, options in WAYS.items():
        options = ["--initial", half] if options is None else options
        run(command, "reconstruct", cloud, mesh, "--vertices", str(VERTICES), "--quiet",
            "--statistics", curve, *ALONE, *options)
        with open(curve, encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        cost = 1e9 * float(last["Seconds"]) / float(last["Iteration"])
        distances = json.loads(run(command, "compare", surface, mesh, "--json", "--samples", "50000"))
        rms = distances["reference_to_result"]["rms_percent"]
        print(f"| {way} | {last['Vertices']} | {cost:.0f} | {rms:.3f} "
              f"| {100 * float(last['RegularRatio']):.1f} % |", flush=True)


if __name__ == "__main__":
    main()
