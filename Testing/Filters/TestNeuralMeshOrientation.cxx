// SPDX-License-Identifier: BSD-3-Clause
// Promise: surfaces are turned to their outer side by their volume, or as viewpoints, an up direction and
// normals tell, wherever the points come from; where nothing tells, the field data says so; and what is
// given in vain is an error, or a warning.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshStream.h"
#include "vtkPNeuralMesh.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

namespace
{
using FilterTesting::FieldValue;

const double NotANumber = std::numeric_limits<double>::quiet_NaN();

/** A square of side 2 in the plane of that height. */
vtkNew<vtkPolyData> Sheet(double height = 0.0)
{
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 4000; ++i)
  {
    // By a lattice that fills the square evenly.
    const double x = std::fmod(0.7548776662 * i, 1.0), y = std::fmod(0.5698402910 * i, 1.0);
    points->InsertNextPoint(2.0 * x - 1.0, 2.0 * y - 1.0, height);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

vtkNew<vtkPolyData> OpenSphere()
{
  const auto all = FilterTesting::SpherePoints(20000);
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
  {
    if (all->GetPoint(i)[2] > -0.5)
    {
      points->InsertNextPoint(all->GetPoint(i));
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

/** An array with the same tuple for all. */
template <typename ArrayT>
vtkNew<ArrayT> Constant(const char* name, vtkIdType count, const std::vector<double>& tuple)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(tuple.size()));
  array->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->SetTuple(i, tuple.data());
  }
  return array;
}

std::string OrientedBy(vtkPolyData* mesh)
{
  auto* by = vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("OrientedBy"));
  return by ? by->GetValue(0) : "";
}

/** Of the normals, by points. */
double ShareUpwards(vtkPolyData* mesh)
{
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  double count = 0.0;
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    count += normals->GetComponent(i, 2) > 0.0 ? 1.0 : 0.0;
  }
  return count / static_cast<double>(normals->GetNumberOfTuples());
}

struct Outcome
{
  vtkNew<vtkPolyData> Mesh;
  int Errors = 0;
  int Warnings = 0;
  std::string Text;
};

using Setting = std::function<void(vtkNeuralMesh*)>;

Outcome Run(
  vtkDataObject* cloud, const Setting& set = [](vtkNeuralMesh*) {})
{
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  filter->SetNumberOfVertices(200);
  filter->SetInputDataObject(cloud);
  set(filter);
  filter->Update();
  Outcome outcome;
  outcome.Mesh->ShallowCopy(filter->GetOutput());
  outcome.Errors = messages->Errors;
  outcome.Warnings = messages->Warnings;
  outcome.Text = messages->AllText;
  return outcome;
}

/** Whether places and triangles are the same, to the bit. */
bool IsSame(const Outcome& a, const Outcome& b)
{
  return FilterTesting::SameBytes(a.Mesh->GetPoints()->GetData(), b.Mesh->GetPoints()->GetData()) &&
    FilterTesting::SameBytes(
      a.Mesh->GetPolys()->GetConnectivityArray(), b.Mesh->GetPolys()->GetConnectivityArray());
}

/** Whether a sheet looks up or down, and is known to by that. */
bool Looks(const Outcome& outcome, bool isUp, const std::string& by)
{
  return outcome.Errors == 0 && outcome.Warnings == 0 &&
    ShareUpwards(outcome.Mesh) == (isUp ? 1.0 : 0.0) && OrientedBy(outcome.Mesh) == by &&
    FieldValue(outcome.Mesh, "UnorientedPieces") == 0.0 &&
    FieldValue(outcome.Mesh, "UnorientedShare") == 0.0;
}

bool IsUnknown(const Outcome& outcome)
{
  return OrientedBy(outcome.Mesh) == "nothing" &&
    FieldValue(outcome.Mesh, "UnorientedPieces") == 1.0 &&
    FieldValue(outcome.Mesh, "UnorientedShare") == 1.0;
}

