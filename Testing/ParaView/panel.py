# SPDX-License-Identifier: BSD-3-Clause
"""What the GUI has open while panel.xml is played."""

from paraview.simple import *

scan = NeuralMeshScan(Input=Sphere(), NumberOfPoints=2000)
mesh = NeuralMesh(Input=scan, NumberOfVertices=100)
Show(mesh)
SetActiveSource(mesh)
