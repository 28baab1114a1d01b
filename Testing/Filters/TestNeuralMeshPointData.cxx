// SPDX-License-Identifier: BSD-3-Clause
// Promise: the point data of the input arrives on the mesh, each array with its name and type: real
// numbers and colours fitted, all else by vote; with the active scalars, and without what is not
// data of the surface.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>

namespace
{
constexpr int Points = 20000;
constexpr int Vertices = 500;

/** An array with the values that `fill(array, tuple, coordinates)` sets, one for each point. */
template <typename ArrayT, typename FillT>
vtkNew<ArrayT> MakeArray(vtkPolyData* cloud, const char* name, int components, const FillT& fill)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    fill(array, i, p);
  }
  return array;
}

void AddColors(vtkPolyData* cloud)
{
  cloud->GetPointData()->SetScalars(MakeArray<vtkUnsignedCharArray>(cloud, "RGB", 3,
    [](auto& array, vtkIdType i, const double* p)
    { array->SetTuple3(i, p[2] > 0 ? 255 : 0, 127.5 + 127.0 * p[0], 40); }));
}

vtkNew<vtkNeuralMesh> Run(vtkDataObject* input)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(Vertices);
  filter->SetInputDataObject(input);
  filter->Update();
  return filter;
}

int CheckFitted()
{
  const auto cloud = FilterTesting::SphereCloud(Points);
  AddColors(cloud);
  auto position = MakeArray<vtkDoubleArray>(
    cloud, "Position", 3, [](auto& array, vtkIdType i, const double* p) { array->SetTuple(i, p); });
  position->SetComponentName(1, "second");
  cloud->GetPointData()->AddArray(position);
  cloud->GetPointData()->AddArray(MakeArray<vtkFloatArray>(cloud, "Constant", 1,
    [](auto& array, vtkIdType i, const double*) { array->SetValue(i, 0.1f); }));
  cloud->GetPointData()->AddArray(MakeArray<vtkDoubleArray>(cloud, "Time", 1,
    [](auto& array, vtkIdType i, const double*) { array->SetValue(i, 1.6e9 + 1.0 / 3.0); }));
  cloud->GetPointData()->AddArray(MakeArray<vtkDoubleArray>(cloud, "Many", 6,
    [](auto& array, vtkIdType i, const double* p)
    {
      for (int component = 0; component < 6; ++component)
      {
        array->SetComponent(i, component, component * p[0]);
      }
    }));
  const auto filter = Run(cloud);
  vtkPolyData* mesh = filter->GetOutput();
  vtkPointData* data = mesh->GetPointData();
  auto* positions = vtkDoubleArray::SafeDownCast(data->GetArray("Position"));
  auto* constants = vtkFloatArray::SafeDownCast(data->GetArray("Constant"));
  auto* times = vtkDoubleArray::SafeDownCast(data->GetArray("Time"));
  auto* many = vtkDoubleArray::SafeDownCast(data->GetArray("Many"));
  auto* colors = vtkUnsignedCharArray::SafeDownCast(data->GetArray("RGB"));
  CHECK(positions && constants && times && many && colors);
  CHECK(positions->GetNumberOfComponents() == 3 && many->GetNumberOfComponents() == 6);
  CHECK(std::string(positions->GetComponentName(1)) == "second");
  CHECK(data->GetScalars() == colors && colors->GetNumberOfComponents() == 3);
  for (vtkIdType v = 0; v < Vertices; ++v)
  {
    double p[3];
    mesh->GetPoint(v, p);
    for (int axis = 0; axis < 3; ++axis)
    {
      CHECK(std::abs(positions->GetComponent(v, axis) - p[axis]) < 0.03);
    }
    CHECK(constants->GetValue(v) == 0.1f && times->GetValue(v) == 1.6e9 + 1.0 / 3.0);
    CHECK(std::abs(many->GetComponent(v, 5) - 5.0 * p[0]) < 0.15);
    CHECK(std::abs(many->GetComponent(v, 5) - 5.0 * many->GetComponent(v, 1)) < 1e-3);
    // A jump: it is over within three edges of about 0.17.
    CHECK(p[2] < 0.5 || colors->GetComponent(v, 0) > 250);
    CHECK(p[2] > -0.5 || colors->GetComponent(v, 0) < 5);
    CHECK(std::abs(colors->GetComponent(v, 1) - 127.5 - 127.0 * p[0]) < 5.0);
    CHECK(colors->GetComponent(v, 2) == 40);
  }
  return EXIT_SUCCESS;
}

