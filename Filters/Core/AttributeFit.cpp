// SPDX-License-Identifier: BSD-3-Clause
#include "AttributeFit.h"

#include "NearestMarked.h"
#include "UmbrellaLaplacian.h"

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
  this->rowBegin_.reserve(mesh.indexEnd() + 1);
  this->rowBegin_.push_back(0);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    this->rowBegin_.push_back(this->rowBegin_.back() + mesh.valence(v));
  }
  this->others_.resize(this->rowBegin_.back());
}

void AttributeFit::add(const CloudPlaces::Corners& corners, double weight, const Values& values)
{
  for (const auto& [v, share] : corners)
  {
    const Ring& ring = this->mesh_.ring(v);
    this->support_[v] += weight * share;
    this->rightSide_[v] += weight * share * values;
    for (const auto& [other, otherShare] : corners)
    {
      double& entry =
        other == v ? this->diagonal_[v] : this->others_[this->rowBegin_[v] + ring.find(other)];
      entry += weight * share * otherShare;
    }
  }
}

void AttributeFit::apply(
  const std::vector<Values>& x, std::vector<Values>& laplacian, std::vector<Values>& result) const
{
  this->executor_.forEachRange(x.size(), AttributeRowsPerRange,
    [&](std::size_t begin, std::size_t end)
    { applyUmbrella<double, Values>(this->mesh_, x, laplacian, begin, end); });
  const auto applyRow = [&](VertexIndex v)
  {
    const Ring& ring = this->mesh_.ring(v);
    Values sum = this->diagonal_[v] * x[v] - Lambda * laplacian[v];
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex neighbor = ring[slot];
      sum += this->others_[this->rowBegin_[v] + slot] * x[neighbor] +
        Lambda * umbrellaWeight<double>(this->mesh_.ring(neighbor), v) * laplacian[neighbor];
    }
    result[v] = sum;
  };
  this->executor_.forEachRange(x.size(), AttributeRowsPerRange,
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
  std::vector<double> result(this->diagonal_.size());
  for (VertexIndex v = 0; v < result.size(); ++v)
  {
    double squares = 1.;
    for (const VertexIndex neighbor : this->mesh_.ring(v))
    {
      const double weight = umbrellaWeight<double>(this->mesh_.ring(neighbor), v);
      squares += weight * weight;
    }
    result[v] = 1. / (this->diagonal_[v] + Lambda * squares);
  }
  return result;
}

/// The mean of the points around each vertex, or around the nearest that has some.
std::vector<Values> AttributeFit::firstValues() const
{
  std::vector<bool> marked(this->support_.size());
  for (VertexIndex v = 0; v < marked.size(); ++v)
  {
    marked[v] = this->isSupported(v);
  }
  std::vector<Values> result(this->support_.size(), Values::Zero());
  const std::vector<VertexIndex> nearest = nearestMarked(this->mesh_, marked);
  for (VertexIndex v = 0; v < result.size(); ++v)
  {
    if (nearest[v] != NoVertex)
    {
      result[v] = this->rightSide_[nearest[v]] / this->support_[nearest[v]];
    }
  }
  return result;
}

std::vector<Values> AttributeFit::solve() const
{
  const std::size_t n = this->support_.size();
  const std::vector<double> inverse = this->inverseDiagonal();
  std::vector<Values> x = this->firstValues();
  std::vector<Values> residual(n), direction(n), product(n), laplacian(n);
  this->apply(x, laplacian, product);
  Values squared = Values::Zero();
  for (std::size_t v = 0; v < n; ++v)
  {
    residual[v] = this->rightSide_[v] - product[v];
    direction[v] = inverse[v] * residual[v];
    squared += residual[v] * direction[v];
  }
  const Values end = AttributeTolerance * AttributeTolerance * squared;
  for (int i = 0; i < MostAttributeIterations && (squared > end).any(); ++i)
  {
    this->apply(direction, laplacian, product);
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
