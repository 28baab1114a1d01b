// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/NearestPoints.h"
#include "start/LayerSearch.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// What is taken for one surface.
enum class Layers
{
  Joined, ///< all that is closer than samples are: right where scatter is wider than it seems
  Apart   ///< points in one plane, as of the two sides of a plate that is thinner than that
};

/// The samples that points of a cloud become, each moved onto the layer that it lies in by as few of its nearest
/// points as the noise needs. What was told is remembered: a front that is tried once more asks for most of it
/// again.
class PointLayers
{
public:
  /// Samples get a radius such that there is room for about `count`. It grows with the root of the distance between
  /// points. (One that grows with the distance itself leaves nothing of what is sparse.)
  PointLayers(const NearestPoints& nearest, std::size_t count);

  struct Told
  {
    LayerSample sample;
    bool isInLayer = false;
    bool isOneOfTwo = false; ///< layers almost as close to each other as samples are
  };
  /// The radius is less where another layer lies beside that of the sample, as in bores and thin walls: samples as far
  /// apart as walls are thick leave corners without any, and triangles go from one side to the other there.
  Told at(std::uint32_t point, Layers layers);

  /// Whether a point lies in one of two layers almost as close to each other as samples are.
  bool isInOneOfTwo(std::uint32_t point);

  const NearestPoints& nearest() const { return search_.nearest(); }
  /// About how many samples there are to be.
  std::size_t count() const { return count_; }

private:
  struct Known
  {
    Spacing spacing;
    Told joined;
    bool isTold = false;
  };

  float radius(const Spacing& spacing) const;
  Known& known(std::uint32_t point);
  Told told(std::uint32_t point, Layers layers);
  float gapBeside(const LayerSample& sample, Layers layers);

  LayerSearch search_;
  std::size_t count_;
  float usualSpacing_;
  float factor_ = 0.f;                 ///< of the radius
  std::vector<std::uint32_t> numbers_; ///< of what is known of a point; its maximum: nothing
  std::vector<Known> known_;
};
}
