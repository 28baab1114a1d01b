# SPDX-License-Identifier: BSD-3-Clause
"""Prints our meshes beside those of others, as a table in Markdown, and plots error over CPU time.

    compare.py COMMAND TOOLS FOLDER PICTURE|- [--rounds N] [CLOUD,REFERENCE,noisy|clean...]

Peers are run by turns; CPU and wall are the least of the rounds, memory is the most that a process
had. What a peer lacks on this machine is said, and the peer is left out.
"""

import argparse
import importlib.util
import json
import os
import platform
import resource
import subprocess
import sys
import time

import numpy as np
from vtkmodules.vtkCommonCore import vtkVersion

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "Support"))
import clouds

VERTICES = 20000
LIMIT = 600  # seconds for a mesh
HERE = os.path.dirname(os.path.abspath(__file__))

# name in the table: (name for peer.py, what it needs, for noisy clouds, for clean ones)
PEERS = {
    "CGAL advancing front + decimation": ("cgal_front", ("open3d", "CgalSurface"), True, True),
    "CGAL Poisson": ("cgal_poisson", ("open3d", "CgalSurface"), True, True),
    "Open3D Poisson, depth 7 + decimation": ("poisson7", ("open3d",), True, False),
    "Open3D Poisson, depth 8 + decimation": ("poisson8", ("open3d",), True, True),
    "Open3D Poisson, depth 9 + decimation": ("poisson9", ("open3d",), False, True),
    "Open3D ball pivoting + decimation": ("ball_pivoting", ("open3d",), True, True),
    "VTK signed distance + decimation": ("vtk", (), True, True),
}
OURS = {"NeuralMesh, 1 thread": 1, "NeuralMesh": 0}


def own_clouds(folder):
    """A clean cloud of a model of CGAL's, and one with noise of 0.5 % and 2 % of outliers."""
    points, triangles = clouds.cgal_mesh("armadillo")
    points = (points - points.mean(axis=0)) / np.linalg.norm(np.ptp(points, axis=0))
    reference = f"{folder}/armadillo.obj"
    clouds.write_obj(reference, points, triangles)
    clean = clouds.sample(points, triangles, 200000)
    random = np.random.default_rng(1)
    noisy = clean + random.normal(0, 0.005, clean.shape)
    outliers = random.uniform(points.min(axis=0), points.max(axis=0), (4000, 3))
    for name, cloud, kind in (("armadillo", clean, "clean"),
                              ("armadillo_noise_outliers", np.vstack((noisy, outliers)), "noisy")):
        path = f"{folder}/{name}.ply"
        clouds.write_ply(path, cloud)
        yield path, reference, kind


def machine():
    """The processor, its cores, the system and the versions of those who compete."""
    with open("/proc/cpuinfo") as file:
        model = next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "?")
    versions = [("VTK", vtkVersion.GetVTKVersion())]
    for name, package in (("Open3D", "python3-open3d"), ("CGAL", "libcgal-dev")):
        asked = subprocess.run(("dpkg-query", "-W", "-f", "${Version}", package), capture_output=True, text=True)
        versions += [(name, asked.stdout)] if asked.stdout else []
    return (f"{model}, {os.cpu_count()} cores, {platform.freedesktop_os_release()['PRETTY_NAME']}; "
            + ", ".join(" ".join(version) for version in versions))


def is_there(need, tools):
    if need == "open3d":
        return importlib.util.find_spec("open3d") is not None
    return os.path.exists(f"{tools}/{need}")


def timed(arguments):
    """CPU seconds, wall seconds and the most memory in MB of a process and those that it starts."""
    begin = time.monotonic()
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT)))
    message = process.stderr.read().decode(errors="replace").strip()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(message.splitlines()[-1] if message else f"ended with {process.returncode}")
    return np.array([usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss / 1024])


def figures(command, reference, mesh):
    def said(*arguments):
        return json.loads(subprocess.run((command, *arguments, "--json"), check=True,
                                         capture_output=True, text=True).stdout)

    distances = said("compare", reference, mesh, "--samples", "30000")
    info = said("info", mesh)
    to, back = distances["reference_to_result"], distances["result_to_reference"]
    return {
        "vertices": info["vertices"],
        "topology": f"{'yes' if info['closed'] else 'no'} / {info['components']} / {info['genus']}",
        "mean": (to["mean_percent"] + back["mean_percent"]) / 2,
        "rms": np.sqrt((to["rms_percent"] ** 2 + back["rms_percent"] ** 2) / 2),
        "hausdorff": distances["hausdorff_percent"],
        "normals": distances["normal_angle"],
        "regular": 100 * info["regular_ratio"],
        "quality": info["triangle_quality"],
    }


