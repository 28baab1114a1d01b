// SPDX-License-Identifier: BSD-3-Clause
#include "fit/TriangleSamples.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// Of the sum of squares of so many Gaussian samples, which is their number but for the root of twice as
/// many.
constexpr double ExcessDeviations = 2.;

/// Corners in rising order.
Triangle inOrder(VertexIndex a, VertexIndex b, VertexIndex c)
{
  Triangle corners{ a, b, c };
  std::sort(corners.begin(), corners.end());
  return corners;
}
}

double SampleLoad::excess(double variance) const
{
  return squares - variance * (count + ExcessDeviations * std::sqrt(2. * count));
}

TriangleSamples::TriangleSamples(const PlacedSamples& samples, std::size_t indexEnd)
  : samples_(samples)
  , entries_(indexEnd, None)
  , next_(samples.points.size(), None)
  , squaredDistances_(samples.points.size())
{
  triangles_.reserve(2 * indexEnd);
  for (std::uint32_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.isUsed[i] != 0)
    {
      const PlaceOnMesh& place = samples.places[i];
      const auto& [a, b, c] = place.triangle;
      put(i, a, b, c, place.squaredDistance);
      const double weight = double(samples.weight(i));
      total_ += { weight, weight * double(place.squaredDistance) };
    }
  }
}

std::uint32_t TriangleSamples::find(const Triangle& corners) const
{
  const auto [least, middle, most] = corners;
  std::uint32_t entry = entries_[least];
  while (entry != None && (triangles_[entry].middle != middle || triangles_[entry].most != most))
  {
    entry = triangles_[entry].next;
  }
  return entry;
}

SampleLoad TriangleSamples::load(VertexIndex a, VertexIndex b, VertexIndex c) const
{
  const std::uint32_t entry = find(inOrder(a, b, c));
  return entry == None ? SampleLoad() : triangles_[entry].load;
}

void TriangleSamples::collect(
  VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found) const
{
  const std::uint32_t entry = find(inOrder(a, b, c));
  for (std::uint32_t i = entry == None ? None : triangles_[entry].first; i != None; i = next_[i])
  {
    found.push_back(i);
  }
}

void TriangleSamples::take(
  VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found)
{
  collect(a, b, c, found);
  const std::uint32_t entry = find(inOrder(a, b, c));
  if (entry != None)
  {
    triangles_[entry].first = triangles_[entry].last = None;
    triangles_[entry].load = {};
  }
}

void TriangleSamples::put(
  std::uint32_t sample, VertexIndex a, VertexIndex b, VertexIndex c, float squaredDistance)
{
  const Triangle corners = inOrder(a, b, c);
  std::uint32_t at = find(corners);
  if (at == None)
  {
    at = std::uint32_t(triangles_.size());
    triangles_.push_back({ corners[1], corners[2], entries_[corners[0]], None, None, {} });
    entries_[corners[0]] = at;
  }
  Entry& entry = triangles_[at];
  (entry.last == None ? entry.first : next_[entry.last]) = sample;
  entry.last = sample;
  next_[sample] = None;
  squaredDistances_[sample] = squaredDistance;
  const double weight = double(samples_.weight(sample));
  entry.load += { weight, weight * double(squaredDistance) };
}
}
