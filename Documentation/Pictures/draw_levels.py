# SPDX-License-Identifier: BSD-3-Clause
"""Draws the levels of detail of one run, in pvpython: draw_levels.py FOLDER"""

import os
import sys
import tempfile

import clouds
import numpy as np
from panels import delete_views, save_beside
from paraview import simple

SIZE = (1260, 420)  # pixels
LEVELS = (500, 2000, 8000)
POINTS = 200000


def scan():
    points, triangles = clouds.cgal_mesh("elephant")
    cloud = clouds.sample(points / np.linalg.norm(np.ptp(points, axis=0)), triangles, POINTS)
    return cloud + np.random.default_rng(1).normal(scale=0.0005, size=cloud.shape)


def show(mesh, vertices):
    view = simple.CreateRenderView()
    level = simple.ExtractBlock(Input=simple.OutputPort(mesh, 4), Selectors=[f"/Root/_{vertices}vertices"])
    surface = simple.Show(level, view)
    surface.Representation = "Surface With Edges"
    surface.EdgeColor = (0.25, 0.3, 0.4)
    surface.AmbientColor = surface.DiffuseColor = (0.8, 0.84, 0.9)
    surface.ColorArrayName = ("POINTS", "")
    view.OrientationAxesVisibility = 0
    view.CameraPosition = [view.CameraFocalPoint[i] + (0.4, 0.3, -1.0)[i] for i in range(3)]
    view.CameraViewUp = (0, 1, 0)
    view.CameraParallelProjection = 1
    view.ResetCamera()
    view.CameraParallelScale = 0.4  # of the diagonal: half of what is seen
    return view


def draw_levels(path):
    with tempfile.TemporaryDirectory() as folder:
        cloud = os.path.join(folder, "scan.ply")
        clouds.write_ply(cloud, scan())
        mesh = simple.NeuralMesh(Input=simple.PLYReader(FileNames=[cloud]), Levels=LEVELS)
        mesh.UpdatePipeline()
        save_beside([show(mesh, vertices) for vertices in LEVELS], SIZE, path)


def main():
    draw_levels(os.path.join(sys.argv[1], "levels.png"))
    delete_views()


if __name__ == "__main__":
    main()
