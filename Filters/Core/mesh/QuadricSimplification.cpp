// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/QuadricSimplification.h"

#include "mesh/EdgeQueue.h"
#include "mesh/EdgeValues.h"
#include "mesh/TriangleShape.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of the squared edge, where a triangle gets nearly a line.
constexpr double WeightOfShape = 0.05;
/// Of the squared edge, against the squared distance: on a plane short edges go first.
constexpr double UsualEvenness = 1e-3;
constexpr double EvennessOfSurface = 1e-4;
/// Of the radius ratio, of a surface: with less, normals tell little.
constexpr float LeastShape = 0.25f;
/// Of the angle by which a triangle may turn.
constexpr float LeastCosineOfCollapse = 0.2f;
/// Of what draws a vertex to the middle of its edge, against the planes.
constexpr double WeightOfNear = 1e-3;
constexpr double Never = std::numeric_limits<double>::infinity();
/// Of a closed mesh.
constexpr std::size_t EdgesPerVertex = 3;
/// Vertices, or edges, between two questions whether to go on: a hundredth of a second.
constexpr std::size_t StepsPerAsk = 1024;

/// The mean squared distance of a point from some planes, by their weights, as a quadratic form. Were it the
/// sum, what is thin would go first: its planes have little area.
class Quadric
{
public:
  void addPlane(Vector4 point, Vector4 normal)
  {
    const Eigen::Vector3d direction = normal.toDouble();
    const double weight = direction.norm();
    if (weight > 0.)
    {
      Eigen::Vector4d plane;
      plane << direction / weight, -direction.dot(point.toDouble()) / weight;
      form_ += weight * plane * plane.transpose();
      weight_ += weight;
    }
  }
  void add(const Quadric& other)
  {
    form_ += other.form_;
    weight_ += other.weight_;
  }
  /// Where it is least; on planes, and along lines, that is next to `near`.
  Vector4 leastPlace(Vector4 near) const
  {
    const Eigen::Matrix3d form = form_.topLeftCorner<3, 3>();
    const double toNear = WeightOfNear * form.trace();
    if (!(toNear > 0.))
    {
      return near;
    }
    const Eigen::Matrix3d sum = form + toNear * Eigen::Matrix3d::Identity();
    return Vector4(
      sum.ldlt().solve(toNear * near.toDouble() - Eigen::Vector3d(form_.topRightCorner<3, 1>())));
  }
  double at(Vector4 point) const
  {
    Eigen::Vector4d place;
    place << point.toDouble(), 1.;
    return weight_ > 0. ? std::max(0., place.dot(form_ * place)) / weight_ : 0.;
  }

private:
  Eigen::Matrix4d form_ = Eigen::Matrix4d::Zero();
  double weight_ = 0.;
};

class QuadricSimplifier
{
public:
  QuadricSimplifier(Mesh& mesh, double evenness, float leastShape)
    : mesh_(mesh)
    , evenness_(evenness)
    , leastShape_(leastShape)
    , quadrics_(mesh.indexEnd())
    , waiting_(EdgesPerVertex * mesh.vertexCount())
  {
  }

  /// To be called first. Returns false if `progress` ended it.
  bool lookAtAll(const Progress& progress)
  {
    return forEachVertex(progress,
             [this](VertexIndex v)
             {
               mesh_.forEachTriangleFrom(
                 v, [this](VertexIndex a, VertexIndex b, VertexIndex c) { addTriangle(a, b, c); });
             }) &&
      forEachVertex(progress,
        [this](VertexIndex v)
        {
          for (const VertexIndex neighbor : mesh_.ring(v))
          {
            if (v < neighbor)
            {
              pushBothWays(v, neighbor, waiting_.at(v, neighbor));
            }
          }
        });
  }

  /// Returns false if `progress` ended it.
  bool simplify(std::size_t count, const Progress& progress)
  {
    const std::size_t before = mesh_.vertexCount();
    for (std::size_t step = 0; mesh_.vertexCount() > count && !edges_.empty(); ++step)
    {
      if (step % StepsPerAsk == 0 &&
        !progress(double(before - mesh_.vertexCount()) / double(before - count)))
      {
        return false;
      }
      const auto [cost, removed, kept] = edges_.takeCheapest();
      // An edge is there as long as both its ends.
      if (mesh_.isAlive(removed) && mesh_.isAlive(kept))
      {
        collapse(removed, kept, cost);
      }
    }
    return true;
  }

private:
  /// What an edge has cost that was pushed last, either way; Never, if that does not wait.
  struct WaitingCosts
  {
    bool isUpToDate() const { return now < Never && up == now && down == now; }
    double& way(VertexIndex removed, VertexIndex kept) { return removed < kept ? up : down; }

