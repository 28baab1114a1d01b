# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvpython, pvbatch and paraview --script, with NEURALMESH_PLUGIN, the plugin of what pip installed: makes a
mesh of a scan, and saves a picture where NEURALMESH_PICTURE names one. Prints "well".
"""

import os
import sys
import traceback

from paraview import simple


def main():
    simple.LoadPlugin(os.environ["NEURALMESH_PLUGIN"], remote=False, ns=vars(simple))
    scan = simple.NeuralMeshScan(Input=simple.Sphere(PhiResolution=60, ThetaResolution=60))
    scan.NumberOfPoints = 20000
    mesh = simple.NeuralMesh(Input=scan, NumberOfVertices=1000)
    mesh.UpdatePipeline()
    information = mesh.GetDataInformation()
    assert information.GetNumberOfPoints() == 1000, information.GetNumberOfPoints()
    assert information.GetNumberOfCells() == 1996, information.GetNumberOfCells()
    # What the panel shows comes from the same list.
    assert mesh.FitRounds == 2 and mesh.Variant == "Noise Filtering", (mesh.FitRounds, mesh.Variant)
    ensemble = simple.NeuralMeshEnsemble(Input=scan, NumberOfVertices=500, NumberOfMembers=2)
    ensemble.UpdatePipeline()
    assert ensemble.GetDataInformation().GetNumberOfPoints() == 500
    comparison = simple.NeuralMeshComparison(Input=mesh, Reference=scan.Input)
    comparison.UpdatePipeline()
    picture = os.environ.get("NEURALMESH_PICTURE")
    if picture:
        view = simple.GetActiveViewOrCreate("RenderView")
        simple.Show(mesh, view).Representation = "Surface With Edges"
        simple.ResetCamera(view)
        simple.Render(view)
        simple.SaveScreenshot(picture, view)
    # Not sys.stdout, which in the window is its shell.
    print("well", file=sys.__stdout__, flush=True)


try:
    main()
    status = 0
except BaseException:  # whatever it is: paraview would stay open
    traceback.print_exc()
    status = 1
sys.stdout.flush()
os._exit(status)
