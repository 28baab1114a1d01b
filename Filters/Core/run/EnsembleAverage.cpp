// SPDX-License-Identifier: BSD-3-Clause
#include "run/EnsembleAverage.h"

#include "cloud/MeshBuilder.h"
#include "mesh/Simplification.h"
#include "start/Isosurface.h"

#include <vector>

namespace neuralmesh
{
namespace
{
/// The refined mesh has so many times the vertices of the average mesh, at least.
constexpr std::uint64_t VerticesPerAverageVertex = 4;
}

EnsembleAverage averageOf(
  const VoxelVotes& votes, const PointCloud& cloud, std::uint64_t numberOfVertices)
{
  EnsembleAverage result;
  const std::vector<std::uint8_t> solid = averageSolid(votes);
  result.agreement = agreement(votes, solid);
  if (result.agreement < EnsembleAverage::LeastAgreement)
  {
    return result;
  }
  const VoteField field = voteField(votes, solid);
  result.mesh = buildMesh(isosurface(votes.grid, field.values, field.level), cloud);
  simplify(*result.mesh, numberOfVertices / VerticesPerAverageVertex);
  return result;
}
}