    double up = Never;
    double down = Never;
    double now = Never; ///< what it costs, if no triangle turns over
  };

  /// What a collapse costs, and where its vertex goes.
  struct Outcome
  {
    double cost = Never;
    Vector4 place;
  };

  template <typename Visit>
  bool forEachVertex(const Progress& progress, const Visit& visit) const
  {
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (v % StepsPerAsk == 0 && !progress(0.))
      {
        return false;
      }
      visit(v);
    }
    return true;
  }

  void addTriangle(VertexIndex a, VertexIndex b, VertexIndex c)
  {
    const Vector4 normal = normalOf(a, b, c);
    for (const VertexIndex v : { a, b, c })
    {
      quadrics_[v].addPlane(mesh_.position(v), normal);
    }
    for (const auto& [from, to] : { std::pair(a, b), std::pair(b, c), std::pair(c, a) })
    {
      if (mesh_.isBoundaryEdge(from, to))
      {
        addBoundary(from, to, normal);
      }
    }
  }

  Vector4 normalOf(VertexIndex a, VertexIndex b, VertexIndex c) const
  {
    const Vector4 corner = mesh_.position(a);
    return cross(mesh_.position(b) - corner, mesh_.position(c) - corner);
  }

  /// A plane that stands on the surface keeps the boundary where it is.
  void addBoundary(VertexIndex from, VertexIndex to, Vector4 normal)
  {
    const float length = std::sqrt(squaredNorm(normal));
    if (length > 0.f)
    {
      const Vector4 edge = mesh_.position(to) - mesh_.position(from);
      const Vector4 out = std::sqrt(squaredNorm(edge)) / length * cross(edge, normal);
      quadrics_[from].addPlane(mesh_.position(from), out);
      quadrics_[to].addPlane(mesh_.position(to), out);
    }
  }

  Quadric quadricOf(VertexIndex a, VertexIndex b) const
  {
    Quadric sum = quadrics_[a];
    sum.add(quadrics_[b]);
    return sum;
  }

  /// The cost is Never, where a triangle would turn over. Either way the outcome is the same.
  Outcome outcomeOf(VertexIndex removed, VertexIndex kept) const
  {
    const Quadric sum = quadricOf(removed, kept);
    const Vector4 place = sum.leastPlace(0.5f * (mesh_.position(removed) + mesh_.position(kept)));
    if (turnsOver(removed, kept, place) || turnsOver(kept, removed, place))
    {
      return { Never, place };
    }
    const double squared = double(squaredNorm(mesh_.position(removed) - mesh_.position(kept)));
    const double flattened =
      leastShape_ > 0.f && flattens(removed, kept, place) ? WeightOfShape : 0.;
    return { sum.at(place) + (evenness_ + flattened) * squared, place };
  }

  /// Whether a triangle of `v` does that is not at the edge.
  bool turnsOver(VertexIndex v, VertexIndex other, Vector4 place) const
  {
    const Ring& ring = mesh_.ring(v);
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      const VertexIndex b = ring[slot], c = ring[ring.after(slot)];
      if (b != other && c != other)
      {
        const Vector4 before = normalOf(v, b, c);
        const Vector4 after = cross(mesh_.position(b) - place, mesh_.position(c) - place);
        const float lengths = std::sqrt(squaredNorm(before) * squaredNorm(after));
        const bool isLine = lengths == 0.f && squaredNorm(before) > 0.f;
        if (isLine || dot(before, after) < LeastCosineOfCollapse * lengths)
        {
          return true;
        }
      }
    }
    return false;
  }

  /// Whether a triangle gets nearly a line that is none yet.
  bool flattens(VertexIndex removed, VertexIndex kept, Vector4 place) const
  {
    float before = 1.f, after = 1.f;
    for (const auto& [v, other] : { std::pair(removed, kept), std::pair(kept, removed) })
    {
      const Ring& ring = mesh_.ring(v);
      for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
      {
        const VertexIndex b = ring[slot], c = ring[ring.after(slot)];
        before =
          std::min(before, radiusRatio(mesh_.position(v), mesh_.position(b), mesh_.position(c)));
        if (b != other && c != other)
        {
          after = std::min(after, radiusRatio(place, mesh_.position(b), mesh_.position(c)));
        }
      }
    }
    return after < leastShape_ && after < before;
  }

  /// What it costs has changed with what is around it, perhaps: then it has to wait.
  void collapse(VertexIndex removed, VertexIndex kept, double expected)
  {
    WaitingCosts& waiting = waiting_.at(removed, kept);
    if (waiting.way(removed, kept) == expected)
    {
      waiting.way(removed, kept) = Never;
    }
    if (!mesh_.canCollapse(removed, kept))
    {
      return;
    }
    const auto [cost, place] = outcomeOf(removed, kept);
    if (cost > expected)
    {
      push(cost, removed, kept, waiting);
      return;
    }
    quadrics_[kept].add(quadrics_[removed]);
    mesh_.collapse(removed, kept);
    mesh_.setPosition(kept, place);
    pushAround(kept);
  }

  /// All edges of a vertex and of its neighbours, each once.
  void pushAround(VertexIndex v)
  {
    const Ring& ring = mesh_.ring(v);
    for (const VertexIndex neighbor : ring)
    {
      WaitingCosts& waiting = waiting_.at(v, neighbor);
      waiting.now = Never;
      pushBothWays(v, neighbor, waiting);
      for (const VertexIndex other : mesh_.ring(neighbor))
      {
        if (other != v && (neighbor < other || !ring.contains(other)))
        {
          pushBothWays(neighbor, other, waiting_.at(neighbor, other));
        }
      }
    }
  }

  void pushBothWays(VertexIndex a, VertexIndex b, WaitingCosts& waiting)
  {
    // Beside a vertex that moves, a cost changes only by the shape of triangles.
    if (leastShape_ == 0.f && waiting.isUpToDate())
    {
      return;
    }
    const bool isToB = mesh_.canCollapse(a, b), isToA = mesh_.canCollapse(b, a);
    if (isToB || isToA)
    {
      const double cost = outcomeOf(a, b).cost;
      waiting.now = std::min(waiting.now, cost);
      push(isToB ? cost : Never, a, b, waiting);
      push(isToA ? cost : Never, b, a, waiting);
    }
  }

  /// Most edges around a collapse cost what they did before, and wait already.
  void push(double cost, VertexIndex removed, VertexIndex kept, WaitingCosts& waiting)
  {
    if (cost < Never && std::exchange(waiting.way(removed, kept), cost) != cost)
    {
      edges_.push({ cost, removed, kept });
    }
  }

  Mesh& mesh_;
  double evenness_;
  float leastShape_;
  std::vector<Quadric> quadrics_;
  EdgeQueue<double> edges_; ///< that vanish with their first vertex
  EdgeValues<WaitingCosts> waiting_;
};

