// SPDX-License-Identifier: BSD-3-Clause
// Files as the command reads them; the first byte says of which kind. What our own readers know is read
// here, though the command leaves some of it to VTK. VTK's readers may end the process, as they may end the command: each file of theirs is read in a process
// of its own, which must end with status 0 or, after one line on stderr, 1.
#include "file/ReadFile.h"
#include "file/WriteMesh.h"
#include "FuzzTarget.h"
#include "MeshReader.h"
#include "PointReader.h"

#include "vtkCell.h"
#include "vtkNew.h"
#include "vtkOBJWriter.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSphereSource.h"
#include "vtkSTLWriter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridWriter.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

/** With the address sanitizer, too, what VTK does wrong is to end in a signal, as for the command. */
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "abort_on_error=1"; }

/** Of the sanitizers; nothing without them. */
extern "C" void __sanitizer_set_death_callback(void (*)()) __attribute__((weak));

namespace
{
using Bytes = std::vector<std::uint8_t>;

constexpr std::array Extensions{ ".xyz", ".off", ".pcd", ".ptx", ".pwn", ".ply", ".vtp", ".vtk",
  ".vtu", ".obj", ".stl" };
constexpr std::size_t Text = 0;
/** Those before are read by no reader of VTK. */
constexpr std::size_t FirstOfVTK = 5;

/** What a process of our own has said counts as covered for libFuzzer, which does not see into it. */
__attribute__((section("__libfuzzer_extra_counters"))) std::array<std::uint8_t, 4096> Outcomes;

void Require(bool holds, const std::string& promise)
{
  if (!holds)
  {
    std::fprintf(stderr, "broken promise: %s\n", promise.c_str());
    std::abort();
  }
}

/** A folder for the files of this process, gone at its end. */
struct OwnFolder
{
  OwnFolder()
    : Path(
        std::filesystem::temp_directory_path() / ("neuralmesh-fuzzing-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(this->Path);
  }
  ~OwnFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  const std::filesystem::path Path;
};

const std::filesystem::path& Folder()
{
  static const OwnFolder folder;
  return folder.Path;
}

void RequireSoundCells(vtkPointSet* points)
{
  for (vtkIdType i = 0; i < points->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> ids;
    points->GetCellPoints(i, ids);
    for (const vtkIdType id : *ids)
    {
      Require(id >= 0 && id < points->GetNumberOfPoints(), "cells have points that exist");
    }
  }
}

/** Reads a file without VTK. */
void ReadContents(const std::string& path)
{
  try
  {
    const neuralmesh::FileContents contents = neuralmesh::readFile(path);
    const std::size_t points = contents.size();
    for (const auto& triangle : contents.triangles)
    {
      Require(*std::max_element(triangle.begin(), triangle.end()) < points,
        "triangles have points that exist");
    }
    Require(contents.normals.empty() || contents.normals.size() == points,
      "each point has a normal, or none has");
    Require(contents.colors.empty() || contents.colors.size() == points,
      "each point has a colour, or none has");
    Require(contents.views.empty() || contents.views.size() == points,
      "each point has a view, or none has");
  }
  catch (const std::runtime_error& error)
  {
    const std::string message = error.what();
    Require(message.starts_with(path), "a message names its file");
    Require(message.find('\n') == std::string::npos, "a message is one line");
  }
}

/** Reads a file of points and, if it can be one, of a mesh; true if there was no error. In a process
 * apart, tells the error as the command does. */
bool Read(const std::string& path, bool isApart)
{
  try
  {
    RequireSoundCells(ReadPoints(path));
    static constexpr std::array meshes{ ".off", ".ply", ".vtp", ".vtk", ".obj", ".stl" };
    if (std::any_of(meshes.begin(), meshes.end(),
          [&path](const char* extension) { return path.ends_with(extension); }))
    {
      RequireSoundCells(ReadMesh(path));
    }
    return true;
  }
  catch (const std::runtime_error& error)
  {
    const std::string message = error.what();
    Require(message.starts_with(path), "a message names its file");
    Require(message.find('\n') == std::string::npos, "a message is one line");
    if (isApart)
    {
      std::cerr << "neuralmesh: " << message << std::endl;
    }
    return false;
  }
}

/** A system call, once more where a signal has cut it short: libFuzzer's clock sends some. */
template <typename Call>
auto Whole(const Call& call)
{
  auto result = call();
  while (result < 0 && errno == EINTR)
  {
    result = call();
  }
  return result;
}

/** Has a process read a file; what it writes to stderr, and its status as by waitpid(). */
std::pair<std::string, int> ReadApart(const std::string& path)
{
  std::array<int, 2> ends{};
  Require(pipe(ends.data()) == 0, "there are pipes");
  const pid_t child = fork();
  Require(child >= 0, "there are processes");
  if (child == 0)
  {
    // What VTK does wrong and the command survives is no find.
    if (__sanitizer_set_death_callback)
    {
      __sanitizer_set_death_callback(nullptr);
    }
    dup2(ends[1], STDERR_FILENO);
    _exit(Read(path, true) ? 0 : 1);
  }
  close(ends[1]);
  std::string said;
  std::array<char, 4096> part{};
  for (ssize_t count = 0;
       (count = Whole([&] { return read(ends[0], part.data(), part.size()); })) > 0;)
  {
    said.append(part.data(), std::size_t(count));
  }
  close(ends[0]);
  int status = 0;
  Whole([&] { return waitpid(child, &status, 0); });
  return { said, status };
}

void RequireCommandsManners(const std::string& path)
{
  const auto [said, status] = ReadApart(path);
  std::size_t errors = 0;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
  {
    const bool isWarning = line.starts_with("neuralmesh: warning: ");
    Require(isWarning || line.starts_with("neuralmesh: " + path),
      "every line is a warning or names the file: " + line);
    errors += isWarning ? 0 : 1;
  }
  Require(WIFEXITED(status) && WEXITSTATUS(status) <= 1, "reading ends with status 0 or 1");
  Require(errors == std::size_t(WEXITSTATUS(status)), "there is one line for an error: " + said);
  std::string kind = path;
  std::copy_if(
    said.begin(), said.end(), std::back_inserter(kind), [](char c) { return c < '0' || c > '9'; });
  Outcomes[std::hash<std::string>()(kind) % Outcomes.size()] = 1;
}

Bytes Seed(std::size_t kind, const std::string& content)
{
  Bytes seed(1 + content.size(), static_cast<std::uint8_t>(kind));
  std::copy(content.begin(), content.end(), seed.begin() + 1);
  return seed;
}

template <typename WriterT, typename PrepareT>
Bytes WriteWith(const std::string& extension, vtkDataObject* data, PrepareT prepare)
{
  const std::filesystem::path path = Folder() / ("seed" + extension);
  vtkNew<WriterT> writer;
  prepare(writer.Get());
  writer->SetFileName(path.c_str());
  writer->SetInputDataObject(data);
  writer->Write();
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  const auto kind = std::find(Extensions.begin(), Extensions.end(), extension);
  return Seed(static_cast<std::size_t>(kind - Extensions.begin()), bytes.str());
}

/** Small files of the formats that VTK does not know, by their extensions. */
std::vector<std::pair<std::string, std::string>> ScannerFiles()
{
  neuralmesh::FileContents mesh;
  for (const Eigen::Vector3d& point :
    { Eigen::Vector3d(0.0, 0.0, 0.0), { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 } })
  {
    mesh.addPoint(point);
    mesh.colors.push_back({ 1, 2, 3 });
  }
  mesh.triangles.push_back({ 0, 1, 2 });
  const std::string header = "VERSION 0.7\nFIELDS x y z rgb _ ring\nSIZE 4 4 4 4 1 2\n"
                             "TYPE F F F F U U\nCOUNT 1 1 1 1 2 1\nWIDTH 2\nHEIGHT 1\n"
                             "VIEWPOINT 0 0 5 1 0 0 0\nPOINTS 2\nDATA ";
  const std::string scan = "2\n1\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 9 1\n"
                           "0 0 0 0.5 0 0 0\n1 2 3 0.25 9 8 7\n";
  // Two runs of literals: 40 bytes in 42.
  std::string packed("\x2a\0\0\0\x28\0\0\0\x1f", 9);
  packed += std::string(32, '1') + '\x07' + std::string(8, '2');
  return { { ".off", neuralmesh::meshBytesOf(".off", mesh) },
    { ".off", "NOFF 1 0 0\n1 2 3 0 0 1\n" },
    { ".pcd", header + "ascii\n1 2 3 4e6 0 0 7\nnan nan nan 0 0 0 7\n" },
    { ".pcd", header + "binary\n" + std::string(40, '1') },
    { ".pcd", header + "binary_compressed\n" + packed }, { ".ptx", scan + scan },
    { ".pwn", "1\n1 2 3\n0 0 1\n" }, { ".pwn", "1 2 3 0 0 1\n" } };
}
}

std::vector<Bytes> neuralmesh::testing::fuzzSeeds()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(4);
  sphere->SetPhiResolution(3);
  sphere->Update();
  vtkPolyData* mesh = sphere->GetOutput();
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(mesh->GetPoints());
  grid->SetCells(VTK_TRIANGLE, mesh->GetPolys());
  grid->GetPointData()->SetNormals(mesh->GetPointData()->GetNormals());
  const auto asItIs = [](auto*) {};
  const auto asText = [](auto* writer) { writer->SetDataModeToAscii(); };
  const auto asBinary = [](auto* writer) { writer->SetFileTypeToBinary(); };
  std::vector<Bytes> seeds{ WriteWith<vtkPLYWriter>(".ply", mesh, asItIs),
    WriteWith<vtkPLYWriter>(".ply", mesh, [](auto* writer) { writer->SetFileTypeToASCII(); }),
    WriteWith<vtkXMLPolyDataWriter>(".vtp", mesh, asItIs),
    WriteWith<vtkXMLPolyDataWriter>(".vtp", mesh, asText),
    WriteWith<vtkPolyDataWriter>(".vtk", mesh, asItIs),
    WriteWith<vtkPolyDataWriter>(".vtk", mesh, asBinary),
    WriteWith<vtkUnstructuredGridWriter>(".vtk", grid, asBinary),
    WriteWith<vtkXMLUnstructuredGridWriter>(".vtu", grid, asItIs),
    WriteWith<vtkXMLUnstructuredGridWriter>(".vtu", grid, asText),
    WriteWith<vtkOBJWriter>(".obj", mesh, asItIs), WriteWith<vtkSTLWriter>(".stl", mesh, asItIs),
    WriteWith<vtkSTLWriter>(".stl", mesh, asBinary) };
  for (const std::string text : { "0 0 0\n1 0 0\n0 1 0\n", "3\n# a comment\n1e3,+2;-3\t4\r\n\n",
         "x y z\nnan inf -inf\n1e-400 1e400 0x10\n", "1 2 3 // 4\n//\n.5 5. 1e+1" })
  {
    seeds.push_back(Seed(Text, text));
  }
  for (const auto& [extension, content] : ScannerFiles())
  {
    const auto kind = std::find(Extensions.begin(), Extensions.end(), extension);
    seeds.push_back(Seed(static_cast<std::size_t>(kind - Extensions.begin()), content));
  }
  return seeds;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::size_t kind = size == 0 ? Text : data[0] % Extensions.size();
  const std::string path = Folder() / (std::string("input") + Extensions[kind]);
  std::ofstream file(path, std::ios::binary);
  if (size > 1)
  {
    file.write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  }
  file.close();
  Require(static_cast<bool>(file), "there is room for a file");
  if (neuralmesh::canReadFile(path))
  {
    ReadContents(path);
  }
  if (kind < FirstOfVTK)
  {
    Read(path, false);
  }
  else
  {
    RequireCommandsManners(path);
  }
  return 0;
}
