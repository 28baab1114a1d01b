# SPDX-License-Identifier: BSD-3-Clause
"""Prints how far each way to learn topology gets: topology.py COMMAND FOLDER [CLOUD...]

The clouds are made, in FOLDER, but for those given.
"""

import collections
import json
import os
import subprocess
import sys

import clouds

VERTICES, SEEDS = 10000, range(1, 6)
WAYS = {
    "none": ["--topology", "off"],
    "thesis rules, basic": ["--topology", "on", "--method", "basic", "--preset", "thesis"],
    "thesis rules, noise filtering": ["--topology", "on", "--preset", "thesis"],
    "mended rules, basic": ["--topology", "on", "--method", "basic"],
    "mended rules, noise filtering": ["--topology", "on"],
    "mended rules, the list": ["--topology", "on", "--order", "list"],
    "ensemble of 9": ["--ensemble", "9"],
}


def make_clouds(folder):
    made = {
        "torus": clouds.torus(200000),
        "thin torus": clouds.torus(200000, 0.2),
        "eight": clouds.sample(*clouds.cgal_mesh("eight"), 200000),
        "knot": clouds.sample(*clouds.cgal_mesh("knot1"), 200000),
    }
    for name, points in made.items():
        path = f"{folder}/{name.replace(' ', '_')}.ply"
        clouds.write_ply(path, points)
        yield name, path


def learnt(command, cloud, mesh, options):
    """What came out, in words."""
    subprocess.run([command, "reconstruct", cloud, mesh, "--quiet", "--set", "Start=tetrahedron", "--vertices", str(VERTICES),
                    *options], check=True, stderr=subprocess.DEVNULL)
    report = json.loads(subprocess.run([command, "info", "--json", mesh], check=True,
                                       capture_output=True, text=True).stdout)
    words = f"genus {report['genus']}"
    if report["components"] > 1:
        words += f", {report['components']} pieces"
    if not report["closed"]:
        words += ", open"
    return words


def main():
    command, folder, *others = sys.argv[1:]
    named = [(os.path.splitext(os.path.basename(path))[0], path) for path in others]
    print(f"{VERTICES} vertices, {len(SEEDS)} seeds\n")
    print("| cloud | way | result |")
    print("|---|---|---|")
    for name, cloud in [*make_clouds(folder), *named]:
        for way, options in WAYS.items():
            results = collections.Counter(
                learnt(command, cloud, f"{folder}/mesh.ply", [*options, "--seed", str(seed)])
                for seed in SEEDS)
            words = "; ".join(f"{count} times {result}" for result, count in results.most_common())
            print(f"| {name} | {way} | {words} |", flush=True)


if __name__ == "__main__":
    main()
