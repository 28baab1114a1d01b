# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the documentation: draw.py FOLDER NAME...

A picture is drawn by the function of its name, which gives scenes that stand side by side.
"""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkProperty, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)
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


def mesh_data(points, triangles):
    offsets, corners = vtkIdTypeArray(), vtkIdTypeArray()
    offsets.DeepCopy(numpy_to_vtk(np.arange(len(triangles) + 1, dtype=np.int64) * 3))
    corners.DeepCopy(numpy_to_vtk(triangles.astype(np.int64).ravel()))
    cells = vtkCellArray()
    cells.SetData(offsets, corners)
    mesh = vtkPolyData()
    mesh.SetPoints(cloud_data(points).GetPoints())
    mesh.SetPolys(cells)
    return mesh


def with_errors(mesh, points, triangles):
    """The mesh with its distances from the surface as `Distance`, in percent of the diagonal."""
    comparison = neuralmesh.vtkNeuralMeshComparison()
    comparison.SetInputData(mesh)
    comparison.SetReferenceData(mesh_data(points, triangles))
    comparison.Update()
    compared = comparison.GetOutput()
    distance = compared.GetPointData().GetArray("Distance")
    vtk_to_numpy(distance)[:] *= 100 / np.linalg.norm(np.ptp(points, axis=0))
    return compared


def scene(data, up, azimuth, elevation, scalars=None, zoom=1.25, values=None, near=None, edges=None):
    """A renderer with the points or the triangles, their edges drawn unless there are scalars.

    `values` is the range of the scalars that is coloured, `near` what is looked at instead of all:
    a place and how much of the height is seen."""
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
        mapper.SetScalarRange(values or data.GetPointData().GetArray(scalars).GetRange())
        mapper.GetLookupTable().SetHueRange(2 / 3, 0)  # from blue to red
        looks.EdgeVisibilityOff()
    if edges is not None:
        looks.SetEdgeVisibility(edges)
    inside = vtkProperty()
    inside.DeepCopy(looks)
    inside.SetColor(0.95, 0.75, 0.5)
    actor.SetBackfaceProperty(inside)
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
    if near is not None:
        place, height = near
        camera.ParallelProjectionOn()
        camera.SetPosition(*(np.array(camera.GetPosition()) + place - camera.GetFocalPoint()))
        camera.SetFocalPoint(*place)
        camera.SetParallelScale(height / 2)
        renderer.ResetCameraClippingRange()
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
    meshes = [neuralmesh.reconstruct(points, n, variant="basic", start="tetrahedron", fit_rounds=0)
              for n in (100, 500, 5000)]
    return [scene(mesh, "y", 30, 10) for mesh in meshes]


def spoilt(points, noise, outliers):
    """With noise of this part of the diagonal and so many outliers."""
    random = np.random.default_rng(1)
    low, high = points.min(axis=0), points.max(axis=0)
    points = points + random.normal(0, noise * np.linalg.norm(high - low), points.shape)
    return np.vstack((points, random.uniform(low, high, (outliers, 3))))


def noise():
    points = spoilt(clouds.sample(*bunny(), 60000), 0.005, 1200)
    return [scene(cloud_data(points), "y", 30, 10),
            scene(neuralmesh.reconstruct(points, 3000), "y", 30, 10)]


def topology():
    points = clouds.torus(200000)
    return [scene(neuralmesh.reconstruct(points, 2000, start="tetrahedron", topology_learning=learnt), "z", 20, 40)
            for learnt in (False, True)]


def normals():
    points = clouds.cube(200000)
    basic = neuralmesh.reconstruct(points, 2000, variant="basic", curvature_density=0)
    normal_based = neuralmesh.reconstruct(points, 2000, variant="normal_based")
    strength = neuralmesh.reconstruct(points, 2000, compute_feature_strength=True)
    return [scene(basic, "z", 30, 25, zoom=1), scene(normal_based, "z", 30, 25, zoom=1),
            scene(strength, "z", 30, 25, "FeatureStrength", zoom=1)]


def with_irregularities(mesh):
    """The mesh with `Irregularity`: by how much the number of neighbours of a vertex is not 6."""
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())
    irregularity = numpy_to_vtk(np.abs(np.bincount(triangles) - 6.0), deep=True)
    irregularity.SetName("Irregularity")
    mesh.GetPointData().AddArray(irregularity)
    return mesh


def orders():
    points = clouds.sample(*bunny(), 200000)
    return [scene(with_irregularities(neuralmesh.reconstruct(points, 3000, preset="thesis", **order)),
                  "y", 30, 10, "Irregularity", values=(0, 3), edges=1)
            for order in ({}, {"order": "list"}, {"order": "list", "jump_fraction": 0.1})]


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


def sides():
    points = clouds.sample(*height_field(), 50000)
    return [scene(cloud_data(points), "y", 30, 35)] + [
        scene(neuralmesh.reconstruct(points, 4000, up=up), "y", 30, 35)
        for up in ((0, -1, 0), (0, 1, 0))]


def leap():
    models = [clouds.cgal_mesh("armadillo"), clouds.cgal_mesh("elephant")]
    scan, other = (clouds.sample(*model, 200000) for model in models)
    scan = spoilt(scan, 0.005, 4000)
    return [scene(cloud_data(scan[::5]), "y", 200, 10),
            scene(neuralmesh.reconstruct(scan), "y", 200, 10, edges=0),
            scene(neuralmesh.reconstruct(other), "y", 40, 10),
            scene(with_errors(neuralmesh.reconstruct(other), *models[1]), "y", 40, 10, "Distance",
                  values=(0, 0.1))]


def errors():
    scenes = []
    for model, up, azimuth in ((bunny(), "y", 30), (clouds.cgal_mesh("armadillo"), "y", 200),
                               (clouds.cgal_mesh("elephant"), "y", 40),
                               (clouds.cgal_mesh("knot1"), "z", 30)):
        mesh = neuralmesh.reconstruct(clouds.sample(*model, 200000))
        scenes.append(scene(with_errors(mesh, *model), up, azimuth, 15, "Distance", values=(0, 0.1)))
    return scenes


def height_field():
    x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(-1, 1, 200), np.linspace(-1, 1, 200)))
    z = 0
    for octave, turn in enumerate((0.3, 2.1, 4.4, 1.2)):
        along = np.cos(turn) * x + np.sin(turn) * y
        z = z + 0.3 / 2**octave * np.sin(2**octave * np.pi * along + turn)
    corner = (np.arange(199)[:, None] * 200 + np.arange(199)).ravel()
    below = np.column_stack((corner, corner + 1, corner + 201))
    above = np.column_stack((corner, corner + 201, corner + 200))
    return np.column_stack((x, z, -y)), np.vstack((below, above))


def seen_from(points, triangles, viewpoint):
    scan = neuralmesh.vtkNeuralMeshScan()
    scan.SetInputData(mesh_data(points, triangles))
    scan.SetNumberOfPoints(200000)
    scan.OcclusionOn()
    scan.SetViewpoint(*viewpoint)
    scan.Update()
    return scan.GetOutput()


def hard_scans():
    points, triangles = bunny()
    samples = clouds.sample(points, triangles, 200000)
    size = np.linalg.norm(np.ptp(samples, axis=0))
    holed = samples
    for gap in samples[[11, 5000, 60000, 120000, 190000]]:
        holed = holed[np.linalg.norm(holed - gap, axis=1) > 0.03 * size]
    eye = samples.mean(axis=0) + size * np.array((1.5, 0.6, 2.6))
    field = height_field()
    scenes = []
    for scan, surface, most, azimuth, elevation in (
            (spoilt(samples, 0.005, 4000), (points, triangles), 0.3, 30, 10),
            (holed, (points, triangles), 0.1, 30, 10),
            (seen_from(points, triangles, eye), (points, triangles), 0.1, 60, 15),
            (clouds.sample(*field, 200000), field, 0.1, 30, 35)):
        mesh = with_errors(neuralmesh.reconstruct(scan), *surface)
        scenes.append(scene(mesh, "y", azimuth, elevation, "Distance", values=(0, most)))
    return scenes


def details():
    points = clouds.sample(*bunny(), 200000)
    size = np.linalg.norm(np.ptp(points, axis=0))
    ear = points[np.argmax(points[:, 1])]
    away = points[np.argmax(points[:, 2])]
    seen = points[np.linalg.norm(points - away, axis=1) > 0.06 * size]
    eight = clouds.sample(*clouds.cgal_mesh("eight"), 200000)
    return [scene(neuralmesh.reconstruct(points), "y", 30, 10, near=(ear, 0.2 * size)),
            scene(neuralmesh.reconstruct(seen), "y", *direction(away - points.mean(axis=0)),
                  near=(away, 0.2 * size)),
            scene(neuralmesh.reconstruct(eight, 5000), "y", 20, 30)]


def ball(count):
    points = np.random.default_rng(2).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


def failure(points, *views, **options):
    """The points, a mesh of them for each of the options, from the same side."""
    return [scene(data, *views) for data in (
        cloud_data(points[::max(1, len(points) // 20000)]),
        *(neuralmesh.reconstruct(points, **wanted) for wanted in options["meshes"]))]


def failure_missing():
    random = np.random.default_rng(3)
    angle = random.uniform(0, 2 * np.pi, 4000)
    rod = np.column_stack((0.04 * np.cos(angle), random.uniform(0.95, 2.15, 4000), 0.04 * np.sin(angle)))
    return failure(np.vstack((ball(40000), rod)), "y", 30, 10,
                   meshes=({"vertices": 40}, {"vertices": 2000}))


def failure_thin():
    """The two sides of a plate."""
    random = np.random.default_rng(3)
    points = random.uniform((0, 0, 0), (1, 0.6, 0), (60000, 3))
    points += 0.0035 * random.choice((-1, 1), (60000, 1)) * (0, 0, 1) + random.normal(0, 0.001, points.shape)
    return failure(points, "z", 20, 40, meshes=({"vertices": 1000}, {"vertices": 10000}))


def failure_finer():
    points = ball(1500) * (1 + np.random.default_rng(3).normal(0, 0.02, (1500, 1)))
    return failure(points, "y", 30, 10, meshes=({"vertices": 1400}, {"vertices": 300}))


def direction(towards):
    """Azimuth and elevation of a camera that looks from there, with y upwards."""
    x, y, z = towards / np.linalg.norm(towards)
    return np.degrees(np.arctan2(x, z)), np.degrees(np.arcsin(y))


def main():
    folder, *names = sys.argv[1:]
    for name in names:
        draw(f"{folder}/{name}.png", globals()[name]())


if __name__ == "__main__":
    main()
