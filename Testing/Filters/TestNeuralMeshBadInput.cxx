// SPDX-License-Identifier: BSD-3-Clause
// Promise: whatever the points are, the filter ends: with a closed manifold of finite numbers near
// them, with an empty output, or with an error and an empty output. With its defaults it gives
// as many vertices as are asked for; the basic variant and the thesis's values may stall. Cells and
// attributes of the input change nothing. Each warning of a mesh ends with its tag.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <regex>
#include <set>

namespace
{
using Point = std::array<double, 3>;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr int Vertices = 600;

enum class Outcome
{
  Mesh,
  Sheet, ///< closed or open
  Empty,
  Error
};

struct Case
{
  const char* Name;
  int Count;
  /// The i-th point, made of one on the unit sphere.
  std::function<Point(int i, const Point& onSphere)> MakePoint;
  Outcome Expected;
  int Warnings;
  int Dropped;
};

Point Scaled(const Point& p, double factor, double offset = 0.0)
{
  return { factor * p[0] + offset, factor * p[1] + offset, factor * p[2] + offset };
}

const std::vector<Case>& Cases()
{
  static const std::vector<Case> cases{
    { "no points", 0, [](int, const Point& p) { return p; }, Outcome::Empty, 0, 0 },
    { "1 point", 1, [](int, const Point& p) { return p; }, Outcome::Error, 0, 0 },
    { "2 points", 2, [](int, const Point& p) { return p; }, Outcome::Mesh, 1, 0 },
    { "3 points", 3, [](int, const Point& p) { return p; }, Outcome::Mesh, 1, 0 },
    { "4 points", 4, [](int, const Point& p) { return p; }, Outcome::Mesh, 1, 0 },
    { "fewer points than vertices", 200, [](int, const Point& p) { return p; }, Outcome::Mesh, 1,
      0 },
    { "all equal", 1000,
      [](int, const Point&) {
        return Point{ 5, 6, 7 };
      },
      Outcome::Error, 0, 0 },
    { "all equal but one", 20000,
      [](int i, const Point&) {
        return Point{ i == 10000 ? 1. : 0., 0, 0 };
      },
      Outcome::Mesh, 0, 0 },
    { "on a line", 1000,
      [](int, const Point& p) {
        return Point{ p[0], 2 * p[0], -p[0] };
      },
      Outcome::Sheet, 0, 0 },
    { "in a plane", 1000,
      [](int, const Point& p) {
        return Point{ p[0], p[1], p[0] - p[1] };
      },
      Outcome::Sheet, 0, 0 },
    { "in a plane of the axes", 1000,
      [](int, const Point& p) {
        return Point{ p[0], p[1], 3 };
      },
      Outcome::Sheet, 0, 0 },
    { "NaN and infinity among good points", 1200,
      [](int i, const Point& p) {
        return i % 6 != 0 ? p : i % 12 != 0 ? Point{ NaN, 0, p[2] } : Point{ p[0], -Infinity, 0 };
      },
      Outcome::Mesh, 0, 200 },
    { "a fifth on one spot", 1000,
      [](int i, const Point& p) {
        return i % 5 != 0 ? p : Point{ 0, 0, 3 };
      },
      Outcome::Mesh, 1, 199 },
    { "all NaN", 1000,
      [](int, const Point& p) {
        return Point{ p[0], p[1], NaN };
      },
      Outcome::Error, 0, 0 },
    { "all infinite", 1000,
      [](int, const Point&) {
        return Point{ Infinity, 0, 0 };
      },
      Outcome::Error, 0, 0 },
    { "extent 1e-30", 1000, [](int, const Point& p) { return Scaled(p, 1e-30); }, Outcome::Mesh, 0,
      0 },
    { "extent 1e30", 1000, [](int, const Point& p) { return Scaled(p, 1e30); }, Outcome::Mesh, 0,
      0 },
    { "extents 1, 1e-30 and 1e-30", 1000,
      [](int, const Point& p) {
        return Point{ p[0], 1e-30 * p[1], 1e-30 * p[2] };
      },
      Outcome::Sheet, 0, 0 },
    { "offset 1e7, extent 1", 1000, [](int, const Point& p) { return Scaled(p, 1, 1e7); },
      Outcome::Mesh, 0, 0 },
  };
  return cases;
}

vtkNew<vtkPolyData> MakeCloud(const Case& input, int type)
{
  const auto sphere = FilterTesting::SpherePoints(input.Count, 1.0, { 0, 0, 0 }, VTK_DOUBLE);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  for (int i = 0; i < input.Count; ++i)
  {
    Point onSphere;
    sphere->GetPoint(i, onSphere.data());
    points->InsertNextPoint(input.MakePoint(i, onSphere).data());
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

bool HaveTags(vtkPolyData* mesh)
{
  const auto* warnings =
    vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("Warnings"));
  const std::regex tag(".* \\[[a-z]+(-[a-z]+)*\\]");
  for (vtkIdType i = 0; i < warnings->GetNumberOfValues(); ++i)
  {
    if (!std::regex_match(std::string(warnings->GetValue(i)), tag))
    {
      return false;
    }
  }
  return true;
}

bool AllFinite(vtkDataArray* array)
{
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int j = 0; j < array->GetNumberOfComponents(); ++j)
    {
      if (!std::isfinite(array->GetComponent(i, j)))
      {
        return false;
      }
    }
  }
  return true;
}