int CheckVoted()
{
  // Numbers that no double tells apart, tuples, and strings.
  constexpr long long Large = (1LL << 60) + 1;
  const auto cloud = FilterTesting::SphereCloud(Points);
  cloud->GetPointData()->AddArray(MakeArray<vtkLongLongArray>(cloud, "Large", 1,
    [](auto& array, vtkIdType i, const double* p)
    { array->SetValue(i, p[2] > 0 ? Large : Large + 1); }));
  cloud->GetPointData()->AddArray(MakeArray<vtkIntArray>(cloud, "Pair", 2,
    [](auto& array, vtkIdType i, const double* p)
    { p[2] > 0 ? array->SetTuple2(i, 1, 2) : array->SetTuple2(i, 3, 4); }));
  cloud->GetPointData()->AddArray(MakeArray<vtkStringArray>(cloud, "Label", 1,
    [](auto& array, vtkIdType i, const double* p)
    { array->SetValue(i, p[2] > 0 ? "upper" : "lower"); }));
  const auto filter = Run(cloud);
  vtkPolyData* mesh = filter->GetOutput();
  vtkPointData* data = mesh->GetPointData();
  auto* large = vtkLongLongArray::SafeDownCast(data->GetArray("Large"));
  auto* pairs = vtkIntArray::SafeDownCast(data->GetArray("Pair"));
  auto* labels = vtkStringArray::SafeDownCast(data->GetAbstractArray("Label"));
  CHECK(large && pairs && labels && pairs->GetNumberOfComponents() == 2);
  for (vtkIdType v = 0; v < Vertices; ++v)
  {
    double p[3];
    mesh->GetPoint(v, p);
    const bool isUpper = labels->GetValue(v) == "upper";
    CHECK(isUpper || labels->GetValue(v) == "lower");
    CHECK(large->GetValue(v) == (isUpper ? Large : Large + 1));
    CHECK(pairs->GetComponent(v, 0) == (isUpper ? 1 : 3));
    CHECK(pairs->GetComponent(v, 1) == (isUpper ? 2 : 4));
    CHECK(std::abs(p[2]) < 0.1 || isUpper == (p[2] > 0));
  }
  return EXIT_SUCCESS;
}

int CheckNotFinite()
{
  // Some points without a value do no harm; where none has one there is none.
  const auto cloud = FilterTesting::SphereCloud(Points);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cloud->GetPointData()->AddArray(MakeArray<vtkDoubleArray>(cloud, "Some", 1,
    [=](auto& array, vtkIdType i, const double*) { array->SetValue(i, i % 3 == 0 ? nan : 2.0); }));
  cloud->GetPointData()->AddArray(MakeArray<vtkDoubleArray>(cloud, "Half", 1,
    [=](auto& array, vtkIdType i, const double* p) { array->SetValue(i, p[0] > 0 ? nan : 2.0); }));
  cloud->GetPointData()->AddArray(MakeArray<vtkFloatArray>(cloud, "None", 1,
    [=](auto& array, vtkIdType i, const double*)
    { array->SetValue(i, std::numeric_limits<float>::infinity()); }));
  const auto filter = Run(cloud);
  vtkPolyData* mesh = filter->GetOutput();
  vtkPointData* data = mesh->GetPointData();
  for (vtkIdType v = 0; v < Vertices; ++v)
  {
    double p[3];
    mesh->GetPoint(v, p);
    CHECK(data->GetArray("Some")->GetTuple1(v) == 2.0);
    CHECK(std::isnan(data->GetArray("None")->GetTuple1(v)));
    CHECK(p[0] > -0.01 || data->GetArray("Half")->GetTuple1(v) == 2.0);
    CHECK(p[0] < 0.2 || std::isnan(data->GetArray("Half")->GetTuple1(v)));
  }
  return EXIT_SUCCESS;
}

int CheckNames()
{
  const auto cloud = FilterTesting::SphereCloud(Points);
  const auto normals = MakeArray<vtkFloatArray>(cloud, "Normals", 3,
    [](auto& array, vtkIdType i, const double* p)
    { array->SetTuple3(i, 5.0 * p[0], 5.0 * p[1], 5.0 * p[2]); });
  const auto ids = MakeArray<vtkIdTypeArray>(
    cloud, "Ids", 1, [](auto& array, vtkIdType i, const double*) { array->SetValue(i, i); });
  const auto pedigree = MakeArray<vtkIdTypeArray>(
    cloud, "Pedigree", 1, [](auto& array, vtkIdType i, const double*) { array->SetValue(i, i); });
  const auto ghosts = MakeArray<vtkUnsignedCharArray>(cloud, vtkDataSetAttributes::GhostArrayName(),
    1, [](auto& array, vtkIdType i, const double*) { array->SetValue(i, 0); });
  vtkPointData* data = cloud->GetPointData();
  data->SetNormals(normals);
  data->SetGlobalIds(ids);
  data->SetPedigreeIds(pedigree);
  data->AddArray(ghosts);
  const auto filter = Run(cloud);
  vtkPointData* output = filter->GetOutput()->GetPointData();
  CHECK(output->GetNumberOfArrays() == 5);
  for (const char* own : { "Normals", "Activity", "Boundary", "Residual", "Support" })
  {
    CHECK(output->HasArray(own));
  }
  // Normals of the mesh, not those of the points, which are longer.
  CHECK(std::abs(vtkMath::Norm(output->GetNormals()->GetTuple(0)) - 1.0) < 1e-5);

  // As mere data, the same array is one of several that have names of the output's own.
  data->SetActiveNormals(nullptr);
  for (const char* name : { "Activity", "FeatureStrength", "Uncertainty" })
  {
    data->AddArray(MakeArray<vtkDoubleArray>(
      cloud, name, 1, [](auto& array, vtkIdType i, const double*) { array->SetValue(i, -7.0); }));
  }
  const auto again = Run(cloud);
  output = again->GetOutput()->GetPointData();
  CHECK(output->GetNumberOfArrays() == 9);
  CHECK(output->GetArray("Uncertainty_Input")->GetTuple1(0) == -7.0);
  CHECK(output->GetArray("Activity")->GetTuple1(0) >= 0.0);
  CHECK(output->GetArray("Activity_Input")->GetTuple1(0) == -7.0);
  CHECK(output->GetArray("FeatureStrength_Input")->GetTuple1(0) == -7.0);
  CHECK(vtkMath::Norm(output->GetArray("Normals_Input")->GetTuple(0)) > 2.0);
  CHECK(output->GetNormals() == output->GetArray("Normals"));

  again->CarryPointDataOff();
  again->Update();
  CHECK(again->GetOutput()->GetPointData()->GetNumberOfArrays() == 5);
  return EXIT_SUCCESS;
}

