# SPDX-License-Identifier: BSD-3-Clause
"""
Error bars
==========

`compute_uncertainty=True` estimates for each vertex how far it may lie off the surface, as a standard deviation. It is
larger where there are few points, or where these are noisy.
"""

import numpy as np
import pyvista

import neuralmesh

random = np.random.default_rng(4)
directions = random.normal(size=(30000, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
# One half is noisier, and one quarter of it has one point of ten.
noise = np.where(directions[:, 0] > 0, 0.03, 0.005)
kept = (directions[:, 0] < 0) | (directions[:, 2] < 0) | (random.uniform(size=30000) < 0.1)
points = directions * (1 + random.normal(0, noise))[:, None]
cloud = pyvista.PolyData(points[kept])

mesh = neuralmesh.reconstruct(cloud, vertices=2000, compute_uncertainty=True)

# %%
# Each vertex has its error bar in the array `Uncertainty`:

plotter = pyvista.Plotter()
plotter.add_mesh(mesh, scalars="Uncertainty", cmap="plasma", smooth_shading=True)
plotter.camera_position = [(1, -4, 1), (0, 0, 0), (0, 0, 1)]
plotter.show()