/** Whether the mesh lies in the box of the finite points, enlarged by half of its diagonal. */
bool IsNear(vtkPolyData* mesh, vtkPolyData* cloud)
{
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double* p = cloud->GetPoint(i);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
    {
      box.AddPoint(p);
    }
  }
  box.Inflate(0.5 * box.GetDiagonalLength());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    if (!box.ContainsPoint(mesh->GetPoint(i)))
    {
      return false;
    }
  }
  return true;
}

vtkIdType DifferentPoints(vtkPolyData* cloud)
{
  std::set<Point> different;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Point point;
    cloud->GetPoint(i, point.data());
    if (std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); }))
    {
      different.insert(point);
    }
  }
  return static_cast<vtkIdType>(different.size());
}

int CheckMesh(vtkNeuralMesh* filter, vtkPolyData* cloud, const Case& input)
{
  vtkPolyData* mesh = filter->GetOutput();
  const bool mayStall =
    filter->GetVariant() == vtkNeuralMesh::BASIC || filter->GetPreset() == vtkNeuralMesh::THESIS;
  CHECK(mesh->GetNumberOfPoints() == Vertices ||
    (mayStall && std::string(filter->GetStopReason()) == "stalled"));
  const auto report = FilterTesting::Manifold(mesh);
  CHECK(report.defect.empty() && report.unusedPoints == 0);
  CHECK(report.isClosed() || input.Expected == Outcome::Sheet);
  CHECK(AllFinite(mesh->GetPoints()->GetData()));
  CHECK(AllFinite(mesh->GetPointData()->GetNormals()));
  CHECK(AllFinite(mesh->GetPointData()->GetArray("Activity")));
  CHECK(IsNear(mesh, cloud));
  CHECK(HaveTags(mesh));
  CHECK(FilterTesting::FieldValue(mesh, "DroppedPoints") == input.Dropped);
  return EXIT_SUCCESS;
}

bool IsOnLine(const Case& input)
{
  const std::set<std::string> names{ "on a line", "all equal but one",
    "extents 1, 1e-30 and 1e-30" };
  return names.count(input.Name) > 0;
}

