# SPDX-License-Identifier: BSD-3-Clause
"""
Feature lines
=============

`feature_lines=True` finds the sharp edges that the points confirm, as lines that end in corners.
"""

import numpy as np
import pyvista

import neuralmesh

# A bracket, and noisy points on it.
outline = [(0, 0, 0), (2, 0, 0), (2, 0.6, 0), (0.8, 0.6, 0), (0.8, 1.4, 0), (0, 1.4, 0)]
bracket = pyvista.PolyData(outline, [6, *range(6)]).extrude((0, 0, 1), capping=True).triangulate()

random = np.random.default_rng(5)
areas = bracket.compute_cell_sizes(length=False, volume=False)["Area"]
a, b, c = bracket.points[bracket.regular_faces[random.choice(len(areas), 40000, p=areas / areas.sum())]].swapaxes(0, 1)
u, v = np.sort(random.uniform(size=(2, 40000, 1)), axis=0)
points = a * u + b * (v - u) + c * (1 - v)
cloud = pyvista.PolyData(points + random.normal(0, 0.004, points.shape))

mesh, lines = neuralmesh.reconstruct(cloud, vertices=3000, feature_lines=True)
print(lines.n_lines, "lines,", lines.n_verts, "corners")

# %%
# The lines in the colours of their angle, and the corners:

plotter = pyvista.Plotter()
plotter.add_mesh(mesh, color="lightgrey", show_edges=True, edge_color="darkgrey")
plotter.add_mesh(lines, scalars="Angle", cmap="autumn", line_width=6)
plotter.add_points(lines.points[lines["Corner"] == 1], color="black", point_size=12, render_points_as_spheres=True)
plotter.camera_position = [(4.5, 3.5, 4), (0.9, 0.6, 0.5), (0, 1, 0)]
plotter.show()