int CheckVolume()
{
  const Outcome sphere = Run(OpenSphere());
  CHECK(sphere.Warnings == 0 && OrientedBy(sphere.Mesh) == "volume");
  CHECK(FieldValue(sphere.Mesh, "UnorientedPieces") == 0.0);
  for (vtkIdType i = 0; i < sphere.Mesh->GetNumberOfPoints(); ++i)
  {
    double point[3], normal[3];
    sphere.Mesh->GetPoint(i, point);
    sphere.Mesh->GetPointData()->GetNormals()->GetTuple(i, normal);
    CHECK(point[0] * normal[0] + point[1] * normal[1] + point[2] * normal[2] > 0.0);
  }
  const Outcome sheet = Run(Sheet());
  CHECK(sheet.Warnings == 0 && IsUnknown(sheet));
  return EXIT_SUCCESS;
}

int CheckProperties()
{
  const auto sheet = Sheet();
  for (const bool isUp : { true, false })
  {
    const double up = isUp ? 1.0 : -1.0;
    CHECK(Looks(Run(sheet, [&](auto* filter) { filter->SetUpDirection(0.1, 0.0, up); }), isUp,
      "up direction"));
    CHECK(Looks(
      Run(sheet, [&](auto* filter) { filter->SetViewpoint(1.0, 3.0, up); }), isUp, "viewpoints"));
    CHECK(Looks(Run(sheet,
                  [&](auto* filter)
                  {
                    filter->SetUpDirection(0.0, 0.0, -up); // a viewpoint knows better
                    filter->AddViewpoint(NotANumber, 0.0, 0.0);
                    filter->AddViewpoint(0.2, 0.1, 1e4 * up);
                  }),
      isUp, "viewpoints"));
  }
  vtkNew<vtkNeuralMesh> filter;
  CHECK(filter->GetNumberOfViewpoints() == 0 && std::string(filter->GetViewArrayName()).empty());
  const vtkMTimeType before = filter->GetMTime();
  filter->AddViewpoint(1.0, 2.0, 3.0);
  filter->AddViewpoint(4.0, 5.0, 6.0);
  CHECK(filter->GetNumberOfViewpoints() == 2 && filter->GetMTime() > before);
  double place[3];
  filter->GetViewpoint(1, place);
  CHECK(place[0] == 4.0 && place[1] == 5.0 && place[2] == 6.0);
  filter->GetViewpoint(2, place);
  CHECK(std::isnan(place[0]));
  filter->SetViewpoint(7.0, 8.0, 9.0);
  CHECK(filter->GetNumberOfViewpoints() == 1);
  filter->SetViewArrayName("Station");
  std::ostringstream text;
  filter->Print(text);
  CHECK(text.str().find("Viewpoint: 7 8 9") != std::string::npos);
  CHECK(text.str().find("ViewArrayName: Station") != std::string::npos);
  filter->SetViewArrayName(nullptr);
  filter->RemoveAllViewpoints();
  CHECK(filter->GetNumberOfViewpoints() == 0 && std::string(filter->GetViewArrayName()).empty());
  return EXIT_SUCCESS;
}

