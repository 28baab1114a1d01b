# SPDX-License-Identifier: BSD-3-Clause
"""Prints the battery as a table in Markdown. See scans.sh."""

import argparse
import dataclasses
import fnmatch
import hashlib
import json
import os
import resource
import subprocess
import sys
from typing import Optional

import numpy as np

import crossings
import files
import measure
import rows
import shapes


@dataclasses.dataclass
class Scan:
    """A cloud in a file, and what is known of it."""

    path: str
    reference: Optional[str] = None
    view: Optional[np.ndarray] = None
    eyes: Optional[np.ndarray] = None
    part: Optional[np.ndarray] = None


def found(cloud, folder):
    """The cloud from the folder that the user names, or None."""
    path = f"{folder}/{cloud.file}.ply"
    if not folder or not os.path.exists(path):
        return None
    references = [f"{folder}/{name}.ply" for name in (cloud.reference, f"{cloud.file}_reference") if name]
    scan = Scan(path, next(filter(os.path.exists, references), None))
    if os.path.exists(path[:-4] + ".npz"):
        known = np.load(path[:-4] + ".npz")
        scan.eyes = known["eyes"].reshape(-1, 3)
        scan.view = known["view"].astype(int) % len(scan.eyes)
    return scan


def made(cloud, folder):
    """The cloud as it is made, in the folder of the work; it is not made twice in the same way."""
    kept = f"{folder}/{cloud.file}.json"
    makers = digest(*(module.__file__ for module in (rows, rows.made, rows.made.clouds, rows.made.scanner, shapes)))
    written = {}
    if os.path.exists(kept):
        with open(kept, encoding="ascii") as file:
            written = json.load(file)
    if written.pop("makers", None) != makers:
        content = cloud.make()
        data, ending = content.get("file", (None, "ply"))
        written = {"path": f"{folder}/{cloud.file}.{ending}"}
        if data is None:
            rows.made.clouds.write_ply(written["path"], content["points"])
        else:
            with open(written["path"], "wb") as file:
                file.write(data)
        if "mesh" in content:
            written["reference"] = f"{folder}/{cloud.file}_reference.ply"
            files.write_mesh(written["reference"], *content["mesh"])
        known = {name: content[name] for name in ("view", "eyes", "part") if name in content}
        np.savez_compressed(f"{folder}/{cloud.file}.npz", **known)
        with open(kept, "w", encoding="ascii") as file:
            json.dump({**written, "makers": makers}, file)
    return Scan(**written, **np.load(f"{folder}/{cloud.file}.npz"))


def digest(*paths):
    result = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            result.update(file.read())
    return result.hexdigest()


def program(command):
    """What tells this build from another one: the command, the libraries of ours that it loads, and how is measured."""
    loaded = subprocess.run(["ldd", command], capture_output=True, text=True).stdout
    own = [line.split("=>")[1].split()[0] for line in loaded.splitlines() if "NeuralMesh" in line and "=>" in line]
    return digest(command, *own, measure.__file__, crossings.__file__)


def run(command, cloud, scan, seed, mesh, points):
    """Reconstructs; what the run said on stderr, and its CPU seconds."""
    vertices = cloud.vertices or min(rows.VERTICES, points // 5)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([command, "reconstruct", scan.path, mesh, "--vertices", str(vertices), "--seed", str(seed),
                           "--quiet", *cloud.options], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 3):
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr[-300:].strip()}")
    return done.stderr, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def figures(command, build, cloud, scan, seed, folder):
    """The figures of one run; those of an earlier one, if build, cloud and the figures asked for are the same."""
    mesh, kept = (f"{folder}/{cloud.name}_seed_{seed}.{ending}" for ending in ("ply", "json"))
    os.makedirs(folder, exist_ok=True)
    known = [path for path in (scan.reference, scan.path[:-4] + ".npz") if path and os.path.exists(path)]
    key = [build, digest(scan.path, *known), sorted(cloud.goals), cloud.vertices, list(cloud.options)]
    if os.path.exists(kept):
        with open(kept, encoding="utf-8") as file:
            result = json.load(file)
        if result["key"] == key:
            return result
    result = {"key": key, "points": len(files.read_points(scan.path))}
    try:
        result["said"], result["cpu"] = run(command, cloud, scan, seed, mesh, result["points"])
        measured = measure.Measurement(command, scan, mesh).figures(cloud.goals)
        result["figures"] = {name: None if value is None else float(value) for name, value in measured.items()}
    except RuntimeError as error:
        result["error"] = str(error)
    with open(kept + ".new", "w", encoding="utf-8") as file:
        json.dump(result, file)
    os.replace(kept + ".new", kept)
    return result


def meets(name, figure, goal):
    if figure is None:
        return False
    if name in rows.EXACTLY:
        return figure == goal
    return figure >= goal if name in rows.AT_LEAST else figure <= goal


def worst(name, figures, goal):
    """The figure of the seeds that is farthest from the goal."""
    if name in rows.AT_LEAST:
        return min(figures)
    if name in rows.EXACTLY:
        return max(figures, key=lambda figure: abs(figure - goal) if figure is not None else np.inf)
    return max(figures)


def number(value):
    return "none" if value is None else f"{value:.4g}"


