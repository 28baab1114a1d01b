# SPDX-License-Identifier: BSD-3-Clause
"""
Remeshing
=========

`remesh` makes other triangles of a surface. The slivers of a marching-cubes surface become even triangles, fewer than
before.
"""

import numpy as np
import pyvista

import neuralmesh

# Two blobs that touch, as an isosurface of a grid.
grid = pyvista.ImageData(dimensions=(40, 40, 40), spacing=(0.1, 0.1, 0.1), origin=(-1.95, -1.95, -1.95))
places = np.asarray(grid.points)
grid["value"] = sum(1 / np.linalg.norm(places - centre, axis=1) for centre in ((-0.7, 0, 0), (0.7, 0.2, 0.1)))
surface = grid.contour([2.2], method="marching_cubes")

mesh = neuralmesh.remesh(surface, vertices=1000)
for name, told in (("before", surface.neuralmesh.info()), ("after", mesh.neuralmesh.info())):
    print(name, told["triangles"], "triangles, quality", round(told["triangle_quality"], 3))

# %%
# Before on the left, after on the right:

plotter = pyvista.Plotter(window_size=(1200, 600))
plotter.add_mesh(surface, color="lightsteelblue", show_edges=True)
plotter.add_mesh(mesh.translate((3.6, 0, 0)), color="lightsteelblue", show_edges=True)
plotter.camera_position = [(1.8, -6.5, 2), (1.8, 0, 0), (0, 0, 1)]
plotter.show()
