# SPDX-License-Identifier: BSD-3-Clause
"""
A noisy closed scan
===================

The scan is an asteroid with 30,000 points, noise and 200 stray points. The mesh averages the noise out and leaves the
stray points out.
"""

import numpy as np
import pyvista

import neuralmesh

random = np.random.default_rng(2)
waves, phases = random.normal(size=(40, 3)) * 5, random.uniform(0, 2 * np.pi, 40)
directions = random.normal(size=(30000, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
radii = 1 + 0.016 * np.sin(directions @ waves.T + phases).sum(axis=1)
surface = directions * radii[:, None] + random.normal(0, 0.008, directions.shape)
stray = random.uniform(-1.4, 1.4, (200, 3))
cloud = pyvista.PolyData(np.vstack((surface, stray)))

mesh = neuralmesh.reconstruct(cloud, vertices=5000)
print("standard deviation of the noise:", round(mesh.field_data["Noise"][0], 4))

# sphinx_gallery_thumbnail_number = 2

# %%
# The points:

plotter = pyvista.Plotter()
plotter.add_points(cloud, color="steelblue", point_size=2)
plotter.camera_position = "xz"
plotter.show()

# %%
# The mesh, in the colours of its distance from the centre:

mesh["distance from the centre"] = np.linalg.norm(mesh.points, axis=1)
plotter = pyvista.Plotter()
plotter.add_mesh(mesh, scalars="distance from the centre", cmap="viridis", smooth_shading=True)
plotter.camera_position = "xz"
plotter.show()
