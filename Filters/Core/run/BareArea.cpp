// SPDX-License-Identifier: BSD-3-Clause
#include "run/BareArea.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of the points that were asked: what rests on less rests on nothing.
constexpr double LeastPoints = 0.5;
/// Its area asks for so many times as much.
constexpr double Asked = 10.;

/// A third of the triangles around each vertex.
std::vector<double> areasOfVertices(const TriangleMesh& mesh)
{
  std::vector<double> areas(mesh.points.size(), 0.);
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Eigen::Vector3d u = mesh.points[b] - mesh.points[a], v = mesh.points[c] - mesh.points[a];
    const double third = u.cross(v).norm() / 6.;
    areas[a] += third;
    areas[b] += third;
    areas[c] += third;
  }
  return areas;
}

/// Points per area where half of them have it denser: the median over points, not over vertices, of which
/// many may have none.
double usualDensity(const std::vector<double>& weights, const std::vector<double>& areas)
{
  struct Vertex
  {
    double density, weight;
  };
  std::vector<Vertex> vertices;
  for (std::size_t v = 0; v < weights.size(); ++v)
  {
    if (areas[v] > 0.)
    {
      vertices.push_back({ weights[v] / areas[v], weights[v] });
    }
  }
  double left = 0.;
  for (const Vertex& vertex : vertices)
  {
    left += 0.5 * vertex.weight;
  }
  const auto isSparser = [](const Vertex& a, const Vertex& b) { return a.density < b.density; };
  // The one that it is lies from `begin` to `end`, and `left` of the weight comes before it there.
  auto begin = vertices.begin(), end = vertices.end();
  while (end - begin > 1)
  {
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, isSparser);
    double below = 0.;
    for (auto vertex = begin; vertex != middle; ++vertex)
    {
      below += vertex->weight;
    }
    if (below >= left)
    {
      end = middle;
    }
    else
    {
      left -= below;
      begin = middle;
    }
  }
  return begin == end ? 0. : begin->density;
}
}

double bareShare(const TriangleMesh& mesh, const VertexSupport& support)
{
  const std::vector<double>& weights = support.weights;
  const std::vector<double> areas = areasOfVertices(mesh);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.);
  if (weights.size() != areas.size() || !(area > 0.))
  {
    return 0.;
  }
  const double least = LeastPoints * support.pointsPerAsked;
  const double density = usualDensity(weights, areas);
  double bare = 0.;
  for (std::size_t v = 0; v < areas.size(); ++v)
  {
    bare += weights[v] < least && density * areas[v] >= Asked * least ? areas[v] : 0.;
  }
  return bare / area;
}
}
