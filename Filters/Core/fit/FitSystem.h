// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The linear system of a fit, (B^T W B + lambda L^T L) x = B^T W p, for the positions x of all
/// vertices of a mesh: B are the barycentric coordinates of the places of samples p, W how much they
/// weigh in each direction, L is the umbrella Laplacian (of a vertex on a boundary, that along it, for
/// which lambda is at most MostBoundarySmoothness).
/// Solved by conjugate gradients; the matrices are kept beside the rings. About 330 bytes a vertex.
class FitSystem
{
public:
  /// Held any smoother, boundaries would shrink: nothing but their own samples holds them out.
  static constexpr double MostBoundarySmoothness = 20.;

  /// How much a sample weighs along the normal of its triangle is 1; along the triangle, `slip`: if
  /// it is below 1, the surface may slide below its samples. Mesh and executor must outlive the
  /// system.
  FitSystem(const Mesh& mesh, double slip, const Executor& executor = Executor::sequential());

  /// Some of the vertices: those from `begin` to before `end`.
  struct Rows
  {
    VertexIndex begin = 0;
    VertexIndex end = NoVertex;

    bool has(VertexIndex v) const { return v >= begin && v < end; }
  };
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
    diagonal_[v].diagonal += Vector4(weight, weight, weight);
    rightSide_[v] += weight * position;
  }
  /// Takes away what samples, normals and anchors pull to; how much they weigh stays.
  void clearPulls() { rightSide_.assign(rightSide_.size(), Vector4()); }
  /// Adds to what a sample at this place pulls to, times its weight.
  void addPull(const PlaceOnMesh& place, Vector4 pull)
  {
    for (unsigned i = 0; i < 3; ++i)
    {
      rightSide_[place.triangle[i]] += place.weights[int(i)] * pull;
    }
  }
  /// L x is to be this at each vertex, in place of 0, with the lambda of what is solved.
  void addBends(double lambda, std::span<const Vector4> bends);
  /// Lambda counts so much of itself at each vertex; without any, all of it.
  void setSmoothnessParts(std::span<const float> parts)
  {
    parts_.assign(parts.begin(), parts.end());
  }

  /// Improves `x` until the residual is `tolerance` times `scale`, which is raised first to the
  /// residual of the given `x`. Returns false if it was ended before.
  bool solve(double lambda, double tolerance, double& scale, std::span<Vector4> x,
    const Progress& progress) const;

  /// The lambda for which each place of the surface follows about so many samples, with so many of them a vertex:
  /// it bends over a length of the fourth root of lambda over their density and that of the vertices.
  static constexpr double smoothnessThatFollows(double samples, double perVertex)
  {
    return samples * samples / perVertex;
  }

private:
  /// A symmetric matrix of 3 x 3.
  struct Block
  {
    Vector4 diagonal; ///< xx, yy, zz
    Vector4 others;   ///< xy, yz, zx

    Block& operator+=(const Block& b)
    {
      diagonal += b.diagonal;
      others += b.others;
      return *this;
    }
    Block inverse() const;
    friend Block operator*(float s, const Block& b) { return { s * b.diagonal, s * b.others }; }
    friend Vector4 operator*(const Block& b, Vector4 x)
    {
      return b.diagonal * x + b.others * rotated(x) + rotated(rotated(b.others * x));
    }
  };

  void apply(double lambda, std::span<const Vector4> x, std::span<Vector4> laplacian,
    std::span<Vector4> result) const;
  /// Of lambda, for a vertex.
  float smoothnessPart(VertexIndex v, float onBoundary) const
  {
    return mesh_.isBoundary(v) ? onBoundary : parts_.empty() ? 1.f : parts_[v];
  }
  /// Of lambda, for the vertices on boundaries.
  static float boundaryPart(double lambda);
  std::vector<Block> inverseDiagonal(double lambda) const;
  /// As umbrellaWeight(), without a look at the ring where there is no boundary.
  float weight(VertexIndex vertex, VertexIndex neighbor) const;

  const Mesh& mesh_;
  const Executor& executor_;
  float slip_;
  std::vector<std::uint32_t> rowBegin_;
  std::vector<Block> diagonal_;
  std::vector<Block> others_; ///< for each slot of the ring of each vertex
  std::vector<Vector4> rightSide_;
  std::vector<float> parts_;        ///< of lambda; empty: all 1
  std::vector<float> innerWeights_; ///< umbrella weights at inner vertices; 0 at others
};
}
