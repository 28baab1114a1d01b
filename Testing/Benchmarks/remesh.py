# SPDX-License-Identifier: BSD-3-Clause
"""Prints surfaces that are remeshed by us and by others, see remesh.sh.

    remesh.py COMMAND PYTHON WORK [MODEL.ply...]
    remesh.py --make METHOD MODEL RESULT TRIANGLES     (in a process of its own)

Others run in the Python of their packages, each in a process of its own: CPU seconds are those of the whole
process, for others less those of one that only reads and writes.
"""

import json
import pathlib
import resource
import subprocess
import sys

MODELS = ("bunny00", "armadillo")  # of CGAL
PARTS = (0.5, 0.1, 0.01)
OURS = "NeuralMesh"
# PyMeshLab is told an edge, not a number of triangles: so often it is told another one, and the last counts.
TRIES = 3
VTK = ("vtkQuadricDecimation", "vtkDecimatePro")
PEERS = ("pyacvd", "fast-simplification", "PyMeshLab isotropic")


def make(method, model, result, triangles):
    """Write what a method makes of a model; of 0 triangles, the model as it was read."""
    if method in VTK:
        with_vtk(method, model, result, triangles)
    elif method == "pyacvd":
        with_pyacvd(model, result, triangles)
    elif method == "fast-simplification":
        with_fast_simplification(model, result, triangles)
    elif method == "PyMeshLab isotropic":
        with_pymeshlab(model, result, triangles)
    else:
        sys.exit(f"{method}: there is no such method")


def with_vtk(method, model, result, triangles):
    from vtkmodules import vtkFiltersCore
    from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter

    reader = vtkPLYReader()
    reader.SetFileName(model)
    reader.Update()
    last = reader
    if triangles > 0:
        last = getattr(vtkFiltersCore, method)()
        last.SetInputConnection(reader.GetOutputPort())
        last.SetTargetReduction(1.0 - triangles / reader.GetOutput().GetNumberOfPolys())
        if method == "vtkDecimatePro":
            last.PreserveTopologyOn()
    writer = vtkPLYWriter()
    writer.SetInputConnection(last.GetOutputPort())
    writer.SetFileName(result)
    writer.Write()


def with_pyacvd(model, result, triangles):
    import pyacvd
    import pyvista

    mesh = pyvista.read(model)
    if triangles == 0:
        mesh.save(result)
        return
    clustering = pyacvd.Clustering(mesh)
    # It wants as many points as ten times those of the result.
    wanted = int(mesh.n_points * triangles / mesh.n_cells)
    times = 0
    while clustering.mesh.n_points < 10 * wanted and times < 3:
        clustering.subdivide(2)
        times += 1
    clustering.cluster(wanted)
    clustering.create_mesh().save(result)


def with_fast_simplification(model, result, triangles):
    import fast_simplification
    import pyvista

    mesh = pyvista.read(model)
    if triangles > 0:
        mesh = fast_simplification.simplify_mesh(mesh, 1.0 - triangles / mesh.n_cells)
    mesh.save(result)


def with_pymeshlab(model, result, triangles):
    """It is told an edge, not a number: that of equilateral triangles of the same area, and then one nearer."""
    import math

    import pymeshlab

    edge, scale = None, 1.0
    if triangles == 0:
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(model)
    for _ in range(TRIES if triangles > 0 else 0):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(model)
        if edge is None:
            area = meshes.get_geometric_measures()["surface_area"]
            edge = math.sqrt(4.0 * area / (math.sqrt(3.0) * triangles))
        meshes.meshing_isotropic_explicit_remeshing(
            iterations=10, targetlen=pymeshlab.PureValue(scale * edge)
        )
        scale *= math.sqrt(meshes.current_mesh().face_number() / triangles)
    meshes.save_current_mesh(result)


def write_surface(path, points, triangles):
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOPLY import vtkPLYWriter

    import numpy

    places, cells, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    places.SetData(numpy_to_vtk(numpy.asarray(points, dtype=numpy.float32), deep=True))
    corners = numpy.ascontiguousarray(triangles, dtype=numpy.int64)
    cells.SetData(3, numpy_to_vtkIdTypeArray(corners.reshape(-1), deep=True))
    surface.SetPoints(places)
    surface.SetPolys(cells)
    writer = vtkPLYWriter()
    writer.SetInputData(surface)
    writer.SetFileName(str(path))
    writer.Write()


def make_model(name, work):
    import clouds

    path = work / f"{name}.ply"
    write_surface(path, *clouds.cgal_mesh(name))
    return str(path)


