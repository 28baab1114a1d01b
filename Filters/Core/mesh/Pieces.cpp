// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Pieces.h"

#include "base/ConcurrentSets.h"
#include "mesh/BoundaryManager.h"

#include <Eigen/Geometry>

#include <cmath>
#include <span>

namespace neuralmesh
{
namespace
{
/// A part for the executor.
constexpr std::size_t VerticesOfPiecesPart = 4096;

/// Adds up area and volume, with a vertex of the piece as the origin, for precision.
class PieceMeasure
{
public:
  PieceMeasure(const Mesh& mesh, Piece& piece)
    : mesh_(mesh)
    , piece_(piece)
    , origin_(mesh.position(piece.vertices.front()).toDouble())
  {
  }

  void addTriangles(const Executor& executor)
  {
    struct Sum
    {
      double area = 0., volume = 0.;
      bool isClosed = true;
    };
    const std::span<const VertexIndex> vertices = piece_.vertices;
    std::vector<Sum> sums((vertices.size() + VerticesOfPiecesPart - 1) / VerticesOfPiecesPart);
    executor.forEachRange(vertices.size(), VerticesOfPiecesPart,
      [&](std::size_t begin, std::size_t end)
      {
        Sum sum;
        for (const VertexIndex v : vertices.subspan(begin, end - begin))
        {
          const Ring& ring = mesh_.ring(v);
          sum.isClosed = sum.isClosed && !ring.isOpen();
          const Eigen::Vector3d a = at(v);
          for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
          {
            const VertexIndex second = ring[slot], third = ring[ring.after(slot)];
            if (v < second && v < third)
            {
              sum.area += add(a, at(second), at(third), sum.volume);
            }
          }
        }
        sums[begin / VerticesOfPiecesPart] = sum;
      });
    for (const Sum& sum : sums)
    {
      piece_.area += sum.area;
      piece_.volume += sum.volume;
      piece_.isClosed = piece_.isClosed && sum.isClosed;
    }
  }

  /// `isClosed` tells of each vertex whether its loop has been closed.
  void closeLoops(std::vector<bool>& isClosed)
  {
    std::vector<VertexIndex> loop;
    for (const VertexIndex first : piece_.vertices)
    {
      if (!mesh_.isBoundary(first) || isClosed[first])
      {
        continue;
      }
      loop.clear();
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (VertexIndex v = first; !isClosed[v]; v = mesh_.ring(v).back())
      {
        isClosed[v] = true;
        loop.push_back(v);
        sum += at(v);
      }
      const Eigen::Vector3d centroid = sum / double(loop.size());
      for (const VertexIndex v : loop)
      {
        piece_.closingArea += add(centroid, at(v), at(mesh_.ring(v).back()), piece_.volume);
      }
    }
  }

private:
  Eigen::Vector3d at(VertexIndex v) const { return mesh_.position(v).toDouble() - origin_; }

  /// Adds the volume below a triangle; returns its area.
  static double add(
    const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double& volume)
  {
    volume += a.dot(b.cross(c)) / 6.;
    return 0.5 * (b - a).cross(c - a).norm();
  }

  const Mesh& mesh_;
  Piece& piece_;
  Eigen::Vector3d origin_;
};
}

std::vector<Piece> findPieces(const Mesh& mesh, const Executor& executor)
{
  std::vector<Piece> pieces;
  std::vector<bool> isFound(mesh.indexEnd(), false), isClosed(mesh.indexEnd(), false);
  for (VertexIndex seed = 0; seed < mesh.indexEnd(); ++seed)
  {
    if (isFound[seed] || !mesh.isAlive(seed))
    {
      continue;
    }
    Piece& piece = pieces.emplace_back();
    std::vector<VertexIndex>& vertices = piece.vertices;
    isFound[seed] = true;
    vertices.push_back(seed);
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      for (const VertexIndex neighbor : mesh.ring(vertices[i]))
      {
        if (!isFound[neighbor])
        {
          isFound[neighbor] = true;
          vertices.push_back(neighbor);
        }
      }
    }
    PieceMeasure measure(mesh, piece);
    measure.addTriangles(executor);
    measure.closeLoops(isClosed);
  }
  return pieces;
}

std::vector<Eigen::AlignedBox3d> boxesOf(const Mesh& mesh, std::span<const Piece> pieces)
{
  std::vector<Eigen::AlignedBox3d> boxes(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (const VertexIndex v : pieces[i].vertices)
    {
      boxes[i].extend(mesh.position(v).toDouble());
    }
  }
  return boxes;
}

double areaOf(const Mesh& mesh, const Triangle& triangle)
{
  const Vector4 a = mesh.position(triangle[0]);
  return 0.5 *
    std::sqrt(
      double(squaredNorm(cross(mesh.position(triangle[1]) - a, mesh.position(triangle[2]) - a))));
}

double areaOf(const Mesh& mesh, const Executor& executor)
{
  return executor.sum(mesh.indexEnd(), VerticesOfPiecesPart,
    [&](std::size_t v)
    {
      double area = 0.;
      mesh.forEachTriangleFrom(VertexIndex(v),
        [&](VertexIndex a, VertexIndex b, VertexIndex c) {
          area += areaOf(mesh, { a, b, c });
        });
      return area;
    });
}

std::size_t pieceCount(const Mesh& mesh, const Executor& executor)
{
  ConcurrentSets sets(mesh.indexEnd(), executor);
  const auto countWhere = [&](const auto& isCounted)
  {
    return executor.sum(mesh.indexEnd(), VerticesOfPiecesPart,
      [&](std::size_t v) { return isCounted(VertexIndex(v)) ? 1. : 0.; });
  };
  executor.forEachRange(mesh.indexEnd(), VerticesOfPiecesPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        for (const VertexIndex neighbor : mesh.ring(v))
        {
          if (neighbor < v)
          {
            sets.join(v, neighbor);
          }
        }
      }
    });
  return std::size_t(
    countWhere([&](VertexIndex v) { return mesh.isAlive(v) && sets.root(v) == v; }));
}

long genusOf(const Mesh& mesh, const Executor& executor)
{
  const auto pieces = long(pieceCount(mesh, executor)),
             loops = long(BoundaryManager(mesh).loopCount());
  long sides = 0; // of the edges
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    sides += long(mesh.valence(v));
  }
  const long euler = long(mesh.vertexCount()) - sides / 2 + long(mesh.triangleCount());
  return (2 * pieces - loops - euler) / 2;
}
}
