// SPDX-License-Identifier: BSD-3-Clause
#include "LevelFiles.h"

#include "FieldNumber.h"
#include "LearningParameters.h"
#include "MeshWriter.h"

#include "vtkNeuralMesh.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>

namespace
{
/** Calls `use` with each of the smaller levels that are there, and with its file. */
void ForEachSmallerLevel(vtkNeuralMesh* filter, const std::string& output,
  const std::function<void(vtkPolyData*, const std::string&)>& use)
{
  std::vector<vtkIdType> levels;
  levels.reserve(static_cast<std::size_t>(filter->GetNumberOfLevels()));
  for (int number = 0; number < filter->GetNumberOfLevels(); ++number)
  {
    levels.push_back(filter->GetLevel(number));
  }
  const std::vector<std::string> paths = SmallerLevelPaths(output, levels);
  for (unsigned number = 0; number < paths.size(); ++number)
  {
    if (auto* mesh = vtkPolyData::SafeDownCast(filter->GetLevels()->GetBlock(number)))
    {
      use(mesh, paths[number]);
    }
  }
}
}

void AddLevelsOption(
  CLI::App* command, std::vector<vtkIdType>& levels, vtkIdType fewest, vtkIdType most)
{
  command
    ->add_option("--levels", levels,
      "Levels of detail: meshes of N1, N2, ... vertices in one run, instead of --vertices. The "
      "largest is OUTPUT. The others are beside it, such as OUTPUT_1000.vtp")
    ->type_name("N1,N2,...")
    ->delimiter(',')
    ->expected(1, CLI::detail::expected_max_vector_size - 1)
    ->allow_extra_args(false)
    ->check(CLI::Range(fewest, most))
    ->excludes("--vertices");
}

void RequireSoundLevels(const std::vector<vtkIdType>& levels,
  const neuralmesh::Parameters& parameters, const neuralmesh::BesideLevels& beside)
{
  const std::vector<std::uint64_t> sizes(levels.begin(), levels.end());
  const std::string problem = neuralmesh::whyNoLevels(sizes, parameters, beside);
  if (!sizes.empty() && !problem.empty())
  {
    throw UsageError("--levels: " + problem);
  }
}

std::vector<std::string> SmallerLevelPaths(
  const std::string& output, const std::vector<vtkIdType>& levels)
{
  const std::filesystem::path path(output);
  std::vector<std::string> result;
  for (std::size_t number = 0; number + 1 < levels.size(); ++number)
  {
    std::filesystem::path level = path;
    level.replace_filename(
      path.stem().string() + "_" + std::to_string(levels[number]) + path.extension().string());
    result.push_back(level.string());
  }
  return result;
}

void WriteSmallerLevels(vtkNeuralMesh* filter, const std::string& output, const MeshShift& shift)
{
  ForEachSmallerLevel(filter, output,
    [&](vtkPolyData* mesh, const std::string& path) { WriteMesh(mesh, path, shift); });
}

void PrintSmallerLevels(vtkNeuralMesh* filter, const std::string& output)
{
  ForEachSmallerLevel(filter, output,
    [](vtkPolyData* mesh, const std::string& path)
    {
      std::printf("level      %lld vertices, residual %.3g: %s\n",
        static_cast<long long>(mesh->GetNumberOfPoints()), FieldNumber(mesh, "Residual"),
        path.c_str());
    });
}