int CheckNormals()
{
  for (const bool isUp : { true, false })
  {
    const auto sheet = Sheet();
    vtkNew<vtkMinimalStandardRandomSequence> random;
    random->SetSeed(5);
    auto normals = Constant<vtkFloatArray>("Normals", sheet->GetNumberOfPoints(), { 0, 0, 0 });
    for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
    {
      const double sign = (random->GetNextRangeValue(0.0, 1.0) < 0.75) == isUp ? 1.0 : -1.0;
      normals->SetTuple3(i, random->GetNextRangeValue(-1.0, 1.0),
        random->GetNextRangeValue(-1.0, 1.0), sign * random->GetNextRangeValue(0.2, 2.0));
    }
    sheet->GetPointData()->AddArray(normals);
    CHECK(Looks(Run(sheet), isUp, "normals"));
    normals->SetName("Directions");
    sheet->GetPointData()->SetNormals(normals);
    CHECK(Looks(Run(sheet), isUp, "normals"));
    CHECK(Looks(Run(sheet, [](auto* filter) { filter->CarryPointDataOff(); }), isUp, "normals"));

    // On all processes, of which here there is one.
    vtkNew<vtkPNeuralMesh> parallel;
    parallel->SetController(nullptr);
    parallel->SetNumberOfVertices(200);
    parallel->SetInputData(sheet);
    parallel->Update();
    CHECK(OrientedBy(parallel->GetOutput()) == "normals");
    CHECK(ShareUpwards(parallel->GetOutput()) == (isUp ? 1.0 : 0.0));
    CHECK(!parallel->GetOutput()->GetPointData()->HasArray("Normals_Input"));

    // One of two blocks has some.
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, Sheet());
    blocks->SetBlock(1, sheet);
    CHECK(Looks(Run(blocks), isUp, "normals"));
  }
  for (const double useless : { 0.0, NotANumber })
  {
    const auto sheet = Sheet();
    sheet->GetPointData()->SetNormals(Constant<vtkDoubleArray>(
      "Normals", sheet->GetNumberOfPoints(), { useless, useless, useless }));
    const Outcome outcome = Run(sheet);
    CHECK(IsUnknown(outcome) && outcome.Warnings == 1);
    CHECK(outcome.Text.find("normals of the input determine no side") != std::string::npos);
  }
  const auto sheet = Sheet();
  sheet->GetPointData()->AddArray(Constant<vtkFloatArray>("Normals", 17, { 0, 0, 1 }));
  const Outcome outcome = Run(sheet);
  CHECK(IsUnknown(outcome) && outcome.Warnings == 1);
  CHECK(outcome.Text.find("3 components for each point") != std::string::npos);
  return EXIT_SUCCESS;
}

/** Normals that are named, on all processes, tell the side, and arrive only where they would else. */
bool LooksOnProcesses(vtkDataObject* cloud, const char* name, bool carries, bool isUp)
{
  const Setting set = [=](auto* filter)
  {
    filter->SetNormalArrayName(name);
    filter->SetCarryPointData(carries);
  };
  vtkNew<vtkPNeuralMesh> parallel;
  parallel->SetController(nullptr);
  parallel->SetNumberOfVertices(200);
  parallel->SetInputDataObject(cloud);
  set(parallel);
  parallel->Update();
  vtkPolyData* mesh = parallel->GetOutput();
  const Outcome alone = Run(cloud, set);
  return OrientedBy(mesh) == "normals" && ShareUpwards(mesh) == (isUp ? 1.0 : 0.0) &&
    mesh->GetPointData()->GetNumberOfArrays() == alone.Mesh->GetPointData()->GetNumberOfArrays();
}

