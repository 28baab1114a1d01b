# SPDX-License-Identifier: BSD-3-Clause
"""
An open scan and its back faces
===============================

A scanner above a bowl sees its inner side only, so the mesh has a boundary. `viewpoints` says where the scanner stood:
the front of the mesh looks there. Back faces are red.
"""

import numpy as np
import pyvista

import neuralmesh

random = np.random.default_rng(3)
angle = random.uniform(0, 2 * np.pi, 20000)
distance = np.sqrt(random.uniform(0, 1, 20000))
height = 0.7 * distance**2 + 0.04 * np.sin(6 * angle) * distance
points = np.column_stack((distance * np.cos(angle), distance * np.sin(angle), height))
cloud = pyvista.PolyData(points + random.normal(0, 0.004, points.shape))

mesh = neuralmesh.reconstruct(cloud, vertices=2000, viewpoints=(0, 0, 4))
print("boundaries:", mesh.neuralmesh.info()["boundary_loops"])

# %%
# Front faces and back faces are drawn as two objects, because the 3D view in a browser has one colour for an object:

plotter = pyvista.Plotter()
plotter.add_mesh(mesh, color="lightsteelblue", culling="back", smooth_shading=True)
plotter.add_mesh(mesh, color="firebrick", culling="front", smooth_shading=True)
plotter.add_mesh(mesh.extract_feature_edges(feature_edges=False), color="black", line_width=3)
plotter.camera_position = [(1.2, -3.6, 1.6), (0, 0, 0.3), (0, 0, 1)]
plotter.show()
