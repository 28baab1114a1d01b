// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "base/Progress.h"
#include "base/ZeroedArray.h"
#include "cloud/PlaceOnMesh.h"
#include "fit/PlacesByRows.h"
#include "fit/SymmetricBlocks.h"
#include "mesh/CompactRings.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// The linear system of a fit, (B^T W B + lambda L^T L) x = B^T W p, for the positions x of all
/// vertices of a mesh. B has the barycentric coordinates of the places of the samples p, and W
/// their weights in each direction. L is the umbrella Laplacian. At a vertex on a boundary, L is
/// the Laplacian along the boundary, and lambda is at most MostBoundarySmoothness. Conjugate
/// gradients solve the system. Half of the symmetric matrix is stored: about 150 bytes per vertex,
/// and 72 more during the solution.
class FitSystem
{
public:
  /// With a larger lambda, boundaries shrink, as only their own samples hold them.
  static constexpr double MostBoundarySmoothness = 20.;

  /// A sample has the weight 1 along the normal of its triangle, and `slip` along the triangle. If
  /// that is below 1, the surface may slide below its samples. The system copies the rings of the
  /// mesh as they are now. The executor must outlive it.
  FitSystem(const Mesh& mesh, double slip, const Executor& executor = Executor::sequential());

  using Rows = VertexRows;
  /// Adds a sample with its place on a triangle to the equations of those corners that are among
  /// `rows`. `normal` is that of the triangle, with any length. Threads may add to different rows
  /// at the same time.
  void add(const PlaceOnMesh& place, Vector4 sample, Vector4 normal, float weight)
  {
    add(place, sample, normal, weight, Rows());
  }
  void add(
    const PlaceOnMesh& place, Vector4 sample, Vector4 normal, float weight, const Rows& rows);

  /// Pulls the edges of the triangle of a place into a plane with this normal, whose length is 1 or
  /// 0.
  void addNormal(const PlaceOnMesh& place, Vector4 unitNormal, float weight, const Rows& rows);
  /// Pulls a vertex to a position.
  void addAnchor(VertexIndex v, Vector4 position, float weight)
  {
    diagonal_.add(v, { Vector4(weight, weight, weight), Vector4() });
    rightSide_.add(v, weight * position);
  }
  /// Clears the right side: the pulls of samples, normals and anchors. Their weights stay in the
  /// matrix.
  void clearPulls() { rightSide_.clear(); }
  /// Adds the pull of a sample at this place, times its weight.
  void addPull(const PlaceOnMesh& place, Vector4 pull)
  {
    const Vector4 weights = place.weights();
    for (unsigned i = 0; i < 3; ++i)
    {
      rightSide_.add(place.triangle[i], weights[int(i)] * pull);
    }
  }
  /// Pulls L x at each vertex to this value instead of 0. `lambda` is that of the solution.
  void addBends(double lambda, std::span<const Vector4> bends);
  /// Sets the part of lambda at each vertex; empty: all 1. The parts must outlive the system.
  void setSmoothnessParts(std::span<const float> parts) { parts_ = parts; }
  /// Smooths L x towards these values instead of 0; empty: all 0. They must outlive the system.
  void expectBends(std::span<const Vector4> bends) { bends_ = bends; }

  /// Improves `x` until the residual is `tolerance` times `scale`. First raises `scale` to the
  /// residual of the given `x`. Returns false if `progress` ended it.
  bool solve(double lambda, double tolerance, double& scale, std::span<Vector4> x,
    const Progress& progress) const
  {
    return solve(lambda, tolerance, scale, x, progress, rightSide_);
  }
  /// Solves the system for the last time, in less memory. Nothing but the rings is left of it.
  bool solveLast(
    double lambda, double tolerance, double& scale, std::span<Vector4> x, const Progress& progress)
  {
    const bool isSolved = solve(lambda, tolerance, scale, x, progress, std::move(rightSide_));
    diagonal_ = SymmetricBlocks(0);
    others_.reset();
    return isSolved;
  }

  const CompactRings& rings() const { return rings_; }

  /// The lambda with which each place of the surface follows about so many samples, if there are
  /// `perVertex` samples per vertex. The surface bends over a length of the fourth root of lambda
  /// over the densities of samples and vertices.
  static constexpr double smoothnessThatFollows(double samples, double perVertex)
  {
    return samples * samples / perVertex;
  }

private:
  /// `residual` has the right side at first.
  bool solve(double lambda, double tolerance, double& scale, std::span<Vector4> x,
    const Progress& progress, PackedVectors residual) const;
  /// `bends` are taken from L x, unless they are empty.
  template <typename Vectors>
  void apply(double lambda, const Vectors& x, std::span<const Vector4> bends,
    PackedVectors& laplacian, PackedVectors& result) const;
  /// The index of the block of an edge. It is stored once, with the vertex of the lower index.
  std::size_t entryOf(VertexIndex lower, VertexIndex higher) const;
  /// The part of lambda at a vertex.
  float smoothnessPart(VertexIndex v, float onBoundary) const
  {
    return rings_.isOpen(v) ? onBoundary : parts_.empty() ? 1.f : parts_[v];
  }
  /// The part of lambda at vertices on boundaries.
  static float boundaryPart(double lambda);
  SymmetricBlocks inverseDiagonal(double lambda) const;
  /// The weight of a neighbour at a vertex, see umbrellaWeight().
  float weight(VertexIndex vertex, VertexIndex neighbor) const;

  CompactRings rings_;
  const Executor& executor_;
  float slip_;
  SymmetricBlocks diagonal_;
  /// For each vertex, the block of its first higher neighbour
  ZeroedArray<std::uint32_t> firstEntry_;
  /// For each edge at each vertex, its position among the entries of the lower vertex
  ZeroedArray<std::uint8_t> rank_;
  std::optional<SymmetricBlocks> others_; ///< one for each edge
  PackedVectors rightSide_;
  std::span<const float> parts_;    ///< the part of lambda at each vertex; empty: all 1
  std::span<const Vector4> bends_;  ///< that are expected of each vertex; empty: all 0
  ZeroedArray<float> innerWeights_; ///< umbrella weights at inner vertices; 0 at others
};
}
