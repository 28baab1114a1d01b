# SPDX-License-Identifier: BSD-3-Clause
"""Prints our meshes beside those of others, as tables in Markdown, and draws charts and meshes.

    compare.py COMMAND TOOLS FOLDER [--chart FILE] [--meshes FILE] [CLOUD...]

TOOLS has the others: CgalSurface, and the virtual environment `venv`. One thread each. Of the settings of one the
best counts: with the least mean distance, or on hard clouds the least sum of points missed and area invented. What
FOLDER has from an earlier run of the same programs is not made again. What a peer lacks on this machine is said.
"""

import argparse
import json
import os
import platform
import subprocess
import sys

import files
import measure
import numpy as np
import rows
import settings
import table

LIMIT = 150  # seconds of CPU time for a mesh
HERE = os.path.dirname(os.path.abspath(__file__))
COVERAGE = ("open", "small")  # kinds of clouds that are no complete surface
# Kinds as peer.py knows them; the others are hard.
TREATED = {"clean": "clean", "dense": "clean", "rough": "clean", "noisy": "noisy"}
CLOSED = ("mean", "rms", "hausdorff", "normals", "crossings")
OPEN = ("missed", "invented", "crossings", "slivers")
OPEN_WITH_REFERENCE = ("seen", "inside")
# The meshes that are shown, of these makers.
SHOWN = ("open_bunny_15_quarter", "b9_training", "hippo2"), (settings.OURS, "PoissonRecon", "Open3D ball pivoting",
                                                     "CGAL advancing front")


def machine(arguments):
    """The processor, its cores, the system and the versions of those who compete."""
    with open("/proc/cpuinfo") as file:
        model = next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "?")
    asked = subprocess.run(("dpkg-query", "-W", "-f", "${Version}", "libcgal-dev"), capture_output=True, text=True)
    versions = [f"CGAL {asked.stdout}"] if asked.stdout else []
    with open(f"{HERE}/requirements.txt", encoding="ascii") as file:
        versions += [line.strip().replace("==", " ") for line in file if "==" in line]
    return (f"{model}, {os.cpu_count()} cores, {platform.freedesktop_os_release()['PRETTY_NAME']}; "
            + ", ".join(versions))


def timed(arguments):
    """CPU seconds and the most memory in MB of a process and those that it starts."""
    done = subprocess.run(("/usr/bin/python3", "-I", "-S", f"{HERE}/launch.py", str(LIMIT), *arguments),
                          capture_output=True, text=True, errors="replace", env={**os.environ, "OMP_NUM_THREADS": "1"})
    status, seconds, memory = (float(word) for word in done.stdout.split())
    if status < 0:
        raise RuntimeError(f"stopped after {LIMIT} s of CPU time" if seconds > LIMIT - 1 else
                           f"ended by signal {-status:.0f}")
    if status not in (0, 3):
        raise RuntimeError((done.stderr.strip().splitlines() or [f"ended with {status:.0f}"])[-1])
    return seconds, memory / 1024


def figures(command, scan, mesh, is_open):
    measured = measure.Measurement(command, scan, mesh)
    names = OPEN + (OPEN_WITH_REFERENCE if scan.reference else ()) if is_open else CLOSED
    found = {name: float(value) for name, value in measured.figures(names).items()}
    return {**found, "info": measured.info}


def words_of(setting):
    return ", ".join(name if value is True else f"{name} {value:g}" for name, value in setting.items())


def attempts(arguments, scan, kind, vertices):
    """Name, setting, file and command line of each run for a cloud; the command line is None if a part is missing."""
    folder = os.path.splitext(scan.path)[0]
    os.makedirs(folder, exist_ok=True)
    mesh = f"{folder}/{settings.OURS}.ply"
    yield settings.OURS, {}, mesh, (arguments.command, "reconstruct", scan.path, mesh, "--vertices", str(vertices),
                                    "--threads", "1", "--quiet")
    python = f"{arguments.tools}/venv/bin/python"
    for name, (peer, of_kind) in settings.PEERS.items():
        there = os.path.exists(python) and (
            not peer.startswith("cgal") or os.path.exists(f"{arguments.tools}/CgalSurface"))
        for setting in of_kind[kind]:
            mesh = f"{folder}/{name} {words_of(setting)}".strip() + ".ply"
            line = (python, f"{HERE}/peer.py", peer, json.dumps(setting), scan.path, mesh, str(vertices),
                    TREATED.get(kind, "hard"), arguments.tools)
            yield name, setting, mesh, line if there else None


