// SPDX-License-Identifier: BSD-3-Clause
// Damaged files of every kind that is read. As a file may end the process, each is read in one of
// its own, as by the command.
#include "FileTest.h"
#include "PointReader.h"

#include "vtkOBJWriter.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSphereSource.h"
#include "vtkSTLWriter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridWriter.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <iostream>
#include <random>
#include <sstream>
#include <stdexcept>

#include <sys/wait.h>

namespace
{
/** Reads a file and exits with the command's status; with 3 if what was read makes no sense. */
[[noreturn]] void ReadAsCommand(const std::string& path)
{
  try
  {
    const auto points = ReadPoints(path);
    for (vtkIdType i = 0; i < points->GetNumberOfCells(); ++i)
    {
      vtkNew<vtkIdList> ids;
      points->GetCellPoints(i, ids);
      for (vtkIdType j = 0; j < ids->GetNumberOfIds(); ++j)
      {
        if (ids->GetId(j) < 0 || ids->GetId(j) >= points->GetNumberOfPoints())
        {
          _exit(3);
        }
      }
    }
    _exit(0);
  }
  catch (const std::runtime_error& error)
  {
    std::cerr << "neuralmesh: " << error.what() << std::endl;
  }
  _exit(1);
}

bool Failed(int status) { return WIFEXITED(status) && WEXITSTATUS(status) == 1; }

bool SucceededOrFailed(int status)
{
  return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 1);
}

/** One line that names the file, or nothing but warnings. */
const char* const OneLine = "^neuralmesh: [^\n]*damaged\\.[^\n]*\n$";
const char* const OneLineOrWarnings =
  "^((neuralmesh: warning: [^\n]*\n)*|neuralmesh: [^\n]*damaged\\.[^\n]*\n)$";

class BadFiles : public FileTest
{
protected:
  void SetUp() override
  {
    FileTest::SetUp();
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(6);
    sphere->SetPhiResolution(5);
    sphere->Update();
    vtkPolyData* mesh = sphere->GetOutput();
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(mesh->GetPoints());
    grid->SetCells(VTK_TRIANGLE, mesh->GetPolys());
    grid->GetPointData()->SetNormals(mesh->GetPointData()->GetNormals());

    this->WriteWith<vtkPLYWriter>("binary.ply", mesh);
    this->WriteWith<vtkPLYWriter>(
      "big.ply", mesh, [](auto* writer) { writer->SetDataByteOrderToBigEndian(); });
    this->WriteWith<vtkPLYWriter>(
      "text.ply", mesh, [](auto* writer) { writer->SetFileTypeToASCII(); });
    this->WriteWith<vtkXMLPolyDataWriter>(
      "text.vtp", mesh, [](auto* writer) { writer->SetDataModeToAscii(); });
    this->WriteWith<vtkXMLPolyDataWriter>(
      "binary.vtp", mesh, [](auto* writer) { writer->SetDataModeToBinary(); });
    this->WriteWith<vtkXMLPolyDataWriter>("appended.vtp", mesh);
    this->WriteWith<vtkXMLUnstructuredGridWriter>(
      "appended.vtu", grid, [](auto* writer) { writer->EncodeAppendedDataOff(); });
    this->WriteWith<vtkXMLUnstructuredGridWriter>(
      "text.vtu", grid, [](auto* writer) { writer->SetDataModeToAscii(); });
    this->WriteWith<vtkPolyDataWriter>("text.vtk", mesh);
    this->WriteWith<vtkPolyDataWriter>(
      "binary.vtk", mesh, [](auto* writer) { writer->SetFileTypeToBinary(); });
    this->WriteWith<vtkUnstructuredGridWriter>(
      "grid.vtk", grid, [](auto* writer) { writer->SetFileTypeToBinary(); });
    this->WriteWith<vtkOBJWriter>("text.obj", mesh);
    this->WriteWith<vtkSTLWriter>("text.stl", mesh);
    this->WriteWith<vtkSTLWriter>(
      "binary.stl", mesh, [](auto* writer) { writer->SetFileTypeToBinary(); });
    std::ostringstream text;
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const double* p = mesh->GetPoint(i);
      text << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
    for (const char* name : { "text.xyz", "text.pts", "text.txt", "text.csv" })
    {
      this->WriteText(name, text.str());
    }
    const std::string points = text.str(), count = std::to_string(mesh->GetNumberOfPoints());
    this->WriteText("text.off", "OFF\n" + count + " 1 0\n" + points + "3 0 1 2\n");
    this->WriteText("text.pcd",
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
        "\nHEIGHT 1\nPOINTS " + count + "\nDATA ascii\n" + points);
    this->WriteText("text.pwn", count + "\n" + points + points);
    this->WriteText("text.ptx",
      count + "\n1\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 9 1\n" + points);
    for (const auto& entry : std::filesystem::directory_iterator(this->Folder))
    {
      this->Samples.push_back(entry.path());
    }
  }

