// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/EdgeFlips.h"
#include "mesh/HalfEdgeCollapse.h"
#include "mesh/VertexSplit.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

namespace neuralmesh::testing
{
namespace
{
double length(const Mesh& mesh, VertexIndex a, VertexIndex b)
{
  return (mesh.position(a) - mesh.position(b)).toDouble().norm();
}

/// Valences, boundary vertices and opposite vertices of edges, from the triangles alone.
class Connectivity
{
public:
  explicit Connectivity(const Mesh& mesh)
  {
    for (const Triangle& triangle : trianglesOf(mesh))
    {
      for (unsigned k = 0; k < 3; ++k)
      {
        const VertexIndex a = triangle[k], b = triangle[(k + 1) % 3];
        this->opposite_[{ a, b }] = triangle[(k + 2) % 3];
        this->neighbors_[a].insert(b);
        this->neighbors_[b].insert(a);
      }
    }
  }

  int valence(VertexIndex v) const { return int(this->neighbors_.at(v).size()); }
  const std::set<VertexIndex>& neighbors(VertexIndex v) const { return this->neighbors_.at(v); }
  bool isBoundaryEdge(VertexIndex a, VertexIndex b) const
  {
    return this->opposites(a, b).size() == 1;
  }
  bool isBoundary(VertexIndex v) const
  {
    return std::any_of(this->neighbors(v).begin(), this->neighbors(v).end(),
      [&](VertexIndex neighbor) { return this->isBoundaryEdge(v, neighbor); });
  }
  int regularValence(VertexIndex v) const { return this->isBoundary(v) ? 4 : 6; }
  std::vector<VertexIndex> opposites(VertexIndex a, VertexIndex b) const
  {
    std::vector<VertexIndex> result;
    for (const auto& edge : { std::pair(a, b), std::pair(b, a) })
    {
      const auto place = this->opposite_.find(edge);
      if (place != this->opposite_.end())
      {
        result.push_back(place->second);
      }
    }
    return result;
  }

