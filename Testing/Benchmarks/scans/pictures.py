# SPDX-License-Identifier: BSD-3-Clause
"""Draws meshes from two sides, front faces light and back faces red: pictures.py PICTURE MESH..."""

import os
import sys

from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkProperty, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (draws the text)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer behind the classes above)

import files
import shapes

SIZE = 220  # pixels, of a mesh from one side
COLUMNS = 4
# From where it is looked, and what is up there.
SIDES = (((1, 1, 2), (0, 1, 0)), ((-1, -1, -2), (0, 1, 0)))


def actor_of(path):
    points, triangles = files.read_mesh(path)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(files.poly_data(shapes.unit(points), triangles))
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetColor(0.8, 0.84, 0.9)
    back = vtkProperty()
    back.DeepCopy(actor.GetProperty())
    back.SetColor(0.85, 0.1, 0.1)
    actor.SetBackfaceProperty(back)
    return actor


def title(text):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.GetTextProperty().SetColor(0, 0, 0)
    actor.GetTextProperty().SetFontSize(13)
    actor.SetPosition(4, 4)
    return actor


def montage(picture, meshes):
    rows = -(-len(meshes) // COLUMNS)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(SIZE * 2 * min(COLUMNS, len(meshes)), SIZE * rows)
    wide, high = 1 / (2 * min(COLUMNS, len(meshes))), 1 / rows
    for index, mesh in enumerate(meshes):
        row, column = divmod(index, COLUMNS)
        actor = actor_of(mesh)
        for side, (eye, up) in enumerate(SIDES):
            renderer = vtkRenderer()
            renderer.SetBackground(1, 1, 1)
            renderer.AddActor(actor)
            if side == 0:
                renderer.AddActor(title(os.path.splitext(os.path.basename(mesh))[0]))
            left, low = (2 * column + side) * wide, 1 - (row + 1) * high
            renderer.SetViewport(left, low, left + wide, low + high)
            camera = renderer.GetActiveCamera()
            camera.SetPosition(*eye)
            camera.SetViewUp(*up)
            camera.ParallelProjectionOn()
            camera.SetParallelScale(0.45)  # half of what is seen of the diagonal
            renderer.ResetCameraClippingRange()
            window.AddRenderer(renderer)
    for index in range(len(meshes), rows * COLUMNS if rows > 1 else 0):
        row, column = divmod(index, COLUMNS)
        blank = vtkRenderer()
        blank.SetBackground(1, 1, 1)
        blank.SetViewport(2 * column * wide, 1 - (row + 1) * high, 2 * (column + 1) * wide, 1 - row * high)
        window.AddRenderer(blank)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    montage(sys.argv[1], sys.argv[2:])
