// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/CloudPlaces.h"
#include "mesh/Mesh.h"

#include <Eigen/Core>

#include <vector>

namespace neuralmesh
{
/// Carries values at points over to the vertices of a mesh: finds those values a that minimise
///
///   sum over points p of w_p |a_p - b_p a|^2  +  lambda sum over vertices |L a|^2
///
/// where b_p a is the value at the place of p on the mesh and L is the umbrella Laplacian. Lambda is
/// so small that it only decides where there are few points: there, a vertex has the mean of its
/// neighbours. Four values at a time. About 260 bytes a vertex.
class AttributeFit
{
public:
  using Values = Eigen::Array4d;

  /// No vertex may be erased. Mesh and executor must outlive the fit.
  explicit AttributeFit(const Mesh& mesh, const Executor& executor = Executor::sequential());

  void add(const CloudPlaces::Corners& corners, double weight, const Values& values);

  /// The values at the vertices; those without any point in their component are 0.
  std::vector<Values> solve() const;

  /// Whether a vertex is a corner of a triangle on which points lie.
  bool isSupported(VertexIndex v) const { return support_[v] > 0.; }

private:
  void apply(const std::vector<Values>& x, std::vector<Values>& laplacian,
    std::vector<Values>& result) const;
  std::vector<double> inverseDiagonal() const;
  std::vector<Values> firstValues() const;

  const Mesh& mesh_;
  const Executor& executor_;
  std::vector<double> support_; ///< sum of the weights of points
  std::vector<std::size_t> rowBegin_;
  std::vector<double> diagonal_;
  std::vector<double> others_; ///< for each slot of the ring of each vertex
  std::vector<Values> rightSide_;
};
}
