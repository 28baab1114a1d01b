// SPDX-License-Identifier: BSD-3-Clause
#include "PointReader.h"

#include "ErrorCollector.h"
#include "FileExtension.h"
#include "PointTextReader.h"

#include "vtkExecutive.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkPLYReader.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>

namespace
{
template <typename ReaderT>
vtkSmartPointer<vtkPointSet> ReadWith(const std::string& path)
{
  vtkNew<ErrorCollector> errors;
  vtkNew<ReaderT> reader;
  errors->Observe(reader);
  errors->Observe(reader->GetExecutive());
  reader->SetFileName(path.c_str());
  reader->Update();
  if (errors->HasError())
  {
    throw std::runtime_error(path + ": " + errors->GetMessage());
  }
  auto* points = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
  if (!points)
  {
    throw std::runtime_error(path + ": this holds no point set");
  }
  return points;
}

using Read = std::function<vtkSmartPointer<vtkPointSet>(const std::string&)>;

const std::map<std::string, Read>& Readers()
{
  static const std::map<std::string, Read> readers{
    { ".ply", ReadWith<vtkPLYReader> },
    { ".vtp", ReadWith<vtkXMLPolyDataReader> },
    { ".vtk", ReadWith<vtkGenericDataObjectReader> },
    { ".vtu", ReadWith<vtkXMLUnstructuredGridReader> },
    { ".obj", ReadWith<vtkOBJReader> },
    { ".stl", ReadWith<vtkSTLReader> },
    { ".xyz", ReadPointText },
    { ".pts", ReadPointText },
    { ".txt", ReadPointText },
    { ".csv", ReadPointText },
  };
  return readers;
}

void RequireReadableFile(const std::string& path)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
  {
    throw std::runtime_error(path + ": there is no such file");
  }
  if (std::filesystem::is_directory(status))
  {
    throw std::runtime_error(path + ": this is a folder");
  }
  if (!std::ifstream(path))
  {
    throw std::runtime_error(path + ": cannot be opened for reading");
  }
}
}

vtkSmartPointer<vtkPointSet> ReadPoints(const std::string& path)
{
  RequireReadableFile(path);
  const auto reader = Readers().find(FileExtension(path));
  if (reader == Readers().end())
  {
    throw std::runtime_error(path +
      ": unknown extension; readable are .ply .vtp .vtk .vtu .obj "
      ".stl .xyz .pts .txt .csv");
  }
  return reader->second(path);
}
