// SPDX-License-Identifier: BSD-3-Clause
#include "PointReader.h"

#include "ErrorCollector.h"
#include "FileExtension.h"
#include "ReadingGuard.h"
#include "SoundCells.h"

#include "vtkNeuralMeshPLYReader.h"
#include "vtkNeuralMeshReader.h"
#include "vtkNeuralMeshWriter.h"

#include "vtkGenericDataObjectReader.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkOutputWindow.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <stdexcept>

namespace
{
/** Runs a reader, whatever the file does to it. */
void Update(vtkAlgorithm* reader, const std::string& path, ErrorCollector* errors)
{
  errors->Observe(reader);
  errors->Observe(vtkOutputWindow::GetInstance());
  bool done = true;
  try
  {
    const ReadingGuard guard(path);
    reader->Update();
  }
  catch (const std::exception&) // bad_alloc, length_error, ...
  {
    done = false;
  }
  vtkOutputWindow::GetInstance()->RemoveObserver(errors);
  if (!done || errors->HasError())
  {
    const std::string& message = errors->GetMessage();
    throw std::runtime_error(
      done && !message.empty() ? path + ": " + message : ReadingGuard::Message(path));
  }
}

template <typename ReaderT>
vtkSmartPointer<vtkPointSet> ReadWith(const std::string& path)
{
  vtkNew<ErrorCollector> errors;
  vtkNew<ReaderT> reader;
  errors->DeferWarnings();
  reader->SetFileName(path.c_str());
  Update(reader, path, errors);
  errors->ShowDeferredWarnings();
  auto* points = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
  if (!points)
  {
    throw std::runtime_error(path + ": this holds no point set");
  }
  if (!HasSoundCells(points))
  {
    throw std::runtime_error(
      path + ": damaged: there are cells without corners, or with points that do not exist");
  }
  return points;
}

/** Throws std::runtime_error unless `end` stands in the last bytes of a file. */
void RequireEnd(const std::string& path, const std::string& end)
{
  constexpr std::streamoff bytes = 1024;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(size - bytes, 0));
  const std::string last(std::istreambuf_iterator<char>(file), {});
  if (last.find(end) == std::string::npos)
  {
    throw std::runtime_error(path + ": damaged: it ends before its " + end);
  }
}

/** Not all versions of VTK notice that data which is appended ends too soon. */
template <typename ReaderT>
vtkSmartPointer<vtkPointSet> ReadXML(const std::string& path)
{
  RequireEnd(path, "</VTKFile>");
  return ReadWith<ReaderT>(path);
}

/** VTK takes an .stl that ends too soon for a shorter one. */
vtkSmartPointer<vtkPointSet> ReadSTL(const std::string& path)
{
  constexpr std::size_t titleSize = 80, headerSize = 84, triangleSize = 50;
  std::string header(headerSize, ' ');
  std::ifstream(path, std::ios::binary).read(header.data(), headerSize);
  const bool isText = header.find('\0') == std::string::npos;
  std::uintmax_t triangles = 0;
  for (std::size_t i = headerSize; i-- > titleSize;)
  {
    triangles = 256 * triangles + static_cast<unsigned char>(header[i]);
  }
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!isText && !error && size < headerSize + triangleSize * triangles)
  {
    throw std::runtime_error(path + ": damaged: it ends before its last triangle");
  }
  if (isText)
  {
    RequireEnd(path, "endsolid");
  }
  return ReadWith<vtkSTLReader>(path);
}

/** What VTK has no reader for. */
vtkSmartPointer<vtkPointSet> ReadOther(const std::string& path)
{
  vtkNew<ErrorCollector> errors;
  vtkNew<vtkNeuralMeshReader> reader;
  reader->SetFileName(path.c_str());
  errors->Observe(reader);
  reader->Update();
  if (errors->HasError())
  {
    throw std::runtime_error(errors->GetMessage());
  }
  return reader->GetOutput();
}

using Read = std::function<vtkSmartPointer<vtkPointSet>(const std::string&)>;

const std::map<std::string, Read>& Readers()
{
  static const std::map<std::string, Read> readers{
    { ".ply", ReadWith<vtkNeuralMeshPLYReader> },
    { ".vtp", ReadXML<vtkXMLPolyDataReader> },
    { ".vtk", ReadWith<vtkGenericDataObjectReader> },
    { ".vtu", ReadXML<vtkXMLUnstructuredGridReader> },
    { ".obj", ReadWith<vtkOBJReader> },
    { ".stl", ReadSTL },
    { ".off", ReadOther },
    { ".pcd", ReadOther },
    { ".ptx", ReadOther },
    { ".pwn", ReadOther },
    { ".xyz", ReadOther },
    { ".pts", ReadOther },
    { ".txt", ReadOther },
    { ".csv", ReadOther },
    { ".asc", ReadOther },
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
  if (!std::filesystem::is_regular_file(status))
  {
    throw std::runtime_error(path + ": this is no regular file");
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
    const std::string conversion = vtkNeuralMeshReader::GetConversion(path.c_str());
    throw std::runtime_error(path + ": " +
      (conversion.empty()
          ? "unknown extension; readable are .ply .vtp .vtk .vtu .obj .stl .off .pcd "
            ".ptx .pwn .xyz .pts .txt .csv .asc"
          : conversion));
  }
  auto points = reader->second(path);
  vtkNeuralMeshWriter::UndoShift(path.c_str(), points);
  return points;
}
