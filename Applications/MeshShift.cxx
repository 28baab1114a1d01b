// SPDX-License-Identifier: BSD-3-Clause
#include "MeshShift.h"

#include "cloud/PlyContents.h"
#include "LearningParameters.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <cstdio>

void AddShiftOption(CLI::App* command, std::string& text)
{
  command
    ->add_option("--shift", text,
      "Subtract this from the coordinates of OUTPUT, and store it there. auto: a round vector if "
      "they are too large for floats")
    ->type_name("auto|X,Y,Z");
}

MeshShift ParseShift(const std::string& text)
{
  MeshShift shift;
  if (text.empty())
  {
    return shift;
  }
  shift.IsAutomatic = text == "auto";
  const char* place = text.data();
  const char* const end = place + text.size();
  for (std::size_t axis = 0; axis < 3 && !shift.IsAutomatic; ++axis)
  {
    double& number = shift.Vector[axis];
    const auto [next, error] = std::from_chars(place, end, number);
    const bool isLast = axis == 2;
    const bool isFollowed = isLast ? next == end : next != end && *next == ',';
    if (error != std::errc() || !std::isfinite(number) || !isFollowed)
    {
      throw UsageError("--shift: " + text + " is neither auto nor X,Y,Z");
    }
    place = isLast ? next : next + 1;
  }
  return shift;
}

void PrintShift(const std::array<double, 3>& shift, const std::string& path)
{
  const Eigen::Vector3d vector(shift.data());
  if (vector.isZero(0.0))
  {
    std::printf("shift      none\n");
    return;
  }
  const std::string comment = neuralmesh::commentOfShift(vector);
  std::printf("shift     %s, to be added to the coordinates of %s\n",
    comment.substr(comment.find(' ')).c_str(), path.c_str());
}
