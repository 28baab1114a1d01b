// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// Where the surface goes on beyond the samples: samples pull at what is below them, and nothing tells a vertex
/// that sticks out of a tip, or lies too deep in a pit, that there are none around it.
///
/// The cap of a vertex is the part of its triangles that is nearer to it than any of their samples. With samples
/// spread evenly there is a chance that it is so large. Beside a neighbour without samples there is a gap that was closed:
/// the surface bends freely there, and its vertices are left where they are.
class EmptyCaps
{
public:
  /// Samples about the surface have this variance.
  EmptyCaps(
    const Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor);

  /// Where the samples end, and what those that tell it weigh.
  struct End
  {
    Vector4 position;
    float weight;
  };
  /// Of a vertex with an empty cap that is too large for chance, unless its triangles lie as close to the samples as
  /// others do.
  std::optional<End> endAt(VertexIndex v) const;

private:
  static constexpr std::uint32_t None = 0xffffffffu;

  struct Cap
  {
    float count = 0.f;            ///< of the samples on the triangles of the vertex ...
    float weight = 0.f;           ///< ... what they weigh together ...
    float squares = 0.f;          ///< ... and the sum of their squared distances, weighted
    float most = 0.f;             ///< of their barycentric coordinates at the vertex
    float expected = 0.f;         ///< how many samples there are on as much area near by
    std::uint32_t nearest = None; ///< of the samples around
    float squaredDistance = 0.f;  ///< of that
  };

  void offer(VertexIndex v, Cap& cap, std::uint32_t sample) const;
  void lookAround();
  void expect();
  bool isAtGap(VertexIndex v) const;

  const Mesh& mesh_;
  PlacedSamples samples_;
  const Executor& executor_;
  double scale_; ///< squared distance of a sample that is usual
  std::vector<Cap> caps_;
};
}
