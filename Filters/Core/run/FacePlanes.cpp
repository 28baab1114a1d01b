// SPDX-License-Identifier: BSD-3-Clause
#include "run/FacePlanes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// A plane fits fewer points by chance.
constexpr std::size_t FewestPoints = 5;
/// A patch is wide enough for its noise if the variance across it is less than this part of that
/// along it. Patches grow until half of them are, up to so many rings.
constexpr double MostFlatness = 0.1;
constexpr unsigned MostRings = 3;
constexpr std::size_t PatchesPerRange = 256;
/// A triangle changes sides to shorten the border if it lies no farther from the other side than
/// this part of its size.
constexpr double FarthestOver = 0.35;
constexpr unsigned RoundsOfShortening = 4;
/// Two planes belong to one side if the cosine of their angle is larger.
constexpr double CosineOfOneSide = 0.94;
}

void FacePlanes::Moments::add(const Eigen::Vector3d& point, double pointWeight)
{
  weight += pointWeight;
  sum += pointWeight * point;
  squares += pointWeight * point * point.transpose();
  ++count;
}

void FacePlanes::Moments::add(const Moments& others)
{
  weight += others.weight;
  sum += others.sum;
  squares += others.squares;
  count += others.count;
}

FacePlanes::FacePlanes(const CloudPlaces& places, const Executor& executor)
  : places_(places)
  , triangles_(places.mesh())
{
  sortPoints(places);
  findNeighbours();
  const std::size_t count = triangles_.all().size();
  std::vector<Moments> moments(count);
  patches_.resize(count);
  chosen_.resize(count);
  const auto forEach = [&](const auto& body)
  {
    executor.forEachRange(count, PatchesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          body(std::uint32_t(i));
        }
      });
  };
  const PointCloud& cloud = places.cloud();
  forEach(
    [&](std::uint32_t t)
    {
      for (const std::uint32_t point : pointsOn(t))
      {
        moments[t].add(cloud.points()[point].toDouble(), double(cloud.weight(point)));
      }
    });
  noise_.resize(count);
  forEach([&](std::uint32_t t) { noise_[t] = noiseAcross(t, moments[t]); });
  const auto isFlat = [](const Patch& patch) { return patch.flatness < MostFlatness; };
  for (rings_ = 1;; ++rings_)
  {
    forEach([&](std::uint32_t t) { patches_[t] = patchAround(t, moments); });
    const auto flat = std::count_if(patches_.begin(), patches_.end(), isFlat);
    if (rings_ == MostRings || 2 * flat > std::ptrdiff_t(count))
    {
      break;
    }
  }
  forEach([&](std::uint32_t t) { chosen_[t] = bestPatch(t, moments[t]); });
  shortenBorders(moments);
}