def runs_of(arguments, cloud, kind, mesh):
    """Name and command line of each run for a cloud."""
    for name, threads in OURS.items():
        yield name, (arguments.command, "reconstruct", cloud, mesh, "--vertices", str(VERTICES),
                     "--threads", str(threads), "--quiet")
    for name, (peer, needs, noisy, clean) in PEERS.items():
        missing = [need for need in needs if not is_there(need, arguments.tools)]
        if missing:
            print(f"{name}: left out, as there is no {' and no '.join(missing)} here.\n", file=sys.stderr)
        elif noisy if kind == "noisy" else clean:
            yield name, ("/usr/bin/python3", f"{HERE}/peer.py", peer, cloud, mesh, str(VERTICES), kind,
                         arguments.tools)


def measure(arguments, cloud, reference, kind):
    mesh = f"{arguments.folder}/mesh.ply"
    costs, quality, failed = {}, {}, {}
    for _ in range(arguments.rounds):
        for name, line in runs_of(arguments, cloud, kind, mesh):
            if name in failed:
                continue
            try:
                cost = timed(line)
                costs[name] = np.minimum(costs.get(name, cost), cost)
                if name not in quality:
                    quality[name] = figures(arguments.command, reference, mesh)
            except (RuntimeError, subprocess.CalledProcessError) as error:
                failed[name] = str(error)[:80]
    return costs, quality, failed


def print_table(cloud, costs, quality, failed):
    print(f"**{os.path.splitext(os.path.basename(cloud))[0]}**\n")
    print("| | vertices | closed / pieces / genus | mean | RMS | Hausdorff | normals | regular | 2r/R "
          "| CPU s | wall s | memory MB |")
    print("|---|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    for name, found in sorted(quality.items(), key=lambda item: item[1]["mean"]):
        cpu, wall, memory = costs[name]
        print(f"| {name} | {found['vertices']} | {found['topology']} | {found['mean']:.4f} "
              f"| {found['rms']:.4f} | {found['hausdorff']:.2f} | {found['normals']:.1f}° "
              f"| {found['regular']:.0f} % | {found['quality']:.3f} | {cpu:.1f} | {wall:.1f} | {memory:.0f} |")
    for name, reason in failed.items():
        print(f"| {name} | failed: {reason} | | | | | | | | | | |")
    print(flush=True)


def draw(results, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot, ticker

    figure, axes = pyplot.subplots(1, len(results), figsize=(6.5 * len(results), 5), squeeze=False)
    for axis, (cloud, costs, quality) in zip(axes[0], results):
        middle = np.exp(np.mean([np.log(cost[0]) for cost in costs.values()]))
        for name, found in quality.items():
            if name == "NeuralMesh":
                continue  # on several threads: the same mesh
            place = (costs[name][0], found["mean"])
            left = place[0] > middle
            axis.scatter(*place, color="tab:red" if name in OURS else "tab:blue", zorder=3)
            axis.annotate(name, place, xytext=(-6 if left else 6, 4), textcoords="offset points",
                          ha="right" if left else "left", fontsize=8)
        axis.set(xscale="log", yscale="log", title=os.path.splitext(os.path.basename(cloud))[0],
                 xlabel="CPU seconds", ylabel="mean distance, % of the diagonal")
        axis.grid(True, which="both", alpha=0.25)
        axis.margins(x=0.15, y=0.15)
        for ticks in (axis.xaxis, axis.yaxis):
            ticks.set_major_formatter("{x:g}")
            ticks.set_minor_formatter("")
        axis.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("tools")
    parser.add_argument("folder")
    parser.add_argument("picture")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("clouds", nargs="*")
    arguments = parser.parse_args()
    results = []
    print(machine() + "\n")
    print(f"{VERTICES} vertices; distances in % of the diagonal of the reference, mean and RMS of both ways;"
          f" the least of {arguments.rounds} rounds.\n")
    for cloud, reference, kind in [run.split(",") for run in arguments.clouds] or own_clouds(arguments.folder):
        costs, quality, failed = measure(arguments, cloud, reference, kind)
        print_table(cloud, costs, quality, failed)
        results.append((cloud, costs, quality))
    if arguments.picture != "-":
        draw(results, arguments.picture)


if __name__ == "__main__":
    main()
