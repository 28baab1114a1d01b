// SPDX-License-Identifier: BSD-3-Clause
#include "run/EnsembleAverage.h"

#include "cloud/MeshBuilder.h"
#include "mesh/Simplification.h"

#include <vector>

namespace neuralmesh
{
namespace
{
/// The refined mesh has so many times the vertices of the average mesh, at least.
constexpr std::uint64_t VerticesPerAverageVertex = 4;
}

EnsembleAverage averageOf(const VoxelVotes& votes, const PointCloud& cloud,
  std::uint64_t numberOfVertices, const Isosurface& isosurface)
{
  EnsembleAverage result;
  const std::vector<std::uint8_t> solid = averageSolid(votes);
  result.agreement = agreement(votes, solid);
  if (result.agreement < EnsembleAverage::LeastAgreement)
  {
    return result;
  }
  TriangleMesh surface = isosurface(voteField(votes, solid), votes.grid);
  for (Eigen::Vector3d& point : surface.points)
  {
    point = votes.grid.first + votes.grid.width * point;
  }
  result.mesh = buildMesh(surface, cloud);
  simplify(*result.mesh, numberOfVertices / VerticesPerAverageVertex);
  return result;
}
}
