// SPDX-License-Identifier: BSD-3-Clause
// Promise: with Automatic on, the field data say which parameters were chosen and why, and the mesh is
// the one that these give when they are set by hand; the properties stay as they are. Without it no
// word of that is there. Whoever aborts while parameters are chosen gets a valid mesh at once.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkCallbackCommand.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include <string>

namespace
{
vtkStringArray* Words(vtkNeuralMesh* filter, const char* name)
{
  return vtkStringArray::SafeDownCast(filter->GetOutput()->GetFieldData()->GetAbstractArray(name));
}

void Abort(vtkObject* caller, unsigned long, void*, void*)
{
  static_cast<vtkNeuralMesh*>(caller)->SetAbortExecute(1);
}
}

int TestNeuralMeshAutomatic(int, char*[])
{
  const auto cloud = FilterTesting::SphereCloud(34000);
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(cloud);
  filter->SetNumberOfVertices(4500);
  filter->SetFidelityToDraft(); // too little
  CHECK(!filter->GetAutomatic());
  filter->Update();
  CHECK(!Words(filter, "ChosenParameters") && !Words(filter, "ReasonsOfChoice"));
  CHECK(filter->GetChoiceTime() == 0.0);

  filter->AutomaticOn();
  filter->Update();
  vtkStringArray* chosen = Words(filter, "ChosenParameters");
  CHECK(chosen && chosen->GetNumberOfValues() > 0);
  CHECK(Words(filter, "ReasonsOfChoice")->GetNumberOfValues() >= chosen->GetNumberOfValues());
  CHECK(
    filter->GetFidelity() == vtkNeuralMesh::DRAFT_FIDELITY && filter->GetFitSmoothness() == 0.0);
  CHECK(filter->GetChoiceTime() > 0.0);

  vtkNew<vtkNeuralMesh> byHand;
  byHand->SetInputData(cloud);
  byHand->SetNumberOfVertices(4500);
  byHand->SetFidelityToDraft();
  for (vtkIdType i = 0; i < chosen->GetNumberOfValues(); ++i)
  {
    const std::string text = chosen->GetValue(i);
    const std::string name = text.substr(0, text.find('='));
    const std::string value = text.substr(text.find('=') + 1);
    if (name == "Fidelity")
    {
      CHECK(value == "default" || value == "high");
      byHand->SetFidelity(
        value == "high" ? vtkNeuralMesh::HIGH_FIDELITY : vtkNeuralMesh::DEFAULT_FIDELITY);
    }
    else if (name == "FitSmoothness")
    {
      byHand->SetFitSmoothness(std::stod(value));
    }
    else
    {
      CHECK(name == "CurvatureDensity");
      byHand->SetCurvatureDensity(std::stod(value));
    }
  }
  byHand->Update();
  CHECK(FilterTesting::SameBytes(
    filter->GetOutput()->GetPoints()->GetData(), byHand->GetOutput()->GetPoints()->GetData()));

  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(Abort);
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Modified();
  filter->Update();
  CHECK(std::string(filter->GetStopReason()) == "cancelled");
  CHECK(filter->GetOutput()->GetNumberOfPoints() > 3);
  CHECK(Words(filter, "ChosenParameters")->GetNumberOfValues() == 0);
  return EXIT_SUCCESS;
}
