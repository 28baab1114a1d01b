// SPDX-License-Identifier: BSD-3-Clause
#include "SizeOptions.h"

#include "LearningParameters.h"
#include "LevelFiles.h"
#include "PropertyOptions.h"

#include "vtkNeuralMesh.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>

namespace
{
const std::string Automatic = "auto";
}

void SizeOptions::AddTo(CLI::App* command)
{
  vtkNew<vtkNeuralMesh> defaults;
  const auto vertices = NEURAL_MESH_NUMBERS(defaults, NumberOfVertices);
  this->Vertices = vertices.Default;
  this->Measure = defaults->GetToleranceMeasure();
  const auto toNumber = [vertices](std::string& text) -> std::string
  {
    if (text == Automatic)
    {
      text = "0";
      return {};
    }
    const std::string problem = NumberWithin(vertices.Minimum, vertices.Maximum)(text);
    return problem.empty() ? problem : problem + ", nor " + Automatic;
  };
  CLI::Option* const number = command
                                ->add_option("--vertices", this->Vertices,
                                  "Vertices of the mesh, " + Described(vertices) + "; " +
                                    Automatic + ": as many as the points support")
                                ->transform(CLI::Validator(toNumber, ""))
                                ->type_name("N|" + Automatic);
  AddLevelsOption(command, this->Levels, vertices.Minimum, vertices.Maximum);
  const double largest = defaults->GetToleranceMaxValue();
  const auto toLength = [this, largest](const std::string& text)
  {
    this->IsPercent = text.ends_with('%');
    const std::string digits = this->IsPercent ? text.substr(0, text.size() - 1) : text;
    const bool isNumber = CLI::detail::lexical_cast(digits, this->Tolerance);
    if (!isNumber || !(this->Tolerance > 0.0 && this->Tolerance <= largest))
    {
      throw CLI::ValidationError("--tolerance",
        text + " is no length above 0, to " + PlainNumber(largest) +
          ", with % behind it or without");
    }
  };
  CLI::Option* const tolerance =
    command
      ->add_option_function<std::string>("--tolerance", toLength,
        "Choose the fewest vertices with this distance to held-out points, without their noise. In "
        "units of INPUT, or with % in percent of the diagonal of its bounding box")
      ->type_name("LENGTH[%]")
      ->excludes(number)
      ->excludes("--levels");
  const std::vector<PropertyWord> measures{ { "rms", vtkNeuralMesh::ROOT_MEAN_SQUARE,
                                              "the root of the mean square" },
    { "99", vtkNeuralMesh::NINETY_NINE_PERCENT, "the distance that 99 % do not exceed" },
    { "largest", vtkNeuralMesh::LARGEST, "" } };
  AddChoice(command, "--tolerance-of", this->Measure, measures,
    "Which distance --tolerance limits; " + Described(measures, this->Measure))
    ->needs(tolerance);
}

void SizeOptions::Apply(vtkNeuralMesh* filter) const
{
  filter->SetNumberOfVertices(this->Levels.empty() ? this->Vertices : this->Levels.back());
  for (const vtkIdType level : this->Levels)
  {
    filter->AddLevel(level);
  }
  filter->SetTolerance(this->Tolerance);
  filter->SetToleranceIsPercent(this->IsPercent);
  filter->SetToleranceMeasure(this->Measure);
}

void SizeOptions::RequireSound(
  vtkNeuralMesh* filter, neuralmesh::BesideSize beside, bool isEstimated) const
{
  const neuralmesh::Parameters parameters = filter->GetRunParameters();
  RequireSoundLevels(this->Levels, parameters,
    { .firstMesh = beside.firstMesh,
      .checkpoint = beside.checkpoint,
      .automatic = beside.automatic });
  const std::string problem = neuralmesh::whyNoSize(parameters, beside);
  if (this->IsToBeFound() && !problem.empty())
  {
    throw UsageError(
      (this->Tolerance > 0.0 ? "--tolerance: " : "--vertices " + Automatic + ": ") + problem);
  }
  if (this->IsToBeFound() && isEstimated)
  {
    throw UsageError("--dry-run: the program estimates a run only for a given number of vertices");
  }
}

vtkIdType SizeOptions::GetMostVertices(vtkIdType points) const
{
  if (!this->Levels.empty())
  {
    return this->Levels.back();
  }
  return this->IsToBeFound() ? std::max<vtkIdType>(4, points / 2) : this->Vertices;
}

void PrintSizeChoice(vtkPolyData* mesh)
{
  auto* reasons = vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("Choice"));
  for (vtkIdType i = 0; reasons && i < reasons->GetNumberOfValues(); ++i)
  {
    std::printf("%-10s %s\n", i == 0 ? "how many" : "", reasons->GetValue(i).c_str());
  }
}
