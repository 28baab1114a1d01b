# SPDX-License-Identifier: BSD-3-Clause
"""Draws meshes: a script for pvbatch or python3, with a display; what to draw is on its input."""

import json
import sys
from pathlib import Path

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer behind the classes)
from neuralmesh.batch.meshes import arrays_of, read_points, to_vtk
from neuralmesh.batch.atomic_file import atomic_file
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)

SIZE = (640, 480)  # pixels
# Where the camera is, before it is turned, and which way is up.
SIDES = {"x": ((0, -1, 0), (1, 0, 0)), "y": ((0, 0, 1), (0, 1, 0)), "z": ((0, -1, 0), (0, 0, 1))}


def smooth(mesh):
    """The mesh with a normal at each vertex."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(mesh)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def scene(mesh, view):
    _, _, colors = arrays_of(mesh)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(smooth(to_vtk(mesh)))
    mapper.SetScalarVisibility(colors is not None)
    actor = vtkActor()
    actor.SetMapper(mapper)
    looks = actor.GetProperty()
    looks.SetColor(0.75, 0.8, 0.9)
    looks.SetAmbient(0.1)
    looks.SetDiffuse(0.8)
    looks.SetSpecular(0.15)
    looks.SetSpecularPower(20)
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    position, up = SIDES[view["up"]]
    camera.SetPosition(*position)
    camera.SetViewUp(*up)
    camera.Azimuth(view["azimuth"])
    camera.Elevation(view["elevation"])
    camera.OrthogonalizeViewUp()
    renderer.ResetCamera()
    camera.Zoom(1.4)
    return renderer


def draw(window, mesh, path, view):
    renderer = scene(mesh, view)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    with atomic_file(path) as temporary:
        writer = vtkPNGWriter()
        writer.SetFileName(str(temporary))
        writer.SetInputConnection(image.GetOutputPort())
        writer.Write()
    window.RemoveRenderer(renderer)


def main():
    # By its number, as pvbatch puts something else in the place of sys.stdin.
    with open(0, encoding="utf-8") as file:
        order = json.load(file)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    failed = False
    for mesh, picture in order["pictures"]:
        try:
            draw(window, read_points(Path(mesh)), Path(picture), order["view"])
        except Exception as error:  # the others can still be drawn
            print(f"{mesh}: {error}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
