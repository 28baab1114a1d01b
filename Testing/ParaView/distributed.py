# SPDX-License-Identifier: BSD-3-Clause
"""Played by pvbatch on several processes: a cloud of which each has a part, and one mesh.

    distributed.py CASE DIVISION

A line of JSON tells what process 0 has found; every process exits with 0 unless something that it
looks after by itself is not as it should be.
"""

import hashlib
import json
import os
import sys
import traceback

# Before any filter is wrapped by GetClientSideObject().
import neuralmesh
import numpy
import support
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkParallelCore import vtkMultiProcessController

CONTROLLER = vtkMultiProcessController.GetGlobalController()
PROCESS, PROCESSES = CONTROLLER.GetLocalProcessId(), CONTROLLER.GetNumberOfProcesses()

STOPS = []  # the reasons that the other processes know


def torus(count):
    """Points of a torus with a little noise, the same on all processes."""
    random = numpy.random.default_rng(5)
    around, across = random.uniform(0.0, 2.0 * numpy.pi, (2, count))
    radius = 2.0 + 0.7 * numpy.cos(across)
    points = numpy.stack(
        [radius * numpy.cos(around), radius * numpy.sin(around), 0.7 * numpy.sin(across)], axis=1
    )
    return points + random.normal(0.0, 0.01, points.shape)


def torus_piece(around, across):
    """What this process has of a coarse mesh of the torus: every so many-th segment."""
    points, quads = vtkPoints(), vtkCellArray()
    for i in range(PROCESS, around, PROCESSES):
        for j in range(across):
            quads.InsertNextCell(4)
            for k, m in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                u, v = (2.0 * numpy.pi * (n % of) / of for n, of in ((k, around), (m, across)))
                radius = 2.0 + 0.7 * numpy.cos(v)
                place = radius * numpy.cos(u), radius * numpy.sin(u), 0.7 * numpy.sin(v)
                quads.InsertCellPoint(points.InsertNextPoint(place))
    corners = vtkPolyData()
    corners.SetPoints(points)
    corners.SetPolys(quads)
    # Its segments share no points: only their coordinates are the same.
    return corners


def owners_of(points, division):
    """For each point, the process that has it."""
    count = len(points)
    if division == "last":  # nothing where learning takes place
        return numpy.full(count, PROCESSES - 1)
    random = numpy.random.default_rng(9)
    if division == "shuffled":
        return random.integers(0, PROCESSES, count)
    if division == "uneven":  # one, three, five ... parts, and none on the second of several
        owners = numpy.sqrt(random.integers(0, PROCESSES**2, count)).astype(int)
        return numpy.where((owners == 1) & (PROCESSES > 2), 0, owners)
    raise ValueError(division)


def part_of(points, owners, reverse=False):
    """What this process has of the points, with data of many kinds."""
    mine = numpy.flatnonzero(owners == PROCESS)
    if reverse:
        mine = mine[::-1]
    data = vtkPolyData()
    if len(mine) == 0:
        return data
    own = numpy.ascontiguousarray(points[mine])
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(own, deep=True))
    data.SetPoints(vtk_points)
    arrays = {
        "Height": own[:, 2].copy(),
        "Place": own.astype(numpy.float32),
        "Color": numpy.clip(numpy.nan_to_num(128 + 40 * own), 0, 255).astype(numpy.uint8),
        "Side": (own[:, 0] > 0).astype(numpy.int64),
        "Trust": 1.0 + (mine % 7),
    }
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    label = vtkStringArray()
    label.SetName("Label")
    for side in own[:, 1] > 0:
        label.InsertNextValue("east & west" if side else "Süden")
    data.GetPointData().AddArray(label)
    data.GetPointData().SetActiveScalars("Height")
    return data