int CheckNamedNormals()
{
  for (const bool isUp : { true, false })
  {
    // Those that are named count, and the active ones do not.
    const auto sheet = Sheet();
    const double up = isUp ? 1.0 : -1.0;
    sheet->GetPointData()->SetNormals(
      Constant<vtkFloatArray>("Normals", sheet->GetNumberOfPoints(), { 0, 0, -up }));
    sheet->GetPointData()->AddArray(
      Constant<vtkIntArray>("Directions", sheet->GetNumberOfPoints(), { 0, 0, 3.0 * up }));
    const auto named = [](auto* filter) { filter->SetNormalArrayName("Directions"); };
    CHECK(Looks(Run(sheet, named), isUp, "normals"));
    // A block may lack them, but not all blocks, and they must be vectors.
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, Sheet());
    blocks->SetBlock(1, sheet);
    CHECK(Looks(Run(blocks, named), isUp, "normals"));

    // On all processes, of which here there is one: the mesh gets no data that it would not get else.
    for (const bool carries : { true, false })
    {
      CHECK(LooksOnProcesses(blocks, "Directions", carries, isUp));
      CHECK(LooksOnProcesses(sheet, "Directions", carries, isUp));
      CHECK(LooksOnProcesses(sheet, "Normals", carries, !isUp));
    }
    const Outcome missing = Run(Sheet(), named);
    CHECK(missing.Errors == 1 && missing.Mesh->GetNumberOfPoints() == 0);
    CHECK(missing.Text.find("called Directions for the normals. None has three components.") !=
      std::string::npos);
    sheet->GetPointData()->AddArray(
      Constant<vtkIntArray>("Single", sheet->GetNumberOfPoints(), { 1 }));
    const Outcome single = Run(sheet, [](auto* filter) { filter->SetNormalArrayName("Single"); });
    CHECK(single.Errors == 1 && single.Mesh->GetNumberOfPoints() == 0);
    CHECK(
      single.Text.find("called Single for the normals. Arrays with three components: Directions, "
                       "Normals.") != std::string::npos);

    // Without use, the mesh is that of points without normals, whatever is named.
    for (const char* name : { "", "Directions", "Nothing" })
    {
      const Outcome unused = Run(sheet,
        [name](auto* filter)
        {
          filter->UseNormalsOff();
          filter->SetNormalArrayName(name);
        });
      CHECK(IsUnknown(unused) && unused.Errors == 0 && unused.Warnings == 0);
      CHECK(IsSame(unused, Run(Sheet())));
    }
  }
  return EXIT_SUCCESS;
}

/** A sphere with noise, and its normals as they are without. */
vtkNew<vtkPolyData> NoisySphere()
{
  const auto exact = FilterTesting::SpherePoints(2000);
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(3);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < exact->GetNumberOfPoints(); ++i)
  {
    const double* point = exact->GetPoint(i);
    const double factor = random->GetNextRangeValue(0.95, 1.05);
    points->InsertNextPoint(factor * point[0], factor * point[1], factor * point[2]);
    normals->InsertNextTuple(point);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(normals);
  return cloud;
}

/// The fit uses those that are named as it uses active ones, and none that are off.
int CheckFit()
{
  const auto cloud = NoisySphere();
  vtkDataArray* normals = cloud->GetPointData()->GetArray("Normals");
  const Outcome used = Run(cloud);
  cloud->GetPointData()->SetNormals(normals);
  CHECK(IsSame(Run(cloud), used));
  const Outcome off = Run(cloud, [](auto* filter) { filter->UseNormalsOff(); });
  CHECK(!IsSame(off, used));

  normals->SetName("Directions");
  cloud->GetPointData()->SetActiveNormals(nullptr);
  const auto named = [](auto* filter) { filter->SetNormalArrayName("Directions"); };
  CHECK(IsSame(Run(cloud, named), used));
  CHECK(IsSame(Run(cloud), off));

  // What tells nothing is as if there were none, but for the warning.
  for (const std::vector<double>& useless : std::vector<std::vector<double>>{
         { 0, 0, 0 }, { NotANumber, NotANumber, NotANumber }, { 0, 0, 1 } })
  {
    cloud->GetPointData()->AddArray(
      Constant<vtkDoubleArray>("Directions", cloud->GetNumberOfPoints(), useless));
    const Outcome outcome = Run(cloud, named);
    CHECK(IsSame(outcome, off) && outcome.Errors == 0 && outcome.Warnings == off.Warnings + 1);
    CHECK(outcome.Text.find("normals of the input determine no side") != std::string::npos);
  }
  return EXIT_SUCCESS;
}

int CheckNormalProperties()
{
  vtkNew<vtkNeuralMesh> filter;
  CHECK(filter->GetUseNormals() == 1 && std::string(filter->GetNormalArrayName()).empty());
  filter->UseNormalsOff();
  const vtkMTimeType before = filter->GetMTime();
  filter->SetNormalArrayName("Directions");
  CHECK(filter->GetMTime() > before);
  std::ostringstream text;
  filter->Print(text);
  CHECK(text.str().find("UseNormals: 0") != std::string::npos);
  CHECK(text.str().find("NormalArrayName: Directions") != std::string::npos);
  filter->SetNormalArrayName(nullptr);
  CHECK(std::string(filter->GetNormalArrayName()).empty());
  return EXIT_SUCCESS;
}