  /// Sum over all vertices of the squared distance of the valence from the regular one.
  int irregularity() const
  {
    int sum = 0;
    for (const auto& [v, neighbors] : this->neighbors_)
    {
      const int excess = this->valence(v) - this->regularValence(v);
      sum += excess * excess;
    }
    return sum;
  }

private:
  std::map<std::pair<VertexIndex, VertexIndex>, VertexIndex> opposite_;
  std::map<VertexIndex, std::set<VertexIndex>> neighbors_;
};

/// (6.7) and (7.3) with the regular valence 4 in place of 6 for boundary vertices.
double errorByFormula(const Connectivity& mesh, VertexIndex removed, VertexIndex kept)
{
  const bool boundaryEdge = mesh.isBoundaryEdge(removed, kept);
  const int lost = boundaryEdge ? 3 : 4;
  const int ends = mesh.valence(kept) + mesh.valence(removed) - lost - mesh.regularValence(kept);
  double sum = double(ends) * ends;
  for (const VertexIndex opposite : mesh.opposites(removed, kept))
  {
    const int excess = mesh.valence(opposite) - 1 - mesh.regularValence(opposite);
    sum += double(excess) * excess;
  }
  return std::sqrt(sum) / (boundaryEdge ? 2. : 3.);
}

std::vector<Mesh> randomMeshes(int count, bool open, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Mesh> meshes;
  for (int i = 0; i < count; ++i)
  {
    meshes.push_back(makeRandomMesh(20 + std::size_t(i), random));
    if (open)
    {
      tear(meshes.back(), 6 + unsigned(i) / 4, random);
    }
  }
  return meshes;
}

double doubledAreaInPlane(const Mesh& mesh, const Triangle& triangle)
{
  const Eigen::Vector3d a = mesh.position(triangle[0]).toDouble();
  const Eigen::Vector3d b = mesh.position(triangle[1]).toDouble();
  const Eigen::Vector3d c = mesh.position(triangle[2]).toDouble();
  return (b - a).cross(c - a).z();
}

/// A flat, very irregular triangulation of a disk.
Mesh makeIrregularDisk(std::size_t vertices, Random& random)
{
  Mesh mesh = makeFan(7);
  while (mesh.vertexCount() < vertices)
  {
    const VertexIndex v = random.below(std::uint32_t(mesh.indexEnd()));
    const Ring& ring = mesh.ring(v);
    const unsigned slot = random.below(ring.triangleCount());
    const Triangle triangle{ v, ring[slot], ring[ring.after(slot)] };
    const bool fits = std::all_of(triangle.begin(), triangle.end(),
      [&](VertexIndex corner) { return mesh.valence(corner) < Ring::Capacity; });
    if (fits && doubledAreaInPlane(mesh, triangle) > 1e-5 && !ring.isOpen())
    {
      insertIntoTriangle(mesh, v, slot);
    }
  }
  return mesh;
}
}

// An inner vertex is split at its longest edge, at its midpoint, into two halves of its star.
TEST(Growth, SplitHalvesTheStarAroundTheLongestEdge)
{
  int splits = 0;
  for (const Mesh& original : randomMeshes(40, false, 1))
  {
    for (VertexIndex v = 0; v < original.indexEnd(); ++v)
    {
      const auto plan = planVertexSplit(original, v);
      if (!plan)
      {
        continue;
      }
      ++splits;
      VertexIndex farthest = original.ring(v)[0];
      for (const VertexIndex neighbor : original.ring(v))
      {
        farthest =
          length(original, v, neighbor) > length(original, v, farthest) ? neighbor : farthest;
      }
      const Vector4 middle = 0.5f * (original.position(v) + original.position(farthest));
      EXPECT_LT((plan->position - middle).toDouble().norm(), 1e-6);

      // The longest edge is in the middle of those that the new vertex takes over.
      const Ring& ring = original.ring(v);
      const unsigned offset = (ring.find(farthest) + ring.size() - plan->first) % ring.size();
      EXPECT_LE(std::abs(2 * int(offset) - int(plan->steps)), 1);
      EXPECT_GT(offset, 0u);
      EXPECT_LT(offset, plan->steps);

      Mesh mesh = original;
      const VertexIndex added = mesh.split(v, plan->first, plan->steps, plan->position);
      EXPECT_TRUE(mesh.ring(added).contains(farthest));
      EXPECT_FALSE(mesh.ring(v).contains(farthest));
      EXPECT_LE(std::abs(int(mesh.valence(v)) - int(mesh.valence(added))), 1);
      ASSERT_EQ(defectOf(mesh), "");
    }
  }
  EXPECT_GT(splits, 500);
}

// Where the star cannot lie evenly around the longest edge, the ends of lower valence gain.
TEST(Growth, UnevenSplitLeansToLowerValence)
{
  // Of six edges three steps are taken over: from one before the longest, or from two before.
  const auto leansTo = [](unsigned raised)
  {
    Mesh mesh = makeBipyramid(6);
    const Ring ring = mesh.ring(0);
    mesh.setPosition(ring[2], 3.f * mesh.position(ring[2]));
    // A vertex in a triangle beside the rim raises two rim vertices.
    insertIntoTriangle(mesh, 4,
      [&]
      {
        const Ring& below = mesh.ring(4);
        const unsigned a = below.find(ring[raised]), b = below.find(ring[raised + 1]);
        return below.next(a) == ring[raised + 1] ? a : b;
      }());
    return planVertexSplit(mesh, 0)->first;
  };
  // The ends are 1 and 4, or 0 and 3. Raising 3 (and 2, not an end) favours the first pair ...
  Mesh even = makeBipyramid(6);
  even.setPosition(even.ring(0)[2], 3.f * even.position(even.ring(0)[2]));
  EXPECT_EQ(planVertexSplit(even, 0)->steps, 3u);
  EXPECT_EQ(leansTo(2), 1u);
  // ... raising 4 (and 5, not an end) the second.
  EXPECT_EQ(leansTo(4), 0u);
}

// At a boundary: no split below valence 4; else at the longest boundary edge, which stays on the
// boundary.
TEST(Growth, SplitAtBoundary)
{
  int splits = 0, refused = 0;
  for (const Mesh& original : randomMeshes(60, true, 2))
  {
    for (VertexIndex v = 0; v < original.indexEnd(); ++v)
    {
      if (!original.isAlive(v) || !original.isBoundary(v))
      {
        continue;
      }
      const auto plan = planVertexSplit(original, v);
      if (original.valence(v) < 4)
      {
        EXPECT_FALSE(plan.has_value());
        ++refused;
        continue;
      }
      if (!plan)
      {
        continue;
      }
      ++splits;
      const VertexIndex front = original.ring(v).front(), back = original.ring(v).back();
      const VertexIndex farther =
        length(original, v, front) >= length(original, v, back) ? front : back;
      const Vector4 middle = 0.5f * (original.position(v) + original.position(farther));
      EXPECT_LT((plan->position - middle).toDouble().norm(), 1e-6);

      Mesh mesh = original;
      const VertexIndex added = mesh.split(v, plan->first, plan->steps, plan->position);
      EXPECT_TRUE(mesh.isBoundaryEdge(v, added));
      EXPECT_TRUE(mesh.isBoundaryEdge(added, farther));
      EXPECT_LE(std::abs(int(mesh.valence(v)) - int(mesh.valence(added))), 1);
      ASSERT_EQ(defectOf(mesh), "");
    }
  }
  EXPECT_GT(splits, 100);
  EXPECT_GT(refused, 100);
}

// A split that is not legal is not planned: here the ends of the star have full rings.
TEST(Growth, IllegalSplitIsNotPlanned)
{
  Mesh mesh = makeBipyramid(Ring::Capacity);
  const VertexIndex rim = mesh.ring(0)[0];
  // With the longest edge along the rim, the two edges of the split are those up and down.
  mesh.setPosition(mesh.ring(rim).next(mesh.ring(rim).find(0)), Vector4(50.f, 0.f, 0.f));
  EXPECT_FALSE(planVertexSplit(mesh, rim).has_value());
  Mesh fitting = makeBipyramid(Ring::Capacity - 1);
  fitting.setPosition(fitting.ring(rim).next(fitting.ring(rim).find(0)), Vector4(50.f, 0.f, 0.f));
  EXPECT_TRUE(planVertexSplit(fitting, rim).has_value());
}

// F_v is the square of the mean length of the edges at a vertex, (6.20).
TEST(Growth, RestrictedVoronoiArea)
{
  Mesh fan = makeFan(6);
  EXPECT_NEAR(restrictedVoronoiArea(fan, 0), 1., 1e-6);
  for (const Mesh& mesh : randomMeshes(5, true, 3))
  {
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      if (mesh.isAlive(v))
      {
        double sum = 0.;
        for (const VertexIndex neighbor : mesh.ring(v))
        {
          sum += length(mesh, v, neighbor);
        }
        const double mean = sum / mesh.valence(v);
        EXPECT_NEAR(restrictedVoronoiArea(mesh, v), mean * mean, 1e-6 * mean * mean);
      }
    }
  }
}

