# SPDX-License-Identifier: BSD-3-Clause
"""One run for wheel.sh: wheel.py NAME prints its figures as JSON, wheel.py table FILE a table of all."""

import hashlib
import json
import resource
import statistics
import sys
import time

POINTS, VERTICES = 200000, 20000


def measure(name):
    start = time.perf_counter()
    import neuralmesh

    imported = time.perf_counter() - start
    import numpy as np

    points = np.random.default_rng(1).normal(size=(POINTS, 3)).astype(np.float32)
    points /= np.linalg.norm(points, axis=1)[:, None]
    points[:, 2] *= 0.5
    # What is loaded for the first mesh is not measured.
    neuralmesh.reconstruct(points[:1000], 100)
    before, cpu = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
    mesh = neuralmesh.reconstruct(points, VERTICES, number_of_threads=1)
    cpu = time.process_time() - cpu
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    return {
        "name": name,
        "CPU s": cpu,
        "MB beside the points": memory / 1024,
        "import s": imported,
        "mesh": hashlib.sha256(places(mesh).tobytes()).hexdigest()[:12],
    }


def places(mesh):
    if hasattr(mesh, "points") and not hasattr(mesh, "GetPoints"):
        return mesh.points
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(mesh.GetPoints().GetData())


def table(path):
    with open(path, encoding="utf-8") as file:
        rows = [json.loads(line) for line in file]
    columns = [column for column in rows[0] if column not in ("name", "mesh")]
    print("| | " + " | ".join(columns) + " | mesh |")
    print("|---|" + "--:|" * len(columns) + "---|")
    medians = {}
    for name in dict.fromkeys(row["name"] for row in rows):
        own = [row for row in rows if row["name"] == name]
        medians[name] = [statistics.median(row[column] for row in own) for column in columns]
        figures = " | ".join(f"{value:.3g}" for value in medians[name])
        print(f"| {name} | {figures} | {', '.join(sorted({row['mesh'] for row in own}))} |")
    ratio = medians["wheel"][0] / medians["filter"][0]
    print(f"\nThe wheel takes {ratio:.3f} times the CPU time of the filter.")


if __name__ == "__main__":
    if sys.argv[1] == "table":
        table(sys.argv[2])
    else:
        print(json.dumps(measure(sys.argv[1])))
