# SPDX-License-Identifier: BSD-3-Clause
"""Played by pvbatch on several processes: a line of the table of moved_bytes.sh."""

import sys

# Before any filter is wrapped by GetClientSideObject().
import neuralmesh
import numpy
import support
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkParallelCore import vtkMultiProcessController

SELECTED = 200000


def sphere(count, seed):
    """Points of a sphere in single precision, with a colour each."""
    random = numpy.random.default_rng(seed)
    points = random.normal(size=(count, 3)).astype(numpy.float32)
    points /= numpy.linalg.norm(points, axis=1, keepdims=True)
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    colors = numpy_to_vtk((127 + 127 * points).astype(numpy.uint8), deep=True)
    colors.SetName("Color")
    data.GetPointData().AddArray(colors)
    return data


controller = vtkMultiProcessController.GetGlobalController()
process, processes = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
millions = float(sys.argv[1])
count = int(millions * 1e6)
support.load_plugin()
source = simple.TrivialProducer()
source.GetClientSideObject().SetOutput(sphere(count // processes, process))
mesh = simple.NeuralMesh(Input=source, NumberOfVertices=2000, MaximumPoints=SELECTED)
mesh.UpdatePipeline()
if process == 0:
    moved = mesh.GetClientSideObject().GetMovedBytes()
    print(f"{millions:14g} | {processes:9} | {SELECTED:15} | {moved:11} | {moved / count:.3f}",
          flush=True)
