// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "cloud/VertexGrid.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <functional>

namespace neuralmesh::testing
{
namespace
{
using Draw = std::function<Vector4(Random&)>;

/// A grid and, beside it, a plain list of which vertices there are.
class GridUnderTest
{
public:
  GridUnderTest(Vector4 boxMin, Vector4 boxMax, float cellSize, std::size_t capacity)
  {
    this->grid_.reset(boxMin, boxMax, cellSize, capacity);
  }

  VertexIndex insert(Vector4 position)
  {
    const auto v = VertexIndex(this->positions_.size());
    this->positions_.push_back(position);
    this->present_.push_back(true);
    this->grid_.insert(v, position);
    return v;
  }
  void insertAgain(VertexIndex v, Vector4 position)
  {
    this->positions_[v] = position;
    this->present_[v] = true;
    this->grid_.insert(v, position);
  }
  void erase(VertexIndex v)
  {
    this->grid_.erase(v, this->positions_[v]);
    this->present_[v] = false;
  }
  void move(VertexIndex v, Vector4 to)
  {
    this->grid_.move(v, this->positions_[v], to);
    this->positions_[v] = to;
  }

  std::size_t size() const { return this->positions_.size(); }
  bool isPresent(VertexIndex v) const { return this->present_[v]; }
  Vector4 position(VertexIndex v) const { return this->positions_[v]; }

