// SPDX-License-Identifier: BSD-3-Clause
#include "MeshWriter.h"

#include "base/AtomicFile.h"
#include "ErrorCollector.h"
#include "FileExtension.h"
#include "WrittenMesh.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkOBJWriter.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSTLWriter.h"
#include "vtkXMLPolyDataWriter.h"

#include <functional>
#include <map>
#include <stdexcept>
#include <type_traits>

namespace
{
/** Writes the active scalars if they are colours. */
void SetColors(vtkPLYWriter* writer, vtkPolyData* mesh)
{
  vtkDataArray* scalars = mesh->GetPointData()->GetScalars();
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  if (scalars && scalars->GetName() && scalars->GetDataType() == VTK_UNSIGNED_CHAR &&
    (components == 3 || components == 4))
  {
    writer->SetArrayName(scalars->GetName());
    writer->SetEnableAlpha(components == 4);
  }
}

template <typename WriterT>
void WriteWith(vtkPolyData* mesh, const std::string& path)
{
  vtkNew<ErrorCollector> errors;
  vtkNew<WriterT> writer;
  errors->Observe(writer);
  if constexpr (std::is_same_v<WriterT, vtkSTLWriter>)
  {
    writer->SetFileTypeToBinary();
  }
  if constexpr (std::is_same_v<WriterT, vtkPLYWriter>)
  {
    SetColors(writer, mesh);
  }
  writer->SetFileName(path.c_str());
  writer->SetInputData(mesh);
  const bool written = writer->Write() == 1;
  if (errors->HasError())
  {
    throw std::runtime_error(errors->GetMessage());
  }
  if (!written || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw std::runtime_error(vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
}

/**
 * By way of a string, as VTK 9.2 crashes if the disk is full. Data in the elements, not appended
 * behind them: with the newer versions of expat, VTK 9.2 reads little appended data.
 */
void WriteVTP(vtkPolyData* mesh, const std::string& path)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary();
  writer->WriteToOutputStringOn();
  writer->SetInputData(mesh);
  if (writer->Write() != 1)
  {
    throw std::runtime_error(vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
  neuralmesh::writeText(writer->GetOutputString(), path);
}

using Write = std::function<void(vtkPolyData*, const std::string&)>;

const std::map<std::string, Write>& Writers()
{
  static const std::map<std::string, Write> writers{
    { ".vtp", WriteVTP },
    { ".ply", WriteWith<vtkPLYWriter> },
    { ".obj", WriteWith<vtkOBJWriter> },
    { ".stl", WriteWith<vtkSTLWriter> },
  };
  return writers;
}
}

void RequireWritableExtension(const std::string& path)
{
  if (Writers().count(FileExtension(path)) == 0)
  {
    throw std::runtime_error(path + ": unknown extension; writable are .vtp .ply .obj .stl");
  }
}

void WriteMesh(vtkPolyData* mesh, const std::string& path)
{
  RequireWritableExtension(path);
  const std::string extension = FileExtension(path);
  neuralmesh::writeAtomicFile(path,
    [&](const std::string& temporary)
    {
      Writers().at(extension)(mesh, temporary);
      if (extension != ".vtp" && !IsWrittenWhole(mesh, temporary))
      {
        throw std::runtime_error("not all of it could be written; is the disk full?");
      }
    });
}
