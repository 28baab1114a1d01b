// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "base/Progress.h"
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
/// vertices of a mesh: B are the barycentric coordinates of the places of samples p, W how much they
/// weigh in each direction, L is the umbrella Laplacian (of a vertex on a boundary, that along it, for
/// which lambda is at most MostBoundarySmoothness).
/// Solved by conjugate gradients. As the matrix is symmetric, half of it is kept: about 150 bytes a vertex, and 72 more
/// while it is solved.
class FitSystem
{
public:
  /// Held any smoother, boundaries would shrink: nothing but their own samples holds them out.
  static constexpr double MostBoundarySmoothness = 20.;

  /// How much a sample weighs along the normal of its triangle is 1; along the triangle, `slip`: if
  /// it is below 1, the surface may slide below its samples. The executor must outlive the system, which has
  /// the rings of the mesh, as they are now, for itself.
  FitSystem(const Mesh& mesh, double slip, const Executor& executor = Executor::sequential());

  using Rows = VertexRows;
  /// Adds a sample whose place is on a triangle with this normal (of any length), to the equations
  /// of those corners that are among `rows`. Other rows may be added to at the same time.
  void add(const PlaceOnMesh& place, Vector4 sample, Vector4 normal, float weight)
  {
    add(place, sample, normal, weight, Rows());
  }
  void add(
    const PlaceOnMesh& place, Vector4 sample, Vector4 normal, float weight, const Rows& rows);

  /// Pulls the edges of a triangle, on which a place is, into a plane with this normal, of length 1 or 0.
  void addNormal(const PlaceOnMesh& place, Vector4 unitNormal, float weight, const Rows& rows);
  /// Pulls a vertex to a position.
  void addAnchor(VertexIndex v, Vector4 position, float weight)
  {
    diagonal_.add(v, { Vector4(weight, weight, weight), Vector4() });
    rightSide_.add(v, weight * position);
  }
  /// Takes away what samples, normals and anchors pull to; how much they weigh stays.
  void clearPulls() { rightSide_.clear(); }
  /// Adds to what a sample at this place pulls to, times its weight.
  void addPull(const PlaceOnMesh& place, Vector4 pull)
  {
    const Vector4 weights = place.weights();
    for (unsigned i = 0; i < 3; ++i)
    {
      rightSide_.add(place.triangle[i], weights[int(i)] * pull);
    }
  }
  /// L x is to be this at each vertex, in place of 0, with the lambda of what is solved.
  void addBends(double lambda, std::span<const Vector4> bends);
  /// Lambda counts so much of itself at each vertex; without any, all of it. They must outlive the system.
  void setSmoothnessParts(std::span<const float> parts) { parts_ = parts; }

  /// Improves `x` until the residual is `tolerance` times `scale`, which is raised first to the
  /// residual of the given `x`. Returns false if it was ended before.
  bool solve(double lambda, double tolerance, double& scale, std::span<Vector4> x,
    const Progress& progress) const
  {
    return solve(lambda, tolerance, scale, x, progress, rightSide_);
  }
  /// The same for the last time, in less memory.
  bool solveLast(
    double lambda, double tolerance, double& scale, std::span<Vector4> x, const Progress& progress)
  {
    return solve(lambda, tolerance, scale, x, progress, std::move(rightSide_));
  }

  const CompactRings& rings() const { return rings_; }

  /// The lambda for which each place of the surface follows about so many samples, with so many of them a vertex:
  /// it bends over a length of the fourth root of lambda over their density and that of the vertices.
  static constexpr double smoothnessThatFollows(double samples, double perVertex)
  {
    return samples * samples / perVertex;
  }

private:
  /// `residual` is the right side at first.
  bool solve(double lambda, double tolerance, double& scale, std::span<Vector4> x,
    const Progress& progress, PackedVectors residual) const;
  template <typename Vectors>
  void apply(
    double lambda, const Vectors& x, PackedVectors& laplacian, PackedVectors& result) const;
  /// Where the block of an edge is, which is stored once, with the vertex of the lower index.
  std::size_t entryOf(VertexIndex lower, VertexIndex higher) const;
  /// Of lambda, for a vertex.
  float smoothnessPart(VertexIndex v, float onBoundary) const
  {
    return rings_.isOpen(v) ? onBoundary : parts_.empty() ? 1.f : parts_[v];
  }
  /// Of lambda, for the vertices on boundaries.
  static float boundaryPart(double lambda);
  SymmetricBlocks inverseDiagonal(double lambda) const;
  /// How much a neighbour counts at a vertex, as umbrellaWeight() has it.
  float weight(VertexIndex vertex, VertexIndex neighbor) const;

  CompactRings rings_;
  const Executor& executor_;
  float slip_;
  SymmetricBlocks diagonal_;
  std::vector<std::uint32_t> firstEntry_; ///< of each vertex, for its neighbours of a higher index
  std::vector<std::uint8_t>
    rank_; ///< of each neighbour of each vertex, among the entries of the lower of both
  std::optional<SymmetricBlocks> others_; ///< one for each edge
  PackedVectors rightSide_;
  std::span<const float> parts_;    ///< of lambda; empty: all 1
  std::vector<float> innerWeights_; ///< umbrella weights at inner vertices; 0 at others
};
}
