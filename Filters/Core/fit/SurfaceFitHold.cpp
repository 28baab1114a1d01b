// SPDX-License-Identifier: BSD-3-Clause
// Vertices that stay where they are, as samples would be lost otherwise.
#include "fit/SurfaceFit.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// A sample is lost if it is farther from the mesh than so many median distances, and than so many
/// local distances between samples. The latter limit is below that of FitGuard, which counts points
/// as missed beyond three distances.
constexpr float LostMedians = 10.f;
constexpr float LostSpacings = 2.5f;
/// A vertex stays if more than this part of the samples around it would be lost. Where samples are
/// not sparse, more than so many must be lost: single ones are outliers that have attracted the
/// mesh.
constexpr float LeastLostPart = 0.05f;
constexpr float LeastLost = 2.f;
constexpr int MostHolds = 4;
/// A vertex must not be farther from the surface than so many deviations of the samples about the
/// mesh.
constexpr double OvershotDeviations = 3.;
}

/// Whether the mesh was near a sample and is not any more.
bool SurfaceFit::isLost(std::size_t sample, float squaredBefore) const
{
  const PlaceOnMesh& place = places_[sample];
  const float toPlace = squaredNorm(samples_[sample] - pointAt(place, mesh_.positions()));
  const float usual = LostMedians * medianDistance_;
  // Most samples are still near their place. The search is for the others only.
  if (squaredBefore < 0.f || toPlace <= usual * usual)
  {
    return false;
  }
  const float limit = std::max(usual, LostSpacings * spacing_->samplesAt(place));
  const auto isBeyond = [limit](float squared) { return squared > limit * limit; };
  return !isBeyond(squaredBefore) && isBeyond(toPlace) &&
    isBeyond(closestPlaceFrom(samples_[sample], mesh_, place.triangle[0]).squaredDistance);
}

/// For each vertex, 1 if samples around it are lost. `squaredBefore(i)` is the squared distance
/// that sample i had before, or less than 0 if it was not used.
template <typename Distance>
std::vector<std::uint8_t> SurfaceFit::verticesWithLostSamples(const Distance& squaredBefore) const
{
  std::vector<std::uint8_t> lostSamples(samples_.size());
  executor_.forEachRange(samples_.size(), SamplesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        lostSamples[i] = isLost(i, squaredBefore(i)) ? 1 : 0;
      }
    });
  std::vector<std::uint8_t> result(mesh_.indexEnd());
  if (std::find(lostSamples.begin(), lostSamples.end(), 1) == lostSamples.end())
  {
    return result;
  }
  std::vector<float> all(mesh_.indexEnd()), lost(mesh_.indexEnd());
  forEachPlaceByRows(
    places_, RowParts(mesh_.indexEnd(), executor_), executor_, [](std::size_t) { return true; },
    [&](const VertexRows& rows, std::size_t i)
    {
      const float counts = squaredBefore(i) >= 0.f ? 1.f : 0.f;
      for (const VertexIndex v : places_[i].triangle)
      {
        if (rows.has(v))
        {
          all[v] += counts;
          lost[v] += float(lostSamples[i]);
        }
      }
    });
  const float sparse = SparseSpacings * spacing_->usual();
  for (VertexIndex v = 0; v < result.size(); ++v)
  {
    const float least = spacing_->samplesAt(v) > sparse
      ? LeastLostPart * all[v]
      : std::max(LeastLost, LeastLostPart * all[v]);
    result[v] = lost[v] > least ? 1 : 0;
  }
  return result;
}

/// Moves vertices back if samples around them are lost. Returns how many.
template <typename Positions, typename Distance>
std::size_t SurfaceFit::hold(const Positions& before, const Distance& squaredBefore)
{
  std::size_t held = 0;
  for (int i = 0; i < MostHolds; ++i)
  {
    const std::vector<std::uint8_t> isLostAt = verticesWithLostSamples(squaredBefore);
    const std::size_t heldBefore = held;
    for (VertexIndex v = 0; v < before.size(); ++v)
    {
      if (isLostAt[v] != 0 && squaredNorm(mesh_.position(v) - before[v]) > 0.f)
      {
        mesh_.setPosition(v, before[v]);
        ++held;
      }
    }
    if (held == heldBefore)
    {
      break;
    }
  }
  return held;
}

std::size_t SurfaceFit::holdLost(const PackedVectors& before)
{
  return hold(
    before, [this](std::size_t i) { return isUsed(i) ? places_[i].squaredDistance : -1.f; });
}

/// Moves vertices back that have overshot the surface: they are farther from it than samples are
/// from the mesh. Few samples hold such vertices.
std::size_t SurfaceFit::holdOvershot(const PackedVectors& before)
{
  double sum = 0.;
  for (const PlaceOnMesh& place : places_)
  {
    sum += double(place.squaredDistance);
  }
  const double most = OvershotDeviations * OvershotDeviations * sum / double(places_.size());
  std::vector<std::uint8_t> isOvershot(mesh_.indexEnd(), 0);
  executor_.forEachRange(mesh_.indexEnd(), SamplesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      const auto squaredDistance = [this](Vector4 place)
      { return surface_->find(place.toDouble()).squaredDistance; };
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const double now = squaredDistance(mesh_.position(v));
        isOvershot[v] = now > most && now > squaredDistance(before[v]) ? 1 : 0;
      }
    });
  std::size_t held = 0;
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    if (isOvershot[v] != 0)
    {
      mesh_.setPosition(v, before[v]);
      ++held;
    }
  }
  return held;
}

std::size_t SurfaceFit::holdAgainst(const Mesh& before)
{
  hasDistances_ = false;
  std::vector<float> squaredBefore(samples_.size(), -1.f);
  const auto hasMoved = [&](VertexIndex v)
  { return squaredNorm(mesh_.position(v) - before.position(v)) > 0.f; };
  executor_.forEachRange(samples_.size(), SamplesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const Triangle& triangle = places_[i].triangle;
        if (isUsed(i) && std::any_of(triangle.begin(), triangle.end(), hasMoved))
        {
          squaredBefore[i] = closestPlaceFrom(samples_[i], before, triangle[0]).squaredDistance;
        }
      }
    });
  return hold(before.positions(), [&](std::size_t i) { return squaredBefore[i]; });
}
}
