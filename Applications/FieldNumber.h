// SPDX-License-Identifier: BSD-3-Clause
#ifndef FieldNumber_h
#define FieldNumber_h

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"

/** The number that the field data of a mesh has under that name, which must be there. */
inline double FieldNumber(vtkPolyData* mesh, const char* name)
{
  return mesh->GetFieldData()->GetArray(name)->GetTuple1(0);
}

#endif
