# SPDX-License-Identifier: BSD-3-Clause
"""Clouds, and what tests ask of meshes."""

import os
import subprocess
import textwrap

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFeatureEdges

# Seconds in which a process that takes a few of them must have hung, however busy the machine is.
HANGING = 900


def sphere(count=2000, dtype=np.float64):
    """Points on the unit sphere, an array of shape (count, 3)."""
    points = np.random.default_rng(1).normal(size=(count, 3))
    return (points / np.linalg.norm(points, axis=1, keepdims=True)).astype(dtype)


def point_set(array):
    """A vtkPolyData with the points, made without the package, of 8-byte floats."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for point in array:
        points.InsertNextPoint(point)
    dataset = vtkPolyData()
    dataset.SetPoints(points)
    return dataset


def arrays_of(mesh):
    """The bytes of the points, the triangles and the point data of a mesh."""
    parts = [mesh.GetPoints().GetData(), mesh.GetPolys().GetConnectivityArray()]
    parts += [mesh.GetPointData().GetArray(i) for i in range(mesh.GetPointData().GetNumberOfArrays())]
    return [vtk_to_numpy(part).tobytes() for part in parts]


def coordinates(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData())


def stop_reason(mesh):
    return mesh.GetFieldData().GetAbstractArray("StopReason").GetValue(0)


def is_closed_manifold(mesh):
    """Whether every edge has two triangles."""
    edges = vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.FeatureEdgesOff()
    edges.Update()
    return mesh.GetNumberOfPolys() > 0 and edges.GetOutput().GetNumberOfCells() == 0


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
