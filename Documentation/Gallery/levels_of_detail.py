# SPDX-License-Identifier: BSD-3-Clause
"""
Levels of detail
================

`levels` gives meshes of several sizes in one run. Each is fitted to the points.
"""

import numpy as np
import pyvista

import neuralmesh

# Noisy points on a torus with waves.
random = np.random.default_rng(6)
turn, around = random.uniform(0, 2 * np.pi, (2, 40000))
radius = 0.7 + 0.1 * np.sin(8 * turn + 3 * around)
distance = 2 + radius * np.cos(around)
points = np.column_stack((distance * np.cos(turn), distance * np.sin(turn), radius * np.sin(around)))
cloud = pyvista.PolyData(points + random.normal(0, 0.02, points.shape))

levels = neuralmesh.reconstruct(cloud, levels=(500, 2000, 8000))

# %%
# The meshes side by side:

plotter = pyvista.Plotter(window_size=(1200, 480))
for number, level in enumerate(levels):
    print(level.n_points, "vertices, distance of the points:", round(level.field_data["Residual"][0], 4))
    plotter.add_mesh(level.translate((6 * number, 0, 0)), color="lightsteelblue", show_edges=True)
plotter.camera_position = [(6, -9, 24), (6, 0, 0), (0, 1, 0)]
plotter.camera.zoom(1.3)
plotter.show()