def key_of(arguments, scan, maker, vertices):
    """What a result depends on, beside its setting."""
    program = (table.program(arguments.command) if maker == settings.OURS else
               table.digest(*(f"{HERE}/{name}" for name in ("peer.py", "CgalSurface.cpp", "requirements.txt"))))
    return [program, table.digest(scan.path, measure.__file__), vertices]


def result_of(arguments, scan, kind, mesh, line, key):
    """What a run needed and how good its mesh is, or its error; from an earlier run if there was the same one."""
    kept = mesh[:-4] + ".json"
    if os.path.exists(kept):
        with open(kept, encoding="utf-8") as file:
            result = json.load(file)
        if result["key"] == key:
            return result
    result = {"key": key, "mesh": mesh}
    try:
        result["cpu"], result["memory"] = timed(line)
        result.update(figures(arguments.command, scan, mesh, kind in COVERAGE))
    except (RuntimeError, OSError, ValueError, subprocess.CalledProcessError) as error:
        result["error"] = str(error)[:80]
    with open(kept + ".new", "w", encoding="utf-8") as file:
        json.dump(result, file)
    os.replace(kept + ".new", kept)
    return result


def error_of(result):
    """The least is the best."""
    if "error" in result:
        return np.inf
    return result["mean"] if "mean" in result else result["missed"] + result["invented"]


def place_of(result):
    """What is as good to the digits that are printed goes by CPU time."""
    return round(error_of(result), 4 if "mean" in result else 2), result.get("cpu", np.inf)


