// SPDX-License-Identifier: BSD-3-Clause
// How smooth the surface is to be: the choice of lambda.
#include "fit/SurfaceFit.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
constexpr double FirstSmoothness = 1000.;
constexpr double MostSmoothness = 1e4;
/// A bit more: too rough a surface would follow the noise all the way.
constexpr double SmoothnessFactor = 1.1;
constexpr int MostChoices = 8;
/// It is found if it changes by no more than that.
constexpr double NearPart = 0.85;
/// A learnt mesh follows noise, so the surface is farther from the samples, but not so many times. Beyond,
/// what is narrow has shrunk, and passes for noise: then lambda is a tenth at most.
constexpr double MostGrowthByNoise = 2.;
constexpr double PartIfShrunk = 0.1;
/// Of the residual of the equations, against that at the start.
constexpr double ToleranceOfChoice = 1e-2;
}

/// With Gaussian noise of variance s^2 and a surface whose L x has the variance r^2 across it, the
/// most probable positions are those for lambda = s^2 / r^2. Both are measured, beginning with a
/// smooth surface: on a rough one, noise would pass for shape.
bool SurfaceFit::chooseSmoothness(const Progress& progress)
{
  smoothness_ = FirstSmoothness;
  double most = MostSmoothness;
  const double mostVariance = MostGrowthByNoise * MostGrowthByNoise * meanSquaredDistance();
  std::vector<Vector4> positions(mesh_.positions().begin(), mesh_.positions().end());
  for (int i = 0; i < MostChoices; ++i)
  {
    double scale = 0.;
    if (!system_->solve(smoothness_, ToleranceOfChoice, scale, positions,
          partOf(progress, double(i) / MostChoices, double(i + 1) / MostChoices)))
    {
      return false;
    }
    const double rough = roughness(positions);
    const double variance = residualVariance(positions, smoothness_);
    const double ratio = rough > 0. ? variance / rough : MostSmoothness;
    const double before = smoothness_;
    const double next = SmoothnessFactor * ratio;
    const bool isNear = next > NearPart * before;
    const bool isShrunk = isNear && variance > mostVariance && before > LeastSmoothness;
    most = isShrunk ? std::max(PartIfShrunk * before, LeastSmoothness) : most;
    // From far away it falls further yet.
    smoothness_ =
      std::clamp(isNear ? next : next * std::sqrt(next / before), LeastSmoothness, most);
    if (isNear && !isShrunk)
    {
      break;
    }
  }
  return true;
}

double SurfaceFit::meanSquaredDistance() const
{
  const double sum = executor_.sum(samples_.size(), SamplesPerRange,
    [this](std::size_t i) { return isUsed(i) ? double(places_[i].squaredDistance) : 0.; });
  return sum / double(std::max<std::size_t>(1, usedCount_));
}

double SurfaceFit::residualVariance(std::span<const Vector4> positions, double lambda) const
{
  const auto squaredDistance = [&](std::size_t i)
  {
    const PlaceOnMesh& place = places_[i];
    if (!isUsed(i))
    {
      return 0.;
    }
    const Vector4 normal = normalAt(place, positions);
    const Vector4 offset = samples_[i] - positions[place.triangle[0]];
    const float across = dot(offset, normal);
    const float squared = squaredNorm(normal);
    const float distance = squared > 0.f ? across * across / squared : squaredNorm(offset);
    // Where points are sparse the mesh may be farther off than any noise.
    const float most = outlierDistance_ * outlierDistance_;
    return double(weight(i)) *
      double(place.squaredDistance > most ? std::min(most, distance) : distance);
  };
  const double sum = executor_.sum(samples_.size(), SamplesPerRange, squaredDistance);
  // Vertices follow noise, the less the smoother they are held: so many of them do (a curve through
  // traces of the solution, measured for 2 to 20 samples a vertex).
  const auto vertices = double(positions.size());
  const auto samples = double(std::max<std::size_t>(1, usedCount_));
  const double followers = vertices / (1. + std::pow(2. * lambda * vertices / samples, 0.75));
  return sum / std::max(0.25 * samples, samples - followers);
}

double SurfaceFit::roughness(std::span<const Vector4> positions) const
{
  std::vector<Vector4> laplacian(positions.size());
  system_->applyLaplacian(positions, laplacian);
  const auto squaredAcross = [&](std::size_t vertex)
  {
    const auto v = VertexIndex(vertex);
    const Ring& ring = mesh_.ring(v);
    Vector4 normal;
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      normal += cross(
        positions[ring[slot]] - positions[v], positions[ring[ring.after(slot)]] - positions[v]);
    }
    const float across = dot(laplacian[v], normal);
    const float squared = squaredNorm(normal);
    return squared > 0.f ? double(across * across / squared) : 0.;
  };
  return executor_.sum(positions.size(), VerticesPerRange, squaredAcross) /
    double(positions.size());
}
}
