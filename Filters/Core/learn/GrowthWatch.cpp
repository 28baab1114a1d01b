// SPDX-License-Identifier: BSD-3-Clause
#include "learn/GrowthWatch.h"

#include "mesh/Orientation.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
GrowthSnapshot snapshotOf(const Learner& learner, const PointCloud& cloud)
{
  GrowthSnapshot result;
  LearntMesh learnt = learner.learntMesh();
  Mesh& mesh = learnt.mesh;
  orientOutwards(mesh);
  result.points.reserve(mesh.vertexCount());
  result.activities.reserve(mesh.vertexCount());
  for (VertexIndex v = 0; v < mesh.vertexCount(); ++v)
  {
    const Eigen::Vector3f point = mesh.position(v).toDouble().cast<float>();
    result.points.push_back({ point.x(), point.y(), point.z() });
    result.activities.push_back(float(mesh.values(learnt.activity)[v]));
  }
  result.triangles.reserve(mesh.triangleCount());
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c) {
      result.triangles.push_back({ a, b, c });
    });
  result.iterations = learner.counts().iterations;
  result.center = cloud.toInput(Vector4());
  result.unit = cloud.unit();
  return result;
}
}

TriangleMesh GrowthSnapshot::mesh() const
{
  TriangleMesh result;
  result.points.reserve(points.size());
  for (const auto& [x, y, z] : points)
  {
    result.points.emplace_back(center + unit * Eigen::Vector3d(x, y, z));
  }
  result.triangles = triangles;
  return result;
}

GrowthRecorder::GrowthRecorder(
  const GrowthWatch& watch, const Learner& learner, const PointCloud& cloud, std::size_t vertices)
  : watch_(watch)
  , learner_(learner)
  , cloud_(cloud)
  , first_(double(learner.mesh().vertexCount()))
  , growth_(std::pow(std::max(1., double(vertices) / first_), 1. / double(watch.snapshots)))
  , next_(learner.mesh().vertexCount())
{
  takeIfDue();
}

void GrowthRecorder::takeIfDue()
{
  const std::size_t vertices = learner_.mesh().vertexCount();
  if (watch_.snapshots == 0 || vertices < next_ || learner_.hasAllVertices())
  {
    return;
  }
  watch_.take(snapshotOf(learner_, cloud_));
  // The next term of the series that is above this one.
  const double taken = std::log(double(vertices) / first_) / std::log(growth_);
  const double term = first_ * std::pow(growth_, std::floor(taken + 1e-9) + 1.);
  next_ = std::max(vertices + 1, std::size_t(std::ceil(term)));
}
}