void FacePlanes::sortPoints(const CloudPlaces& places)
{
  const auto forEachPoint = [&](const auto& use)
  {
    places.forEach([&](std::size_t point, const CloudPlaces::Corners& corners)
      { use(std::uint32_t(point), triangles_.number(corners[0].vertex, corners[1].vertex)); });
  };
  first_.assign(triangles_.all().size() + 1, 0);
  forEachPoint([&](std::uint32_t, std::uint32_t triangle) { ++first_[triangle + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  points_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  forEachPoint(
    [&](std::uint32_t point, std::uint32_t triangle) { points_[next[triangle]++] = point; });
}

void FacePlanes::findNeighbours()
{
  const Mesh& mesh = places_.mesh();
  beyond_.reserve(triangles_.all().size());
  for (const Triangle& triangle : triangles_.all())
  {
    std::array<std::uint32_t, 3> neighbours{};
    for (unsigned corner = 0; corner < 3; ++corner)
    {
      const VertexIndex a = triangle[corner];
      const VertexIndex b = triangle[(corner + 1) % 3];
      // The triangle beyond runs from b to a.
      neighbours[corner] = mesh.isBoundaryEdge(a, b) ? None : triangles_.number(b, a);
    }
    beyond_.push_back(neighbours);
  }
}

Eigen::Vector3d FacePlanes::normalOf(std::uint32_t triangle) const
{
  const Triangle& corners = triangles_.all()[triangle];
  const Mesh& mesh = places_.mesh();
  const Eigen::Vector3d a = mesh.position(corners[0]).toDouble();
  return (mesh.position(corners[1]).toDouble() - a).cross(mesh.position(corners[2]).toDouble() - a);
}

Eigen::Vector3d FacePlanes::centerOf(std::uint32_t triangle) const
{
  const Triangle& corners = triangles_.all()[triangle];
  const Mesh& mesh = places_.mesh();
  return (mesh.position(corners[0]).toDouble() + mesh.position(corners[1]).toDouble() +
           mesh.position(corners[2]).toDouble()) /
    3.;
}

double FacePlanes::noiseAcross(std::uint32_t triangle, const Moments& own) const
{
  if (own.count < FewestPoints)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Eigen::Vector3d mean = own.sum / own.weight;
  const Eigen::Vector3d normal = normalOf(triangle).normalized();
  Eigen::Matrix3d frame;
  frame << normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()), normal;
  const Eigen::Matrix3d covariance =
    frame.transpose() * (own.squares / own.weight - mean * mean.transpose()) * frame;
  const Eigen::Vector2d tilt =
    covariance.topLeftCorner<2, 2>().ldlt().solve(covariance.topRightCorner<2, 1>());
  const double across = covariance(2, 2) - tilt.dot(covariance.topRightCorner<2, 1>());
  // The caller takes the median of such variances, which is below their mean if points are few
  // (Wilson, Hilferty).
  const double freedom = double(own.count - 3);
  const double medianToMean = std::pow(1. - 2. / (9. * freedom), 3.);
  return std::max(0., across) * double(own.count) / (freedom * medianToMean);
}

/// The triangles within so many rings of vertices around a triangle, in ascending order.
std::vector<std::uint32_t> FacePlanes::around(std::uint32_t triangle, unsigned rings) const
{
  const auto makeUnique = [](std::vector<std::uint32_t>& numbers)
  {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  };
  const Triangle& corners = triangles_.all()[triangle];
  std::vector<VertexIndex> vertices(corners.begin(), corners.end());
  for (unsigned ring = 1; ring < rings; ++ring)
  {
    for (std::size_t i = 0, inner = vertices.size(); i < inner; ++i)
    {
      const Ring& neighbours = places_.mesh().ring(vertices[i]);
      vertices.insert(vertices.end(), neighbours.begin(), neighbours.end());
    }
    makeUnique(vertices);
  }
  std::vector<std::uint32_t> result;
  for (const VertexIndex v : vertices)
  {
    const auto fan = triangles_.at(v);
    result.insert(result.end(), fan.begin(), fan.end());
  }
  makeUnique(result);
  return result;
}

FacePlanes::Patch FacePlanes::patchAround(
  std::uint32_t triangle, std::span<const Moments> moments) const
{
  Moments all;
  Eigen::Vector3d outside = Eigen::Vector3d::Zero();
  for (const std::uint32_t member : around(triangle, rings_))
  {
    all.add(moments[member]);
    outside += normalOf(member);
  }
  Patch result;
  result.variance = std::numeric_limits<double>::infinity();
  if (all.count < FewestPoints)
  {
    return result;
  }
  const Eigen::Vector3d center = all.sum / all.weight;
  const Eigen::Matrix3d covariance = all.squares / all.weight - center * center.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  result.plane = { normal.dot(outside) < 0. ? Eigen::Vector3d(-normal) : normal, center };
  result.variance =
    std::max(0., solver.eigenvalues()[0]) * double(all.count) / double(all.count - 3);
  result.flatness = result.variance / std::max(solver.eigenvalues()[1], result.variance);
  return result;
}

/// The mean squared distance of the points of a triangle to a plane; that of its centre if it has
/// no points.
double FacePlanes::misfit(std::uint32_t triangle, const Plane& plane, const Moments& own) const
{
  if (own.count == 0)
  {
    const double distance = plane.distance(centerOf(triangle));
    return distance * distance;
  }
  const Eigen::Vector3d mean = own.sum / own.weight;
  const double distance = plane.distance(mean);
  const Eigen::Matrix3d covariance = own.squares / own.weight - mean * mean.transpose();
  return distance * distance + std::max(0., plane.normal.dot(covariance * plane.normal));
}

std::uint32_t FacePlanes::bestPatch(std::uint32_t triangle, const Moments& own) const
{
  const Eigen::Vector3d normal = normalOf(triangle);
  std::uint32_t best = triangle;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t candidate : around(triangle, rings_ + 1))
  {
    const Patch& patch = patches_[candidate];
    if (!patch.plane.isKnown() || patch.plane.normal.dot(normal) <= 0.)
    {
      continue;
    }
    const double cost = patch.variance + misfit(triangle, patch.plane, own);
    if (cost < least)
    {
      least = cost;
      best = candidate;
    }
  }
  return best;
}

/// Gives a triangle that juts into the other side to that side, if it lies almost as close to its
/// plane. This shortens the border between both.
void FacePlanes::shortenBorders(std::span<const Moments> moments)
{
  const auto isOneSide = [&](std::uint32_t a, std::uint32_t b)
  { return planeOf(a).normal.dot(planeOf(b).normal) > CosineOfOneSide; };
  for (unsigned round = 0; round < RoundsOfShortening; ++round)
  {
    bool hasChanged = false;
    for (std::uint32_t t = 0; t < triangles_.all().size(); ++t)
    {
      const auto& around = beyond_[t];
      for (unsigned first = 0; first < 3; ++first)
      {
        const std::uint32_t a = around[first];
        const std::uint32_t b = around[(first + 1) % 3];
        if (a == None || b == None || isOneSide(t, a) || isOneSide(t, b) || !isOneSide(a, b))
        {
          continue;
        }
        const std::uint32_t over = chosen_[a];
        const double size = std::sqrt(normalOf(t).norm());
        const double most = FarthestOver * FarthestOver * size * size + patches_[over].variance;
        if (misfit(t, patches_[over].plane, moments[t]) <= most)
        {
          chosen_[t] = over;
          hasChanged = true;
          break;
        }
      }
    }
    if (!hasChanged)
    {
      return;
    }
  }
}
}
