// SPDX-License-Identifier: BSD-3-Clause
#include "fit/SheetJoints.h"

#include "base/UnitVector.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryManager.h"
#include "mesh/EachVertex.h"
#include "mesh/NarrowStrips.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// What is smaller, against the other part, is no sheet of its own.
constexpr double LeastPartOfOther = 0.05;
/// The length of the mean normal of a sheet around the end of a tube. It is lower where a true neck widens as a funnel
/// does.
constexpr float LeastFlatness = 0.8f;
/// Cosines between the axis of a tube and the normals of its wall, and of the sheets.
constexpr float MostOnWall = 0.4f;
constexpr float LeastOnSheet = 0.8f;
/// The samples that lie on the wall of a tube within the noise, against those of as large an area of the sheets. On a
/// true tube there are as many. On a false one, the samples of the sheets that it pierces are closest to it. They are
/// farther from it than so many times the median distance.
constexpr double MostSamplesOnWall = 0.5;
constexpr float MostMedians = 3.f;
/// Wider tubes are seen.
constexpr StripLimits Tubes{ .longestLoop = 11, .mostVertices = 60, .leastOnEachSide = 0 };
/// The length of the mean normal of the triangles at a vertex, at a bend.
constexpr float MostAtBend = 0.9f;

/// For the executor.
constexpr std::size_t VerticesOfJointRange = 4096;

/// Vertices at one end of a tube.
struct TubeEnd
{
  std::vector<VertexIndex> rim;
  std::vector<VertexIndex> around; ///< of the rim, too
};

Vector4 meanNormal(const Mesh& mesh, const std::vector<VertexIndex>& vertices)
{
  Vector4 sum;
  for (const VertexIndex v : vertices)
  {
    sum += unit(mesh.normal(v));
  }
  return (1.f / float(vertices.size())) * sum;
}

Vector4 unitNormal(const Mesh& mesh, const Triangle& triangle)
{
  const auto [a, b, c] = triangle;
  return unit(cross(mesh.position(b) - mesh.position(a), mesh.position(c) - mesh.position(a)));
}

template <typename Visit>
void forEachTriangleAt(const Mesh& mesh, VertexIndex v, const Visit& visit)
{
  const Ring& ring = mesh.ring(v);
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    visit(Triangle{ v, ring[slot], ring[ring.after(slot)] });
  }
}

bool isBent(const Mesh& mesh, VertexIndex v)
{
  Vector4 sum;
  forEachTriangleAt(mesh, v, [&](const Triangle& triangle) { sum += unitNormal(mesh, triangle); });
  const float most = MostAtBend * float(mesh.ring(v).triangleCount());
  return squaredNorm(sum) < most * most;
}

/// The vertices at which the surface bends as at the end of a tube, and their neighbours.
std::vector<std::uint8_t> verticesAtBends(const Mesh& mesh, const Executor& executor)
{
  std::vector<std::uint8_t> isAtBend(mesh.indexEnd(), 0), isCandidate(mesh.indexEnd(), 0);
  forEachVertex(mesh, executor, VerticesOfJointRange,
    [&](VertexIndex v) { isAtBend[v] = isBent(mesh, v) ? 1 : 0; });
  forEachVertex(mesh, executor, VerticesOfJointRange,
    [&](VertexIndex v)
    {
      const Ring& ring = mesh.ring(v);
      isCandidate[v] = isAtBend[v] != 0 ||
          std::any_of(ring.begin(), ring.end(), [&](VertexIndex at) { return isAtBend[at] != 0; })
        ? 1
        : 0;
    });
  return isCandidate;
}

/// The parts of a mesh that is cut at all narrow strips.
class CutParts
{
public:
  CutParts(const Mesh& mesh, const std::vector<NarrowStrip>& strips, const Executor& executor)
    : mesh_(mesh)
    , partOf_(mesh.indexEnd(), NoPart)
  {
    Mesh rest = mesh;
    for (const NarrowStrip& strip : strips)
    {
      cutStrip(rest, strip);
    }
    for (const Piece& piece : findPieces(rest, executor))
    {
      bool isOpen = false;
      for (const VertexIndex v : piece.vertices)
      {
        partOf_[v] = std::uint32_t(areas_.size());
        isOpen = isOpen || mesh.isBoundary(v);
      }
      areas_.push_back(piece.area);
      isOpen_.push_back(isOpen);
    }
  }

  /// Whether two large parts, open or closed, hang together by this strip, which are flat there, and whether it turns them contrary
  /// and hardly any samples lie on it.
  bool areJoinedBy(
    const NarrowStrip& strip, std::span<const PlaceOnMesh> places, float medianDistance) const
  {
    const std::map<std::uint32_t, TubeEnd> ends = endsOf(strip);
    if (ends.size() != 2)
    {
      return false;
    }
    const auto& [one, endOfOne] = *ends.begin();
    const auto& [other, endOfOther] = *ends.rbegin();
    const auto [smaller, larger] = std::minmax(areas_[one], areas_[other]);
    if (isOpen_[one] != isOpen_[other] || smaller < LeastPartOfOther * larger)
    {
      return false;
    }
    const Vector4 a = meanNormal(mesh_, endOfOne.around), b = meanNormal(mesh_, endOfOther.around);
    const float least = LeastFlatness * LeastFlatness;
    if (squaredNorm(a) < least || squaredNorm(b) < least)
    {
      return false;
    }
    std::vector<VertexIndex> vertices = strip;
    vertices.insert(vertices.end(), endOfOne.around.begin(), endOfOne.around.end());
    vertices.insert(vertices.end(), endOfOther.around.begin(), endOfOther.around.end());
    return isWallBare(vertices, unit(a - b), places, medianDistance);
  }

