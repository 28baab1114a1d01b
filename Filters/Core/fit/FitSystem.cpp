// SPDX-License-Identifier: BSD-3-Clause
#include "fit/FitSystem.h"

#include "mesh/UmbrellaLaplacian.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
constexpr int MostIterations = 300;
constexpr int IterationsPerCheck = 4;
/// Of a triangle, in units of the cloud: with less, what is divided by it is beyond all numbers.
constexpr float LeastSquaredNormal = 1e-30f;

/// A part for the executor.
constexpr std::size_t RowsPerRange = 4096;
}

FitSystem::FitSystem(const Mesh& mesh, double slip, const Executor& executor)
  : mesh_(mesh)
  , executor_(executor)
  , slip_(float(slip))
  , diagonal_(mesh.indexEnd())
  , rightSide_(mesh.indexEnd())
{
  innerWeights_.reserve(mesh.indexEnd());
  rowBegin_.reserve(mesh.indexEnd() + 1);
  rowBegin_.push_back(0);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    innerWeights_.push_back(mesh.isBoundary(v) ? 0.f : 1.f / float(mesh.valence(v)));
    rowBegin_.push_back(rowBegin_.back() + mesh.valence(v));
  }
  others_.resize(rowBegin_.back());
}

void FitSystem::add(
  const PlaceOnMesh& place, Vector4 sample, Vector4 normal, float weight, const Rows& rows)
{
  const float squared = squaredNorm(normal);
  const bool hasPlane = squared > LeastSquaredNormal;
  const float along = hasPlane ? weight * slip_ : weight;
  const float across = hasPlane ? weight * (1.f - slip_) / squared : 0.f;
  const Block metric{ Vector4(along, along, along) + across * (normal * normal),
    across * (normal * rotated(normal)) };
  const Vector4 pull = metric * sample;
  for (unsigned i = 0; i < 3; ++i)
  {
    const VertexIndex v = place.triangle[i];
    if (!rows.has(v))
    {
      continue;
    }
    const float share = place.weights[int(i)];
    diagonal_[v] += share * share * metric;
    rightSide_[v] += share * pull;
    const Ring& ring = mesh_.ring(v);
    for (const unsigned j : { (i + 1) % 3, (i + 2) % 3 })
    {
      const std::uint32_t entry = rowBegin_[v] + ring.find(place.triangle[j]);
      others_[entry] += share * place.weights[int(j)] * metric;
    }
  }
}

void FitSystem::addNormal(
  const PlaceOnMesh& place, Vector4 unitNormal, float weight, const Rows& rows)
{
  const Block metric{ weight * (unitNormal * unitNormal),
    weight * (unitNormal * rotated(unitNormal)) };
  for (unsigned i = 0; i < 3; ++i)
  {
    const VertexIndex v = place.triangle[i];
    if (!rows.has(v))
    {
      continue;
    }
    diagonal_[v] += 2.f * metric;
    const Ring& ring = mesh_.ring(v);
    for (const unsigned j : { (i + 1) % 3, (i + 2) % 3 })
    {
      others_[rowBegin_[v] + ring.find(place.triangle[j])] += -1.f * metric;
    }
  }
}

float FitSystem::weight(VertexIndex vertex, VertexIndex neighbor) const
{
  const float inner = innerWeights_[vertex];
  return inner > 0.f ? inner : umbrellaWeight<float>(mesh_.ring(vertex), neighbor);
}

float FitSystem::boundaryPart(double lambda)
{
  return float(std::min(1., MostBoundarySmoothness / lambda));
}

void FitSystem::apply(double lambda, std::span<const Vector4> x, std::span<Vector4> laplacian,
  std::span<Vector4> result) const
{
  const auto smooth = float(lambda);
  const float onBoundary = boundaryPart(lambda);
  executor_.forEachRange(x.size(), RowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      applyUmbrella<float>(mesh_, x, laplacian, begin, end);
      for (auto v = VertexIndex(begin); v < end && (onBoundary < 1.f || !parts_.empty()); ++v)
      {
        laplacian[v] = smoothnessPart(v, onBoundary) * laplacian[v];
      }
    });
  const auto applyRow = [&](VertexIndex v)
  {
    const Ring& ring = mesh_.ring(v);
    Vector4 sum = diagonal_[v] * x[v] - smooth * laplacian[v];
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex neighbor = ring[slot];
      sum += others_[rowBegin_[v] + slot] * x[neighbor];
      sum += smooth * weight(neighbor, v) * laplacian[neighbor];
    }
    result[v] = sum;
  };
  executor_.forEachRange(x.size(), RowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        applyRow(v);
      }
    });
}

