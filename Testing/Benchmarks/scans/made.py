# SPDX-License-Identifier: BSD-3-Clause
"""The clouds of the battery: made, or from Debian packages. Each function gives a dictionary with

points      of the cloud, or
file        the bytes of a file and how its name ends, as the package has it
mesh        points and triangles of the surface from which it was made, if there is one
view, eyes  the index of the view of each point, and the places of the eyes, if they are known
part        the part of each point, from 0 on, if it has parts
"""

import functools
import tarfile

import numpy as np

import clouds
import files
import scanner
import shapes

BUNNY = "/usr/share/glmark2/models/bunny.obj"  # of the Debian package glmark2-data


@functools.cache
def model(name):
    """Points and triangles of a model, with a diagonal of 1."""
    points, triangles = files.read_mesh(BUNNY) if name == "bunny" else clouds.cgal_mesh(name)
    return shapes.unit(points), triangles


def sampled(mesh, count=200000, noise=0.0, seed=1):
    points = clouds.sample(*mesh, count, seed)
    return {"points": points + np.random.default_rng(seed + 1).normal(0, noise / 100, points.shape), "mesh": mesh}


def scanned(name, views, registration):
    points, view, eyes = scanner.scan(*model(name), views, registration)
    return {"points": points, "view": view, "eyes": eyes, "mesh": model(name)}


def from_cgal(name):
    with tarfile.open(clouds.CGAL_DATA) as archive:
        return {"file": (archive.extractfile(f"data/points_3/{name}").read(), name.rsplit(".", 1)[1])}


def open_sphere(degrees, count=110000):
    """Without the cap at the bottom that spans so many degrees from its middle."""
    points = sampled(shapes.sphere(), count)["points"]
    kept = points[:, 2] > -np.cos(np.radians(degrees)) * np.linalg.norm(points, axis=1)
    return {"points": points[kept], "mesh": shapes.sphere()}


def open_bunny(percent, tilt=0):
    """Without what is lower than so much of its height, along a plane that is tilted by so many degrees."""
    up = np.array([np.sin(np.radians(tilt)), np.cos(np.radians(tilt)), 0])
    points = sampled(model("bunny"))["points"]
    heights = model("bunny")[0] @ up
    return {"points": points[points @ up > heights.min() + percent / 100 * np.ptp(heights)], "mesh": model("bunny")}


def wave(x, y):
    return 0.05 * np.sin(5 * x) * np.cos(4 * y)


def density(ratio):
    """A wavy sheet of 1 x 0.6 whose density falls to 1 / ratio along it, with noise of 0.02."""
    random = np.random.default_rng(1)
    u, y = random.random(200000), random.random(200000) * 0.6
    x = u if ratio == 1 else -np.log(1 - u * (1 - 1 / ratio)) / np.log(ratio)
    return {"points": np.column_stack((x, y, wave(x, y))) + random.normal(0, 0.0002, (len(x), 3))}


def islands(per_area=400000):
    """A wavy sheet in four parts, of which the smallest has a hundredth of the area of the largest."""
    random = np.random.default_rng(2)
    points, part = [], []
    for index, (left, low, side) in enumerate(((0, 0, 0.6), (0.63, 0, 0.19), (0.63, 0.3, 0.06), (0.8, 0.3, 0.1))):
        x, y = random.random((2, int(per_area * side * side))) * side + [[left], [low]]
        points.append(np.column_stack((x, y, wave(x, y))))
        part.append(np.full(len(x), index))
    points = np.vstack(points)
    return {"points": points + random.normal(0, 0.0002, points.shape), "part": np.concatenate(part)}


def small_bunny():
    """The vertices of the model; parts 1 and 2 are its ears: all that is so high hangs together in two pieces."""
    with open(BUNNY, "rb") as file:
        content = file.read()
    points, triangles = model("bunny")
    high = triangles[(points[triangles][:, :, 1] > 0.2).all(axis=1)]
    label = shapes.connected(len(points), np.vstack((high[:, :2], high[:, 1:])))
    largest = np.unique(label[np.unique(high)], return_counts=True)
    part = np.zeros(len(points), int)
    for index, of in enumerate(largest[0][np.argsort(largest[1])[-2:]]):
        part[label == of] = index + 1
    return {"file": (content, "obj"), "part": part}


def spoilt(name, noise=0.0, outliers=0, holes=0, radius=0.0):
    """A model with noise, so many outliers and gaps."""
    made = sampled(model(name))
    points, random = made["points"], np.random.default_rng(5)
    for middle in points[random.choice(len(points), holes, replace=False)]:
        points = points[np.linalg.norm(points - middle, axis=1) > radius / 100]
    low, high = model(name)[0].min(axis=0), model(name)[0].max(axis=0)
    points = np.vstack((points + random.normal(0, noise / 100, points.shape),
                        random.uniform(low, high, (outliers, 3))))
    return {"points": random.permutation(points), "mesh": made["mesh"]}


def terrain():
    """A height field with noise of 0.05."""
    points, triangles = shapes.rectangle(1, 1, 0.005)
    random = np.random.default_rng(3)
    height = np.zeros(len(points))
    for waves in range(1, 31):
        turn, phase = random.uniform(0, 2 * np.pi, 2)
        height += np.sin(2 * np.pi * waves / 3 * (points @ (np.cos(turn), np.sin(turn))) + phase) / waves ** 1.5 / 15
    return sampled((shapes.unit(np.column_stack((points, height))), triangles), noise=0.05)


def one_view():
    """What one viewpoint sees of a model at less than 75 degrees, with noise of 0.05."""
    points, triangles = model("bunny")
    camera = scanner.DepthMap(points, triangles, np.array([0, 0.2, 1]) * scanner.DISTANCE, 1500)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    cosine = (normals @ -camera.axes[2]) / np.linalg.norm(normals, axis=1).clip(1e-30)
    part = (np.isin(np.arange(len(triangles)), camera.triangle) & (cosine > np.cos(np.radians(75)))).astype(float)
    for _ in range(8):  # no ragged outlines, no specks
        total = np.bincount(triangles.ravel(), np.repeat(part, 3)) / np.bincount(triangles.ravel())
        part = total[triangles].mean(axis=1)
    seen = triangles[part > 0.5]
    label = shapes.connected(len(points), np.vstack((seen[:, :2], seen[:, 1:])))[seen[:, 0]]
    used, seen = np.unique(seen[label == np.bincount(label).argmax()], return_inverse=True)
    return sampled((points[used], seen.reshape(-1, 3)), noise=0.05)
