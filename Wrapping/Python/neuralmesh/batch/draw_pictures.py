# SPDX-License-Identifier: BSD-3-Clause
"""Draws meshes: a script for pvbatch or python3, with a display; what to draw is on its input."""

import json
import sys
from pathlib import Path

import numpy as np
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
FILLED = 0.95  # of the width or the height
BACK = (0.95, 0.55, 0.3)  # as in the pictures of the documentation
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


def front(mesh, has_colors):
    """The outer side of the mesh."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.SetScalarVisibility(has_colors)
    actor = vtkActor()
    actor.SetMapper(mapper)
    looks = actor.GetProperty()
    looks.SetColor(0.75, 0.8, 0.9)
    looks.SetAmbient(0.1)
    looks.SetDiffuse(0.8)
    looks.SetSpecular(0.15)
    looks.SetSpecularPower(20)
    looks.BackfaceCullingOn()
    return actor


def back(mesh):
    """The inner side of the mesh, in a colour of its own, whatever colours the points have."""
    actor = front(mesh, False)
    looks = actor.GetProperty()
    looks.BackfaceCullingOff()
    looks.FrontfaceCullingOn()
    looks.SetColor(*BACK)
    return actor


def scene(mesh, view):
    points, _, colors = arrays_of(mesh)
    shaded = smooth(to_vtk(mesh))
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(front(shaded, colors is not None))
    renderer.AddActor(back(shaded))
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    position, up = SIDES[view["up"]]
    camera.SetPosition(*position)
    camera.SetViewUp(*up)
    camera.Azimuth(view["azimuth"])
    camera.Elevation(view["elevation"])
    camera.OrthogonalizeViewUp()
    fit(renderer, points)
    return renderer


def fit(renderer, points):
    """Move the camera, along the direction of view, so that the points just fill the picture."""
    camera = renderer.GetActiveCamera()
    backwards = -np.array(camera.GetDirectionOfProjection())
    up = np.array(camera.GetViewUp())
    axes = np.array([np.cross(up, backwards), up, backwards])
    seen = points.astype(np.float64) @ axes.T
    middle = (seen.min(axis=0) + seen.max(axis=0)) / 2
    slope = np.tan(np.radians(camera.GetViewAngle() / 2))  # of the upper edge of the view
    slopes = FILLED * slope * np.array([SIZE[0] / SIZE[1], 1])
    distance = distance_to_see(seen - middle, slopes)
    # What is near looks larger, so that the middle of the picture is another one.
    for _ in range(4):
        places = seen - middle
        pictured = places[:, :2] / (distance - places[:, 2:])
        middle[:2] += distance * (pictured.min(axis=0) + pictured.max(axis=0)) / 2
        distance = distance_to_see(seen - middle, slopes)
    focus = axes.T @ middle
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(focus + distance * backwards))
    renderer.ResetCameraClippingRange()


def distance_to_see(places, slopes):
    """How far from the middle a camera has to be to see each point, between lines of these slopes."""
    # A little more, so that no point is where the camera is, whatever there is of the mesh.
    return 1.001 * (places[:, 2] + (np.abs(places[:, :2]) / slopes).max(axis=1)).max() + 1e-300


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
        if writer.GetErrorCode():
            raise OSError("not all of it could be written; is the disk full?")
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