  std::map<std::uint32_t, TubeEnd> endsOf(const NarrowStrip& strip) const
  {
    std::map<std::uint32_t, TubeEnd> ends;
    for (const VertexIndex v : strip)
    {
      for (const VertexIndex neighbor : mesh_.ring(v))
      {
        if (partOf_[neighbor] != NoPart)
        {
          ends[partOf_[neighbor]].rim.push_back(neighbor);
        }
      }
    }
    for (auto& [part, end] : ends)
    {
      sortUnique(end.rim);
      end.around = end.rim;
      for (int ring = 0; ring < RingsAround; ++ring)
      {
        const std::vector<VertexIndex> before = end.around;
        for (const VertexIndex v : before)
        {
          const Ring& neighbors = mesh_.ring(v);
          std::copy_if(neighbors.begin(), neighbors.end(), std::back_inserter(end.around),
            [&, wanted = part](VertexIndex neighbor) { return partOf_[neighbor] == wanted; });
        }
        sortUnique(end.around);
      }
    }
    return ends;
  }

private:
  static constexpr std::uint32_t NoPart = std::numeric_limits<std::uint32_t>::max();

  /// Of a tube that consists of some of the triangles between these vertices. The axis is that between sheets which it
  /// turns contrary: no others lie across it.
  bool isWallBare(std::vector<VertexIndex> vertices, Vector4 axis,
    std::span<const PlaceOnMesh> places, float medianDistance) const
  {
    const float most = MostMedians * medianDistance;
    sortUnique(vertices);
    struct Samples
    {
      double count = 0.;
      double area = 0.;
    } wall, sheets;
    const auto add = [&](const Triangle& triangle, double count, double area)
    {
      const float cosine = std::abs(dot(unitNormal(mesh_, triangle), axis));
      if (cosine <= MostOnWall || cosine >= LeastOnSheet)
      {
        Samples& samples = cosine <= MostOnWall ? wall : sheets;
        samples.count += count;
        samples.area += area;
      }
    };
    const auto isAmong = [&](VertexIndex v)
    { return std::binary_search(vertices.begin(), vertices.end(), v); };
    for (const VertexIndex v : vertices)
    {
      forEachTriangleAt(mesh_, v,
        [&](const Triangle& triangle)
        {
          if (triangle[1] > v && triangle[2] > v && isAmong(triangle[1]) && isAmong(triangle[2]))
          {
            add(triangle, 0., areaOf(mesh_, triangle));
          }
        });
    }
    for (const PlaceOnMesh& place : places)
    {
      if (place.squaredDistance <= most * most &&
        std::all_of(place.triangle.begin(), place.triangle.end(), isAmong))
      {
        add(place.triangle, 1., 0.);
      }
    }
    return wall.count * sheets.area < MostSamplesOnWall * sheets.count * wall.area;
  }

  static void sortUnique(std::vector<VertexIndex>& vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> partOf_;
  std::vector<double> areas_;
  std::vector<bool> isOpen_;
};

/// Of those whose vertices are all in `rim`, which is sorted.
void fillLoopsWithin(Mesh& mesh, BoundaryManager& boundaries, const std::vector<VertexIndex>& rim)
{
  constexpr double AnyArea = std::numeric_limits<double>::max();
  for (const VertexIndex v : rim)
  {
    const BoundaryManager::LoopIndex loop = boundaries.loopOf(v);
    if (loop == BoundaryManager::NoLoop)
    {
      continue;
    }
    const std::vector<VertexIndex> vertices = boundaries.vertices(mesh, loop);
    if (std::all_of(vertices.begin(), vertices.end(),
          [&](VertexIndex at) { return std::binary_search(rim.begin(), rim.end(), at); }))
    {
      fillBoundary(mesh, boundaries, loop, CosineOfOutline, AnyArea);
    }
  }
}
}

std::size_t cutSheetJoints(
  Mesh& mesh, std::span<const PlaceOnMesh> places, float medianDistance, const Executor& executor)
{
  std::vector<NarrowStrip> strips =
    findNarrowStrips(mesh, executor, Tubes, verticesAtBends(mesh, executor));
  if (strips.empty())
  {
    return 0;
  }
  const CutParts parts(mesh, strips, executor);
  std::erase_if(strips,
    [&](const NarrowStrip& strip) { return !parts.areJoinedBy(strip, places, medianDistance); });
  std::vector<std::vector<VertexIndex>> rims;
  for (const NarrowStrip& strip : strips)
  {
    for (auto& [part, end] : parts.endsOf(strip))
    {
      rims.push_back(std::move(end.rim));
    }
  }
  for (const NarrowStrip& strip : strips)
  {
    cutStrip(mesh, strip);
  }
  BoundaryManager boundaries(mesh);
  for (const std::vector<VertexIndex>& rim : rims)
  {
    fillLoopsWithin(mesh, boundaries, rim);
  }
  return strips.size();
}
}