def measured(arguments, name):
    """The best result of each, the best first; and the number of points."""
    kind, make = settings.CLOUDS[name]
    scan = table.made(rows.Cloud(name, "peers", make, {}), arguments.folder)
    points = len(files.read_points(scan.path))
    vertices = min(settings.VERTICES, points // 5)
    best, missing = {}, set()
    for maker, setting, mesh, line in attempts(arguments, scan, kind, vertices):
        if line is None:
            missing.add(maker)
            continue
        key = key_of(arguments, scan, maker, vertices)
        result = {**result_of(arguments, scan, kind, mesh, line, key), "setting": words_of(setting)}
        if maker not in best or error_of(result) < error_of(best[maker]):
            best[maker] = result
    for maker in missing:
        print(f"{maker}: left out, as it is not here.\n", file=sys.stderr)
    return kind, points, vertices, dict(sorted(best.items(), key=lambda item: place_of(item[1])))


def yes_or_no(answer):
    return "yes" if answer else "no"


def shown(value):
    return "–" if value is None else str(value)


CLOSED_COLUMNS = {
    "closed / pieces / genus": lambda r: f"{yes_or_no(r['info']['closed'])} / {r['info']['components']} "
                                         f"/ {shown(r['info']['genus'])}",
    "mean": lambda r: f"{r['mean']:.4f}",
    "RMS": lambda r: f"{r['rms']:.4f}",
    "Hausdorff": lambda r: f"{r['hausdorff']:.2f}",
    "normals": lambda r: f"{r['normals']:.1f}°",
}
OPEN_COLUMNS = {
    "pieces / loops": lambda r: f"{r['info']['components']} / {r['info']['boundary_loops']}",
    "missed": lambda r: f"{r['missed']:.2f}",
    "invented": lambda r: f"{r['invented']:.2f}",
}
REFERENCE_COLUMNS = {
    "seen": lambda r: f"{r['seen']:.4f}",
    "inside": lambda r: f"{r['inside']:.2f}",
}
COMMON_COLUMNS = {
    "crossings": lambda r: f"{r['crossings']:.0f}",
    "regular": lambda r: f"{100 * r['info']['regular_ratio']:.0f} %",
    "2r/R": lambda r: f"{r['info']['triangle_quality']:.3f}",
    "CPU s": lambda r: f"{r['cpu']:.1f}",
    "MB": lambda r: f"{r['memory']:.0f}",
}


def print_table(name, kind, points, vertices, results):
    columns = {**(OPEN_COLUMNS if kind in COVERAGE else CLOSED_COLUMNS),
               **(REFERENCE_COLUMNS if any("seen" in result for result in results.values()) else {}), **COMMON_COLUMNS}
    print(f"**{name}**, {points:,} points, {vertices:,} vertices wanted\n")
    print("| | setting | vertices | " + " | ".join(columns) + " |\n|---|---|--:|" + "--:|" * len(columns))
    for maker, result in results.items():
        if "error" in result:
            print(f"| {maker} | {result['setting']} | {result['error']} |" + " |" * len(columns))
        else:
            cells = [write(result) for write in columns.values()]
            print(f"| {maker} | {result['setting']} | {result['info']['vertices']} | {' | '.join(cells)} |")
    print(flush=True)


def draw_charts(all_results, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot, ticker

    makers = [settings.OURS, *settings.PEERS]
    signs = dict(zip(makers, "*osD^vPX<>"))
    colours = dict(zip(makers, ["red", *pyplot.get_cmap("tab10").colors]))
    columns = 3
    figure, axes = pyplot.subplots(-(-len(all_results) // columns), columns, figsize=(12, 13), squeeze=False)
    for axis, (name, (kind, results)) in zip(axes.flat, all_results.items()):
        for maker, result in results.items():
            if "error" not in result:
                # What has missed and invented nothing stands at the lower end.
                height = max(error_of(result), 0.005 if kind in COVERAGE else 0)
                axis.scatter(result["cpu"], height, marker=signs[maker], color=colours[maker],
                             s=140 if maker == settings.OURS else 55, label=maker, zorder=3)
        axis.set(xscale="log", yscale="log", title=name, xlabel="CPU seconds",
                 ylabel="missed + invented, %" if kind in COVERAGE else "mean distance, %")
        axis.grid(True, which="both", alpha=0.25)
        for ticks in (axis.xaxis, axis.yaxis):
            ticks.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
            ticks.set_major_formatter("{x:g}")
            ticks.set_minor_formatter("")
    for axis in list(axes.flat)[len(all_results):]:
        axis.set_visible(False)
    handles = [pyplot.Line2D([], [], linestyle="", marker=signs[maker], color=colours[maker], label=maker)
               for maker in makers]
    figure.legend(handles=handles, loc="lower center", ncol=5)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    figure.savefig(path, dpi=90)


def draw_meshes(all_results, path, folder):
    """From two sides, back faces in red: a row a cloud."""
    import pictures

    names, makers = SHOWN
    meshes = []
    for name in names:
        os.makedirs(f"{folder}/shown/{name}", exist_ok=True)
        for maker in makers:
            link = f"{folder}/shown/{name}/{maker}.ply"  # its name is the title
            if os.path.lexists(link):
                os.remove(link)
            os.symlink(os.path.abspath(all_results[name][1][maker]["mesh"]), link)
            meshes.append(link)
    pictures.montage(path, meshes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("tools")
    parser.add_argument("folder")
    parser.add_argument("--chart")
    parser.add_argument("--meshes")
    parser.add_argument("clouds", nargs="*")
    arguments = parser.parse_intermixed_args()
    measure.SAMPLES = measure.SEEN_SAMPLES = 20000  # a third of what the battery takes
    measure.COMPARED_SAMPLES = 30000
    os.makedirs(arguments.folder, exist_ok=True)
    print(machine(arguments) + "\n")
    all_results = {}
    for name in arguments.clouds or settings.CLOUDS:
        kind, points, vertices, results = measured(arguments, name)
        print_table(name, kind, points, vertices, results)
        all_results[name] = kind, results
    if arguments.chart:
        draw_charts(all_results, arguments.chart)
    if arguments.meshes:
        draw_meshes(all_results, arguments.meshes, arguments.folder)


if __name__ == "__main__":
    main()
