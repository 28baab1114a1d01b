// SPDX-License-Identifier: BSD-3-Clause
#include "OrientationOptions.h"

#include "FieldNumber.h"
#include "LearningParameters.h"
#include "PointReader.h"

#include "vtkNeuralMesh.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace
{
/** X,Y,Z as an option has it. */
std::array<double, 3> PlaceOf(const std::string& option, const std::string& text)
{
  std::array<double, 3> place{};
  const char* next = text.data();
  const char* const end = next + text.size();
  bool isSound = true;
  for (std::size_t axis = 0; axis < place.size(); ++axis)
  {
    isSound = isSound && (axis == 0 || (next < end && *next++ == ','));
    const auto [behind, error] = std::from_chars(next, end, place[axis]);
    isSound = isSound && error == std::errc() && std::isfinite(place[axis]);
    next = behind;
  }
  if (!isSound || next != end)
  {
    throw UsageError(option + ": " + text + " is not X,Y,Z: three numbers, as 0.5,0,12");
  }
  return place;
}
}

void OrientationOptions::AddTo(CLI::App* command)
{
  CLI::Option* const viewpoint =
    command
      ->add_option("--viewpoint", this->Viewpoints,
        "Position of the scanner: the surface looks there. May be given several times, and "
        "replaces the viewpoints of INPUT. As many as INPUTs: one for each")
      ->type_name("X,Y,Z")
      ->take_all()
      ->allow_extra_args(false);
  command
    ->add_option("--views", this->ViewFile,
      "The positions of the scanner, one for each view, as the points of this file. Excludes "
      "--viewpoint")
    ->type_name("FILE")
    ->excludes(viewpoint);
  command
    ->add_option("--view-array", this->ViewArray,
      "With --views: the point array of INPUT with the number of the view of each point, from 0 "
      "on. Default: View. Without it, a view sees what nothing hides")
    ->type_name("ARRAY");
  command
    ->add_option("--normals", this->Normals,
      "The point array of INPUT with the normals; off: ignore normals. Default: the active ones, "
      "or Normals (nx, ny, nz of a .ply)")
    ->type_name("ARRAY|off");
  command
    ->add_option("--up", this->Up,
      "The up direction: most of an open surface looks there. --viewpoint is more reliable")
    ->type_name("X,Y,Z");
}

void OrientationOptions::Apply(vtkNeuralMesh* filter) const
{
  for (const std::string& viewpoint : this->Viewpoints)
  {
    filter->AddViewpoint(PlaceOf("--viewpoint", viewpoint).data());
  }
  if (!this->Up.empty())
  {
    const std::array<double, 3> up = PlaceOf("--up", this->Up);
    if (up == std::array<double, 3>{})
    {
      throw UsageError("--up: " + this->Up + " is no direction");
    }
    filter->SetUpDirection(up[0], up[1], up[2]);
  }
  if (!this->ViewArray.empty() && this->ViewFile.empty() && this->Viewpoints.empty())
  {
    throw UsageError("--view-array: this goes with --views or --viewpoint only");
  }
  filter->SetViewArrayName(this->ViewArray.c_str());
  if (this->Normals == "off")
  {
    filter->UseNormalsOff();
  }
  else
  {
    filter->SetNormalArrayName(this->Normals.c_str());
  }
  if (!this->ViewFile.empty())
  {
    const auto views = ReadPoints(this->ViewFile);
    if (views->GetNumberOfPoints() == 0)
    {
      throw std::runtime_error(this->ViewFile + ": there are no places in it");
    }
    for (vtkIdType view = 0; view < views->GetNumberOfPoints(); ++view)
    {
      filter->AddViewpoint(views->GetPoint(view));
    }
  }
}

void PrintSides(vtkPolyData* mesh)
{
  auto* by = vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("OrientedBy"));
  const double unknown = 100.0 * FieldNumber(mesh, "UnorientedShare");
  const double guessed = 100.0 * FieldNumber(mesh, "GuessedShare");
  std::printf("sides      %s", unknown > 50.0 ? "unknown" : ("by " + by->GetValue(0)).c_str());
  if (guessed > 50.0)
  {
    std::printf(", a guess");
  }
  if (unknown > 0.01 && unknown <= 50.0)
  {
    std::printf(", %.2g %% of the area unknown", unknown);
  }
  if (unknown > 50.0 || guessed > 50.0)
  {
    std::printf("%s --viewpoint or --up may determine them",
      unknown > 50.0 ? ", most looks up, along z, or to what stands on it;" : ";");
  }
  std::printf("\n");
}
