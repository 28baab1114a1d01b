# SPDX-License-Identifier: BSD-3-Clause
"""What the window of ParaView shows in the picture of the tutorial; run by draw_tutorial.sh."""

from paraview.simple import *

scan = OpenDataFile("/usr/share/glmark2/models/bunny.obj")
RenameSource("bunny.obj", scan)
mesh = NeuralMesh(Input=scan, NumberOfVertices=5000)
view = GetActiveViewOrCreate("RenderView")
Show(mesh, view, Representation="Surface With Edges")
view.CameraPosition = [1, 0.4, 2]
view.CameraViewUp = [0, 1, 0]
ResetCamera(view)
view.GetActiveCamera().Zoom(1.1)
SetActiveSource(mesh)
Render(view)
