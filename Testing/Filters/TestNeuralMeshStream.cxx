// SPDX-License-Identifier: BSD-3-Clause
// Promises: the output is the mesh of all points that have come, from points or datasets, fitted or
// not, with its arrays; the same calls give the same bytes; a reservoir may be smaller than what comes;
// without points it is empty; what a user must know of the mesh is warned of, and stands in the field data;
// what does not go together is an error; an abort is obeyed; Reset()
// forgets; values out of range are clamped.
#include "FilterTesting.h"

#include "vtkNeuralMeshStream.h"

#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <cmath>
#include <sstream>

namespace
{
vtkNew<vtkPolyData> Half(bool isUpper)
{
  const auto all = FilterTesting::SpherePoints(8000);
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
  {
    if ((all->GetPoint(i)[2] > 0.0) == isUpper)
    {
      points->InsertNextPoint(all->GetPoint(i));
    }
  }
  vtkNew<vtkPolyData> half;
  half->SetPoints(points);
  return half;
}

void Run(vtkNeuralMeshStream* stream)
{
  stream->SetNumberOfVertices(300);
  stream->AddPoints(Half(false));
  stream->Learn(20000);
  stream->AddPoints(Half(true)->GetPoints());
  stream->Learn(40000);
}

int CheckMesh()
{
  vtkNew<vtkNeuralMeshStream> stream;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(stream);
  messages->Observe(stream->GetExecutive());
  stream->Update();
  CHECK(stream->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(stream->Learn(1000) == 0);
  stream->Reset();
  Run(stream);
  CHECK(stream->GetNumberOfAddedPoints() == 8000);
  CHECK(stream->GetNumberOfBeginnings() == 2);
  CHECK(stream->GetNumberOfLearntVertices() == 300);
  stream->Update();
  vtkPolyData* mesh = stream->GetOutput();
  CHECK(mesh->GetNumberOfPoints() == 300);
  const auto report = FilterTesting::Manifold(mesh);
  CHECK(report.defect.empty() && report.isClosed() && report.components == 1);
  CHECK(FilterTesting::EulerCharacteristic(mesh) == 2);
  CHECK(mesh->GetBounds()[4] < -0.95 && mesh->GetBounds()[5] > 0.95);
  CHECK(mesh->GetPointData()->GetNormals() && mesh->GetPointData()->HasArray("Activity"));
  CHECK(FilterTesting::FieldValue(mesh, "NumberOfVertices") == 300);
  CHECK(FilterTesting::FieldValue(mesh, "Iterations") == 60000);
  CHECK(FilterTesting::FieldValue(mesh, "Points") == 8000);
  CHECK(FilterTesting::FieldValue(mesh, "DroppedPoints") == 0);
  CHECK(FilterTesting::FieldValue(mesh, "Beginnings") == 2);
  CHECK(FilterTesting::FieldValue(mesh, "Residual") > 0);
  CHECK(FilterTesting::FieldValue(mesh, "Genus") == 0);

  // Looking in between changes nothing; what is not finished is another mesh, without a report.
  vtkNew<vtkNeuralMeshStream> other;
  other->FinishOutputOff();
  other->SetNumberOfVertices(300);
  other->AddPoints(Half(false));
  other->Learn(20000);
  other->Update();
  CHECK(other->GetOutput()->GetNumberOfPoints() > 0);
  CHECK(!other->GetOutput()->GetFieldData()->HasArray("Residual"));
  other->AddPoints(Half(true));
  other->Learn(40000);
  other->Update();
  CHECK(!FilterTesting::SameBytes(
    other->GetOutput()->GetPoints()->GetData(), mesh->GetPoints()->GetData()));
  other->FinishOutputOn();
  other->Update();
  CHECK(FilterTesting::SameBytes(
    other->GetOutput()->GetPoints()->GetData(), mesh->GetPoints()->GetData()));

  other->Reset();
  CHECK(other->GetNumberOfAddedPoints() == 0 && other->GetNumberOfLearntSamples() == 0);
  other->Update();
  CHECK(other->GetOutput()->GetNumberOfPoints() == 0);
  other->SetReservoirSize(2000);
  Run(other);
  other->Update();
  CHECK(other->GetNumberOfAddedPoints() == 8000);
  CHECK(other->GetOutput()->GetNumberOfPoints() == 300);
  CHECK(messages->Errors == 0 && messages->Warnings == 0);
  return EXIT_SUCCESS;
}

/// What is finished without a fit is measured all the same; noise is not known then.
int CheckUnfitted()
{
  vtkNew<vtkNeuralMeshStream> stream;
  stream->SetFitRounds(0);
  Run(stream);
  stream->Update();
  vtkPolyData* mesh = stream->GetOutput();
  CHECK(mesh->GetNumberOfPoints() > 0);
  for (const char* name : { "Residual", "OutlierShare", "Components", "Genus", "BoundaryLoops" })
  {
    CHECK(mesh->GetFieldData()->HasArray(name));
    CHECK(std::isfinite(FilterTesting::FieldValue(mesh, name)));
  }
  CHECK(std::isnan(FilterTesting::FieldValue(mesh, "Noise")));
  stream->FinishOutputOff();
  stream->Update();
  CHECK(!stream->GetOutput()->GetFieldData()->HasArray("Residual"));
  return EXIT_SUCCESS;
}

int CheckWarnings()
{
  vtkNew<vtkNeuralMeshStream> stream;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(stream);
  stream->SetNumberOfVertices(300);
  stream->AddPoints(FilterTesting::SpherePoints(400));
  stream->Learn(60000);
  stream->Update();
  const auto warningsOf = [](vtkPolyData* mesh)
  { return vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("Warnings")); };
  vtkPolyData* mesh = stream->GetOutput();
  CHECK(warningsOf(mesh) && warningsOf(mesh)->GetNumberOfValues() == messages->Warnings);
  CHECK(messages->Warnings > 0);
  CHECK(warningsOf(mesh)->GetValue(0).find("finer than its data") != std::string::npos);
  CHECK(FilterTesting::FieldValue(mesh, "UnexplainedShare") < 0.01);

  vtkNew<vtkNeuralMeshStream> coarser;
  Run(coarser);
  coarser->Update();
  CHECK(warningsOf(coarser->GetOutput())->GetNumberOfValues() == 0);
  return EXIT_SUCCESS;
}

int CheckErrors()
{
  vtkNew<vtkNeuralMeshStream> stream;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(stream);
  for (const auto& spoil : { +[](vtkNeuralMeshStream* s) { s->SetVariantToBasic(); },
         +[](vtkNeuralMeshStream* s) { s->SetOrderToList(); },
         +[](vtkNeuralMeshStream* s) { s->TopologyLearningOn(); },
         +[](vtkNeuralMeshStream* s) { s->ComputeFeatureStrengthOn(); } })
  {
    messages->Errors = 0;
    spoil(stream);
    stream->AddPoints(Half(true));
    CHECK(stream->Learn(1000) == 0);
    CHECK(messages->Errors == 2);
    CHECK(messages->LastText.find("noise-filtering") != std::string::npos);
    stream->SetVariantToNoiseFiltering();
    stream->SetOrderToExact();
    stream->TopologyLearningOff();
    stream->ComputeFeatureStrengthOff();
  }
  stream->AddPoints(Half(true));
  CHECK(stream->Learn(1000) == 1000);

  stream->SetNumberOfVertices(3);
  stream->SetSeed(-1);
  stream->SetReservoirSize(99);
  CHECK(messages->Warnings == 3);
  CHECK(stream->GetNumberOfVertices() == 4 && stream->GetSeed() == 0);
  CHECK(stream->GetReservoirSize() == 100);
  std::ostringstream text;
  stream->Print(text);
  for (const char* property : { "NumberOfVertices: 4", "Seed: 0", "ReservoirSize: 100",
         "FinishOutput: 1", "NumberOfAddedPoints: ", "NumberOfDroppedPoints: 0",
         "NumberOfLearntSamples: 1000", "NumberOfLearntVertices: ", "NumberOfBeginnings: 1" })
  {
    CHECK(text.str().find(property) != std::string::npos);
  }
  return EXIT_SUCCESS;
}

/** Aborts at each progress. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
  }
};

int CheckEnds()
{
  vtkNew<vtkNeuralMeshStream> stream;
  Run(stream);
  CHECK(stream->LearnForSeconds(0.01) > 0);
  vtkNew<Aborter> aborter;
  const unsigned long tag = stream->AddObserver(vtkCommand::ProgressEvent, aborter);
  CHECK(stream->Learn(1000000000) < 1000000000);
  CHECK(stream->GetAbortExecute() == 0);
  stream->RemoveObserver(tag);
  CHECK(stream->Learn(1000) == 1000);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshStream(int, char*[])
{
  CHECK(CheckMesh() == EXIT_SUCCESS);
  CHECK(CheckUnfitted() == EXIT_SUCCESS);
  CHECK(CheckWarnings() == EXIT_SUCCESS);
  CHECK(CheckErrors() == EXIT_SUCCESS);
  CHECK(CheckEnds() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
