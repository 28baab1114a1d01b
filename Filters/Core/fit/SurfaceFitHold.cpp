// SPDX-License-Identifier: BSD-3-Clause
// Where samples would be lost, vertices stay.
#include "fit/SurfaceFit.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Beyond so many median distances, and distances between samples around it, a sample is lost. Points
/// whose own neighbours are three times their usual distance away count as missed; samples are told
/// earlier.
constexpr float LostMedians = 10.f;
constexpr float LostSpacings = 2.5f;
/// A vertex stays if more than this part of the samples around it would be lost, and, where samples are
/// not sparse, more than so many: single ones are outliers to which the mesh has been drawn.
constexpr float LeastLostPart = 0.05f;
constexpr float LeastLost = 2.f;
constexpr int MostHolds = 4;
/// Of the samples about the mesh, so many: a vertex is not to be farther from the surface.
constexpr double OvershotDeviations = 3.;
}

/// Whether the mesh was near to a sample, and is not now.
bool SurfaceFit::isLost(std::size_t sample, float squaredBefore) const
{
  const PlaceOnMesh& place = places_[sample];
  const float toPlace = squaredNorm(samples_[sample] - pointAt(place, mesh_.positions()));
  const float usual = LostMedians * medianDistance_;
  // Most are still near to the same place: only the others are looked for.
  if (squaredBefore < 0.f || toPlace <= usual * usual)
  {
    return false;
  }
  const float limit = std::max(usual, LostSpacings * spacing_->samplesAt(place));
  const auto isBeyond = [limit](float squared) { return squared > limit * limit; };
  return !isBeyond(squaredBefore) && isBeyond(toPlace) &&
    isBeyond(closestPlaceFrom(samples_[sample], mesh_, place.triangle[0]).squaredDistance);
}

/// The vertices around which samples are lost. `squaredBefore(i)` is the distance of sample i if that
/// was used, else less than 0.
template <typename Distance>
std::vector<std::uint8_t> SurfaceFit::lostPlaces(const Distance& squaredBefore) const
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

/// Vertices around which samples are lost go back.
template <typename Positions, typename Distance>
std::size_t SurfaceFit::hold(const Positions& before, const Distance& squaredBefore)
{
  std::size_t held = 0;
  for (int i = 0; i < MostHolds; ++i)
  {
    const std::vector<std::uint8_t> isLostAt = lostPlaces(squaredBefore);
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

/// Where little holds them, vertices would leave the surface for places beyond it: they go back if they are farther from
/// it than samples are from the mesh.
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
