// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutCorners.h"

#include "fit/CornerSearch.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A part for the executor.
constexpr std::size_t VerticesPerCornerSearch = 1024;
constexpr std::size_t CentersPerCornerSearch = 64;

class CutCorners
{
public:
  CutCorners(
    const Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , samples_(samples, mesh.indexEnd(), executor)
    , scale_(std::max(variance, samples_.total().squares / std::max(samples_.total().count, 1.)))
    , isBent_(mesh.indexEnd(), 0)
    , isSparse_(mesh.indexEnd(), 0)
    , isLocked_(mesh.indexEnd(), 0)
    , changed_(mesh.indexEnd())
    , corners_(findBendsAndGaps())
  {
  }

  std::vector<CornerCenter> vertices() const
  {
    std::vector<CornerCenter> centers;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (isBent_[v] != 0 && isSparse_[v] != 0 && !mesh_.isBoundary(v))
      {
        centers.push_back({ v });
      }
    }
    return centers;
  }

  /// Those beside which a triangle has few samples, where the surface is bent.
  std::vector<CornerCenter> edges() const
  {
    std::vector<CornerCenter> centers;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (mesh_.isBoundary(v) || isSparse_[v] == 0)
      {
        continue;
      }
      const Ring& ring = mesh_.ring(v);
      for (unsigned slot = 0; slot < ring.size(); ++slot)
      {
        const VertexIndex other = ring[slot];
        if (v < other && !mesh_.isBoundary(other) && (isBent_[v] != 0 || isBent_[other] != 0) &&
          (!isConfirmed(v, slot) || !isConfirmed(v, ring.before(slot))))
        {
          centers.push_back({ v, other });
        }
      }
    }
    return centers;
  }

  /// How many of the centers can become corners, at most `most`.
  std::size_t count(const std::vector<CornerCenter>& centers, std::size_t most)
  {
    std::size_t number = 0;
    for (const auto& [gain, center] : inOrder(centers))
    {
      if (number < most && !isAnyLocked(center))
      {
        lockAround(center);
        ++number;
      }
    }
    return number;
  }

  /// Makes corners of at most `most` of the centers.
  ChangedVertices complete(Mesh& mesh, const std::vector<CornerCenter>& centers, std::size_t most)
  {
    std::size_t left = most;
    CornerSearch search = newSearch();
    for (const auto& [gain, center] : inOrder(centers))
    {
      // Samples are no longer known around what has moved.
      if (left == 0 || isAnyLocked(center))
      {
        continue;
      }
      // What has moved farther off has changed the planes: they may no longer meet near by.
      const Corner corner = search.find(center);
      if (corner.gain > 0.)
      {
        apply(mesh, center, corner);
        --left;
      }
    }
    return std::move(changed_);
  }

private:
  bool isConfirmed(VertexIndex v, unsigned slot) const
  {
    const Ring& ring = mesh_.ring(v);
    return CornerPlanes(mesh_, samples_, scale_)
      .isConfirmed(samples_.load(v, ring[slot], ring[ring.after(slot)]));
  }

  /// Twice its area long.
  Vector4 normalAt(VertexIndex v, unsigned slot) const
  {
    const Ring& ring = mesh_.ring(v);
    const Vector4 from = mesh_.position(v);
    return cross(mesh_.position(ring[slot]) - from, mesh_.position(ring[ring.after(slot)]) - from);
  }

  /// Notes vertices with an edge that is bent, and with triangles that samples do not confirm. Returns how many of the
  /// former there are.
  double findBendsAndGaps()
  {
    executor_.forEachRange(mesh_.indexEnd(), VerticesPerCornerSearch,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          const Ring& ring = mesh_.ring(v);
          for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
          {
            const unsigned next = ring.after(slot);
            const bool isBent = next < ring.triangleCount() &&
              cosineBetween(normalAt(v, slot), normalAt(v, next)) <
                CornerPlanes::MostCosineOfCrooked;
            isBent_[v] |= isBent ? 1 : 0;
            isSparse_[v] |= isConfirmed(v, slot) ? 0 : 1;
          }
        }
      });
    return double(std::count(isBent_.begin(), isBent_.end(), 1));
  }

  CornerSearch newSearch() const { return { mesh_, samples_, scale_, corners_, isLocked_ }; }

  std::vector<std::pair<double, CornerCenter>> inOrder(const std::vector<CornerCenter>& centers)
  {
    std::vector<double> gains(centers.size());
    executor_.forEachRange(centers.size(), CentersPerCornerSearch,
      [&](std::size_t begin, std::size_t end)
      {
        CornerSearch search = newSearch();
        for (std::size_t i = begin; i < end; ++i)
        {
          gains[i] = search.find(centers[i]).gain;
        }
      });
    std::vector<std::pair<double, CornerCenter>> order;
    for (std::size_t i = 0; i < centers.size(); ++i)
    {
      if (gains[i] > 0.)
      {
        order.emplace_back(-gains[i], centers[i]);
      }
    }
    std::sort(order.begin(), order.end());
    return order;
  }

  void apply(Mesh& mesh, const CornerCenter& center, const Corner& corner)
  {
    VertexIndex v = center.v;
    if (center.isAdded())
    {
      const Ring& ring = mesh.ring(v);
      v = mesh.split(v, ring.before(ring.find(center.other)), 2, corner.place);
      changed_.add(v, center.v);
      isLocked_.resize(mesh.indexEnd(), 0);
    }
    for (unsigned i = 0; i < corner.flips; ++i)
    {
      mesh.flip(corner.flipped[i][0], corner.flipped[i][1]);
    }
    mesh.setPosition(v, corner.place);
    lockAround({ v });
    changed_.touchAround(mesh, v);
  }

  bool isAnyLocked(const CornerCenter& center) const
  {
    return isLocked_[center.v] != 0 || (center.isAdded() && isLocked_[center.other] != 0);
  }

  void lockAround(const CornerCenter& center)
  {
    for (const VertexIndex v : { center.v, center.other })
    {
      if (v != NoVertex)
      {
        isLocked_[v] = 1;
        for (const VertexIndex neighbor : mesh_.ring(v))
        {
          isLocked_[neighbor] = 1;
        }
      }
    }
  }

  const Mesh& mesh_;
  const Executor& executor_;
  TriangleSamples samples_;
  double scale_; ///< of a sample's squared distance
  std::vector<std::uint8_t> isBent_, isSparse_;
  std::vector<std::uint8_t> isLocked_;
  ChangedVertices changed_;
  double corners_; ///< that there may be
};
}

ChangedVertices completeCorners(
  Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
{
  CutCorners corners(mesh, samples, variance, executor);
  const std::vector<CornerCenter> vertices = corners.vertices();
  return corners.complete(mesh, vertices, vertices.size());
}

std::size_t wantedAtCorners(const Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor)
{
  CutCorners corners(mesh, samples, variance, executor);
  return corners.count(corners.edges(), most);
}

ChangedVertices addAtCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor)
{
  CutCorners corners(mesh, samples, variance, executor);
  return corners.complete(mesh, corners.edges(), most);
}
}