  static std::string BytesOf(const std::filesystem::path& path)
  {
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
  }

  /** The path of a file with the extension of `sample` and other contents. */
  std::string Damage(const std::filesystem::path& sample, const std::string& bytes) const
  {
    return this->WriteText("damaged" + sample.extension().string(), bytes);
  }

  std::vector<std::filesystem::path> Samples;
};

std::string RandomBytes(std::mt19937& random, std::size_t count)
{
  std::string bytes(count, '\0');
  for (char& byte : bytes)
  {
    byte = static_cast<char>(random());
  }
  return bytes;
}

// Promise: a file that ends anywhere is read as far as its format lets one tell that it is whole,
// or refused in one line.
TEST_F(BadFiles, TruncatedAnywhere)
{
  constexpr std::size_t cuts = 40;
  for (const auto& sample : this->Samples)
  {
    const std::string bytes = BytesOf(sample);
    for (std::size_t i = 0; i < cuts; ++i)
    {
      const std::size_t size = i * bytes.size() / cuts;
      SCOPED_TRACE(sample.filename().string() + ", " + std::to_string(size) + " bytes");
      const std::string path = this->Damage(sample, bytes.substr(0, size));
      EXPECT_EXIT(ReadAsCommand(path), SucceededOrFailed, OneLineOrWarnings);
    }
  }
}

// Promise: where a format says how much there is, half of a file is an error.
TEST_F(BadFiles, HalfIsAnError)
{
  for (const auto& sample : this->Samples)
  {
    const std::string extension = sample.extension().string();
    if (extension == ".ply" || extension == ".stl" || extension.starts_with(".vt") ||
      extension == ".off" || extension == ".pcd" || extension == ".ptx" || extension == ".pwn")
    {
      SCOPED_TRACE(sample.filename().string());
      const std::string bytes = BytesOf(sample);
      const std::string path = this->Damage(sample, bytes.substr(0, bytes.size() / 2));
      EXPECT_EXIT(ReadAsCommand(path), Failed, OneLine);
    }
  }
}

// Promise: garbage, alone or behind a good beginning, is refused in one line, or read where it
// makes sense in the format.
TEST_F(BadFiles, Garbage)
{
  for (const auto& sample : this->Samples)
  {
    const std::string bytes = BytesOf(sample);
    for (unsigned seed = 0; seed < 20; ++seed)
    {
      SCOPED_TRACE(sample.filename().string() + ", seed " + std::to_string(seed));
      std::mt19937 random(seed);
      const std::size_t good = seed < 5 ? 0 : random() % bytes.size();
      const std::string path =
        this->Damage(sample, bytes.substr(0, good) + RandomBytes(random, 2000));
      EXPECT_EXIT(ReadAsCommand(path), SucceededOrFailed, OneLineOrWarnings);
    }
  }
}