bool isNeverEnded(double) { return true; }

bool simplifyBy(
  Mesh& mesh, std::size_t count, double evenness, float leastShape, const Progress& progress)
{
  if (mesh.vertexCount() <= count)
  {
    return true;
  }
  QuadricSimplifier simplifier(mesh, evenness, leastShape);
  const bool isDone = simplifier.lookAtAll(progress) && simplifier.simplify(count, progress);
  mesh.dropErased();
  return isDone;
}
}

void simplifyByQuadrics(Mesh& mesh, std::size_t count)
{
  simplifyByQuadrics(mesh, count, isNeverEnded);
}

bool simplifyByQuadrics(Mesh& mesh, std::size_t count, const Progress& progress)
{
  return simplifyBy(mesh, count, UsualEvenness, 0.f, progress);
}

void simplifyByQuadricsToEach(
  Mesh& mesh, std::span<const std::size_t> counts, const std::function<bool()>& reached)
{
  QuadricSimplifier simplifier(mesh, UsualEvenness, 0.f);
  simplifier.lookAtAll(isNeverEnded);
  for (const std::size_t count : counts)
  {
    simplifier.simplify(count, isNeverEnded);
    if (!reached())
    {
      return;
    }
  }
  mesh.dropErased();
}

void simplifySurface(Mesh& mesh, std::size_t count)
{
  simplifyBy(mesh, count, EvennessOfSurface, LeastShape, isNeverEnded);
}
}
