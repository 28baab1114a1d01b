# SPDX-License-Identifier: BSD-3-Clause
"""Prints the errors of levels of detail against runs of their own, as a table in Markdown.

    levels.py COMMAND [--seeds N] [--levels N1,N2,...] CLOUD,REFERENCE...
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import tempfile


def reconstruct(command, cloud, mesh, *options):
    """CPU seconds of a run."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run((command, "reconstruct", cloud, mesh, "--quiet", *options), check=True,
                   capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def rms(command, reference, mesh):
    """Distance both ways, root of the mean square, in % of the diagonal."""
    said = subprocess.run((command, "compare", reference, mesh, "--samples", "50000", "--json"),
                          check=True, capture_output=True, text=True).stdout
    distances = json.loads(said)
    to, back = distances["reference_to_result"], distances["result_to_reference"]
    return ((to["rms_percent"] ** 2 + back["rms_percent"] ** 2) / 2) ** 0.5


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--levels", default="1250,2500,5000,10000,20000")
    parser.add_argument("clouds", nargs="+")
    arguments = parser.parse_args()
    levels = arguments.levels.split(",")
    titles = " | ".join(f"RMS at {level}, own / level" for level in levels)
    print(f"| cloud | {titles} | CPU s, largest / all |")
    print("|---" + "|--:" * (len(levels) + 1) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for run in arguments.clouds:
            cloud, reference = run.split(",")
            own = {level: [] for level in levels}
            made = {level: [] for level in levels}
            seconds, seconds_of_all = [], []
            for seed in range(1, arguments.seeds + 1):
                mesh = f"{folder}/mesh.ply"
                seconds_of_all.append(reconstruct(arguments.command, cloud, mesh, "--levels",
                                                  arguments.levels, "--seed", str(seed)))
                for level in levels:
                    path = mesh if level == levels[-1] else f"{folder}/mesh_{level}.ply"
                    made[level].append(rms(arguments.command, reference, path))
                for level in levels:
                    spent = reconstruct(arguments.command, cloud, mesh, "--vertices", level,
                                        "--seed", str(seed))
                    own[level].append(rms(arguments.command, reference, mesh))
                seconds.append(spent)
            columns = []
            for level in levels:
                ratio = statistics.mean(made[level]) / statistics.mean(own[level])
                columns.append(f"{statistics.mean(own[level]):.4f} / {statistics.mean(made[level]):.4f} "
                               f"({ratio:.2f})")
            name = os.path.splitext(os.path.basename(cloud))[0]
            ratio = statistics.median(b / a for a, b in zip(seconds, seconds_of_all))
            print(f"| {name} | {' | '.join(columns)} | {statistics.mean(seconds):.1f} / "
                  f"{statistics.mean(seconds_of_all):.1f} ({ratio:.2f}) |", flush=True)


if __name__ == "__main__":
    main()
