// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/AttributeFit.h"

#include "cloud/NearestMarked.h"
#include "mesh/UmbrellaLaplacian.h"

namespace neuralmesh
{
namespace
{
/// Against the few points that a triangle has at least, in general.
constexpr double Lambda = 0.1;
constexpr int MostAttributeIterations = 300;
/// A part for the executor.
constexpr std::size_t AttributeRowsPerRange = 4096;
/// Of the residual of the equations, against that at the start.
constexpr double AttributeTolerance = 1e-6;

using Values = AttributeFit::Values;

/// Lane by lane, 0 where the denominator is.
Values ratio(const Values& numerator, const Values& denominator)
{
  return (denominator > 0.).select(numerator / denominator, 0.);
}
}

AttributeFit::AttributeFit(const Mesh& mesh, const Executor& executor)
  : mesh_(mesh)
  , executor_(executor)
  , support_(mesh.indexEnd())
  , diagonal_(mesh.indexEnd())
  , rightSide_(mesh.indexEnd(), Values::Zero())
{
  rowBegin_.reserve(mesh.indexEnd() + 1);
  rowBegin_.push_back(0);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    rowBegin_.push_back(rowBegin_.back() + mesh.valence(v));
  }
  others_.resize(rowBegin_.back());
}

void AttributeFit::add(const CloudPlaces::Corners& corners, double weight, const Values& values)
{
  for (const auto& [v, share] : corners)
  {
    const Ring& ring = mesh_.ring(v);
    support_[v] += weight * share;
    rightSide_[v] += weight * share * values;
    for (const auto& [other, otherShare] : corners)
    {
      double& entry = other == v ? diagonal_[v] : others_[rowBegin_[v] + ring.find(other)];
      entry += weight * share * otherShare;
    }
  }
}

void AttributeFit::apply(
  const std::vector<Values>& x, std::vector<Values>& laplacian, std::vector<Values>& result) const
{
  executor_.forEachRange(x.size(), AttributeRowsPerRange,
    [&](std::size_t begin, std::size_t end)
    { applyUmbrella<double, Values>(mesh_, x, laplacian, begin, end); });
  const auto applyRow = [&](VertexIndex v)
  {
    const Ring& ring = mesh_.ring(v);
    Values sum = diagonal_[v] * x[v] - Lambda * laplacian[v];
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex neighbor = ring[slot];
      sum += others_[rowBegin_[v] + slot] * x[neighbor] +
        Lambda * umbrellaWeight<double>(mesh_.ring(neighbor), v) * laplacian[neighbor];
    }
    result[v] = sum;
  };
  executor_.forEachRange(x.size(), AttributeRowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        applyRow(v);
      }
    });
}

std::vector<double> AttributeFit::inverseDiagonal() const
{
  std::vector<double> result(diagonal_.size());
  for (VertexIndex v = 0; v < result.size(); ++v)
  {
    double squares = 1.;
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      const double weight = umbrellaWeight<double>(mesh_.ring(neighbor), v);
      squares += weight * weight;
    }
    result[v] = 1. / (diagonal_[v] + Lambda * squares);
  }
  return result;
}

/// The mean of the points around each vertex, or around the nearest that has some.
std::vector<Values> AttributeFit::firstValues() const
{
  std::vector<bool> marked(support_.size());
  for (VertexIndex v = 0; v < marked.size(); ++v)
  {
    marked[v] = isSupported(v);
  }
  std::vector<Values> result(support_.size(), Values::Zero());
  const std::vector<VertexIndex> nearest = nearestMarked(mesh_, marked);
  for (VertexIndex v = 0; v < result.size(); ++v)
  {
    if (nearest[v] != NoVertex)
    {
      result[v] = rightSide_[nearest[v]] / support_[nearest[v]];
    }
  }
  return result;
}

std::vector<Values> AttributeFit::solve() const
{
  const std::size_t n = support_.size();
  const std::vector<double> inverse = inverseDiagonal();
  std::vector<Values> x = firstValues();
  std::vector<Values> residual(n), direction(n), product(n), laplacian(n);
  apply(x, laplacian, product);
  Values squared = Values::Zero();
  for (std::size_t v = 0; v < n; ++v)
  {
    residual[v] = rightSide_[v] - product[v];
    direction[v] = inverse[v] * residual[v];
    squared += residual[v] * direction[v];
  }
  const Values end = AttributeTolerance * AttributeTolerance * squared;
  for (int i = 0; i < MostAttributeIterations && (squared > end).any(); ++i)
  {
    apply(direction, laplacian, product);
    Values curvature = Values::Zero();
    for (std::size_t v = 0; v < n; ++v)
    {
      curvature += direction[v] * product[v];
    }
    const Values step = ratio(squared, curvature);
    const Values before = squared;
    squared = Values::Zero();
    for (std::size_t v = 0; v < n; ++v)
    {
      x[v] += step * direction[v];
      residual[v] -= step * product[v];
      squared += inverse[v] * residual[v] * residual[v];
    }
    const Values turn = ratio(squared, before);
    for (std::size_t v = 0; v < n; ++v)
    {
      direction[v] = inverse[v] * residual[v] + turn * direction[v];
    }
  }
  return x;
}
}
