// SPDX-License-Identifier: BSD-3-Clause
#include "GrowthWatch.h"

#include "Orientation.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
GrowthSnapshot snapshotOf(const Learner& learner, const PointCloud& cloud)
{
  GrowthSnapshot result;
  Mesh mesh = learner.mesh();
  const std::vector<VertexIndex> indices = mesh.dropErased();
  orientOutwards(mesh);
  result.points.reserve(indices.size());
  result.activities.reserve(indices.size());
  for (VertexIndex v = 0; v < indices.size(); ++v)
  {
    const Eigen::Vector3f point = mesh.position(v).toDouble().cast<float>();
    result.points.push_back({ point.x(), point.y(), point.z() });
    result.activities.push_back(float(learner.order().activity(indices[v])));
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
  result.points.reserve(this->points.size());
  for (const auto& [x, y, z] : this->points)
  {
    result.points.emplace_back(this->center + this->unit * Eigen::Vector3d(x, y, z));
  }
  result.triangles = this->triangles;
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
  this->look();
}

void GrowthRecorder::look()
{
  const std::size_t vertices = this->learner_.mesh().vertexCount();
  if (this->watch_.snapshots == 0 || vertices < this->next_ || this->learner_.hasAllVertices())
  {
    return;
  }
  this->watch_.take(snapshotOf(this->learner_, this->cloud_));
  // The next term of the series that is above this one.
  const double taken = std::log(double(vertices) / this->first_) / std::log(this->growth_);
  const double term = this->first_ * std::pow(this->growth_, std::floor(taken + 1e-9) + 1.);
  this->next_ = std::max(vertices + 1, std::size_t(std::ceil(term)));
}
}