/** Two sheets, one over the other, each seen from its own side, or from the other one. */
int CheckViews()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkIntArray> views;
  views->SetName("Station");
  for (const double height : { 0.4, -0.4 })
  {
    const auto sheet = Sheet(height);
    for (vtkIdType i = 0; i < sheet->GetNumberOfPoints(); ++i)
    {
      points->InsertNextPoint(sheet->GetPoint(i));
      views->InsertNextValue(i % 10 == 0 ? -3 : (height > 0.0 ? 1 : 0));
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(views);
  const auto upperLooksUp = [](vtkPolyData* mesh, bool isUp)
  {
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const double z = mesh->GetPointData()->GetNormals()->GetComponent(i, 2);
      if ((mesh->GetPoint(i)[2] * z > 0.0) != isUp)
      {
        return false;
      }
    }
    return mesh->GetNumberOfPoints() > 0;
  };
  const auto fromBothSides = [](auto* filter)
  {
    filter->AddViewpoint(0.0, 0.0, 5.0);
    filter->AddViewpoint(0.1, 0.0, -5.0);
  };
  // Without views it counts what is seen.
  const Outcome seen = Run(cloud, fromBothSides);
  CHECK(seen.Errors == 0 && seen.Warnings == 0 && upperLooksUp(seen.Mesh, true));
  const auto byStations = [&](auto* filter)
  {
    fromBothSides(filter);
    filter->SetViewArrayName("Station");
  };
  const Outcome swapped = Run(cloud, byStations);
  CHECK(swapped.Errors == 0 && swapped.Warnings == 0 && upperLooksUp(swapped.Mesh, false));

  // The input may bring all of it.
  auto places = Constant<vtkDoubleArray>("Viewpoints", 2, { 0, 0, 5 });
  places->SetTuple3(1, 0.0, 0.0, -5.0);
  cloud->GetFieldData()->AddArray(places);
  CHECK(upperLooksUp(Run(cloud).Mesh, true));
  views->SetName("View");
  views->Modified();
  cloud->Modified();
  CHECK(upperLooksUp(Run(cloud).Mesh, false));

  const Outcome missing = Run(cloud, byStations);
  CHECK(
    missing.Errors > 0 && missing.Text.find("called Station for the views") != std::string::npos);
  views->SetName("Station");
  views->SetNumberOfTuples(12);
  CHECK(Run(cloud, byStations).Errors > 0);
  return EXIT_SUCCESS;
}

int CheckUselessViewpoints()
{
  const Outcome outcome =
    Run(Sheet(), [](auto* filter) { filter->SetViewpoint(NotANumber, 0.0, 1.0); });
  CHECK(IsUnknown(outcome) && outcome.Warnings == 1);
  CHECK(outcome.Text.find("viewpoints determine no side") != std::string::npos);
  const auto sheet = Sheet();
  sheet->GetFieldData()->AddArray(Constant<vtkDoubleArray>("Viewpoints", 3, { 0, 1 }));
  CHECK(IsUnknown(Run(sheet)) && Run(sheet).Warnings == 1);
  return EXIT_SUCCESS;
}