def mesh_of(data, function=None, **properties):
    """The proxy of a filter that has the data of this process as its input."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    return (function or simple.NeuralMesh)(Input=source, **properties)


def bytes_of(array):
    if array.IsA("vtkStringArray"):
        return "\0".join(array.GetValue(i) for i in range(array.GetNumberOfValues())).encode()
    return memoryview(array).tobytes()


def digest(data):
    """Of all that a mesh consists of, in hexadecimal."""
    total = hashlib.sha256()
    arrays = [data.GetPoints().GetData(), data.GetPolys().GetConnectivityArray()]
    for fields in (data.GetPointData(), data.GetFieldData()):
        arrays += [fields.GetAbstractArray(i) for i in range(fields.GetNumberOfArrays())]
    for array in arrays:
        total.update(f"{array.GetName()} {array.GetDataType()} ".encode())
        total.update(f"{array.GetNumberOfComponents()} {array.GetNumberOfTuples()} ".encode())
        total.update(bytes_of(array))
    scalars = data.GetPointData().GetScalars()
    total.update(scalars.GetName().encode() if scalars else b"")
    return total.hexdigest()


def found_in(mesh):
    """What is to be told of a mesh; on all processes but the first it must be empty."""
    mesh.UpdatePipeline()
    filter = mesh.GetClientSideObject()
    data = filter.GetOutputDataObject(0)
    if PROCESS > 0:
        assert data.GetNumberOfPoints() == 0 and data.GetNumberOfCells() == 0
        STOPS.append(filter.GetStopReason())
        return None
    fields = data.GetFieldData()
    return {
        "vertices": data.GetNumberOfPoints(),
        "stop": filter.GetStopReason(),
        "digest": digest(data) if data.GetNumberOfPoints() else "",
        "dropped": fields.GetArray("DroppedPoints").GetValue(0) if data.GetNumberOfPoints() else 0,
        "genus": fields.GetArray("Genus").GetValue(0) if fields.HasArray("Genus") else -2,
        "bytes": filter.GetMovedBytes(),
    }


def reconstruct(division):
    """All points and a selection of them, weighted, with points that cannot be used, and doubles."""
    points = torus(20000)
    points[:5] = numpy.nan
    points[100:160] = points[200:260]
    owners = owners_of(points, division)
    data = part_of(points, owners, reverse=division == "uneven")
    results = {}
    for name, properties in (
        ("all", {}),
        ("selected", {"MaximumPoints": 8000}),
        ("weighted", {"MaximumPoints": 8000, "WeightArray": "Trust", "CarryPointData": 0}),
    ):
        mesh = mesh_of(data, NumberOfVertices=500, **properties)
        results[name] = found_in(mesh)
    return results


def ensemble(division):
    """The ensemble, weighted, and the votes, which are on all processes."""
    points = torus(20000)
    data = part_of(points, owners_of(points, division))
    mesh = mesh_of(
        data, simple.NeuralMeshEnsemble, NumberOfVertices=1000, NumberOfMembers=3,
        VerticesPerMember=500, GridResolution=24, WeightArray="Trust",
    )
    result = found_in(mesh)
    votes = mesh.GetClientSideObject().GetVotes()
    assert votes.GetPointData().GetScalars().GetRange() == (0.0, 1.0)
    assert votes.GetSpacing()[0] != 1.0
    return result


def first_mesh(division):
    """Starting from a mesh that lies in pieces on all processes."""
    points = torus(20000)
    data = part_of(points, owners_of(points, division))
    first = simple.TrivialProducer()
    first.GetClientSideObject().SetOutput(torus_piece(24, 12))
    return found_in(mesh_of(data, FirstMesh=first, NumberOfVertices=1000, Start="Tetrahedron"))


def abort(process, ensemble=False):
    """A run that would take long is aborted by a process; the next one is as ever."""
    points = torus(50000)
    data = part_of(points, owners_of(points, "shuffled"))
    # Of the ensemble it is the members that take long.
    mesh = (
        mesh_of(
            data, simple.NeuralMeshEnsemble, NumberOfVertices=1000, NumberOfMembers=30,
            VerticesPerMember=2000,
        )
        if ensemble
        else mesh_of(data, NumberOfVertices=20000)
    )
    filter = mesh.GetClientSideObject()
    told = []

    def tell(caller, _event):
        told.append(caller.GetProgress())
        if PROCESS == int(process) and caller.GetProgress() > 0.2:
            caller.RemoveObserver(observer)
            caller.SetAbortExecute(1)

    observer = filter.AddObserver("ProgressEvent", tell)
    # With steps of its growth, which are not kept of an aborted run: all have to know that.
    mesh.GrowthAsTime = 1
    aborted = found_in(mesh)
    mesh.UpdatePipeline(3.0)
    mesh.GrowthAsTime = 0
    assert PROCESS == 0 or STOPS == ["cancelled"], STOPS
    assert any(0.0 < progress < 1.0 for progress in told), told
    assert filter.GetAbortExecute() == 0
    mesh.NumberOfVertices = 500
    if ensemble:
        mesh.NumberOfMembers = 1
    return {"aborted": aborted, "next": found_in(mesh)}


def not_finite_here(process):
    """The points of one process are not finite, or those of all processes if it is -1."""
    points = torus(20000)
    owners = owners_of(points, "shuffled")
    points[(owners == int(process)) | (int(process) < 0)] = numpy.nan
    return found_in(mesh_of(part_of(points, owners), NumberOfVertices=500))


def missing_array(name, process):
    """The array is missing in the part of one process."""
    points = torus(20000)
    data = part_of(points, owners_of(points, "shuffled"))
    if PROCESS == int(process):
        data.GetPointData().RemoveArray(name)
    mesh = mesh_of(data, NumberOfVertices=500, WeightArray="Trust")
    result = found_in(mesh)
    if PROCESS == 0:
        output = mesh.GetClientSideObject().GetOutputDataObject(0)
        result["arrays"] = [
            output.GetPointData().GetArrayName(i)
            for i in range(output.GetPointData().GetNumberOfArrays())
        ]
    return result


def nothing():
    """No process has points."""
    return found_in(mesh_of(vtkPolyData()))


if __name__ == "__main__":
    support.load_plugin()
    case, *arguments = sys.argv[1:]
    try:
        result = globals()[case](*arguments)
    except BaseException:
        # At once: an orderly end would wait for the others, which wait for this one.
        traceback.print_exc()
        os._exit(1)
    if PROCESS == 0:
        print("RESULT " + json.dumps(result), flush=True)
