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
  , first_(indexEnd, NoSample)
  , next_(samples.points.size(), NoSample)
  , corners_(samples.points.size())
  , squaredDistances_(samples.points.size())
{
  for (auto i = std::uint32_t(samples.points.size()); i-- > 0;)
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

SampleLoad TriangleSamples::load(VertexIndex a, VertexIndex b, VertexIndex c) const
{
  const auto [least, middle, most] = inOrder(a, b, c);
  SampleLoad result;
  for (std::uint32_t i = first_[least]; i != NoSample; i = next_[i])
  {
    if (corners_[i][0] == middle && corners_[i][1] == most)
    {
      const double weight = double(samples_.weight(i));
      result += { weight, weight * double(squaredDistances_[i]) };
    }
  }
  return result;
}

void TriangleSamples::collect(
  VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found) const
{
  const auto [least, middle, most] = inOrder(a, b, c);
  for (std::uint32_t i = first_[least]; i != NoSample; i = next_[i])
  {
    if (corners_[i][0] == middle && corners_[i][1] == most)
    {
      found.push_back(i);
    }
  }
}

void TriangleSamples::take(
  VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found)
{
  const auto [least, middle, most] = inOrder(a, b, c);
  for (std::uint32_t* link = &first_[least]; *link != NoSample;)
  {
    const std::uint32_t i = *link;
    if (corners_[i][0] == middle && corners_[i][1] == most)
    {
      found.push_back(i);
      *link = next_[i];
    }
    else
    {
      link = &next_[i];
    }
  }
}

void TriangleSamples::put(
  std::uint32_t sample, VertexIndex a, VertexIndex b, VertexIndex c, float squaredDistance)
{
  const auto [least, middle, most] = inOrder(a, b, c);
  corners_[sample] = { middle, most };
  squaredDistances_[sample] = squaredDistance;
  next_[sample] = first_[least];
  first_[least] = sample;
}
}
