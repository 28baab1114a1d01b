#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the command in every combination of method, order, jump and topology that it offers.

    sweep.py [--vertices N] [--checker PROGRAM] COMMAND CLOUD...

On each cloud every combination must give as many vertices as asked for, or say that it has stalled,
and an oriented 2-manifold by `COMMAND info --json`, and by `PROGRAM info` if another program that
prints such JSON is given. Combinations without sense must be refused as wrong use (status 2), with a
message that names what does go together. Prints a line for each cloud, and what is wrong.
"""

import argparse
import itertools
import json
import os
import subprocess
import sys
import tempfile

METHODS = ("basic", "normal", "noise")
ORDERS = ("exact", "list")
JUMPS = ("constant", "normal", "area", "volume", "weighted")
TOPOLOGIES = ("off", "on")


def refusal(method, order, jump, topology):
    """What the message must name if the combination has no sense; nothing if it has."""
    if order == "exact" and jump != "constant":
        return "list"
    if method == "normal" and topology == "on":
        return "basic"
    return None


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=1800)


def defects(checker, mesh):
    report = json.loads(run(*checker, mesh).stdout.splitlines()[0])
    return [key for key in ("edge_manifold", "vertex_manifold", "oriented") if not report[key]]


def try_combination(arguments, cloud, mesh, combination):
    """What is wrong, in words."""
    options = [text for name, value in zip(("method", "order", "jump", "topology"), combination)
               for text in ("--" + name, value)]
    if os.path.exists(mesh):
        os.remove(mesh)
    done = run(arguments.command, "reconstruct", cloud, mesh, "--quiet", *options,
               "--vertices", str(arguments.vertices))
    sensible = refusal(*combination)
    if sensible:
        refused = done.returncode == 2 and sensible in done.stderr and not os.path.exists(mesh)
        return [] if refused else [f"not refused: {done.returncode}, {done.stderr}"]
    if done.returncode != 0:
        return [f"exit status {done.returncode}: {done.stderr}"]
    wrong = defects([arguments.command, "info", "--json"], mesh)
    if arguments.checker:
        wrong += defects([arguments.checker, "info"], mesh)
    vertices = json.loads(run(arguments.command, "info", "--json", mesh).stdout)["vertices"]
    if vertices != arguments.vertices and "stopped growing" not in done.stderr:
        wrong.append(f"{vertices} vertices")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vertices", type=int, default=2000)
    parser.add_argument("--checker")
    parser.add_argument("command")
    parser.add_argument("clouds", nargs="+")
    arguments = parser.parse_args()
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for cloud in arguments.clouds:
            runs = refused = wrong_here = 0
            for combination in itertools.product(METHODS, ORDERS, JUMPS, TOPOLOGIES):
                wrong = try_combination(arguments, cloud, f"{folder}/mesh.ply", combination)
                runs += refusal(*combination) is None
                refused += refusal(*combination) is not None
                wrong_here += bool(wrong)
                if wrong:
                    print(f"{cloud}: {' '.join(combination)}: {', '.join(wrong)}", flush=True)
            print(f"{cloud}: {runs} combinations run, {refused} refused, {wrong_here} wrong", flush=True)
            failures += wrong_here
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
