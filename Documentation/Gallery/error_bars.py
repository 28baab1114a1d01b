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
# The noise grows from left to right, and above there are few points.
noise = 0.004 * 3 ** directions[:, 0]
kept = (directions[:, 2] < 0.3) | (random.uniform(size=30000) < 0.15)
points = directions * (1 + random.normal(0, noise))[:, None]
cloud = pyvista.PolyData(points[kept])

mesh = neuralmesh.reconstruct(cloud, vertices=2000, compute_uncertainty=True)

# %%
# Each vertex has its error bar in the array `Uncertainty`:

plotter = pyvista.Plotter()
plotter.add_mesh(mesh, scalars="Uncertainty", cmap="plasma", smooth_shading=True)
plotter.camera_position = [(1.3, -5, 1.3), (0, 0, -0.2), (0, 0, 1)]
plotter.show()