  VertexIndex closest(Vector4 sample) const
  {
    return this->grid_.closest(sample, this->positions_);
  }
  VertexIndex closest(Vector4 sample, VertexIndex near) const
  {
    return this->grid_.closest(sample, this->positions_, near);
  }
  VertexIndex closestOfAll(Vector4 sample) const
  {
    VertexIndex best = NoVertex;
    float least = std::numeric_limits<float>::infinity();
    for (VertexIndex v = 0; v < this->size(); ++v)
    {
      const float distance = squaredNorm(this->positions_[v] - sample);
      if (this->present_[v] && distance < least)
      {
        least = distance;
        best = v;
      }
    }
    return best;
  }

private:
  VertexGrid grid_;
  std::vector<Vector4> positions_;
  std::vector<bool> present_;
};

/// Inserts, moves, erases and asks, in random order; counts the wrong answers.
int wrongAnswers(GridUnderTest& grid, const Draw& vertex, const Draw& sample, int vertices,
  int rounds, std::uint64_t seed)
{
  Random random(seed);
  for (int i = 0; i < vertices; ++i)
  {
    grid.insert(vertex(random));
  }
  int wrong = 0;
  for (int round = 0; round < rounds; ++round)
  {
    const VertexIndex v = random.below(std::uint32_t(grid.size()));
    if (!grid.isPresent(v))
    {
      grid.insertAgain(v, vertex(random));
    }
    else if (random.below(4) == 0)
    {
      grid.erase(v);
    }
    else if (random.below(2) == 0)
    {
      grid.move(v, vertex(random));
    }
    else
    {
      grid.move(v, grid.position(v) + 0.01f * (sample(random) - grid.position(v)));
    }
    const Vector4 asked = sample(random);
    wrong += grid.closest(asked) != grid.closestOfAll(asked);
  }
  return wrong;
}

const Vector4 UnitMin(-1.f, -1.f, -1.f);
const Vector4 UnitMax(1.f, 1.f, 1.f);

Vector4 inBox(Random& random) { return randomPoint(random); }

Vector4 onSphere(Random& random)
{
  for (;;)
  {
    const Vector4 p = randomPoint(random);
    const float squared = squaredNorm(p);
    if (squared > 0.01f && squared < 1.f)
    {
      return (0.8f / std::sqrt(squared)) * p;
    }
  }
}
}

// An empty grid has no closest vertex, nor has one from which all are gone.
TEST(VertexGrid, EmptyGivesNoVertex)
{
  GridUnderTest grid(UnitMin, UnitMax, 0.1f, 10);
  EXPECT_EQ(grid.closest({}), NoVertex);
  EXPECT_EQ(grid.closest(Vector4(50.f, 0.f, 0.f)), NoVertex);
  const VertexIndex v = grid.insert(Vector4(0.3f, 0.2f, 0.1f));
  EXPECT_EQ(grid.closest({}), v);
  grid.erase(v);
  EXPECT_EQ(grid.closest({}), NoVertex);
}

// closest() is exact while vertices move, come and go, for cells of any width.
TEST(VertexGrid, ExactInVolume)
{
  for (const float cellSize : { 0.02f, 0.1f, 0.5f, 5.f })
  {
    GridUnderTest grid(UnitMin, UnitMax, cellSize, 300);
    EXPECT_EQ(wrongAnswers(grid, inBox, inBox, 300, 4000, 1), 0) << "cells of " << cellSize;
  }
}

// The same where vertices lie on a surface and samples on it and far from it.
TEST(VertexGrid, ExactOnSurface)
{
  for (const float cellSize : { 0.03f, 0.15f })
  {
    GridUnderTest near(UnitMin, UnitMax, cellSize, 500);
    EXPECT_EQ(wrongAnswers(near, onSphere, onSphere, 500, 3000, 2), 0);
    GridUnderTest far(UnitMin, UnitMax, cellSize, 500);
    EXPECT_EQ(wrongAnswers(far, onSphere, inBox, 500, 3000, 3), 0);
  }
}

// A few vertices in many cells: the search goes outwards until it is sure.
TEST(VertexGrid, ExactWhereSparse)
{
  for (const int vertices : { 1, 2, 5, 20 })
  {
    GridUnderTest grid(UnitMin, UnitMax, 0.01f, 20);
    EXPECT_EQ(wrongAnswers(grid, inBox, inBox, vertices, 500, 4), 0) << vertices << " vertices";
  }
}

// Samples outside the box find their vertex.
TEST(VertexGrid, ExactForSamplesOutside)
{
  for (const float reach : { 1.5f, 10.f, 1e4f })
  {
    const Draw outside = [reach](Random& random) { return randomPoint(random, reach); };
    GridUnderTest grid(UnitMin, UnitMax, 0.1f, 300);
    EXPECT_EQ(wrongAnswers(grid, onSphere, outside, 300, 2000, 5), 0) << "reach " << reach;
  }
}

// Vertices outside the box are found, from inside and from outside.
TEST(VertexGrid, ExactForVerticesOutside)
{
  const Draw outside = [](Random& random) { return randomPoint(random, 2.5f); };
  GridUnderTest fromOutside(UnitMin, UnitMax, 0.1f, 300);
  EXPECT_EQ(wrongAnswers(fromOutside, outside, outside, 300, 3000, 6), 0);
  GridUnderTest fromInside(UnitMin, UnitMax, 0.1f, 300);
  EXPECT_EQ(wrongAnswers(fromInside, outside, inBox, 300, 3000, 7), 0);
  const Draw farAway = [](Random& random)
  { return Vector4(20.f, 0.f, 0.f) + randomPoint(random, 0.5f); };
  GridUnderTest allOutside(UnitMin, UnitMax, 0.1f, 100);
  EXPECT_EQ(wrongAnswers(allOutside, farAway, inBox, 100, 1000, 8), 0);
}

// All vertices in one cell: more than a line of them holds.
TEST(VertexGrid, ExactInOneCell)
{
  const Draw crowded = [](Random& random)
  { return Vector4(0.45f, 0.45f, 0.45f) + randomPoint(random, 0.01f); };
  GridUnderTest grid(UnitMin, UnitMax, 0.1f, 400);
  EXPECT_EQ(wrongAnswers(grid, crowded, inBox, 200, 2000, 9), 0);
  GridUnderTest close(UnitMin, UnitMax, 0.1f, 400);
  EXPECT_EQ(wrongAnswers(close, crowded, crowded, 200, 2000, 10), 0);
}

// Clouds without volume, without area or without length need no special treatment.
TEST(VertexGrid, ExactInFlatBoxes)
{
  const Draw plane = [](Random& random)
  {
    const Vector4 p = randomPoint(random);
    return Vector4(p[0], 0.5f, p[2]);
  };
  GridUnderTest flat(Vector4(-1.f, 0.5f, -1.f), Vector4(1.f, 0.5f, 1.f), 0.05f, 300);
  EXPECT_EQ(wrongAnswers(flat, plane, plane, 300, 3000, 11), 0);
  GridUnderTest above(Vector4(-1.f, 0.5f, -1.f), Vector4(1.f, 0.5f, 1.f), 0.05f, 300);
  EXPECT_EQ(wrongAnswers(above, plane, inBox, 300, 2000, 12), 0);

  const Draw line = [](Random& random) { return Vector4(0.f, 0.f, randomPoint(random)[2]); };
  GridUnderTest thin(Vector4(0.f, 0.f, -1.f), Vector4(0.f, 0.f, 1.f), 0.01f, 300);
  EXPECT_EQ(wrongAnswers(thin, line, line, 300, 3000, 13), 0);

  const Draw point = [](Random&) { return Vector4(0.25f, 0.5f, 0.75f); };
  GridUnderTest spot(point(*std::make_unique<Random>(1)), Vector4(0.25f, 0.5f, 0.75f), 0.1f, 50);
  EXPECT_EQ(wrongAnswers(spot, point, inBox, 50, 500, 14), 0);
}

// Two clusters far apart, with samples at both and between.
TEST(VertexGrid, ExactForClustersFarApart)
{
  const Draw clusters = [](Random& random)
  {
    const float side = random.below(2) == 0 ? -1.f : 1.f;
    return side * Vector4(90.f, 80.f, 70.f) + randomPoint(random, 0.5f);
  };
  const Vector4 boxMax(100.f, 100.f, 100.f);
  for (const float cellSize : { 0.8f, 8.f })
  {
    GridUnderTest grid(-1.f * boxMax, boxMax, cellSize, 200);
    EXPECT_EQ(wrongAnswers(grid, clusters, clusters, 200, 1500, 15), 0);
    const Draw between = [](Random& random) { return randomPoint(random, 100.f); };
    GridUnderTest apart(-1.f * boxMax, boxMax, cellSize, 200);
    EXPECT_EQ(wrongAnswers(apart, clusters, between, 200, 200, 16), 0);
  }
}

// Nearly all vertices in a small part of the box, samples anywhere: in millions of empty blocks.
TEST(VertexGrid, ExactFarFromVertices)
{
  const Draw vertex = [](Random& random)
  {
    const float width = random.below(20) == 0 ? 1.f : 0.002f;
    return Vector4(0.7f, -0.4f, 0.1f) + randomPoint(random, 0.25f * width);
  };
  GridUnderTest grid(UnitMin, UnitMax, 0.001f, 300);
  EXPECT_EQ(wrongAnswers(grid, vertex, inBox, 300, 2000, 19), 0);
}

// Of vertices that are equally close the lowest index wins, in one cell and across cells.
TEST(VertexGrid, LowestIndexWinsTie)
{
  // Positions on a coarse lattice, samples on one of half its width: most answers are ties.
  const auto lattice = [](Random& random, float step)
  {
    const auto coordinate = [&] { return step * (float(random.below(9)) - 4.f); };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return Vector4(x, y, z);
  };
  const Draw vertex = [&](Random& random) { return lattice(random, 0.25f); };
  const Draw sample = [&](Random& random) { return lattice(random, 0.125f); };
  for (const float cellSize : { 0.0625f, 0.3f, 4.f })
  {
    GridUnderTest grid(UnitMin, UnitMax, cellSize, 600);
    Random random(17);
    for (int i = 0; i < 400; ++i)
    {
      grid.insert(vertex(random));
    }
    for (int i = 0; i < 3000; ++i)
    {
      grid.move(random.below(400), vertex(random));
      const Vector4 asked = sample(random);
      ASSERT_EQ(grid.closest(asked), grid.closestOfAll(asked)) << "cells of " << cellSize;
      // From whichever vertex the search begins.
      ASSERT_EQ(grid.closest(asked, random.below(400)), grid.closestOfAll(asked));
    }
  }
}

// Cells too small for the memory are enlarged, those of no width, too; answers stay exact.
TEST(VertexGrid, ExactWithCellsTooSmall)
{
  for (const float cellSize : { 1e-7f, 1e-40f, 0.f })
  {
    GridUnderTest grid(UnitMin, UnitMax, cellSize, 100);
    EXPECT_EQ(wrongAnswers(grid, onSphere, onSphere, 100, 1000, 18), 0);
  }
}

// reset() forgets all vertices.
TEST(VertexGrid, ResetEmpties)
{
  VertexGrid grid;
  const std::vector<Vector4> positions{ Vector4(0.1f, 0.f, 0.f), Vector4(0.9f, 0.f, 0.f) };
  grid.reset(UnitMin, UnitMax, 0.1f, 10);
  grid.insert(0, positions[0]);
  grid.insert(1, positions[1]);
  grid.reset(2.f * UnitMin, 2.f * UnitMax, 0.3f, 10);
  EXPECT_EQ(grid.closest({}, positions), NoVertex);
  grid.insert(1, positions[1]);
  EXPECT_EQ(grid.closest({}, positions), 1u);
}
}
