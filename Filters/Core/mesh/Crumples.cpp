// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Crumples.h"

#include "mesh/EachVertex.h"
#include "mesh/Pieces.h"
#include "mesh/UmbrellaLaplacian.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// For the executor.
constexpr std::size_t VerticesSmoothedPerRange = 4096;
/// A vertex moves by this part of L x in each step.
constexpr float Rate = 0.5f;

/// After so many steps, the area of a crumpled mesh was so many times as large before.
struct Shrinkage
{
  int steps;
  double leastRatio;
};
constexpr std::array<Shrinkage, 3> Shrinkages{ { { 1, 1.3 }, { 3, 1.6 }, { 10, 1.85 } } };
/// Then come so many more, over which it shrinks by this ratio at most: a thin tube would vanish.
constexpr int LaterSteps = 20;
constexpr double MostLater = 2.;
/// As many come again, as long as they shrink it by this ratio.
constexpr double LeastAgain = 1.03;
constexpr int MostAgain = 16;

class Smoother
{
public:
  Smoother(Mesh& mesh, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , first_(mesh.positions().begin(), mesh.positions().end())
    , next_(first_)
  {
  }

  void step(int count)
  {
    for (; count > 0; --count)
    {
      const std::span<const Vector4> now = mesh_.positions();
      forEachVertex(mesh_, executor_, VerticesSmoothedPerRange,
        [&](VertexIndex v) { next_[v] = now[v] + Rate * umbrella<float>(mesh_, now, v); });
      put(next_);
    }
  }

  void restore() { put(first_); }
  std::vector<Vector4> takeFirst() { return std::move(first_); }

private:
  void put(std::span<const Vector4> positions)
  {
    forEachVertex(mesh_, executor_, VerticesSmoothedPerRange,
      [&](VertexIndex v) { mesh_.setPosition(v, positions[v]); });
  }

  Mesh& mesh_;
  const Executor& executor_;
  std::vector<Vector4> first_;
  std::vector<Vector4> next_;
};

/// Smooths the mesh if it was.
bool wasCrumpled(const Mesh& mesh, Smoother& smoother, const Executor& executor)
{
  const double first = areaOf(mesh, executor);
  double now = first;
  int steps = 0;
  for (const Shrinkage& shrinkage : Shrinkages)
  {
    smoother.step(shrinkage.steps - std::exchange(steps, shrinkage.steps));
    now = areaOf(mesh, executor);
    if (!(first > shrinkage.leastRatio * now))
    {
      return false;
    }
  }
  for (int i = 0; i <= MostAgain; ++i)
  {
    smoother.step(LaterSteps);
    const double before = std::exchange(now, areaOf(mesh, executor));
    if (i == 0 && !(before < MostLater * now))
    {
      return false;
    }
    if (before < LeastAgain * now)
    {
      break;
    }
  }
  return true;
}
}

std::vector<Vector4> smoothCrumples(Mesh& mesh, const Executor& executor)
{
  Smoother smoother(mesh, executor);
  if (wasCrumpled(mesh, smoother, executor))
  {
    return smoother.takeFirst();
  }
  smoother.restore();
  return {};
}
}
