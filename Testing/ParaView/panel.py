# SPDX-License-Identifier: BSD-3-Clause
"""What the GUI has open when panel.xml is played."""

import os

from paraview.simple import *

# The plugin in Python, where that is tested.
if "NEURALMESH_PLUGIN" in os.environ:
    LoadPlugin(os.environ["NEURALMESH_PLUGIN"], remote=False, ns=globals())
scan = NeuralMeshScan(Input=Sphere(), NumberOfPoints=30000)
Show(scan)
SetActiveSource(scan)
