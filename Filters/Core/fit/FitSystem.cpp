// SPDX-License-Identifier: BSD-3-Clause
#include "fit/FitSystem.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace neuralmesh
{
namespace
{
constexpr int MostIterations = 300;
constexpr int IterationsPerCheck = 4;
/// The least squared normal of a triangle, in units of the cloud. Divisions by a smaller one
/// overflow.
constexpr float LeastSquaredNormal = 1e-30f;

/// The size of a part for the executor.
constexpr std::size_t RowsPerRange = 4096;

/// L x at a vertex with this ring; see UmbrellaLaplacian.h.
template <typename Vectors>
Vector4 umbrellaAt(
  const Vectors& x, VertexIndex v, std::span<const VertexIndex> ring, bool isOpen, float weight)
{
  if (isOpen)
  {
    return 0.5f * (x[ring.front()] + x[ring.back()]) - x[v];
  }
  Vector4 sum = x[ring.front()];
  for (const VertexIndex neighbor : ring.subspan(1))
  {
    sum += x[neighbor];
  }
  return weight * sum - x[v];
}
}

FitSystem::FitSystem(const Mesh& mesh, double slip, const Executor& executor)
  : rings_(mesh, executor)
  , executor_(executor)
  , slip_(float(slip))
  , diagonal_(mesh.indexEnd())
  , firstEntry_(mesh.indexEnd() + std::size_t(1))
  , rank_(rings_.neighborCount())
  , rightSide_(mesh.indexEnd())
  , innerWeights_(mesh.indexEnd())
{
  executor_.forEachRange(rings_.size(), RowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const std::span<const VertexIndex> ring = rings_[v];
        innerWeights_[v] = rings_.isOpen(v) ? 0.f : 1.f / float(ring.size());
        std::uint8_t count = 0;
        for (std::size_t slot = 0; slot < ring.size(); ++slot)
        {
          rank_[rings_.begin(v) + slot] = ring[slot] > v ? count++ : 0;
        }
        firstEntry_[v + std::size_t(1)] = count;
      }
    });
  std::partial_sum(firstEntry_.begin(), firstEntry_.end(), firstEntry_.begin());
  others_.emplace(firstEntry_[mesh.indexEnd()]);
  executor_.forEachRange(rings_.size(), RowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const std::span<const VertexIndex> ring = rings_[v];
        for (std::size_t slot = 0; slot < ring.size(); ++slot)
        {
          const VertexIndex neighbor = ring[slot];
          if (neighbor < v)
          {
            rank_[rings_.begin(v) + slot] =
              std::uint8_t(entryOf(neighbor, v) - firstEntry_[neighbor]);
          }
        }
      }
    });
}

std::size_t FitSystem::entryOf(VertexIndex lower, VertexIndex higher) const
{
  const std::span<const VertexIndex> ring = rings_[lower];
  const auto slot = std::size_t(std::find(ring.begin(), ring.end(), higher) - ring.begin());
  return firstEntry_[lower] + std::size_t(rank_[rings_.begin(lower) + slot]);
}

void FitSystem::add(
  const PlaceOnMesh& place, Vector4 sample, Vector4 normal, float weight, const Rows& rows)
{
  const float squared = squaredNorm(normal);
  const bool hasPlane = squared > LeastSquaredNormal;
  const float along = hasPlane ? weight * slip_ : weight;
  const float across = hasPlane ? weight * (1.f - slip_) / squared : 0.f;
  const SymmetricBlock metric{ Vector4(along, along, along) + across * (normal * normal),
    across * (normal * rotated(normal)) };
  const Vector4 pull = metric * sample, weights = place.weights();
  for (unsigned i = 0; i < 3; ++i)
  {
    const VertexIndex v = place.triangle[i];
    if (!rows.has(v))
    {
      continue;
    }
    const float share = weights[int(i)];
    diagonal_.add(v, share * share * metric);
    rightSide_.add(v, share * pull);
    for (const unsigned j : { (i + 1) % 3, (i + 2) % 3 })
    {
      if (place.triangle[j] > v)
      {
        others_->add(entryOf(v, place.triangle[j]), share * weights[int(j)] * metric);
      }
    }
  }
}

void FitSystem::addNormal(
  const PlaceOnMesh& place, Vector4 unitNormal, float weight, const Rows& rows)
{
  const SymmetricBlock metric{ weight * (unitNormal * unitNormal),
    weight * (unitNormal * rotated(unitNormal)) };
  for (unsigned i = 0; i < 3; ++i)
  {
    const VertexIndex v = place.triangle[i];
    if (!rows.has(v))
    {
      continue;
    }
    diagonal_.add(v, 2.f * metric);
    for (const unsigned j : { (i + 1) % 3, (i + 2) % 3 })
    {
      if (place.triangle[j] > v)
      {
        others_->add(entryOf(v, place.triangle[j]), -1.f * metric);
      }
    }
  }
}