def make_isosurface(path):
    """A gyroid in a box, which cuts it: open, with a boundary of many corners."""
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
    from vtkmodules.vtkIOPLY import vtkPLYWriter
    from vtkmodules.util.numpy_support import numpy_to_vtk

    import numpy

    count = 61
    x = numpy.linspace(0.0, 3.0 * numpy.pi, count)
    a, b, c = numpy.meshgrid(x, x, x, indexing="ij")
    values = numpy.sin(a) * numpy.cos(b) + numpy.sin(b) * numpy.cos(c) + numpy.sin(c) * numpy.cos(a)
    image = vtkImageData()
    image.SetDimensions(count, count, count)
    image.SetSpacing(*[1.0 / (count - 1)] * 3)
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(order="F"), deep=True))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.2)
    contour.ComputeScalarsOff()
    contour.ComputeNormalsOff()
    writer = vtkPLYWriter()
    writer.SetInputConnection(contour.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()


def cpu_seconds(arguments):
    """Of a process; None if it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    failed = subprocess.run(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if failed.returncode != 0:
        return None
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def told(arguments):
    return json.loads(subprocess.run(arguments, stdout=subprocess.PIPE, check=True).stdout)


class Contest:
    def __init__(self, command, python, work):
        self.command, self.python, self.work = command, python, pathlib.Path(work)
        self.work.mkdir(parents=True, exist_ok=True)

    def arguments(self, method, model, result, triangles, vertices):
        if method == OURS:
            return [self.command, "reconstruct", model, result, "--remesh", "--vertices", str(vertices),
                    "--quiet", "--threads", "1"]
        python = self.python if method in PEERS else "/usr/bin/python3"
        return [python, __file__, "--make", method, model, result, str(triangles)]

    def row(self, method, model, part):
        info = told([self.command, "info", model, "--json"])
        triangles, vertices = round(part * info["triangles"]), max(4, round(part * info["vertices"]))
        result = str(self.work / f"{pathlib.Path(model).stem}_{method.replace(' ', '_')}_{part}.ply")
        pathlib.Path(result).unlink(missing_ok=True)
        seconds = cpu_seconds(self.arguments(method, model, result, triangles, vertices))
        if seconds is None or not pathlib.Path(result).exists():
            return f"| {100 * part:g} % | {method} | failed | | | | | | |"
        reading = 0.0
        if method != OURS:
            # Packages take long to be imported, which is no work.
            reading = cpu_seconds(self.arguments(method, model, str(self.work / "same.ply"), 0, 0)) or 0.0
        found = told([self.command, "info", result, "--json"])
        distance = told([self.command, "compare", model, result, "--json"])
        both = [distance["reference_to_result"], distance["result_to_reference"]]
        mean = sum(one["mean_percent"] for one in both) / 2
        most = max(one["maximum_percent"] for one in both)
        sound = found["edge_manifold"] and found["vertex_manifold"] and found["oriented"]
        loops = str(found["boundary_loops"]) if sound else "no manifold"
        return (
            f"| {100 * part:g} % | {method} | {found['vertices']} | {mean:.4f} | {most:.3f} "
            f"| {100 * found['regular_ratio']:.0f} | {found['triangle_quality']:.3f} | {loops} "
            f"| {max(0.0, seconds - reading) / (TRIES if method == PEERS[-1] else 1):.1f} |"
        )


def main():
    if sys.argv[1] == "--make":
        make(sys.argv[2], sys.argv[3], sys.argv[4], int(sys.argv[5]))
        return
    command, python, work, *models = sys.argv[1:]
    contest = Contest(command, python, work)
    models = models or [make_model(name, contest.work) for name in MODELS]
    isosurface = contest.work / "isosurface.ply"
    make_isosurface(isosurface)
    methods = [OURS, *VTK, *(PEERS if python else ())]
    for model in [*models, str(isosurface)]:
        info = told([command, "info", model, "--json"])
        print(
            f"\n{pathlib.Path(model).stem}: {info['vertices']} vertices, {info['triangles']} triangles, "
            f"{info['boundary_loops']} boundaries\n"
        )
        print("| left | by | vertices | mean | maximum | regular | quality | boundaries | CPU s |")
        print("|--:|---|--:|--:|--:|--:|--:|--:|--:|")
        for part in PARTS:
            for method in methods:
                print(contest.row(method, model, part), flush=True)


if __name__ == "__main__":
    main()
