// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/CornerPlanes.h"
#include "fit/SampleBundle.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"
#include "mesh/SelfIntersections.h"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// A vertex that moves to a corner, or, with another one, the middle of their edge, where one is added.
struct CornerCenter
{
  VertexIndex v;
  VertexIndex other = NoVertex;

  bool isAdded() const { return other != NoVertex; }
  auto operator<=>(const CornerCenter&) const = default;
};

/// Where it goes, and how much straighter the triangles around get.
struct Corner
{
  /// Edges, at most, that are flipped for one vertex.
  static constexpr unsigned MostFlips = 3;

  double gain = 0.; ///< 0: nowhere
  Vector4 place;
  std::array<Edge, MostFlips> flipped{}; ///< in this order, before it goes there
  unsigned flips = 0;
};

/// Looks for where triangles that lie in none of the planes around become ones that do.
class CornerSearch
{
public:
  /// There may be so many corners. Of triangles with three locked corners the samples are not known.
  CornerSearch(const Mesh& mesh, const TriangleSamples& samples, double scale, double corners,
    const std::vector<std::uint8_t>& isLocked)
    : mesh_(mesh)
    , samples_(samples)
    , scale_(scale)
    , corners_(corners)
    , isLocked_(isLocked)
    , planes_(mesh, samples, scale)
  {
  }

  Corner find(const CornerCenter& center);

private:
  /// A triangle of the vertex: its other corners, and its normal, twice the area long, before the vertex goes.
  struct Side
  {
    VertexIndex first, second;
    VertexIndex inner; ///< third corner of what lies there now
    Vector4 normal;
    bool isFlipped = false;
  };

  void collectStar();
  void search(Vector4 place, std::size_t first = 0);
  bool flipSide(std::size_t index);
  unsigned valence(VertexIndex v) const;
  void judge(Vector4 place);
  bool isSpoiled(const Side& side, Vector4 place) const;
  bool turns(const Side& side, Vector4 place) const;
  bool isNear(Vector4 place) const;
  bool keepsShape(Vector4 place) const;
  bool hasSamples(Vector4 place, bool mayBeAsUsual);
  void addTrianglesAround();

  Vector4 normalOf(const Side& side, Vector4 place) const
  {
    return cross(mesh_.position(side.first) - place, mesh_.position(side.second) - place);
  }
  Vector4 normalOf(const Triangle& triangle) const
  {
    const Vector4 from = mesh_.position(triangle[0]);
    return cross(mesh_.position(triangle[1]) - from, mesh_.position(triangle[2]) - from);
  }

  bool isCrooked(const Triangle& triangle) const
  {
    return planes_.isCrooked(
      mesh_.position(triangle[0]), mesh_.position(triangle[1]), mesh_.position(triangle[2]));
  }
  bool isCrooked(const Side& side, Vector4 place) const
  {
    return planes_.isCrooked(place, mesh_.position(side.first), mesh_.position(side.second));
  }

  const Mesh& mesh_;
  const TriangleSamples& samples_;
  double scale_;
  double corners_;
  const std::vector<std::uint8_t>& isLocked_;
  CornerPlanes planes_;
  CornerCenter center_{ NoVertex };
  Vector4 start_;           ///< of it
  std::vector<Side> sides_; ///< around it
  std::vector<Triangle>
    replaced_; ///< by these; of each flip, the last one begins with the vertex beyond
  std::array<Edge, Corner::MostFlips> flipped_{};
  unsigned flips_ = 0;
  Corner best_;
  std::vector<std::uint32_t> onStar_;
  SampleBundle bundle_; ///< of these
  std::vector<TriangleDistances> old_, new_;
};
}