float FitSystem::weight(VertexIndex vertex, VertexIndex neighbor) const
{
  const float inner = innerWeights_[vertex];
  if (inner > 0.f)
  {
    return inner;
  }
  const std::span<const VertexIndex> ring = rings_[vertex];
  return ring.front() == neighbor || ring.back() == neighbor ? 0.5f : 0.f;
}

float FitSystem::boundaryPart(double lambda)
{
  return float(std::min(1., MostBoundarySmoothness / lambda));
}

template <typename Vectors>
void FitSystem::apply(double lambda, const Vectors& x, std::span<const Vector4> bends,
  PackedVectors& laplacian, PackedVectors& result) const
{
  const auto smooth = float(lambda);
  const float onBoundary = boundaryPart(lambda);
  const bool hasParts = onBoundary < 1.f || !parts_.empty();
  executor_.forEachRange(rings_.size(), RowsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        Vector4 bend = umbrellaAt(x, v, rings_[v], rings_.isOpen(v), innerWeights_[v]);
        bend = bends.empty() ? bend : bend - bends[v];
        laplacian.set(v, hasParts ? smoothnessPart(v, onBoundary) * bend : bend);
      }
    });
  const auto applyRow = [&](VertexIndex v)
  {
    const std::span<const VertexIndex> ring = rings_[v];
    const std::uint8_t* rank = rank_.data() + rings_.begin(v);
    Vector4 sum = diagonal_[v] * x[v] - smooth * laplacian[v];
    for (const VertexIndex neighbor : ring)
    {
      const std::size_t entry = std::size_t(firstEntry_[std::min(v, neighbor)]) + *rank++;
      sum += (*others_)[entry] * x[neighbor];
      sum += smooth * weight(neighbor, v) * laplacian[neighbor];
    }
    result.set(v, sum);
  };
  executor_.forEachRange(rings_.size(), RowsPerRange,
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
        for (const VertexIndex neighbor : rings_[v])
        {
          sum += weight(neighbor, v) * bendAt(neighbor);
        }
        rightSide_.add(v, sum);
      }
    });
}

SymmetricBlocks FitSystem::inverseDiagonal(double lambda) const
{
  SymmetricBlocks result(diagonal_.size());
  const float onBoundary = boundaryPart(lambda);
  const auto part = [&](VertexIndex v) { return smoothnessPart(v, onBoundary); };
  const auto invert = [&](VertexIndex v)
  {
    float squares = part(v);
    for (const VertexIndex neighbor : rings_[v])
    {
      const float share = weight(neighbor, v);
      squares += part(neighbor) * share * share;
    }
    const float smooth = float(lambda) * squares;
    SymmetricBlock block = diagonal_[v];
    block.diagonal += Vector4(smooth, smooth, smooth);
    result.set(v, block.inverse());
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
  const Progress& progress, PackedVectors residual) const
{
  const std::size_t n = x.size();
  // The system is stiff across the surface, but not along it. So the preconditioner has blocks of 3
  // x 3.
  const SymmetricBlocks inverse = inverseDiagonal(lambda);
  PackedVectors direction(n), product(n), laplacian(n);
  const auto sumOver = [&](const auto& term) { return executor_.sum(n, RowsPerRange, term); };
  apply(lambda, x, bends_, laplacian, product);
  double squared = sumOver(
    [&](std::size_t v)
    {
      const Vector4 left = residual[v] - product[v], towards = inverse[v] * left;
      residual.set(v, left);
      direction.set(v, towards);
      return dot(towards, left);
    });
  scale = std::max(scale, std::sqrt(squared));
  const double start = squared, end = tolerance * tolerance * scale * scale;
  double done = 0.;
  for (int i = 0; i < MostIterations && squared > end; ++i)
  {
    // The residual falls by about the same factor in each iteration.
    done = std::max(done, std::log(squared / start) / std::log(end / start));
    if (i % IterationsPerCheck == 0 && !progress(done))
    {
      return false;
    }
    apply(lambda, direction, {}, laplacian, product);
    const double curvature = sumOver([&](std::size_t v) { return dot(direction[v], product[v]); });
    if (!(curvature > 0.))
    {
      break;
    }
    const auto step = float(squared / curvature);
    const double before = squared;
    // This memory is free now, and in the cache.
    PackedVectors& preconditioned = product;
    squared = sumOver(
      [&](std::size_t v)
      {
        x[v] += step * direction[v];
        const Vector4 left = residual[v] + -step * product[v], towards = inverse[v] * left;
        residual.set(v, left);
        preconditioned.set(v, towards);
        return dot(towards, left);
      });
    const auto turn = float(squared / before);
    executor_.forEachRange(n, RowsPerRange,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t v = first; v < last; ++v)
        {
          direction.set(v, preconditioned[v] + turn * direction[v]);
        }
      });
  }
  return true;
}
}
