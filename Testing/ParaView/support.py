# SPDX-License-Identifier: BSD-3-Clause
"""The plugin, and shapes to try it on."""

import importlib
import os
import tempfile

import paraview
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

# Seconds in which a process that takes a few of them must have hung, however busy the machine is.
HANGING = 900

CONFIGURATION = os.environ["NEURALMESH_PLUGIN_CONFIG"]
# The compiled one, or that in Python.
PLUGIN = os.environ.get("NEURALMESH_PLUGIN") or os.path.join(
    os.path.dirname(CONFIGURATION), "NeuralMesh", "NeuralMesh.so"
)

IS_PYTHON = PLUGIN.endswith(".py")

paraview.options.batch = True


def class_of(name):
    """The class of the plugin that is tested."""
    if IS_PYTHON:
        return getattr(importlib.import_module("neuralmesh.engine.paraview_filters"), name)
    return getattr(importlib.import_module("neuralmesh"), name)


def load_plugin():
    """Load it where the server runs and, where that is elsewhere, here."""
    if servermanager.ActiveConnection.IsRemote():
        simple.LoadPlugin(PLUGIN, remote=True, ns=vars(simple))
    simple.LoadPlugin(PLUGIN, remote=False, ns=vars(simple))


def scan(points=20000, **properties):
    """A scan of a sphere of radius 1."""
    sphere = simple.Sphere(Radius=1.0, ThetaResolution=64, PhiResolution=64)
    return simple.NeuralMeshScan(Input=sphere, NumberOfPoints=points, **properties)


def information_of(source, port=0):
    """What ParaView knows of an output, brought up to date."""
    source.UpdatePipeline()
    return simple.OutputPort(source, port).GetDataInformation()


def information_at(source, time):
    """What ParaView knows of the mesh at this time."""
    source.UpdatePipeline(time)
    return source.GetDataInformation()


def fetch(source, port=0):
    """The data of an output."""
    return servermanager.Fetch(source, idx=port)


def field_value(source, name):
    """The one value of an array of the field data."""
    return fetch(source).GetFieldData().GetAbstractArray(name).GetValue(0)


def points_of(source):
    """The coordinates, as bytes."""
    return memoryview(fetch(source).GetPoints().GetData()).tobytes()


def covered(view):
    """Which part of the view is not background."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "view.png")
        simple.SaveScreenshot(path, view, ImageResolution=[200, 200])
        reader = vtkPNGReader()
        reader.SetFileName(path)
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).copy()
    return (pixels != pixels[0]).any(axis=1).mean()


def delete_views():
    """Views that are left to the end of the process end it with an error of X."""
    for view in simple.GetViews():
        simple.Delete(view)