// Where everything is regular after the collapse, the error is zero; (6.7) and (7.3) by hand.
TEST(Growth, RegularityErrorByHand)
{
  // Rim of a bipyramid: a = b = 4, c = d = the size of the rim.
  for (const unsigned rim : { 5u, 7u, 9u })
  {
    const Mesh mesh = makeBipyramid(rim);
    const double expected = std::sqrt(4. + 2. * (rim - 7.) * (rim - 7.)) / 3.;
    EXPECT_NEAR(regularityError(mesh, mesh.ring(0)[0], mesh.ring(0)[1]), expected, 1e-12);
  }
  // Rim of a fan, two boundary vertices of valence 3: a + b - 7 = -1, c - 7 for the middle.
  for (const unsigned rim : { 5u, 7u, 9u })
  {
    const Mesh mesh = makeFan(rim);
    const double expected = std::sqrt(1. + (rim - 7.) * (rim - 7.)) / 2.;
    EXPECT_NEAR(regularityError(mesh, mesh.ring(0)[0], mesh.ring(0)[1]), expected, 1e-12);
  }
}

// The error is that of the formulas for every edge of closed and open meshes.
TEST(Growth, RegularityErrorByFormula)
{
  int inner = 0, boundary = 0, mixed = 0;
  for (const bool open : { false, true })
  {
    for (const Mesh& mesh : randomMeshes(30, open, 4))
    {
      const Connectivity connectivity(mesh);
      for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
      {
        for (const VertexIndex neighbor : mesh.ring(v))
        {
          EXPECT_NEAR(
            regularityError(mesh, v, neighbor), errorByFormula(connectivity, v, neighbor), 1e-12);
          const bool atBoundary = connectivity.isBoundary(v) || connectivity.isBoundary(neighbor);
          ++(connectivity.isBoundaryEdge(v, neighbor) ? boundary : atBoundary ? mixed : inner);
        }
      }
    }
  }
  EXPECT_GT(inner, 1000);
  EXPECT_GT(boundary, 300);
  EXPECT_GT(mixed, 300);
}

// The collapse chosen is legal, and no legal one has a lower error; none only if none is legal.
TEST(Growth, BestCollapseIsTheLeastLegalOne)
{
  int chosen = 0, passedOver = 0, none = 0;
  for (const bool open : { false, true })
  {
    for (const Mesh& original : randomMeshes(40, open, 5))
    {
      const Connectivity connectivity(original);
      for (VertexIndex v = 0; v < original.indexEnd(); ++v)
      {
        if (!original.isAlive(v))
        {
          continue;
        }
        double least = std::numeric_limits<double>::infinity();
        double leastIllegal = least;
        for (const VertexIndex neighbor : original.ring(v))
        {
          double& best = original.canCollapse(v, neighbor) ? least : leastIllegal;
          best = std::min(best, errorByFormula(connectivity, v, neighbor));
        }
        const VertexIndex kept = bestCollapse(original, v);
        EXPECT_EQ(kept == NoVertex, std::isinf(least));
        if (kept == NoVertex)
        {
          ++none;
          continue;
        }
        ++chosen;
        passedOver += leastIllegal < least;
        EXPECT_TRUE(original.canCollapse(v, kept));
        EXPECT_NEAR(errorByFormula(connectivity, v, kept), least, 1e-12);
        Mesh mesh = original;
        mesh.collapse(v, kept);
        ASSERT_EQ(defectOf(mesh), "");
      }
    }
  }
  EXPECT_GT(chosen, 1000);
  EXPECT_GT(passedOver, 20);
  EXPECT_GT(none, 0);
}

