# SPDX-License-Identifier: BSD-3-Clause
"""What the GUI has open when panel.xml is played."""

from paraview.simple import *

scan = NeuralMeshScan(Input=Sphere(), NumberOfPoints=30000)
Show(scan)
SetActiveSource(scan)
