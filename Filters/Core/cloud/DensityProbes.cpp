// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/DensityProbes.h"

#include "cloud/NearestPoints.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace neuralmesh
{
namespace
{
constexpr std::size_t DensityProbeCount = 1000;
/// By so many points, whose number is known to a fifth then.
constexpr std::size_t PointsPerProbe = 32;
/// Of the logarithm of the density.
constexpr double FarthestOff = 2.;
}

double densityVarianceByChance() { return 2. / double(PointsPerProbe); }

double densityVarianceOfFarOff() { return FarthestOff * FarthestOff; }

Eigen::AlignedBox3d boundsOf(std::span<const DensityProbe> probes)
{
  Eigen::AlignedBox3d bounds;
  for (const DensityProbe& probe : probes)
  {
    bounds.extend(probe.place);
  }
  return bounds;
}

double densityVariance(std::vector<double>& values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = *middle;
  const double sum = std::accumulate(values.begin(), values.end(), 0.,
    [median](double before, double value)
    { return before + std::pow(std::min(std::abs(value - median), FarthestOff), 2); });
  return sum / double(values.size());
}

std::vector<DensityProbe> densityProbes(const Mesh& mesh, std::span<const Piece> pieces,
  const PointCloud& cloud, const Executor& executor)
{
  const NearestPoints nearest(cloud.points(), executor);
  const std::size_t triangles = mesh.triangleCount(),
                    count = std::min(DensityProbeCount, triangles);
  std::vector<DensityProbe> probes;
  std::array<NearPoint, PointsPerProbe> around;
  std::size_t passed = 0, picked = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (const VertexIndex v : pieces[i].vertices)
    {
      mesh.forEachTriangleFrom(v,
        [&](VertexIndex a, VertexIndex b, VertexIndex c)
        {
          // Spread over all of them.
          if (passed++ != (2 * picked + 1) * triangles / (2 * count))
          {
            return;
          }
          ++picked;
          const Eigen::Vector3d p = mesh.position(a).toDouble(), q = mesh.position(b).toDouble(),
                                r = mesh.position(c).toDouble();
          const Eigen::Vector3d place = (p + q + r) / 3.;
          const std::size_t found = nearest.findPlaces(Vector4(place), around);
          const double farthest = found > 0 ? double(around[found - 1].squaredDistance) : 0.;
          if (found == PointsPerProbe && farthest > 0.)
          {
            probes.push_back({ place, (q - p).cross(r - p).normalized(), i, -std::log(farthest) });
          }
        });
    }
  }
  return probes;
}
}
