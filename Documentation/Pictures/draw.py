# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the documentation: draw.py FOLDER [NAME...]"""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer behind the classes above)

import clouds
import neuralmesh

SIZE = 420  # pixels, of a part of a picture
BUNNY = "/usr/share/glmark2/models/bunny.obj"


def bunny():
    with open(BUNNY, encoding="ascii") as file:
        lines = [line.split() for line in file]
    points = np.array([words[1:4] for words in lines if words[:1] == ["v"]], float)
    corners = [[corner.split("/")[0] for corner in words[1:4]] for words in lines if words[:1] == ["f"]]
    return points, np.array(corners, int) - 1


def cloud_data(points):
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=True))
    cloud = vtkPolyData()
    cloud.SetPoints(vtk_points)
    glyphs = vtkVertexGlyphFilter()
    glyphs.SetInputData(cloud)
    glyphs.Update()
    return glyphs.GetOutput()


def scene(data, up, azimuth, elevation, scalars=None, zoom=1.25):
    """A renderer with the points or the triangles, their edges drawn."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarVisibility(scalars is not None)
    actor = vtkActor()
    actor.SetMapper(mapper)
    looks = actor.GetProperty()
    looks.SetColor(0.75, 0.8, 0.9)
    if data.GetNumberOfPolys() > 0:
        looks.SetInterpolationToFlat()
        looks.EdgeVisibilityOn()
        looks.SetEdgeColor(0.1, 0.15, 0.3)
        looks.SetLineWidth(0.5)
    else:
        looks.SetColor(0.2, 0.3, 0.5)
        looks.SetPointSize(1.5)
    if scalars is not None:
        data.GetPointData().SetActiveScalars(scalars)
        mapper.SetScalarRange(data.GetPointData().GetArray(scalars).GetRange())
        mapper.GetLookupTable().SetHueRange(2 / 3, 0)  # from blue to red
        looks.EdgeVisibilityOff()
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0, 0, 1) if up == "y" else camera.SetPosition(0, -1, 0)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(*((0, 1, 0) if up == "y" else (0, 0, 1)))
    camera.Azimuth(azimuth)
    camera.Elevation(elevation)
    camera.OrthogonalizeViewUp()
    renderer.ResetCamera()
    camera.Zoom(zoom)
    return renderer


def draw(path, renderers):
    """Draws scenes side by side."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(SIZE * len(renderers), SIZE)
    for i, renderer in enumerate(renderers):
        renderer.SetViewport(i / len(renderers), 0, (i + 1) / len(renderers), 1)
        window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


def growth():
    points = clouds.sample(*bunny(), 200000)
    meshes = [neuralmesh.reconstruct(points, n, variant="basic", start="tetrahedron") for n in (100, 500, 5000)]
    return [scene(mesh, "y", 30, 10) for mesh in meshes]


def noise():
    random = np.random.default_rng(1)
    points = clouds.sample(*bunny(), 60000)
    low, high = points.min(axis=0), points.max(axis=0)
    points += random.normal(0, 0.005 * np.linalg.norm(high - low), points.shape)
    points = np.vstack((points, random.uniform(low, high, (1200, 3))))
    return [scene(cloud_data(points), "y", 30, 10),
            scene(neuralmesh.reconstruct(points, 3000), "y", 30, 10)]


def topology():
    points = clouds.torus(200000)
    return [scene(neuralmesh.reconstruct(points, 2000, start="tetrahedron", topology_learning=learnt), "z", 20, 40)
            for learnt in (False, True)]


def normals():
    points = clouds.cube(200000)
    basic, normal_based = (neuralmesh.reconstruct(points, 2000, variant=variant)
                           for variant in ("basic", "normal_based"))
    strength = neuralmesh.reconstruct(points, 2000, compute_feature_strength=True)
    return [scene(basic, "z", 30, 25), scene(normal_based, "z", 30, 25),
            scene(strength, "z", 30, 25, "FeatureStrength")]


def ensemble():
    points = clouds.sample(*clouds.cgal_mesh("eight"), 200000)
    algorithm = neuralmesh.vtkNeuralMeshEnsemble()
    algorithm.SetInputData(cloud_data(points))
    algorithm.SetNumberOfVertices(5000)
    algorithm.Update()
    member = neuralmesh.reconstruct(points, 2000, start="tetrahedron")
    return [scene(mesh, "y", 20, 30)
            for mesh in (member, algorithm.GetAverageMesh(), algorithm.GetOutput())]


def first_mesh():
    coarse = neuralmesh.reconstruct(clouds.torus(50000), 300, ensemble=9)
    points = clouds.torus(200000) * (1, 1, 1.5)
    return [scene(mesh, "z", 20, 40)
            for mesh in (coarse, neuralmesh.reconstruct(points, 3000, first_mesh=coarse))]


def openings():
    points = clouds.sample(*bunny(), 200000)
    seen = points[(points[:, 2] > np.median(points[:, 2])) & (np.linalg.norm(
        points - points[7], axis=1) > 0.1 * np.linalg.norm(np.ptp(points, axis=0)))]
    return [scene(cloud_data(seen), "y", 30, 10)] + [
        scene(neuralmesh.reconstruct(seen, 5000, boundaries=boundaries), "y", 30, 10)
        for boundaries in ("keep", "close")]


PICTURES = {"growth": growth, "noise": noise, "topology": topology, "normals": normals,
            "ensemble": ensemble, "first_mesh": first_mesh, "openings": openings}


def main():
    folder, *names = sys.argv[1:]
    for name in names or PICTURES:
        draw(f"{folder}/{name}.png", PICTURES[name]())


if __name__ == "__main__":
    main()
