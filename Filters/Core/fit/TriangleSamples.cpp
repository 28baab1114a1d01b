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
/// A part for the executor.
constexpr std::size_t LoadsPerRange = 16384;

/// For the triangles of a part: a closed mesh has two a vertex, and lower corners have more of them. Memory is taken
/// only for those that are there.
std::size_t roomOfPart(const RowParts& parts)
{
  const VertexRows rows = parts.rows(0);
  const std::size_t vertices = rows.end - rows.begin;
  return 2 * vertices + vertices / 16;
}

/// Corners in rising order.
Triangle inOrder(VertexIndex a, VertexIndex b, VertexIndex c)
{
  Triangle corners{ a, b, c };
  std::sort(corners.begin(), corners.end());
  return corners;
}
}

double usualSquares(double count, double variance)
{
  return variance * (count + ExcessDeviations * std::sqrt(2. * count));
}

double SampleLoad::excess(double variance) const { return squares - usualSquares(count, variance); }

TriangleSamples::TriangleSamples(
  const PlacedSamples& samples, std::size_t indexEnd, const Executor& executor)
  : samples_(samples)
  , parts_(RowParts::byWork(indexEnd))
  , entries_(indexEnd, None)
  , pieces_(parts_.count() * roomOfPart(parts_))
  , stores_(parts_.count())
  , next_(std::make_unique_for_overwrite<std::uint32_t[]>(samples.points.size()))
{
  for (std::size_t part = 0; part < stores_.size(); ++part)
  {
    stores_[part].room = roomOfPart(parts_);
    stores_[part].piece = pieces_.data() + part * stores_[part].room;
  }
  const auto isUsed = [&](std::size_t i) { return samples.isUsed[i] != 0; };
  forEachPlaceByRows(samples.places, parts_, executor, isUsed,
    [&](const VertexRows& rows, std::size_t i)
    {
      const PlaceOnMesh& place = samples.places[i];
      const Triangle corners = inOrder(place.triangle[0], place.triangle[1], place.triangle[2]);
      if (rows.has(corners[0]))
      {
        putInto(parts_.of(corners[0]), std::uint32_t(i), corners, place.squaredDistance);
      }
    });
  const auto weightOf = [&](std::size_t i) { return isUsed(i) ? double(samples.weight(i)) : 0.; };
  total_ = { executor.sum(samples.points.size(), LoadsPerRange, weightOf),
    executor.sum(samples.points.size(), LoadsPerRange,
      [&](std::size_t i)
      { return isUsed(i) ? weightOf(i) * double(squaredDistance(std::uint32_t(i))) : 0.; }) };
}

const TriangleSamples::Entry* TriangleSamples::find(const Triangle& corners) const
{
  const auto [least, middle, most] = corners;
  for (std::uint32_t number = entries_[least]; number != None; number = entry(number).next)
  {
    const Entry& at = entry(number);
    if (at.middle == middle && at.most == most)
    {
      return &at;
    }
  }
  return nullptr;
}

SampleLoad TriangleSamples::load(VertexIndex a, VertexIndex b, VertexIndex c) const
{
  const Entry* const entry = find(inOrder(a, b, c));
  return entry ? entry->load : SampleLoad();
}

void TriangleSamples::collect(
  VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found) const
{
  const Entry* const entry = find(inOrder(a, b, c));
  for (std::uint32_t i = entry ? entry->first : None; i != None; i = next_[i])
  {
    found.push_back(i);
  }
}

void TriangleSamples::take(
  VertexIndex a, VertexIndex b, VertexIndex c, std::vector<std::uint32_t>& found)
{
  collect(a, b, c, found);
  if (Entry* const entry = find(inOrder(a, b, c)))
  {
    entry->first = entry->last = None;
    entry->load = {};
  }
}

void TriangleSamples::put(std::uint32_t sample, VertexIndex a, VertexIndex b, VertexIndex c,
  float squaredDistance, std::size_t writer)
{
  putInto(parts_.count() + writer, sample, inOrder(a, b, c), squaredDistance);
}

void TriangleSamples::putInto(
  std::size_t store, std::uint32_t sample, const Triangle& corners, float squaredDistance)
{
  Entry* entry = find(corners);
  if (!entry)
  {
    std::uint32_t& first = entries_[corners[0]];
    const std::size_t place = stores_[store].add({ corners[1], corners[2], first, None, None, {} });
    first = std::uint32_t(store) << BitsOfPlace | std::uint32_t(place);
    entry = find(corners);
  }
  (entry->last == None ? entry->first : next_[entry->last]) = sample;
  entry->last = sample;
  next_[sample] = None;
  const double weight = double(samples_.weight(sample));
  entry->load += { weight, weight * double(squaredDistance) };
}
}