/** In place, too. */
int CheckFile()
{
  for (const float side : { 1.f, -1.f })
  {
    const char* const name = "TestNeuralMeshOrientation.ply";
    {
      std::ofstream file(name, std::ios::binary);
      const auto sheet = Sheet();
      file << "ply\nformat binary_little_endian 1.0\nelement vertex " << sheet->GetNumberOfPoints()
           << "\nproperty float nx\nproperty float x\nproperty float y\nproperty float ny\n"
              "property float z\nproperty float nz\nend_header\n";
      for (vtkIdType i = 0; i < sheet->GetNumberOfPoints(); ++i)
      {
        const double* point = sheet->GetPoint(i);
        const std::array<float, 6> record{ 0.f, static_cast<float>(point[0]),
          static_cast<float>(point[1]), 0.f, static_cast<float>(point[2]), side };
        file.write(reinterpret_cast<const char*>(record.data()), sizeof record);
      }
    }
    vtkNew<vtkNeuralMesh> filter;
    filter->SetNumberOfVertices(200);
    filter->SetPointFileName(name);
    filter->Update();
    CHECK(OrientedBy(filter->GetOutput()) == "normals");
    CHECK(ShareUpwards(filter->GetOutput()) == (side > 0.f ? 1.0 : 0.0));
    filter->UseNormalsOff();
    filter->Update();
    CHECK(OrientedBy(filter->GetOutput()) == "nothing");
    filter->UseNormalsOn();
    filter->SetNormalArrayName("Directions");
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(filter);
    filter->Update();
    CHECK(messages->Errors > 0);
    CHECK(messages->AllText.find("Arrays with three components: Normals.") != std::string::npos);
    std::remove(name);
  }
  return EXIT_SUCCESS;
}

/** Points know the viewpoint that was there when they came. */
int CheckStream()
{
  const auto share = [](const std::function<void(vtkNeuralMeshStream*)>& add)
  {
    vtkNew<vtkNeuralMeshStream> stream;
    stream->SetNumberOfVertices(200);
    add(stream);
    stream->Learn(20000);
    stream->Update();
    vtkPolyData* mesh = stream->GetOutput();
    return OrientedBy(mesh) == "nothing" ? NotANumber : ShareUpwards(mesh);
  };
  CHECK(std::isnan(share([](auto* stream) { stream->AddPoints(Sheet()); })));
  for (const double side : { 1.0, -1.0 })
  {
    const double expected = side > 0.0 ? 1.0 : 0.0;
    CHECK(share(
            [&](auto* stream)
            {
              stream->AddPoints(Sheet());
              stream->SetViewpoint(0.3, 0.0, 2.0 * side);
              stream->AddPoints(Sheet());
              stream->RemoveAllViewpoints();
            }) == expected);
    CHECK(share(
            [&](auto* stream)
            {
              stream->AddPoints(Sheet());
              stream->SetUpDirection(0.0, 0.0, side);
            }) == expected);
    CHECK(share(
            [&](auto* stream)
            {
              const auto sheet = Sheet();
              sheet->GetPointData()->SetNormals(
                Constant<vtkFloatArray>("Normals", sheet->GetNumberOfPoints(), { 0, 0.1, side }));
              stream->AddPoints(sheet);
              stream->UseNormalsOff();
              sheet->GetPointData()->SetNormals(Constant<vtkFloatArray>(
                "Normals", sheet->GetNumberOfPoints(), { 0, 0, -9 * side }));
              stream->AddPoints(sheet);
              stream->AddPoints(sheet);
            }) == expected);
    CHECK(share(
            [&](auto* stream)
            {
              const auto sheet = Sheet();
              sheet->GetPointData()->AddArray(Constant<vtkFloatArray>(
                "Directions", sheet->GetNumberOfPoints(), { 0, 0.1, side }));
              stream->SetNormalArrayName("Directions");
              stream->AddPoints(sheet);
            }) == expected);
    CHECK(share(
            [&](auto* stream)
            {
              stream->AddPoints(Sheet());
              stream->AddViewpoint(0.3, 0.0, 2.0 * side);
              stream->AddViewpoint(0.0, 0.2, 2.0 * side);
            }) == expected);
  }
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshOrientation(int, char*[])
{
  for (const auto check : { CheckVolume, CheckProperties, CheckNormals, CheckNamedNormals, CheckFit,
         CheckNormalProperties, CheckViews, CheckUselessViewpoints, CheckFile, CheckStream })
  {
    if (check() != EXIT_SUCCESS)
    {
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
