// SPDX-License-Identifier: BSD-3-Clause
#include "fit/EmptyCaps.h"

#include "fit/PlacesByRows.h"
#include "mesh/RingMeans.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// That an empty cap is as large although there is a surface.
constexpr double ChanceOfEmptyCap = 0.05;
/// The part of its triangles' heights over which a cap is empty on average, times the root of the number of samples.
constexpr double UsualEmptyPart = 0.886;
/// The nearest sample is looked for on the triangles of so many rings, and how many are to be expected, on average.
constexpr int RingsOfNearest = 2;
constexpr int RingsOfExpected = 2;
/// With fewer samples, their distances tell nothing.
constexpr float LeastSamplesOfCap = 6.f;
/// Of so many samples the sum of the squared distances varies by that many deviations.
constexpr double DeviationsOfSquares = 2.;
constexpr std::size_t CapsPerRange = 4096;
}

EmptyCaps::EmptyCaps(
  const Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
  : mesh_(mesh)
  , samples_(samples)
  , executor_(executor)
  , scale_(variance)
  , caps_(mesh.indexEnd())
{
  forEachPlaceByRows(
    samples.places, RowParts(mesh.indexEnd(), executor), executor,
    [&](std::size_t i) { return samples.isUsed[i] != 0; },
    [&](const VertexRows& rows, std::size_t i)
    {
      const PlaceOnMesh& place = samples.places[i];
      for (int corner = 0; corner < 3; ++corner)
      {
        const VertexIndex v = place.triangle[std::size_t(corner)];
        if (rows.has(v))
        {
          Cap& cap = caps_[v];
          cap.count += 1.f;
          cap.weight += samples.weight(i);
          cap.squares += samples.weight(i) * place.squaredDistance;
          cap.most = std::max(cap.most, place.weights()[corner]);
          offer(v, cap, std::uint32_t(i));
        }
      }
    });
  double squares = 0., weights = 0.;
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.isUsed[i] != 0)
    {
      const double weight = double(samples.weight(i));
      squares += weight * double(samples.places[i].squaredDistance);
      weights += weight;
    }
  }
  scale_ = weights > 0. ? std::max(scale_, squares / weights) : scale_;
  lookAround();
  expect();
}

void EmptyCaps::offer(VertexIndex v, Cap& cap, std::uint32_t sample) const
{
  const float squared = squaredNorm(samples_.points[sample] - mesh_.position(v));
  if (cap.nearest == None || squared < cap.squaredDistance)
  {
    cap.nearest = sample;
    cap.squaredDistance = squared;
  }
}

/// Where triangles are without samples, the nearest one lies on others.
void EmptyCaps::lookAround()
{
  std::vector<Cap> before(caps_.size());
  for (int ring = 0; ring < RingsOfNearest; ++ring)
  {
    before.swap(caps_);
    executor_.forEachRange(caps_.size(), CapsPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          caps_[v] = before[v];
          for (const VertexIndex neighbor : mesh_.ring(v))
          {
            if (before[neighbor].nearest != None)
            {
              offer(v, caps_[v], before[neighbor].nearest);
            }
          }
        }
      });
  }
}

/// By how many there are on the area around.
void EmptyCaps::expect()
{
  std::vector<float> counts(caps_.size()), areas(caps_.size());
  executor_.forEachRange(caps_.size(), CapsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        counts[v] = caps_[v].count;
        const Ring& ring = mesh_.ring(v);
        for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
        {
          areas[v] += triangleArea(
            mesh_.position(v), mesh_.position(ring[slot]), mesh_.position(ring[ring.after(slot)]));
        }
      }
    });
  const std::vector<float> own = areas;
  averageOverRings(mesh_, counts, RingsOfExpected, executor_);
  averageOverRings(mesh_, areas, RingsOfExpected, executor_);
  for (VertexIndex v = 0; v < caps_.size(); ++v)
  {
    caps_[v].expected = areas[v] > 0.f ? counts[v] / areas[v] * own[v] : 0.f;
  }
}

bool EmptyCaps::isAtGap(VertexIndex v) const
{
  const Ring& ring = mesh_.ring(v);
  return std::any_of(
    ring.begin(), ring.end(), [&](VertexIndex neighbor) { return caps_[neighbor].count == 0.f; });
}

std::optional<EmptyCaps::End> EmptyCaps::endAt(VertexIndex v) const
{
  const Cap& cap = caps_[v];
  const double count = std::max(cap.count, cap.expected), empty = 1. - cap.most;
  const double usual = UsualEmptyPart / std::sqrt(count + 1.);
  const Vector4 normal = mesh_.normal(v);
  const float squared = squaredNorm(normal);
  if (mesh_.isBoundary(v) || cap.nearest == None || !(squared > 0.f) || !(empty > usual) ||
    std::pow(1. - empty * empty, count) > ChanceOfEmptyCap || isAtGap(v))
  {
    return {};
  }
  // How much of their distances is more than usual.
  double part = 1.;
  if (cap.count >= LeastSamplesOfCap)
  {
    const double samples = cap.count, squares = cap.squares, meanWeight = cap.weight / cap.count;
    const double most =
      scale_ * meanWeight * (samples + DeviationsOfSquares * std::sqrt(2. * samples));
    part = squares > most ? 1. - most / squares : 0.;
  }
  if (!(part > 0.))
  {
    return {};
  }
  const Vector4 origin = mesh_.position(v);
  const float across = dot(samples_.points[cap.nearest] - origin, normal) / squared;
  const auto step = float(part * (1. - usual / empty));
  const float meanWeight = cap.count > 0.f ? cap.weight / cap.count : samples_.weight(cap.nearest);
  return End{ origin + step * across * normal, float(count) * meanWeight };
}
}
