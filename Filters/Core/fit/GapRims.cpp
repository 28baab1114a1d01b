// SPDX-License-Identifier: BSD-3-Clause
#include "fit/GapRims.h"

#include "base/UnitVector.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// The surface goes on across a gap where the mean cosine between its normals at both rims is no less.
constexpr float LeastCosineBetweenRims = 0.3f;
}

GapRims::GapRims(const Mesh& mesh, std::span<const Triangle> triangles)
  : mesh_(mesh)
  , gaps_(triangles.empty() ? 0 : mesh.indexEnd())
  , isAtGap_(triangles.empty() ? 0 : mesh.indexEnd(), 0)
{
  for (const auto& [a, b, c] : triangles)
  {
    gaps_.join(a, b);
    gaps_.join(b, c);
    isAtGap_[a] = isAtGap_[b] = isAtGap_[c] = 1;
  }
}

/// What was opened before is known no more: then both count as those of one gap.
bool GapRims::mayJoin(std::span<const VertexIndex> one, std::span<const VertexIndex> other)
{
  return mainGap(one) != mainGap(other) || continues(one, other);
}

/// The one that has left most of a loop.
std::optional<std::size_t> GapRims::mainGap(std::span<const VertexIndex> loop)
{
  std::vector<std::size_t> gaps;
  for (const VertexIndex v : loop)
  {
    if (v < isAtGap_.size() && isAtGap_[v] != 0)
    {
      gaps.push_back(gaps_.root(v));
    }
  }
  if (2 * gaps.size() <= loop.size())
  {
    return std::nullopt;
  }
  // What more than half of them are, the middle one is.
  std::sort(gaps.begin(), gaps.end());
  const std::size_t middle = gaps[gaps.size() / 2];
  const auto count = std::size_t(std::count(gaps.begin(), gaps.end(), middle));
  return 2 * count > loop.size() ? std::optional(middle) : std::nullopt;
}

bool GapRims::continues(std::span<const VertexIndex> one, std::span<const VertexIndex> other) const
{
  float sum = 0.f;
  for (const VertexIndex v : one)
  {
    const auto distance = [&](VertexIndex across)
    { return squaredNorm(mesh_.position(across) - mesh_.position(v)); };
    const VertexIndex nearest = *std::min_element(other.begin(), other.end(),
      [&](VertexIndex a, VertexIndex b) { return distance(a) < distance(b); });
    sum += dot(unit(mesh_.normal(v)), unit(mesh_.normal(nearest)));
  }
  return sum >= LeastCosineBetweenRims * float(one.size());
}
}