// Flips keep the manifold, its topology and its vertices, however folded it is.
TEST(Growth, FlipsKeepTopology)
{
  unsigned flips = 0;
  for (const bool open : { false, true })
  {
    for (Mesh& mesh : randomMeshes(40, open, 6))
    {
      const ManifoldReport before = reportOf(mesh);
      for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
      {
        flips += mesh.isAlive(v) ? flipEdgesAround(mesh, v) : 0;
      }
      ASSERT_EQ(defectOf(mesh), "");
      const ManifoldReport after = reportOf(mesh);
      EXPECT_EQ(after.eulerCharacteristic, before.eulerCharacteristic);
      EXPECT_EQ(after.boundaryLoops, before.boundaryLoops);
      EXPECT_EQ(after.usedPoints, before.usedPoints);
    }
  }
  EXPECT_GT(flips, 100u);
}

// Where the mesh is not folded, flips bring valences closer to regular, and never farther from it.
TEST(Growth, FlipsImproveValences)
{
  Random random(11);
  unsigned allFlips = 0;
  for (int repetition = 0; repetition < 10; ++repetition)
  {
    Mesh mesh = makeIrregularDisk(80, random);
    int irregularity = Connectivity(mesh).irregularity();
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const unsigned flips = flipEdgesAround(mesh, v);
      allFlips += flips;
      const int now = Connectivity(mesh).irregularity();
      // The sum of squares is even or odd for good, so that every flip lowers it by two or more.
      EXPECT_LE(now, irregularity - 2 * int(flips));
      irregularity = now;
    }
  }
  EXPECT_GT(allFlips, 100u);
}

// The rim of two sheets that lie back to back retracts; that of a body does not.
TEST(Growth, FlipsRetractRimsOfSheets)
{
  for (const float height : { 0.01f, 1.f })
  {
    Mesh mesh = makeBipyramid(6);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const Vector4 p = mesh.position(v);
      mesh.setPosition(v, Vector4(p[0], p[1], height * p[2]));
    }
    EXPECT_EQ(flipEdgesAround(mesh, mesh.ring(0)[0]) > 0, height < 0.5f);
    EXPECT_EQ(defectOf(mesh), "");
  }
}

// Flips never fold: a flat mesh stays flat, all triangles the right way up.
TEST(Growth, FlipsNeverFold)
{
  Random random(7);
  unsigned flips = 0;
  for (int repetition = 0; repetition < 10; ++repetition)
  {
    Mesh mesh = makeIrregularDisk(80, random);
    const int before = Connectivity(mesh).irregularity();
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      flips += flipEdgesAround(mesh, v);
      for (const Triangle& triangle : trianglesOf(mesh))
      {
        // Up to the rounding of single precision.
        ASSERT_GT(doubledAreaInPlane(mesh, triangle), -1e-6);
      }
    }
    EXPECT_LT(Connectivity(mesh).irregularity(), before / 2);
    EXPECT_EQ(defectOf(mesh), "");
  }
  EXPECT_GT(flips, 100u);
}

// A ridge is not flipped away: what a flat edge gives way to, an edge between two planes does not.
TEST(Growth, FlipsKeepRidges)
{
  for (const bool folded : { false, true })
  {
    Mesh mesh = makeFan(8);
    const Ring rim = mesh.ring(0);
    for (const unsigned beside : { 1u, 7u })
    {
      mesh.setPosition(rim[beside], 1.2f * mesh.position(rim[beside]));
    }
    if (folded)
    {
      // By a right angle along the x axis, on which the first edge lies.
      for (const VertexIndex v : rim)
      {
        const Vector4 p = mesh.position(v);
        mesh.setPosition(v, p[1] < -1e-3f ? Vector4(p[0], 0.f, p[1]) : p);
      }
    }
    EXPECT_GT(flipEdgesAround(mesh, 0), 0u);
    EXPECT_EQ(mesh.ring(0).contains(rim[0]), folded);
    EXPECT_EQ(defectOf(mesh), "");
  }
}
}
