# SPDX-License-Identifier: BSD-3-Clause
"""Draws meshes by the error bars of their vertices, in pvpython: draw_bars.py FOLDER

At the left a scan with gaps, which are closed; in the middle one whose points have more noise at one side; at the right
a machined part with noise.
"""

import os
import sys
import tempfile

import clouds
import numpy as np
from panels import delete_views, save_beside
from paraview import simple

SIZE = (1260, 420)  # pixels
VERTICES = 10000
POINTS = 200000


def unit(name):
    points, triangles = clouds.cgal_mesh(name)
    return points / np.linalg.norm(np.ptp(points, axis=0)), triangles


def scan_with_gaps():
    cloud = clouds.sample(*unit("elephant"), POINTS)
    random = np.random.default_rng(3)
    for middle in cloud[random.choice(len(cloud), 12, replace=False)]:
        cloud = cloud[np.linalg.norm(cloud - middle, axis=1) > 0.04]
    return cloud + random.normal(scale=0.0005, size=cloud.shape)


def scan_with_more_noise_at_a_side():
    cloud = clouds.sample(*unit("elephant"), POINTS)
    along = (cloud[:, 0] - cloud[:, 0].min()) / np.ptp(cloud[:, 0])
    noise = 0.0003 * 5 ** along
    return cloud + np.random.default_rng(1).normal(size=cloud.shape) * noise[:, None]


def noisy_part():
    cloud = clouds.sample(*unit("fandisk"), POINTS)
    return cloud + np.random.default_rng(1).normal(scale=0.003, size=cloud.shape)


# Of each part: the cloud, the largest error bar that has a colour, and where it is seen from.
PARTS = ((scan_with_gaps, 0.003, (0.4, 0.3, -1.0), (0, 1, 0)),
         (scan_with_more_noise_at_a_side, 0.0008, (0.4, 0.3, -1.0), (0, 1, 0)),
         (noisy_part, 0.001, (-1.0, -1.6, 1.1), (0, 0, 1)))


def show(path, most, direction, up):
    view = simple.CreateRenderView()
    mesh = simple.NeuralMesh(Input=simple.PLYReader(FileNames=[path]), NumberOfVertices=VERTICES, Boundaries="Close",
                             ComputeUncertainty=1)
    surface = simple.Show(mesh, view)
    mesh.UpdatePipeline()
    simple.ColorBy(surface, ("POINTS", "Uncertainty"), separate=True)
    colors = simple.GetColorTransferFunction("Uncertainty", surface, separate=True)
    colors.ApplyPreset("Viridis (matplotlib)", True)
    colors.RescaleTransferFunction(0, most)
    surface.SetScalarBarVisibility(view, False)
    view.OrientationAxesVisibility = 0
    view.CameraPosition = [view.CameraFocalPoint[i] + direction[i] for i in range(3)]
    view.CameraViewUp = up
    view.CameraParallelProjection = 1
    view.ResetCamera()
    view.CameraParallelScale = 0.4  # of the diagonal: half of what is seen
    return view


def draw_error_bars(path):
    with tempfile.TemporaryDirectory() as folder:
        views = []
        for number, (make, most, direction, up) in enumerate(PARTS):
            cloud = os.path.join(folder, f"{number}.ply")
            clouds.write_ply(cloud, make())
            views.append(show(cloud, most, direction, up))
        save_beside(views, SIZE, path)


def main():
    draw_error_bars(os.path.join(sys.argv[1], "error_bars.png"))
    delete_views()


if __name__ == "__main__":
    main()
