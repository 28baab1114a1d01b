# SPDX-License-Identifier: BSD-3-Clause
"""
Levels of detail
================

`levels` gives meshes of several sizes in one run. Each is fitted to the points.
"""

import numpy as np
import pyvista

import neuralmesh

# Noisy points on a knotted tube.
random = np.random.default_rng(6)
turn, around = random.uniform(0, 2 * np.pi, (2, 40000, 1))
middle = np.hstack((np.sin(turn) + 2 * np.sin(2 * turn), np.cos(turn) - 2 * np.cos(2 * turn), -np.sin(3 * turn)))
along = np.hstack((np.cos(turn) + 4 * np.cos(2 * turn), -np.sin(turn) + 4 * np.sin(2 * turn), -3 * np.cos(3 * turn)))
first = np.cross(along, (0, 0, 1))
second = np.cross(along, first)
first /= np.linalg.norm(first, axis=1)[:, None]
second /= np.linalg.norm(second, axis=1)[:, None]
points = middle + 0.5 * (np.cos(around) * first + np.sin(around) * second)
cloud = pyvista.PolyData(points + random.normal(0, 0.02, points.shape))

levels = neuralmesh.reconstruct(cloud, levels=(1000, 3000, 9000))

# %%
# The meshes side by side:

plotter = pyvista.Plotter(window_size=(1200, 480))
for number, level in enumerate(levels):
    print(level.n_points, "vertices, distance of the points:", round(level.field_data["Residual"][0], 4))
    plotter.add_mesh(level.translate((8 * number, 0, 0)), color="lightsteelblue", show_edges=True)
plotter.camera_position = [(8, 0, 30), (8, 0, 0), (0, 1, 0)]
plotter.camera.zoom(1.3)
plotter.show()