int CheckCase(const Case& input, int type, int variant, int preset)
{
  const auto cloud = MakeCloud(input, type);
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  messages->Observe(filter->GetExecutive());
  filter->SetVariant(variant);
  filter->SetPreset(preset);
  filter->SetNumberOfVertices(Vertices);
  filter->SetInputData(cloud);
  filter->Update();
  CHECK((messages->Errors > 0) == (input.Expected == Outcome::Error));
  const bool isStalled = std::string(filter->GetStopReason()) == "stalled";
  const int ofDefects = FilterTesting::WarningsOfDefects(
    filter->GetOutput(), DifferentPoints(cloud), input.Count - input.Dropped);
  const int ofPoints = FilterTesting::Count(messages->AllText,
    { "[points-are-unexplained]", "[part-is-missing]", "[open-where-points-are]",
      "[mesh-is-coarse]", "[between-layers]", "[surface-without-points]", "[slivers]",
      "[no-surface]", "[gap-is-spanned]", "[falls-into-pieces]", "[stays-open]",
      "[narrow-necks]" });
  const int ofSides =
    FilterTesting::Count(messages->AllText, { "[side-is-unknown]", "[inside-out]" });
  // What is on a line gets no other warning.
  const int ofLines = FilterTesting::Count(messages->AllText, { "All points lie on a line" });
  CHECK(ofLines == (IsOnLine(input) ? 1 : 0));
  CHECK(messages->Warnings ==
    (ofLines > 0 ? 1 : input.Warnings + isStalled + ofDefects + ofPoints + ofSides));
  if (input.Expected == Outcome::Mesh || input.Expected == Outcome::Sheet)
  {
    return CheckMesh(filter, cloud, input);
  }
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(filter->GetOutput()->GetNumberOfCells() == 0);
  return EXIT_SUCCESS;
}

vtkNew<vtkDoubleArray> Attribute(const char* name, vtkIdType count)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(count);
  array->FillValue(NaN);
  return array;
}

int CheckCellsAndAttributes()
{
  const auto plain = FilterTesting::SphereCloud(2000);
  vtkNew<vtkPolyData> rich;
  rich->DeepCopy(plain);
  rich->AllocateEstimate(3, 4);
  for (const auto& [type, size] : { std::pair{ VTK_VERTEX, 1 }, { VTK_LINE, 2 }, { VTK_QUAD, 4 } })
  {
    const std::array<vtkIdType, 4> ids{ 5, 6, 7, 8 };
    rich->InsertNextCell(type, size, ids.data());
  }
  rich->GetPointData()->SetScalars(Attribute("Intensity", 2000));
  rich->GetCellData()->SetScalars(Attribute("Quality", 3));
  rich->GetFieldData()->AddArray(Attribute("Scanner", 7));

  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(Vertices);
  filter->SetInputData(plain);
  filter->Update();
  vtkNew<vtkPolyData> expected;
  expected->ShallowCopy(filter->GetOutput());
  filter->SetInputData(rich);
  filter->Update();
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(mesh->GetNumberOfPoints() == expected->GetNumberOfPoints());
  for (vtkIdType i = 0; i < 3 * mesh->GetNumberOfPoints(); ++i)
  {
    CHECK(mesh->GetPoint(i / 3)[i % 3] == expected->GetPoint(i / 3)[i % 3]);
  }
  CHECK(mesh->GetNumberOfCells() == expected->GetNumberOfCells());
  // Point data is carried over, also where it says nothing.
  vtkPointData* data = mesh->GetPointData();
  CHECK(data->GetNumberOfArrays() == expected->GetPointData()->GetNumberOfArrays() + 1);
  CHECK(data->GetScalars() && std::isnan(data->GetScalars()->GetTuple1(0)));
  CHECK(mesh->GetCellData()->GetNumberOfArrays() == 0);
  CHECK(mesh->GetFieldData()->HasArray("Scanner")); // as VTK's pipeline has it
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshBadInput(int, char*[])
{
  for (const Case& input : Cases())
  {
    for (const int type : { VTK_FLOAT, VTK_DOUBLE })
    {
      for (const int variant : { vtkNeuralMesh::BASIC, vtkNeuralMesh::NOISE_FILTERING })
      {
        for (const int preset : { vtkNeuralMesh::DEFAULT, vtkNeuralMesh::THESIS })
        {
          std::cout << input.Name << (type == VTK_FLOAT ? ", float" : ", double") << ", variant "
                    << variant << ", preset " << preset << std::endl;
          CHECK(CheckCase(input, type, variant, preset) == EXIT_SUCCESS);
        }
      }
    }
  }
  return CheckCellsAndAttributes();
}