// Promise: some wrong bytes in a good file do no other harm.
TEST_F(BadFiles, WrongBytes)
{
  for (const auto& sample : this->Samples)
  {
    for (unsigned seed = 0; seed < 20; ++seed)
    {
      SCOPED_TRACE(sample.filename().string() + ", seed " + std::to_string(seed));
      std::string bytes = BytesOf(sample);
      std::mt19937 random(seed);
      for (unsigned i = 0; i <= seed % 4; ++i)
      {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      const std::string path = this->Damage(sample, bytes);
      EXPECT_EXIT(ReadAsCommand(path), SucceededOrFailed, OneLineOrWarnings);
    }
  }
}

// Promise: nor do numbers that make no sense: negative or huge counts, text for a number.
TEST_F(BadFiles, WrongNumbers)
{
  const std::array<std::string, 7> numbers{ "-1", "0", "4000000000", "9223372036854775807",
    "-4000000000", "1e30", "many" };
  for (const auto& sample : this->Samples)
  {
    const std::string bytes = BytesOf(sample);
    std::size_t begin = 0;
    for (std::size_t i = 0; i < 25; ++i)
    {
      begin = bytes.find_first_of("0123456789", begin);
      const std::size_t end =
        begin == std::string::npos ? begin : bytes.find_first_not_of("0123456789", begin);
      if (end == std::string::npos)
      {
        break;
      }
      const std::string& number = numbers[i % numbers.size()];
      SCOPED_TRACE(sample.filename().string() + ", byte " + std::to_string(begin) + ", " + number);
      const std::string path =
        this->Damage(sample, bytes.substr(0, begin) + number + bytes.substr(end));
      EXPECT_EXIT(ReadAsCommand(path), SucceededOrFailed, OneLineOrWarnings);
      begin = end;
    }
  }
}

// Promise: a small file that claims to hold billions of points is an error; memory is not used up.
TEST_F(BadFiles, MoreIsClaimedThanThere)
{
  const std::string vtkHeader = "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET POLYDATA\n";
  const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
                          "property float x\nproperty float y\nproperty float z\n"
                          "element face 4000000000\nproperty list uchar int vertex_indices\n"
                          "end_header\n";
  const std::string vtp =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\"><PolyData><Piece NumberOfPoints=\"4000000000\" NumberOfVerts=\"0\" "
    "NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"><Points><DataArray "
    "type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points>"
    "</Piece></PolyData></VTKFile>";
  const std::string stl = std::string(80, '\0') + "\xff\xff\xff\xff" + std::string(100, '\0');
  for (const auto& [name, bytes] : { std::pair{ "damaged.ply", ply }, { "damaged.vtp", vtp },
         { "damaged.vtk", vtkHeader + "POINTS 4000000000 float\n" }, { "damaged.stl", stl } })
  {
    SCOPED_TRACE(name);
    const std::string path = this->WriteText(name, bytes);
    EXPECT_EXIT(ReadAsCommand(path), Failed, OneLine);
  }
}

// Promise: a file that would keep VTK busy for ever is an error.
TEST_F(BadFiles, WouldTakeForEver)
{
  const std::string good = BytesOf(this->Path("appended.vtu"));
  const std::string components = "NumberOfComponents=\"";
  const std::size_t number = good.find(components) + components.size();
  const std::string path = this->Damage(
    "a.vtu", good.substr(0, number) + "9223372036854775807" + good.substr(good.find('"', number)));
  EXPECT_EXIT(ReadAsCommand(path), Failed, OneLine);
}

// Promise: cells with points that do not exist are an error, and polygons of two corners.
TEST_F(BadFiles, CellsWithoutPoints)
{
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\n";
  const std::string vtk =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n";
  for (const auto& [name, bytes] : { std::pair{ "damaged.ply", ply + points + "3 0 1 3000000\n" },
         { "damaged.ply", ply + points + "2 0 1\n" },
         { "damaged.vtk", vtk + points + "POLYGONS 1 4\n3 0 1 -2\n" } })
  {
    SCOPED_TRACE(name);
    const std::string path = this->WriteText(name, bytes);
    EXPECT_EXIT(ReadAsCommand(path), Failed, OneLine);
  }
}

// Promise: what is refused leaves the process as it was: the next file is read.
TEST_F(BadFiles, NextOneIsRead)
{
  const std::string bytes = BytesOf(this->Path("text.vtp"));
  const std::string path = this->Damage("a.vtp", bytes.substr(0, bytes.size() / 2));
  EXPECT_THROW(ReadPoints(path), std::runtime_error);
  for (const auto& sample : this->Samples)
  {
    SCOPED_TRACE(sample.filename().string());
    EXPECT_GT(ReadPoints(sample)->GetNumberOfPoints(), 0);
  }
}
}