int CheckComposite()
{
  // What all blocks with points have in the same type; ghosts and NaN in between shift indices.
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int block = 0; block < 2; ++block)
  {
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(
      FilterTesting::SpherePoints(Points / 2, 1.0, { block == 0 ? -2.0 : 2.0, 0, 0 }));
    AddColors(cloud);
    vtkPointData* data = cloud->GetPointData();
    auto position = MakeArray<vtkDoubleArray>(cloud, "Position", 3,
      [](auto& array, vtkIdType i, const double* p) { array->SetTuple(i, p); });
    auto ghosts = MakeArray<vtkUnsignedCharArray>(cloud, vtkDataSetAttributes::GhostArrayName(), 1,
      [](auto& array, vtkIdType i, const double*)
      { array->SetValue(i, i % 4 == 1 ? vtkDataSetAttributes::DUPLICATEPOINT : 0); });
    for (vtkIdType i = 0; i < Points / 2; i += 4)
    {
      cloud->GetPoints()->SetPoint(i, std::numeric_limits<double>::quiet_NaN(), 0, 0);
      position->SetTuple3(i + 1, 99, 99, 99);
    }
    data->AddArray(position);
    data->AddArray(ghosts);
    data->AddArray(MakeArray<vtkIntArray>(cloud, "Block", 1,
      [=](auto& array, vtkIdType i, const double*) { array->SetValue(i, block); }));
    data->AddArray(MakeArray<vtkIntArray>(cloud, block == 0 ? "Left" : "Right", 1,
      [](auto& array, vtkIdType i, const double*) { array->SetValue(i, 0); }));
    data->AddArray(MakeArray<vtkIntArray>(cloud, "Mixed", 1 + block,
      [](auto& array, vtkIdType i, const double*) { array->SetComponent(i, 0, 0); }));
    blocks->SetBlock(static_cast<unsigned>(block), cloud);
  }
  blocks->SetBlock(2, vtkNew<vtkPolyData>());
  const auto filter = Run(blocks);
  vtkPolyData* mesh = filter->GetOutput();
  vtkPointData* data = mesh->GetPointData();
  CHECK(data->HasArray("Position") && data->HasArray("Block"));
  CHECK(data->GetScalars() && data->GetScalars() == data->GetArray("RGB"));
  CHECK(data->GetNumberOfArrays() == 8); // with Normals, Activity, Boundary, Residual and Support
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    double p[3];
    mesh->GetPoint(v, p);
    CHECK(std::abs(data->GetArray("Position")->GetComponent(v, 0) - p[0]) < 0.1);
    CHECK(data->GetArray("Block")->GetTuple1(v) == (p[0] > 0.0 ? 1 : 0));
  }
  return EXIT_SUCCESS;
}

int CheckReproducible()
{
  const auto cloud = FilterTesting::SphereCloud(Points);
  AddColors(cloud);
  const auto plain = FilterTesting::SphereCloud(Points);
  const auto first = Run(cloud), second = Run(cloud), without = Run(plain);
  // Data does not change the mesh, nor does it differ from run to run.
  for (vtkIdType v = 0; v < Vertices; ++v)
  {
    double p[3], q[3];
    first->GetOutput()->GetPoint(v, p);
    without->GetOutput()->GetPoint(v, q);
    CHECK(std::equal(p, p + 3, q));
  }
  auto* a = vtkUnsignedCharArray::SafeDownCast(first->GetOutput()->GetPointData()->GetScalars());
  auto* b = vtkUnsignedCharArray::SafeDownCast(second->GetOutput()->GetPointData()->GetScalars());
  CHECK(a && b);
  CHECK(std::equal(a->GetPointer(0), a->GetPointer(3 * Vertices), b->GetPointer(0)));
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshPointData(int, char*[])
{
  CHECK(CheckFitted() == EXIT_SUCCESS);
  CHECK(CheckVoted() == EXIT_SUCCESS);
  CHECK(CheckNotFinite() == EXIT_SUCCESS);
  CHECK(CheckNames() == EXIT_SUCCESS);
  CHECK(CheckComposite() == EXIT_SUCCESS);
  CHECK(CheckReproducible() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
