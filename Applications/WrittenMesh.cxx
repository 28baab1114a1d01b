// SPDX-License-Identifier: BSD-3-Clause
#include "WrittenMesh.h"

#include "FileExtension.h"
#include "PointReader.h"

#include "vtkCell.h"
#include "vtkPolyData.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace
{
std::uintmax_t SizeOfType(const std::string& type)
{
  return type == "double" ? 8 : type == "float" || type == "int" ? 4 : 1;
}

/** The size that a binary .ply of triangles must have by its own header; 0 if that has no end. */
std::uintmax_t ExpectedSizeOfPLY(const std::string& path)
{
  constexpr std::uintmax_t corners = 3;
  std::ifstream file(path, std::ios::binary);
  std::uintmax_t size = 0, count = 0;
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    std::string word, type;
    words >> word >> type;
    if (word == "element")
    {
      words >> count;
    }
    else if (word == "property" && type == "list")
    {
      std::string countType, indexType;
      words >> countType >> indexType;
      size += count * (SizeOfType(countType) + corners * SizeOfType(indexType));
    }
    else if (word == "property")
    {
      size += count * SizeOfType(type);
    }
    else if (word == "end_header")
    {
      return size + static_cast<std::uintmax_t>(file.tellg());
    }
  }
  return 0;
}

std::uintmax_t ExpectedSizeOfSTL(vtkPolyData* mesh)
{
  constexpr std::uintmax_t header = 84, triangle = 50;
  return header + triangle * static_cast<std::uintmax_t>(mesh->GetNumberOfPolys());
}

bool ReadsAsWritten(vtkPolyData* mesh, const std::string& path)
{
  const auto written = ReadPoints(path);
  const vtkIdType count = mesh->GetNumberOfCells();
  if (written->GetNumberOfPoints() != mesh->GetNumberOfPoints() ||
    written->GetNumberOfCells() != count)
  {
    return false;
  }
  vtkIdList* last = mesh->GetCell(count - 1)->GetPointIds();
  vtkIdList* writtenLast = written->GetCell(count - 1)->GetPointIds();
  return writtenLast->GetNumberOfIds() == 3 && writtenLast->GetId(0) == last->GetId(0) &&
    writtenLast->GetId(1) == last->GetId(1) && writtenLast->GetId(2) == last->GetId(2);
}
}

bool IsWrittenWhole(vtkPolyData* mesh, const std::string& path)
{
  const std::string extension = FileExtension(path);
  if (extension == ".ply")
  {
    return std::filesystem::file_size(path) == ExpectedSizeOfPLY(path);
  }
  if (extension == ".stl")
  {
    return std::filesystem::file_size(path) == ExpectedSizeOfSTL(mesh);
  }
  return ReadsAsWritten(mesh, path);
}
