#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures a reconstruction against its points, and draws both side by side, back sides of the
mesh in orange.

    show.py POINTS MESH.ply PICTURE.png [--up x|y|z] [--azimuth DEGREES]

Prints the distances from the points to the mesh (VTK's Hausdorff filter, point to cell, in percent
of the diagonal of the points' bounding box) and the valences. Needs a display to draw: xvfb-run.
"""

import argparse
import sys

import numpy as np
from vtkmodules.numpy_interface import dataset_adapter as dsa
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkFiltersModeling import vtkHausdorffDistancePointSetFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkProperty, vtkRenderer, vtkRenderWindow,
    vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer behind the classes above)


def read_points(path):
    if path.endswith(".ply"):
        reader = vtkPLYReader()
        reader.SetFileName(path)
        reader.Update()
        return dsa.WrapDataObject(reader.GetOutput()).Points
    if path.endswith(".obj"):
        with open(path, encoding="ascii") as file:
            return np.array([line.split()[1:4] for line in file if line.startswith("v ")], float)
    return np.loadtxt(path, usecols=(0, 1, 2))


def cloud_of(coordinates):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(coordinates, dtype=float), deep=True))
    cloud = vtkPolyData()
    cloud.SetPoints(points)
    glyphs = vtkVertexGlyphFilter()
    glyphs.SetInputData(cloud)
    glyphs.Update()
    return glyphs.GetOutput()


def print_distances(cloud, mesh, diagonal):
    distance = vtkHausdorffDistancePointSetFilter()
    distance.SetInputData(0, cloud)
    distance.SetInputData(1, mesh)
    distance.SetTargetDistanceMethodToPointToCell()
    distance.Update()
    d = np.asarray(dsa.WrapDataObject(distance.GetOutput(0)).PointData["Distance"])
    d = 100 * d / diagonal
    print(f"distance   points to mesh: mean {d.mean():.3f} %, "
          f"RMS {np.sqrt((d ** 2).mean()):.3f} %, maximum {d.max():.3f} % of the diagonal")


def print_valences(mesh):
    corners = dsa.WrapDataObject(mesh).Polygons.reshape(-1, 4)[:, 1:]
    edges = np.sort(np.vstack([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    valences = np.bincount(np.unique(edges, axis=0).ravel())
    shares = ", ".join(f"{v}: {100 * (valences == v).mean():.1f} %" for v in range(4, 9))
    print(f"valence    {shares}")


def draw(cloud, mesh, picture, up, azimuth):
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(1400, 700)
    window.SetMultiSamples(8)
    camera = None
    for side, data in enumerate((cloud, mesh)):
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(data)
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        appearance = actor.GetProperty()
        if data is cloud:
            appearance.SetColor(0.1, 0.25, 0.45)
            appearance.SetPointSize(2)
            appearance.LightingOff()
        else:
            appearance.SetColor(0.85, 0.80, 0.72)
            appearance.EdgeVisibilityOn()
            appearance.SetEdgeColor(0.25, 0.25, 0.3)
            back = vtkProperty()
            back.DeepCopy(appearance)
            back.SetColor(0.95, 0.55, 0.3)
            actor.SetBackfaceProperty(back)
        renderer = vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        renderer.SetViewport(side / 2, 0, (side + 1) / 2, 1)
        renderer.AddActor(actor)
        window.AddRenderer(renderer)
        if camera is None:
            camera = renderer.GetActiveCamera()
            axis = "xyz".index(up)
            view_up, position = np.zeros(3), np.zeros(3)
            view_up[axis] = 1
            position[(axis + 1) % 3] = 1
            camera.SetPosition(position)
            camera.SetFocalPoint(0, 0, 0)
            camera.SetViewUp(view_up)
            camera.Azimuth(azimuth)
            camera.Elevation(15)
            renderer.ResetCamera(mesh.GetBounds())
            camera.Zoom(1.2)
            renderer.ResetCameraClippingRange()
        else:
            renderer.SetActiveCamera(camera)
    window.Render()
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grabber.GetOutputPort())
    writer.Write()


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("points")
    parser.add_argument("mesh")
    parser.add_argument("picture")
    parser.add_argument("--up", choices="xyz", default="y")
    parser.add_argument("--azimuth", type=float, default=30)
    arguments = parser.parse_args()

    coordinates = read_points(arguments.points)
    diagonal = np.linalg.norm(coordinates.max(axis=0) - coordinates.min(axis=0))
    reader = vtkPLYReader()
    reader.SetFileName(arguments.mesh)
    reader.Update()
    mesh = reader.GetOutput()
    if mesh.GetNumberOfPolys() == 0:
        sys.exit(f"show.py: {arguments.mesh} has no triangles")
    cloud = cloud_of(coordinates)
    print_distances(cloud, mesh, diagonal)
    print_valences(mesh)
    draw(cloud, mesh, arguments.picture, arguments.up, arguments.azimuth)
    print(f"picture    {arguments.picture}")


if __name__ == "__main__":
    main()
