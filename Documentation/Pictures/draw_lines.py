# SPDX-License-Identifier: BSD-3-Clause
"""Draws feature lines over the surface, in pvpython: draw_lines.py FOLDER

A machined part as it is scanned clean and with noise, at the left and in the middle; at the right a shape
that is smooth, and has none.
"""

import os
import sys
import tempfile

import clouds
import numpy as np
from panels import delete_views, save_beside
from paraview import simple

SIZE = (1260, 420)  # pixels
# Of each part: the shape, the noise in percent of the diagonal, and where it is seen from.
PARTS = (("fandisk", 0.0, (-1.0, -1.6, 1.1)), ("fandisk", 0.3, (-1.0, -1.6, 1.1)),
         ("armadillo", 0.0, (0.4, 0.3, -1.0)))
VERTICES = 10000


def write_cloud(path, shape, noise):
    points, triangles = clouds.cgal_mesh(shape)
    points = points / np.linalg.norm(np.ptp(points, axis=0))
    cloud = clouds.sample(points, triangles, 200000)
    clouds.write_ply(path, cloud + np.random.default_rng(1).normal(scale=noise / 100, size=cloud.shape))


def look(view, direction, up):
    view.CameraPosition = [view.CameraFocalPoint[i] + direction[i] for i in range(3)]
    view.CameraViewUp = up
    view.CameraParallelProjection = 1
    view.ResetCamera()
    view.CameraParallelScale = 0.4  # of the diagonal: half of what is seen


def show(path, direction, up):
    view = simple.CreateRenderView()
    mesh = simple.NeuralMesh(Input=simple.PLYReader(FileNames=[path]), NumberOfVertices=VERTICES,
                             ComputeFeatureLines=1)
    surface = simple.Show(mesh, view)
    surface.ColorArrayName = [None, ""]
    surface.DiffuseColor = surface.AmbientColor = [0.75, 0.8, 0.9]
    mesh.UpdatePipeline()
    lines = simple.OutputPort(mesh, 3)
    if lines.GetDataInformation().GetNumberOfCells() > 0:
        # As tubes, half of which stands out of the surface.
        tubes = simple.Show(simple.Tube(Input=lines, Radius=0.0025, Capping=1), view)
        tubes.ColorArrayName = [None, ""]
        tubes.DiffuseColor = tubes.AmbientColor = [0.8, 0.1, 0.1]
    view.OrientationAxesVisibility = 0
    look(view, direction, up)
    return view


def draw_feature_lines(path):
    with tempfile.TemporaryDirectory() as folder:
        views = []
        for number, (shape, noise, direction) in enumerate(PARTS):
            cloud = os.path.join(folder, f"{number}.ply")
            write_cloud(cloud, shape, noise)
            views.append(show(cloud, direction, (0, 0, 1) if shape == "fandisk" else (0, 1, 0)))
        save_beside(views, SIZE, path)


def main():
    draw_feature_lines(os.path.join(sys.argv[1], "feature_lines.png"))
    delete_views()


if __name__ == "__main__":
    main()
