// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshFileSampler.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"

#include <iostream>

/// What blocks of C++ in the documentation use without saying where it comes from. The files are
/// those of givens.py.
struct BlockGivens
{
  vtkSmartPointer<vtkXMLPolyDataReader> reader;
  vtkSmartPointer<vtkPLYReader> coarse;
  vtkSmartPointer<vtkPLYReader> scan;
  vtkSmartPointer<vtkNeuralMesh> mesh;

  static BlockGivens make()
  {
    BlockGivens givens;
    givens.reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
    givens.reader->SetFileName("scan.vtp");
    givens.coarse = vtkSmartPointer<vtkPLYReader>::New();
    givens.coarse->SetFileName("coarse.ply");
    givens.scan = vtkSmartPointer<vtkPLYReader>::New();
    givens.scan->SetFileName("scan.ply");
    givens.mesh = vtkSmartPointer<vtkNeuralMesh>::New();
    return givens;
  }
};