def relative_goals(cloud, results):
    """The goals that an earlier build sets."""
    reached = [result["figures"] for result in results]
    return {name: [figures[name] for figures in reached] if name in rows.EXACTLY
            else goal * np.mean([figures[name] for figures in reached]) for name, goal in cloud.goals.items()}


def relative_line(cloud, results, before):
    """The line of a cloud on which an earlier build sets the goals, and whether they are met."""
    failed = [result["error"] for result in (*before, *results) if "error" in result]
    if failed:
        return f"| {cloud.name} | {results[0]['points']} | | {failed[0]} | | | **no** |", False
    goals, words, reached, met = relative_goals(cloud, before), [], [], True
    for name, goal in goals.items():
        found = [result["figures"][name] for result in results]
        if name in rows.EXACTLY:
            there = found == goal
            told, found = (" or ".join(number(value) for value in dict.fromkeys(values)) for values in (goal, found))
            words.append(f"{name} {told}")
        else:
            found = np.mean(found)
            there, found = found <= goal, number(found)
            words.append(f"{name} ≤ {number(goal)}")
        met &= bool(there)
        reached.append(f"{name} {found}" if there else f"**{name} {found}**")
    warned = sum("warning" in result["said"].lower() for result in results)
    cpu = max(result["cpu"] for result in results)
    return (f"| {cloud.name} | {results[0]['points']} | {', '.join(words)} | {', '.join(reached)} "
            f"| {warned} of {len(results)} | {cpu:.1f} | {'yes' if met else '**no**'} |"), met


def line(cloud, scan, results):
    """The line of the table, and whether the goals are met."""
    signs = {name: "" if name in rows.EXACTLY else "≥ " if name in rows.AT_LEAST else "≤ " for name in cloud.goals}
    goals = ", ".join(f"{name} {signs[name]}{goal:g}" for name, goal in cloud.goals.items())
    if scan is None:
        goals = "what an earlier build reaches" if cloud.relative else goals
        return f"| {cloud.name} | | {goals} | | | not here |", True
    errors = [result["error"] for result in results if "error" in result]
    words, met = [], not errors
    for name, goal in cloud.goals.items():
        seeds = [result["figures"][name] for result in results if "error" not in result]
        if seeds:
            figure = worst(name, seeds, goal)
            met &= meets(name, figure, goal)
            words.append(f"{name} {number(figure)}" if meets(name, figure, goal) else f"**{name} {number(figure)}**")
    words += errors[:1]
    warned = sum("warning" in result.get("said", "").lower() for result in results)
    cpu = max((result["cpu"] for result in results if "cpu" in result), default=0)
    return (f"| {cloud.name} | {results[0]['points']} | {goals} | {', '.join(words)} | {warned} of {len(results)} "
            f"| {cpu:.1f} | {'yes' if met else '**no**'} |"), met


def chosen(words):
    """The clouds whose names or rows are those, or match them."""
    def are_meant(word):
        return [cloud for cloud in rows.CLOUDS.values()
                if any(fnmatch.fnmatch(name, word) for name in (cloud.name, cloud.row))]

    for word in words:
        if not are_meant(word):
            sys.exit(f"scans.sh: there is no row {word}; --list names them")
    meant = {cloud.name for word in words for cloud in are_meant(word)}
    return [cloud for cloud in rows.CLOUDS.values() if (cloud.name in meant if words else cloud.row != "small")]


def measured(cloud, arguments, build):
    """The line of the table, whether the goals are met, and whether the cloud is here."""
    scan = found(cloud, arguments.data) or (made(cloud, arguments.work) if cloud.make else None)
    if scan is None:
        return *line(cloud, None, []), False
    if cloud.relative and not arguments.before:
        return f"| {cloud.name} | | what an earlier build reaches | | | | no --before |", True, False

    def all_seeds(command, program_of, folder):
        seeds = arguments.seeds or ("1,2,3,4,5,6,7,8,9,10" if cloud.relative else "1,2,3,4,5")
        return [figures(command, program_of, cloud, scan, int(seed), folder) for seed in seeds.split(",")]

    results = all_seeds(arguments.command, build, arguments.work)
    if not cloud.relative:
        return *line(cloud, scan, results), True
    before = all_seeds(arguments.before, program(arguments.before), f"{arguments.work}/before")
    return *relative_line(cloud, results, before), True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("work")
    parser.add_argument("--seeds")
    parser.add_argument("--data", default="")
    parser.add_argument("--before")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("rows", nargs="*")
    arguments = parser.parse_intermixed_args()
    wanted = chosen(arguments.rows)
    if arguments.list:
        print("\n".join(f"{cloud.row}: {cloud.name}" for cloud in wanted))
        return 0
    os.makedirs(arguments.work, exist_ok=True)
    build = program(arguments.command)
    print("| cloud | points | to reach | reached | warned | CPU s | met |\n|---|--:|---|---|---|--:|---|", flush=True)
    missed = here = 0
    for cloud in wanted:
        text, met, is_here = measured(cloud, arguments, build)
        print(text, flush=True)
        missed += not met
        here += is_here
    print(f"\n{missed} of {here} clouds miss their goals, {len(wanted) - here} were not measured.")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