void FitSystem::addBends(double lambda, std::span<const Vector4> bends)
{
  const float onBoundary = boundaryPart(lambda);
  const auto bendAt = [&](VertexIndex v)
  { return float(lambda) * smoothnessPart(v, onBoundary) * bends[v]; };
  executor_.forEachRange(bends.size(), RowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        Vector4 sum = -1.f * bendAt(v);
        for (const VertexIndex neighbor : mesh_.ring(v))
        {
          sum += weight(neighbor, v) * bendAt(neighbor);
        }
        rightSide_[v] += sum;
      }
    });
}

FitSystem::Block FitSystem::Block::inverse() const
{
  const Eigen::Vector3d d = diagonal.toDouble(), o = others.toDouble();
  Eigen::Matrix3d matrix;
  matrix << d.x(), o.x(), o.z(), o.x(), d.y(), o.y(), o.z(), o.y(), d.z();
  const Eigen::Matrix3d inverse = matrix.inverse();
  return { Vector4(Eigen::Vector3d(inverse.diagonal())),
    Vector4(Eigen::Vector3d(inverse(0, 1), inverse(1, 2), inverse(2, 0))) };
}

std::vector<FitSystem::Block> FitSystem::inverseDiagonal(double lambda) const
{
  std::vector<Block> result = diagonal_;
  const float onBoundary = boundaryPart(lambda);
  const auto part = [&](VertexIndex v) { return smoothnessPart(v, onBoundary); };
  const auto invert = [&](VertexIndex v)
  {
    float squares = part(v);
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      const float share = weight(neighbor, v);
      squares += part(neighbor) * share * share;
    }
    const float smooth = float(lambda) * squares;
    result[v].diagonal += Vector4(smooth, smooth, smooth);
    result[v] = result[v].inverse();
  };
  executor_.forEachRange(result.size(), RowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        invert(v);
      }
    });
  return result;
}

bool FitSystem::solve(double lambda, double tolerance, double& scale, std::span<Vector4> x,
  const Progress& progress) const
{
  const std::size_t n = x.size();
  // Across the surface the system is stiff, along it not: a whole block tells these apart.
  const std::vector<Block> inverse = inverseDiagonal(lambda);
  std::vector<Vector4> residual(n), direction(n), product(n), laplacian(n);
  const auto sumOver = [&](const auto& term) { return executor_.sum(n, RowsPerRange, term); };
  apply(lambda, x, laplacian, product);
  double squared = sumOver(
    [&](std::size_t v)
    {
      residual[v] = rightSide_[v] - product[v];
      direction[v] = inverse[v] * residual[v];
      return dot(direction[v], residual[v]);
    });
  scale = std::max(scale, std::sqrt(squared));
  const double start = squared, end = tolerance * tolerance * scale * scale;
  double done = 0.;
  for (int i = 0; i < MostIterations && squared > end; ++i)
  {
    // The residual falls by about the same factor each time.
    done = std::max(done, std::log(squared / start) / std::log(end / start));
    if (i % IterationsPerCheck == 0 && !progress(done))
    {
      return false;
    }
    apply(lambda, direction, laplacian, product);
    const double curvature = sumOver([&](std::size_t v) { return dot(direction[v], product[v]); });
    if (!(curvature > 0.))
    {
      break;
    }
    const auto step = float(squared / curvature);
    const double before = squared;
    // Of what is no longer needed the memory is still near.
    std::vector<Vector4>& preconditioned = product;
    squared = sumOver(
      [&](std::size_t v)
      {
        x[v] += step * direction[v];
        residual[v] += -step * product[v];
        preconditioned[v] = inverse[v] * residual[v];
        return dot(preconditioned[v], residual[v]);
      });
    const auto turn = float(squared / before);
    executor_.forEachRange(n, RowsPerRange,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t v = first; v < last; ++v)
        {
          direction[v] = preconditioned[v] + turn * direction[v];
        }
      });
  }
  return true;
}
}
