# SPDX-License-Identifier: BSD-3-Clause
"""Prints how far the volume tells the outer side of open shapes, as a table in Markdown.

    orientation.py COMMAND [--vertices N] [--seeds N] [CLOUD...]

Of a shape that is made here it is known which side is the outer one: the last column has the part of the
area that is turned there, of all seeds the least.
"""

import argparse
import os
import subprocess
import tempfile

import numpy as np

POINTS = 50000


def sphere(random, lowest, highest):
    """The part of the unit sphere between two polar angles from the north pole, in degrees."""
    z = random.uniform(*np.cos(np.radians((highest, lowest))), POINTS)
    angle = random.uniform(0, 2 * np.pi, POINTS)
    ring = np.sqrt(1 - z * z)
    return np.stack((ring * np.cos(angle), ring * np.sin(angle), z), 1)


def tube(random, radius):
    angle = random.uniform(0, 2 * np.pi, POINTS)
    return np.stack((radius * np.cos(angle), radius * np.sin(angle), random.uniform(-1, 1, POINTS)), 1)


def field(random, height):
    """A field of heights over a square."""
    x, y = random.uniform(-1, 1, (2, POINTS))
    return np.stack((x, y, height(x, y)), 1)


def from_origin(places):
    return places


def from_axis(places):
    return places * (1, 1, 0)


def shapes():
    """Name, points, and the direction outwards, or None where there is none."""
    random = np.random.default_rng(1)
    for cap in (15, 30, 45, 60, 75, 90):
        yield f"sphere without a cap of {cap} degrees", sphere(random, 0, 180 - cap), from_origin
    for cap in (60, 45, 30, 20, 15):
        yield f"cap of {cap} degrees", sphere(random, 0, cap), from_origin
    yield "pipe, 20 times as long as its radius", tube(random, 0.1), from_axis
    yield "pipe, twice as long as its radius", tube(random, 1.0), from_axis
    yield "dome", field(random, lambda x, y: -0.15 * (x * x + y * y)), None
    yield "saddle", field(random, lambda x, y: 0.3 * (x * x - y * y)), None
    yield "curtain", field(random, lambda x, y: 0.1 * np.sin(15 * x)), None
    yield "plane", field(random, lambda x, y: 0 * x), None


def read_mesh(path):
    """Points and triangles of a .ply as the command writes it."""
    with open(path, "rb") as file:
        content = file.read()
    end = content.index(b"end_header\n") + len(b"end_header\n")
    counts, properties, element = {}, [], ""
    for line in content[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            properties.append((words[2], {"float": "<f4", "uchar": "u1", "double": "<f8"}[words[1]]))
    vertices = np.frombuffer(content, np.dtype(properties), counts["vertex"], end)
    faces = np.frombuffer(content, np.dtype([("count", "u1"), ("corners", "<i4", 3)]), counts["face"],
                          end + vertices.nbytes)
    return np.stack([vertices[axis] for axis in "xyz"], 1).astype(float), faces["corners"].astype(int)


def pieces(points, triangles):
    """The triangles of each piece."""
    lowest = np.arange(len(points))
    while True:
        before = lowest.copy()
        least = lowest[triangles].min(1)
        for corner in range(3):
            np.minimum.at(lowest, triangles[:, corner], least)
        if (lowest == before).all():
            break
    owner = lowest[triangles[:, 0]]
    return [triangles[owner == piece] for piece in np.unique(owner)]


def area_of(a, b, c):
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def flatness(points, triangles):
    """F^1.5 over the volume, for F the area that closes the loops, or its own if that is less."""
    origin = points[triangles[0, 0]]
    a, b, c = (points[triangles[:, corner]] - origin for corner in range(3))
    area = area_of(a, b, c)
    volume = (a * np.cross(b, c)).sum() / 6
    edges = np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    known = set(map(tuple, edges))
    follower = {b: a for a, b in known if (b, a) not in known}
    closing = 0.0
    while follower:
        first, vertex = follower.popitem()
        loop = [first]
        while vertex != first:
            loop.append(vertex)
            vertex = follower.pop(vertex)
        rim = points[loop] - origin
        centroid, following = np.broadcast_to(rim.mean(0), rim.shape), np.roll(rim, -1, 0)
        closing += area_of(centroid, rim, following)
        volume += (centroid * np.cross(rim, following)).sum() / 6
    return min(area, closing) ** 1.5 / abs(volume)


def right_part(points, triangles, outwards):
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a) / 2
    is_right = (normals * outwards((a + b + c) / 3)).sum(1) > 0
    areas = np.linalg.norm(normals, axis=1)
    return areas[is_right].sum() / areas.sum()


def run(command, cloud, mesh, options):
    """What the command says of the sides; the mesh."""
    said = subprocess.run((command, "reconstruct", cloud, mesh, *options), check=True,
                          capture_output=True, text=True).stdout
    sides = next(line.split(None, 1)[1] for line in said.splitlines() if line.startswith("sides"))
    # What to do about it, and where most looks to, is not for the table.
    return sides.partition(";")[0].partition(", most")[0], read_mesh(mesh)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("--vertices", default="4000")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("clouds", nargs="*")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        clouds = []
        for number, (name, points, outwards) in enumerate(shapes()):
            path = f"{folder}/{number}.xyz"
            np.savetxt(path, points, fmt="%.7g")
            clouds.append((name, path, outwards))
        for path in arguments.clouds:
            clouds.append((os.path.splitext(os.path.basename(path))[0], path, None))
        print("| shape | pieces | flatness of the largest | sides | right side out |")
        print("|---|--:|--:|---|--:|")
        for name, path, outwards in clouds:
            counts, flat, said, right = [], [], {}, []
            for seed in range(1, arguments.seeds + 1):
                options = ["--vertices", arguments.vertices, "--seed", str(seed)]
                sides, (points, triangles) = run(arguments.command, path, f"{folder}/mesh.ply", options)
                found = pieces(points, triangles)
                largest = max(found, key=len)
                counts.append(len(found))
                flat.append(flatness(points, largest))
                said[sides] = None
                right.append(right_part(points, triangles, outwards) if outwards else np.nan)
            share = f"{100 * min(right):.1f} %" if outwards else ""
            print(f"| {name} | {max(counts)} | {max(flat):.3g} | {'; '.join(said)} | {share} |", flush=True)


if __name__ == "__main__":
    main()
