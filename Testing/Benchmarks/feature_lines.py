# SPDX-License-Identifier: BSD-3-Clause
"""Prints how much of the sharp edges of known shapes the feature lines find, as a table in Markdown.

    feature_lines.py COMMAND [--vertices N] [--points N] [ROW...]

The edges of a shape are those of vtkFeatureEdges at 30 degrees. Recall is the part of their length that has a
line within half a percent of the diagonal, precision the part of the length of the lines that has an edge as
near. Noise is in percent of the diagonal, on each coordinate.
"""

import argparse
import os
import subprocess
import tempfile

import clouds
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticPointLocator
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

BUNNY = "/usr/share/glmark2/models/bunny.obj"
TOLERANCE = 0.005  # of the diagonal
STEP = 0.0005  # of the diagonal: what is measured at once
ROWS = {
    "cube": ("cube", 0), "cube, noise 0.3": ("cube", 0.3),
    "fandisk": ("fandisk", 0), "fandisk, noise 0.1": ("fandisk", 0.1),
    "fandisk, noise 0.3": ("fandisk", 0.3),
    "coupling": ("coupling", 0), "plate": ("plate_2.4", 0),
    "chair": ("chair", 0.1),
    "bunny": ("bunny_pmp", 0), "bunny, noise 0.5": ("bunny_pmp", 0.5),
    "armadillo": ("armadillo", 0),
}
OF_CGAL = {"fandisk": "fandisk", "coupling": "couplingdown", "armadillo": "armadillo"}


def surface(name):
    """Vertices and triangles, with a diagonal of 1; None where there is no such shape here."""
    path = os.path.join(os.environ.get("NEURALMESH_SCANS", ""), f"{name}_reference.ply")
    if name == "cube":
        points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        triangles = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                              [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    elif os.path.isfile(path):
        reader = vtkPLYReader()
        reader.SetFileName(path)
        reader.Update()
        points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).astype(float)
        triangles = vtk_to_numpy(reader.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
    elif name in OF_CGAL:
        points, triangles = clouds.cgal_mesh(OF_CGAL[name])
    else:
        return None
    low, high = points.min(0), points.max(0)
    return (points - (low + high) / 2) / np.linalg.norm(high - low), triangles


def sharp_edges(points, triangles):
    data, cells, places = vtkPolyData(), vtkCellArray(), vtkPoints()
    places.SetData(numpy_to_vtk(points, deep=True))
    for triangle in triangles:
        cells.InsertNextCell(3, [int(corner) for corner in triangle])
    data.SetPoints(places)
    data.SetPolys(cells)
    edges = vtkFeatureEdges()
    edges.SetInputData(data)
    edges.SetFeatureAngle(30)
    edges.BoundaryEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.ColoringOff()
    edges.Update()
    return edges.GetOutput()


def segments(lines):
    """Both ends of each piece of the lines."""
    if lines is None or lines.GetNumberOfLines() == 0:
        return np.empty((0, 2, 3))
    points = vtk_to_numpy(lines.GetPoints().GetData()).astype(float)
    ends = vtk_to_numpy(lines.GetLines().GetOffsetsArray())
    along = vtk_to_numpy(lines.GetLines().GetConnectivityArray())
    found = []
    for begin, end in zip(ends[:-1], ends[1:]):
        found.append(np.stack((points[along[begin:end - 1]], points[along[begin + 1:end]]), 1))
    return np.concatenate(found)


def lengths_of(pieces):
    return np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1)


def places_on(pieces):
    """Places evenly along each, and the length that each place stands for."""
    places, shares = [np.empty((0, 3))], [np.empty(0)]
    for (a, b), length in zip(pieces, lengths_of(pieces)):
        count = int(np.ceil(length / STEP)) or 1
        places.append(a + (b - a) * ((np.arange(count) + 0.5) / count)[:, None])
        shares.append(np.full(count, length / count))
    return np.concatenate(places), np.concatenate(shares)


def near(pieces, other_pieces):
    """Which part of the length has one of the others within the tolerance; None of nothing."""
    (places, shares), (others, _) = places_on(pieces), places_on(other_pieces)
    if len(places) == 0 or len(others) == 0:
        return None if len(places) == 0 else 0.0
    data, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(others), deep=True))
    data.SetPoints(points)
    locator = vtkStaticPointLocator()
    locator.SetDataSet(data)
    locator.BuildLocator()
    nearest = others[[locator.FindClosestPoint(place) for place in places]]
    return float(shares[np.linalg.norm(nearest - places, axis=1) <= TOLERANCE].sum() / shares.sum())


def lines_of(command, cloud, vertices, folder):
    """The lines of a run; None if there are none."""
    path = os.path.join(folder, "cloud.ply")
    lines = os.path.join(folder, "lines.vtp")
    clouds.write_ply(path, cloud)
    subprocess.run([command, "reconstruct", path, os.path.join(folder, "mesh.ply"), "--feature-lines", lines,
                    "--vertices", str(vertices), "--quiet"], check=True, stderr=subprocess.DEVNULL)
    if not os.path.isfile(lines):
        return None
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(lines)
    reader.Update()
    return reader.GetOutput()


def percent(part):
    return "" if part is None else f"{100 * part:.1f} %"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("--vertices", type=int, default=20000)
    parser.add_argument("--points", type=int, default=200000)
    parser.add_argument("rows", nargs="*", metavar="ROW")
    options = parser.parse_args()
    print("| cloud | edges | lines | length | corners | recall | precision |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    for row in options.rows or ROWS:
        name, noise = ROWS[row]
        shape = surface(name)
        if shape is None:
            continue
        random = np.random.default_rng(1)
        cloud = clouds.sample(*shape, options.points)
        cloud += random.normal(scale=noise / 100, size=cloud.shape)
        with tempfile.TemporaryDirectory() as folder:
            lines = lines_of(options.command, cloud, options.vertices, folder)
        edges, found = segments(sharp_edges(*shape)), segments(lines)
        count, corners = (lines.GetNumberOfLines(), lines.GetNumberOfVerts()) if lines else (0, 0)
        print(f"| {row} | {lengths_of(edges).sum():.2f} | {count} | {lengths_of(found).sum():.2f} | {corners} | "
              f"{percent(near(edges, found))} | {percent(near(found, edges))} |", flush=True)


if __name__ == "__main__":
    main()
