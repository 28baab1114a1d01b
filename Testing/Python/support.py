# SPDX-License-Identifier: BSD-3-Clause
"""Clouds, and what tests ask of meshes."""

import os
import subprocess
import textwrap

import numpy as np

# VTK is imported where it is needed: what pip installs is tested without, too.
# Seconds in which a process that takes a few of them must have hung, however busy the machine is.
HANGING = 900


def sphere(count=2000, dtype=np.float64):
    """Points on the unit sphere, an array of shape (count, 3)."""
    points = np.random.default_rng(1).normal(size=(count, 3))
    return (points / np.linalg.norm(points, axis=1, keepdims=True)).astype(dtype)


def point_set(array):
    """A vtkPolyData with the points, made without the package, of 8-byte floats."""
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    points = vtkPoints()
    points.SetDataTypeToDouble()
    for point in array:
        points.InsertNextPoint(point)
    dataset = vtkPolyData()
    dataset.SetPoints(points)
    return dataset


def is_array_mesh(mesh):
    """Whether it is a neuralmesh.Mesh, and not of VTK."""
    return not hasattr(mesh, "GetPointData")


def arrays_of(mesh):
    """The bytes of the points, the triangles and the point data of a mesh."""
    if is_array_mesh(mesh):
        data = [mesh.point_data[name] for name in sorted(mesh.point_data)]
        return [np.ascontiguousarray(part).tobytes() for part in (mesh.points, mesh.triangles, *data)]
    from vtkmodules.util.numpy_support import vtk_to_numpy

    parts = [mesh.GetPoints().GetData(), mesh.GetPolys().GetConnectivityArray()]
    data = mesh.GetPointData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    parts += sorted(arrays, key=lambda array: array.GetName())
    return [vtk_to_numpy(part).tobytes() for part in parts]


def coordinates(mesh):
    if is_array_mesh(mesh):
        return mesh.points
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(mesh.GetPoints().GetData())


def triangles(mesh):
    """The points of each triangle, of shape (T, 3)."""
    if is_array_mesh(mesh):
        return mesh.triangles
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def field(mesh, name):
    """The first value of an array of the field data."""
    if not is_array_mesh(mesh):
        return mesh.GetFieldData().GetAbstractArray(name).GetValue(0)
    value = mesh.field_data[name]
    return value[0] if isinstance(value, list) else value


def stop_reason(mesh):
    return field(mesh, "StopReason")


def is_closed_manifold(mesh):
    """Whether every edge has two triangles."""
    corners = triangles(mesh)
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    _, counts = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    return len(corners) > 0 and bool((counts == 2).all())


def start_script(script):
    """Start the script in a process of the interpreter under test."""
    return subprocess.Popen(
        [os.environ["NEURALMESH_TEST_PYTHON"], "-c", textwrap.dedent(script)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=os.path.dirname(__file__),
        # In pvpython print(flush=True) alone leaves the text in a buffer until the end.
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )


def run_script(script):
    """Run the script so; its output, its errors and its exit status."""
    process = start_script(script)
    output, errors = process.communicate(timeout=HANGING)
    return output, errors, process.returncode
