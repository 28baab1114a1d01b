// SPDX-License-Identifier: BSD-3-Clause
// Promise: the same input and seed give the same bytes with every compiler, standard library and VTK that
// the tests run with: meshes of five kinds have the hashes that they have everywhere. A change that is to
// change meshes puts other hashes here, and is told in the changelog.
#include "FilterTesting.h"

#include "base/Random.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshStream.h"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <ios>

namespace
{
constexpr int NumberOfPoints = 12000;
constexpr const char* FileName = "TestNeuralMeshPinned.ply";

/** Clouds of additions, products, quotients and roots alone: libraries round others in different ways. */
class Generator
{
public:
  /** A torus with the radii 1 and 0.4, with noise of uniform numbers. */
  vtkNew<vtkPoints> Torus(int count)
  {
    vtkNew<vtkPoints> points;
    while (points->GetNumberOfPoints() < count)
    {
      const auto around = this->Direction();
      const auto along = this->Direction();
      const double r = 1.0 + 0.4 * along[0];
      const auto noise = this->Noise();
      points->InsertNextPoint(
        r * around[0] + noise[0], r * around[1] + noise[1], 0.4 * along[1] + noise[2]);
    }
    return points;
  }

  /** A sheet over a square, with a bump. */
  vtkNew<vtkPoints> Sheet(int count)
  {
    vtkNew<vtkPoints> points;
    while (points->GetNumberOfPoints() < count)
    {
      const double x = this->Random.uniform() - 0.5;
      const double y = this->Random.uniform() - 0.5;
      points->InsertNextPoint(x, y, 0.1 / (1.0 + 30.0 * (x * x + y * y)) + 0.3 * this->Noise()[2]);
    }
    return points;
  }

private:
  std::array<double, 3> Noise()
  {
    std::array<double, 3> noise;
    for (double& coordinate : noise)
    {
      coordinate = 0.004 * (this->Random.uniform() + this->Random.uniform() - 1.0);
    }
    return noise;
  }

  std::array<double, 2> Direction()
  {
    while (true)
    {
      const double x = 2.0 * this->Random.uniform() - 1.0;
      const double y = 2.0 * this->Random.uniform() - 1.0;
      const double squares = x * x + y * y;
      if (squares > 0.01 && squares < 1.0)
      {
        return { x / std::sqrt(squares), y / std::sqrt(squares) };
      }
    }
  }

  neuralmesh::Random Random{ 1 };
};

vtkNew<vtkPolyData> CloudOf(vtkPoints* points)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

/** FNV-1a of the coordinates and of the corners of the triangles. */
std::uint64_t Hash(vtkPolyData* mesh)
{
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](const auto& value)
  {
    std::array<unsigned char, sizeof(value)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(value));
    for (const unsigned char byte : bytes)
    {
      hash = (hash ^ byte) * 0x100000001b3u;
    }
  };
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      add(mesh->GetPoint(i)[axis]);
    }
  }
  vtkNew<vtkIdList> corners;
  for (mesh->GetPolys()->InitTraversal(); mesh->GetPolys()->GetNextCell(corners);)
  {
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
    {
      add(std::int64_t(corners->GetId(i)));
    }
  }
  return hash;
}

/** Tells the hash that was found, for whoever is to pin another one. */
bool Is(vtkPolyData* mesh, vtkIdType vertices, std::uint64_t pinned, const char* kind)
{
  const std::uint64_t found = Hash(mesh);
  std::cout << kind << ": " << mesh->GetNumberOfPoints() << " vertices, hash 0x" << std::hex
            << found << std::dec << std::endl;
  return mesh->GetNumberOfPoints() == vertices && found == pinned;
}

/** A closed solid: the occupied space encloses something. */
bool CheckSolid(vtkPoints* torus)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(CloudOf(torus));
  filter->SetNumberOfVertices(1500);
  filter->Update();
  return Is(filter->GetOutput(), 1500, 0x99555bdd98535f9cu, "solid");
}

/** An open surface, learnt by another variant and order. */
bool CheckSheet()
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(CloudOf(Generator().Sheet(NumberOfPoints)));
  filter->SetNumberOfVertices(1500);
  filter->SetVariantToNormalBased();
  filter->SetOrderToList();
  filter->Update();
  return Is(filter->GetOutput(), 1500, 0x18283147d597172u, "sheet");
}

bool CheckStream(vtkPoints* torus)
{
  vtkNew<vtkPoints> half;
  half->InsertPoints(0, NumberOfPoints / 2, 0, torus);
  vtkNew<vtkNeuralMeshStream> stream;
  stream->SetNumberOfVertices(1000);
  stream->AddPoints(half);
  stream->Learn(20000);
  stream->AddPoints(torus);
  stream->Learn(200000);
  stream->Update();
  return Is(stream->GetOutput(), 1000, 0xad4732bf176a6cf3u, "stream");
}

bool CheckEnsemble(vtkPoints* torus)
{
  vtkNew<vtkNeuralMeshEnsemble> filter;
  filter->SetInputData(CloudOf(torus));
  filter->SetNumberOfMembers(3);
  filter->SetNumberOfVertices(1000);
  filter->Update();
  return Is(filter->GetOutput(), 1000, 0xa2f1a86ddeaa0b50u, "ensemble");
}

/** A part of a file, drawn where it lies. */
bool CheckFile(vtkPoints* torus)
{
  {
    std::ofstream file(FileName, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << NumberOfPoints
         << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
    for (vtkIdType i = 0; i < NumberOfPoints; ++i)
    {
      file.write(reinterpret_cast<const char*>(torus->GetPoint(i)), 3 * sizeof(double));
    }
  }
  vtkNew<vtkNeuralMesh> filter;
  filter->SetPointFileName(FileName);
  filter->SetMaximumPoints(NumberOfPoints / 2);
  filter->SetNumberOfVertices(1000);
  filter->Update();
  std::remove(FileName);
  return Is(filter->GetOutput(), 1000, 0x9259b072da2ba371u, "file");
}
}

int TestNeuralMeshPinned(int, char*[])
{
  const auto torus = Generator().Torus(NumberOfPoints);
  // All of them, whatever comes of the first: who pins hashes wants to see each.
  const std::array<bool, 5> same{ CheckSolid(torus), CheckSheet(), CheckStream(torus),
    CheckEnsemble(torus), CheckFile(torus) };
  CHECK(std::find(same.begin(), same.end(), false) == same.end());
  return EXIT_SUCCESS;
}
