// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshFile.h"

#include "base/AtomicFile.h"
#include "cloud/PlyContents.h"
#include "file/FileExtension.h"
#include "file/WriteMesh.h"
#include "vtkFileContents.h"
#include "vtkInnerAlgorithm.h"
#include "vtkShift.h"

#include "vtkCellArray.h"
#include "vtkErrorCode.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkOBJWriter.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSTLWriter.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace
{
/** Bytes. */
constexpr std::size_t TitleOfSTL = 80;
/** A last line that is longer is no comment of ours. */
constexpr std::streamoff LongestLine = 4096;

[[noreturn]] void ThrowNotWhole()
{
  throw std::runtime_error("not all of it could be written; is the disk full?");
}

template <typename WriterT>
void WriteWith(WriterT* writer, vtkPolyData* mesh)
{
  writer->SetInputData(mesh);
  try
  {
    vtkInnerAlgorithm::Update(writer);
  }
  catch (const std::exception&)
  {
    // VTK's words name a temporary file.
    if (writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError)
    {
      ThrowNotWhole();
    }
    throw;
  }
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw std::runtime_error(vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
}

/** As it is written into files; empty if there is none. */
std::string CommentOfShift(vtkPolyData* mesh)
{
  const Eigen::Vector3d shift = vtkShift::Stored(mesh);
  return shift.isZero(0.0) ? "" : neuralmesh::commentOfShift(shift);
}

/**
 * By way of a string, as VTK 9.2 crashes if the disk is full. Data in the elements, not appended
 * behind them: with the newer versions of expat, VTK 9.2 reads little appended data.
 */
void WriteVTP(vtkPolyData* mesh, const std::string& path, bool)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary();
  writer->WriteToOutputStringOn();
  WriteWith(writer.Get(), mesh);
  neuralmesh::writeText(writer->GetOutputString(), path);
}

/** Legacy, binary; by way of a string, too. */
void WriteVTK(vtkPolyData* mesh, const std::string& path, bool)
{
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetHeader("NeuralMesh");
  writer->SetFileTypeToBinary();
  writer->WriteToOutputStringOn();
  WriteWith(writer.Get(), mesh);
  neuralmesh::writeText(writer->GetOutputStdString(), path);
}

/** What VTK does not write, or not whole. */
void WriteOther(vtkPolyData* mesh, const std::string& path, bool hasDoubles)
{
  neuralmesh::writeText(
    neuralmesh::meshBytesOf(vtkMeshFile::Extension(path), vtkFileContents::Of(mesh, hasDoubles)),
    path);
}

void RequireWholePLY(const std::string& path)
{
  try
  {
    neuralmesh::readPlyContents(path);
  }
  catch (const std::runtime_error&)
  {
    ThrowNotWhole();
  }
}

void WritePLY(vtkPolyData* mesh, const std::string& path, bool hasDoubles)
{
  vtkNew<vtkPLYWriter> writer;
  vtkDataArray* scalars = mesh->GetPointData()->GetScalars();
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  if (scalars && scalars->GetName() && scalars->GetDataType() == VTK_UNSIGNED_CHAR &&
    (components == 3 || components == 4))
  {
    writer->SetArrayName(scalars->GetName());
    writer->SetEnableAlpha(components == 4);
  }
  if (const std::string comment = CommentOfShift(mesh); !comment.empty())
  {
    writer->AddComment(comment);
  }
  writer->SetFileName(path.c_str());
  WriteWith(writer.Get(), mesh);
  RequireWholePLY(path);
  if (hasDoubles)
  {
    std::vector<double> coordinates(3 * static_cast<std::size_t>(mesh->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      mesh->GetPoint(i, &coordinates[3 * static_cast<std::size_t>(i)]);
    }
    std::ostringstream floats;
    floats << std::ifstream(path, std::ios::binary).rdbuf();
    neuralmesh::writeText(neuralmesh::withDoubles(floats.str(), coordinates), path);
    RequireWholePLY(path);
  }
}

bool ReadsAsWritten(vtkPolyData* mesh, const std::string& path)
{
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(path.c_str());
  vtkInnerAlgorithm::Update(reader);
  vtkPolyData* written = reader->GetOutput();
  const vtkIdType count = mesh->GetNumberOfPolys();
  if (written->GetNumberOfPoints() != mesh->GetNumberOfPoints() ||
    written->GetNumberOfPolys() != count)
  {
    return false;
  }
  vtkNew<vtkIdList> last, writtenLast;
  if (count > 0)
  {
    mesh->GetPolys()->GetCellAtId(count - 1, last);
    written->GetPolys()->GetCellAtId(count - 1, writtenLast);
  }
  return std::equal(last->begin(), last->end(), writtenLast->begin(), writtenLast->end());
}

void WriteOBJ(vtkPolyData* mesh, const std::string& path, bool)
{
  vtkNew<vtkOBJWriter> writer;
  writer->SetFileName(path.c_str());
  WriteWith(writer.Get(), mesh);
  if (!ReadsAsWritten(mesh, path))
  {
    ThrowNotWhole();
  }
  if (const std::string comment = CommentOfShift(mesh); !comment.empty())
  {
    std::ofstream file(path, std::ios::app | std::ios::binary);
    file << "# " << comment << "\n";
    file.close();
    if (!file)
    {
      ThrowNotWhole();
    }
  }
}

void WriteSTL(vtkPolyData* mesh, const std::string& path, bool)
{
  constexpr std::uintmax_t header = TitleOfSTL + 4, triangle = 50;
  vtkNew<vtkSTLWriter> writer;
  writer->SetFileTypeToBinary();
  if (const std::string comment = CommentOfShift(mesh); !comment.empty())
  {
    if (comment.size() > TitleOfSTL)
    {
      throw std::runtime_error("the shift is too long for the title of an .stl");
    }
    writer->SetHeader(comment.c_str());
  }
  writer->SetFileName(path.c_str());
  WriteWith(writer.Get(), mesh);
  if (std::filesystem::file_size(path) !=
    header + triangle * static_cast<std::uintmax_t>(mesh->GetNumberOfPolys()))
  {
    ThrowNotWhole();
  }
}

using WriteFunction = void (*)(vtkPolyData*, const std::string&, bool);

const std::map<std::string, WriteFunction>& Writers()
{
  static const std::map<std::string, WriteFunction> writers{
    { ".vtp", WriteVTP },
    { ".ply", WritePLY },
    { ".obj", WriteOBJ },
    { ".stl", WriteSTL },
    { ".glb", WriteOther },
    { ".off", WriteOther },
    { ".vtk", WriteVTK },
  };
  return writers;
}
}

std::string vtkMeshFile::Extension(const std::string& path)
{
  return neuralmesh::fileExtension(path);
}

bool vtkMeshFile::IsKnown(const std::string& extension) { return Writers().count(extension) > 0; }

bool vtkMeshFile::HasOnlyFloats(const std::string& extension)
{
  return neuralmesh::hasOnlyFloats(extension);
}

void vtkMeshFile::Write(vtkPolyData* mesh, const std::string& path, bool hasDoubles)
{
  Writers().at(Extension(path))(mesh, path, hasDoubles);
}

Eigen::Vector3d vtkMeshFile::NotedShift(const std::string& path)
{
  const std::string extension = Extension(path);
  std::string note;
  if (extension == ".stl")
  {
    note.resize(TitleOfSTL);
    std::ifstream(path, std::ios::binary)
      .read(note.data(), static_cast<std::streamsize>(TitleOfSTL));
    note.resize(std::min(note.find('\0'), note.size()));
  }
  else if (extension == ".obj")
  {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    file.seekg(std::max<std::streamoff>(file.tellg() - LongestLine, 0));
    for (std::string line; std::getline(file, line);)
    {
      note = line.starts_with("# ") ? line.substr(2) : "";
    }
  }
  return neuralmesh::shiftOfComment(note).value_or(Eigen::Vector3d::Zero());
}
