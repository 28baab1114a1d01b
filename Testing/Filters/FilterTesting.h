// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterTesting_h
#define FilterTesting_h

#include "ManifoldCheck.h"

#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iostream>
#include <string>
#include <vector>

/** Ends the test with a failure, telling where, if `condition` does not hold. */
#define CHECK(condition)                                                                           \
  do                                                                                               \
  {                                                                                                \
    if (!(condition))                                                                              \
    {                                                                                              \
      std::cerr << __FILE__ << ":" << __LINE__ << ": " #condition " does not hold" << std::endl;   \
      return EXIT_FAILURE;                                                                         \
    }                                                                                              \
  } while (false)

namespace FilterTesting
{
/** Points evenly on a sphere, by VTK's random numbers. */
inline vtkNew<vtkPoints> SpherePoints(
  int count, double radius = 1.0, std::array<double, 3> center = { 0, 0, 0 }, int type = VTK_FLOAT)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  for (int i = 0; i < count; ++i)
  {
    const double z = random->GetNextRangeValue(-1.0, 1.0);
    const double angle = random->GetNextRangeValue(0.0, 2.0 * 3.14159265358979);
    const double r = std::sqrt(1.0 - z * z);
    points->InsertNextPoint(center[0] + radius * r * std::cos(angle),
      center[1] + radius * r * std::sin(angle), center[2] + radius * z);
  }
  return points;
}

inline vtkNew<vtkPolyData> SphereCloud(int count)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(SpherePoints(count));
  return cloud;
}

/** Whether arrays have the same type and values, to the last bit. */
inline bool SameBytes(vtkDataArray* a, vtkDataArray* b)
{
  const auto size = static_cast<std::size_t>(a->GetNumberOfValues()) *
    static_cast<std::size_t>(a->GetDataTypeSize());
  return a->GetNumberOfValues() == b->GetNumberOfValues() && a->GetDataType() == b->GetDataType() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), size) == 0;
}

/** Points on a torus with the radii 1 and 0.4. */
inline vtkNew<vtkPolyData> TorusCloud()
{
  vtkNew<vtkPoints> points;
  constexpr int Around = 400;
  constexpr int Along = 120;
  for (int i = 0; i < Around; ++i)
  {
    for (int j = 0; j < Along; ++j)
    {
      // Neighbouring rows are shifted against each other.
      const double u = 2.0 * 3.14159265358979 * (i + 0.37 * j) / Around;
      const double v = 2.0 * 3.14159265358979 * j / Along;
      const double r = 1.0 + 0.4 * std::cos(v);
      points->InsertNextPoint(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

/** What the independent check finds in the triangles of a mesh. */
inline neuralmesh::testing::ManifoldReport Manifold(vtkPolyData* mesh)
{
  std::vector<std::array<std::uint32_t, 3>> triangles;
  vtkNew<vtkIdList> ids;
  vtkCellArray* polys = mesh->GetPolys();
  for (polys->InitTraversal(); polys->GetNextCell(ids);)
  {
    if (ids->GetNumberOfIds() != 3)
    {
      neuralmesh::testing::ManifoldReport report;
      report.defect = "a cell is no triangle";
      return report;
    }
    triangles.push_back({ static_cast<std::uint32_t>(ids->GetId(0)),
      static_cast<std::uint32_t>(ids->GetId(1)), static_cast<std::uint32_t>(ids->GetId(2)) });
  }
  return neuralmesh::testing::checkManifold(
    static_cast<std::size_t>(mesh->GetNumberOfPoints()), triangles);
}

/** Of closed meshes: 2 for a sphere, 0 for a torus. */
inline vtkIdType EulerCharacteristic(vtkPolyData* mesh)
{
  return mesh->GetNumberOfPoints() - mesh->GetNumberOfPolys() / 2;
}

inline double FieldValue(vtkPolyData* mesh, const char* name)
{
  vtkDataArray* array = mesh->GetFieldData()->GetArray(name);
  return array ? array->GetTuple1(0) : -1.0;
}

/** How often the phrases are in a text, all together. */
inline int Count(const std::string& text, std::initializer_list<std::string> phrases)
{
  int count = 0;
  for (const std::string& phrase : phrases)
  {
    for (std::size_t at = text.find(phrase); at != std::string::npos;
         at = text.find(phrase, at + 1))
    {
      ++count;
    }
  }
  return count;
}

/** The warnings that the report on a mesh calls for, one for each kind of defect, and one for more
 * vertices than so many different points, of so many, are enough for. */
inline int WarningsOfDefects(vtkPolyData* mesh, vtkIdType differentPoints, vtkIdType points)
{
  constexpr vtkIdType Fewest = 4;
  const vtkIdType vertices = mesh->GetNumberOfPoints();
  const bool isFiner = vertices > std::max(differentPoints / 2, Fewest) && vertices <= points;
  return isFiner + (FieldValue(mesh, "FoldedEdges") > 0.) +
    (FieldValue(mesh, "IntersectingTriangles") > 0.) + (FieldValue(mesh, "NarrowHandles") > 0.) +
    (FieldValue(mesh, "FitRoundsTakenBack") > 0.);
}

/** Counts errors and warnings, which are then not printed. */
class MessageCounter : public vtkCommand
{
public:
  static MessageCounter* New() { return new MessageCounter; }

  void Execute(vtkObject*, unsigned long event, void* callData) override
  {
    ++(event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings);
    this->LastText = static_cast<const char*>(callData);
    this->AllText += this->LastText;
  }

  void Observe(vtkObject* object)
  {
    object->AddObserver(vtkCommand::ErrorEvent, this);
    object->AddObserver(vtkCommand::WarningEvent, this);
  }

  int Errors = 0;
  int Warnings = 0;
  std::string LastText;
  std::string AllText;
};

/** Updates a filter that cannot do what is wanted of it: one error has these words, and there is no mesh. */
inline int CheckRefusal(vtkPolyDataAlgorithm* filter, const char* words)
{
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  filter->Update();
  CHECK(messages->Errors == 1);
  CHECK(messages->AllText.find(words) != std::string::npos);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  return EXIT_SUCCESS;
}
}

#endif
