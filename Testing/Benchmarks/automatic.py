# SPDX-License-Identifier: BSD-3-Clause
"""Prints the errors of meshes with and without --automatic, as a table in Markdown.

    automatic.py COMMAND [--seeds N] [--vertices N] CLOUD,REFERENCE[,close]...
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import tempfile


def figures(command, cloud, reference, options, mesh):
    """RMS both ways and mean in % of the diagonal, CPU seconds, what was chosen."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = subprocess.run((command, "reconstruct", cloud, mesh, *options), check=True,
                          capture_output=True, text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    distances = json.loads(subprocess.run((command, "compare", reference, mesh, "--samples", "50000", "--json"),
                                          check=True, capture_output=True, text=True).stdout)
    to, back = distances["reference_to_result"], distances["result_to_reference"]
    chosen = [line[len("chosen"):].strip() for line in said.splitlines() if line.startswith("chosen")]
    return {
        "rms": ((to["rms_percent"] ** 2 + back["rms_percent"] ** 2) / 2) ** 0.5,
        "mean": (to["mean_percent"] + back["mean_percent"]) / 2,
        "cpu": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
        "chosen": chosen[0] if chosen else "",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--vertices", default="20000")
    parser.add_argument("clouds", nargs="+")
    arguments = parser.parse_args()
    print("| cloud | chosen, by seed | mean | with it | RMS | with it | RMS, ratio by seed | CPU | with it |")
    print("|---|---|--:|--:|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder:
        for run in arguments.clouds:
            cloud, reference, *close = run.split(",")
            options = ["--vertices", arguments.vertices, *(["--boundaries", "close"] if close else [])]
            plain, chosen = [], []
            for seed in range(1, arguments.seeds + 1):
                own = [*options, "--seed", str(seed)]
                mesh = f"{folder}/mesh.ply"
                plain.append(figures(arguments.command, cloud, reference, own, mesh))
                chosen.append(figures(arguments.command, cloud, reference, [*own, "--automatic"], mesh))

            def mean(rows, key):
                return statistics.mean(row[key] for row in rows)

            name = os.path.splitext(os.path.basename(cloud))[0] + (", closed" if close else "")
            ratios = " ".join(f"{b['rms'] / a['rms']:.3f}" for a, b in zip(plain, chosen))
            words = "; ".join(dict.fromkeys(row["chosen"] for row in chosen))
            print(f"| {name} | {words} | {mean(plain, 'mean'):.4f} | {mean(chosen, 'mean'):.4f} "
                  f"| {mean(plain, 'rms'):.4f} | {mean(chosen, 'rms'):.4f} | {ratios} "
                  f"| {mean(plain, 'cpu'):.1f} s | {mean(chosen, 'cpu'):.1f} s |", flush=True)


if __name__ == "__main__":
    main()
