// SPDX-License-Identifier: BSD-3-Clause
#include "VTKThreads.h"

#include "vtkSMPTools.h"

void SetNumberOfVTKThreads(int count) { vtkSMPTools::Initialize(count); }
