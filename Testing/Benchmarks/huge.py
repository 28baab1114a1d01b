# SPDX-License-Identifier: BSD-3-Clause
"""A huge file that is sampled in place, beside 1 % of it: huge.py COMMAND FOLDER MILLIONS"""

import json
import os
import re
import statistics
import subprocess
import sys
import time

import clouds
import numpy as np
from neuralmesh import vtkNeuralMeshScan
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkOBJReader

MODEL = "armadillo"
VERTICES = (20000, 100000)
ROUNDS = 3
BLOCK = 1000000
BAD = 1000  # one point of so many is not finite


def write_cloud(path, surface, count):
    """Noisy points of the surface, drawn and written block by block."""
    scan = vtkNeuralMeshScan()
    scan.SetInputData(surface)
    scan.SetNoise(0.001)
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % count)
        file.write(b"property float x\nproperty float y\nproperty float z\nend_header\n")
        for block in range(-(-count // BLOCK)):
            scan.SetSeed(block)
            scan.SetNumberOfPoints(min(BLOCK, count - block * BLOCK))
            scan.Update()
            points = vtk_to_numpy(scan.GetOutput().GetPoints().GetData()).astype("<f4")
            points[BAD // 2 :: BAD, 1] = np.nan
            file.write(points.tobytes())
        os.fsync(file.fileno())


def anonymous(process):
    """Bytes of anonymous memory that it has now."""
    try:
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            found = re.search(r"RssAnon:\s+(\d+) kB", status.read())
    except (FileNotFoundError, ProcessLookupError):
        return 0
    return 1024 * int(found[1]) if found else 0


def run(command, cloud, mesh, vertices):
    """CPU and wall seconds, the peak of anonymous memory, the phases, and what was dropped."""
    begin = time.monotonic()
    process = subprocess.Popen(
        [command, "reconstruct", cloud, mesh, "--in-place", "--vertices", str(vertices)],
        stdout=subprocess.PIPE, text=True)
    peak = 0
    while True:
        peak = max(peak, anonymous(process))
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            break
        time.sleep(0.003)
    said = process.stdout.read()
    if status:
        raise RuntimeError(said)
    figures = {"wall": time.monotonic() - begin, "cpu": usage.ru_utime + usage.ru_stime, "peak": peak}
    figures["drawing"] = float(re.search(r"drawing ([\d.]+)", said)[1])
    figures["drawn"], figures["dropped"] = map(
        int, re.search(r"\((\d+) drawn, (\d+) of them dropped", said).groups())
    return figures


def forget(path):
    """Lets go of the file's pages, so that it comes from the disk again."""
    with open(path, "rb") as file:
        os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


def distances(command, reference, mesh):
    said = subprocess.run([command, "compare", reference, mesh, "--json", "--samples", "100000"],
                          check=True, capture_output=True, text=True).stdout
    figures = json.loads(said)
    return [figures[way]["rms_percent"] for way in ("reference_to_result", "result_to_reference")]


def main():
    command, folder, millions = sys.argv[1:]
    count = int(float(millions) * 1e6)
    points, triangles = clouds.cgal_mesh(MODEL)
    reference = f"{folder}/{MODEL}.obj"
    clouds.write_obj(reference, points, triangles)
    reader = vtkOBJReader()
    reader.SetFileName(reference)
    reader.Update()
    files = {"whole": f"{folder}/whole.ply", "1 %": f"{folder}/part.ply"}
    write_cloud(files["whole"], reader.GetOutput(), count)
    write_cloud(files["1 %"], reader.GetOutput(), count // 100)

    print(f"{MODEL}, noise 0.1 % of the diagonal, one point of {BAD} not finite; medians of {ROUNDS} "
          "interleaved runs; RMS in % of the diagonal, both ways\n")
    print("| vertices | points in the file | drawn | dropped | CPU s | of these drawing | wall s "
          "| peak anonymous MB | RMS |")
    print("|--:|--:|--:|--:|--:|--:|--:|--:|---|")
    for vertices in VERTICES:
        runs = {name: [] for name in files}
        quality = {}
        for _ in range(ROUNDS):
            for name, path in files.items():
                mesh = f"{folder}/mesh.ply"
                runs[name].append(run(command, path, mesh, vertices))
                quality[name] = quality.get(name) or distances(command, reference, mesh)
        median = {name: {key: statistics.median(figures[key] for figures in found)
                         for key in found[0]} for name, found in runs.items()}
        for name, path in files.items():
            found = median[name]
            size = count if name == "whole" else count // 100
            print(f"| {vertices} | {size} | {found['drawn']} | {found['dropped']} "
                  f"| {found['cpu']:.2f} | {found['drawing']:.2f} | {found['wall']:.2f} "
                  f"| {found['peak'] / 1e6:.0f} | {quality[name][0]:.4f}, {quality[name][1]:.4f} |",
                  flush=True)
        print(f"\nCPU of the whole over that of 1 %: "
              f"{median['whole']['cpu'] / median['1 %']['cpu']:.2f}\n", flush=True)
    forget(files["whole"])
    cold = run(command, files["whole"], f"{folder}/mesh.ply", VERTICES[0])
    print(f"The whole, read from the disk: {cold['cpu']:.2f} CPU s, {cold['wall']:.2f} s wall")


if __name__ == "__main__":
    main()
