# SPDX-License-Identifier: BSD-3-Clause
"""What the classes for pipelines need of VTK, of the package that the others are of."""

from __future__ import annotations

from .._kinds import vtk_package
from .vtk_arrays import vtk_module

PACKAGE = vtk_package()

_core = vtk_module(PACKAGE, "vtkCommonCore")
_data = vtk_module(PACKAGE, "vtkCommonDataModel")
_execution = vtk_module(PACKAGE, "vtkCommonExecutionModel")

VTKPythonAlgorithmBase = vtk_module(PACKAGE, "util.vtkAlgorithm").VTKPythonAlgorithmBase
vtkAlgorithm = _execution.vtkAlgorithm
vtkCommand = _core.vtkCommand
vtkCompositeDataSet = _data.vtkCompositeDataSet
vtkDataObject = _data.vtkDataObject
vtkDemandDrivenPipeline = _execution.vtkDemandDrivenPipeline
vtkExecutive = _execution.vtkExecutive
vtkImageData = _data.vtkImageData
vtkLogger = _core.vtkLogger
vtkMultiBlockDataSet = _data.vtkMultiBlockDataSet
vtkObject = _core.vtkObject
vtkOutputWindow = _core.vtkOutputWindow
vtkPolyData = _data.vtkPolyData
vtkStreamingDemandDrivenPipeline = _execution.vtkStreamingDemandDrivenPipeline
vtkTable = _data.vtkTable
