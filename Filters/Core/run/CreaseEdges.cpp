// SPDX-License-Identifier: BSD-3-Clause
#include "run/CreaseEdges.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace neuralmesh
{
namespace
{
using SidePlane = FacePlanes::Plane;

constexpr double PartOfAngle = 0.5; ///< from which on planes differ
constexpr double StandardErrors = 3.;
/// The widths of the two sides that are tried, in lengths of nearby edges. Noise needs wider sides.
constexpr std::array Reaches{ 2.5, 3.5, 5., 7. };
/// A side is at least so many standard deviations of the noise wide. On narrower ones, noise
/// flattens the slopes.
constexpr double NoisesOfReach = 10.;
/// The largest variance of the points about both surfaces, over their noise, and the standard
/// errors that are added for chance. If it is larger, the shape is not a crease between two
/// surfaces.
constexpr double MostMisfit = 1.1;
constexpr double ChanceOfMisfit = 3.;
/// The angle where both sides meet may exceed that of their planes by so many degrees. More is
/// extrapolated too far.
constexpr double MostGuessed = 30.;
/// Noise counts as at least this part of an edge.
constexpr double LeastNoise = 0.03;
/// The residual of one surface without a crease must be larger than that of two surfaces by this
/// factor, and by so many times what one more coefficient explains by chance.
constexpr double WorseWithoutCrease = 1.2;
constexpr double ChanceOfCrease = 100.;
/// The planes of a side turn by less than this, in degrees, or by less than half of the angle of
/// the crease.
constexpr double TurnOfSide = 30.;
/// Both sides meet within so many lengths of the edge of the mesh.
constexpr double FarthestMeeting = 1.;
constexpr unsigned RoundsOfSorting = 3;
constexpr std::size_t FewestOfPlane = 5;
constexpr std::size_t FewestOfCurve = 14;
constexpr std::size_t EdgesPerRange = 64;
constexpr std::size_t EdgesPerAbortCheck = 1024;

double degrees(double radians) { return radians * 180. / std::numbers::pi; }
double radians(double degrees) { return degrees * std::numbers::pi / 180.; }

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

using Points = std::vector<Eigen::Vector3d>;

/// The plane that fits points best along a direction.
std::optional<SidePlane> planeThrough(const Points& points, const Eigen::Vector3d& direction)
{
  if (points.size() < FewestOfPlane)
  {
    return {};
  }
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points)
  {
    center += point;
  }
  center /= double(points.size());
  const Eigen::Vector3d first = direction.unitOrthogonal();
  const Eigen::Vector3d second = direction.cross(first);
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3d& point : points)
  {
    const Eigen::Vector3d from = point - center;
    const Eigen::Vector2d place(first.dot(from), second.dot(from));
    matrix += place * place.transpose();
    right += direction.dot(from) * place;
  }
  const Eigen::Vector2d slopes = matrix.ldlt().solve(right);
  return SidePlane{ (direction - slopes[0] * first - slopes[1] * second).normalized(), center };
}

/// The slope of one side where it meets the other.
struct Slope
{
  Eigen::Vector3d normal;
  double variance = 0.; ///< of its angle about the crease
  double residual = 0.; ///< of the points, squared and summed
};

/// Fits z = a + b x + c y + d x^2 + e x y + f y^2 over a plane, with x away from the crease and y
/// along it. With three terms, fits the linear part only.
template <int Terms>
std::optional<Slope> fitSlope(const Points& points, const SidePlane& plane,
  const Eigen::Vector3d& along, const Eigen::Vector3d& origin, double unit)
{
  using Vector = Eigen::Matrix<double, Terms, 1>;
  using Matrix = Eigen::Matrix<double, Terms, Terms>;
  const Eigen::Vector3d away = along.cross(plane.normal);
  Matrix normals = Matrix::Zero();
  Vector right = Vector::Zero();
  double squares = 0.;
  for (const Eigen::Vector3d& point : points)
  {
    const Eigen::Vector3d from = (point - origin) / unit;
    const double x = away.dot(from);
    const double y = along.dot(from);
    const double z = plane.normal.dot(from);
    Vector row;
    row.template head<3>() << 1., x, y;
    if constexpr (Terms == 6)
    {
      row.template tail<3>() << x * x, x * y, y * y;
    }
    normals += row * row.transpose();
    right += z * row;
    squares += z * z;
  }
  const Eigen::LDLT<Matrix> solver(normals);
  if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-9))
  {
    return {};
  }
  const Vector terms = solver.solve(right);
  const double residual = std::max(0., squares - right.dot(terms));
  const double slope = terms[1];
  const double rise = 1. + slope * slope;
  return Slope{ (plane.normal - slope * away - terms[2] * along).normalized(),
    residual / double(points.size() - Terms) * solver.solve(Vector::Unit(1))[1] / (rise * rise),
    residual * unit * unit };
}

std::optional<Slope> slopeOf(const Points& points, const SidePlane& plane,
  const Eigen::Vector3d& along, const Eigen::Vector3d& origin, double unit)
{
  if (points.size() >= FewestOfCurve)
  {
    if (auto slope = fitSlope<6>(points, plane, along, origin, unit))
    {
      return slope;
    }
  }
  return points.size() >= FewestOfPlane ? fitSlope<3>(points, plane, along, origin, unit)
                                        : std::nullopt;
}

/// The sum of squared distances of points to the cubic surface over a plane that fits them best.
double residualOfOneSurface(const std::array<Points, 2>& points, const Eigen::Vector3d& normal,
  const Eigen::Vector3d& along, const Eigen::Vector3d& origin, double unit)
{
  using Vector = Eigen::Matrix<double, 10, 1>;
  const Eigen::Vector3d across = along.cross(normal);
  Eigen::Matrix<double, 10, 10> matrix = Eigen::Matrix<double, 10, 10>::Zero();
  Vector right = Vector::Zero();
  const auto forEach = [&](const auto& use)
  {
    for (const Points& side : points)
    {
      for (const Eigen::Vector3d& point : side)
      {
        const Eigen::Vector3d from = (point - origin) / unit;
        use(across.dot(from), along.dot(from), normal.dot(from));
      }
    }
  };
  forEach(
    [&](double x, double y, double z)
    {
      Vector row;
      row << 1., x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
      matrix += row * row.transpose();
      right += z * row;
    });
  const Vector t = matrix.ldlt().solve(right);
  double sum = 0.;
  forEach(
    [&](double x, double y, double z)
    {
      const double height = t[0] + t[1] * x + t[2] * y + t[3] * x * x + t[4] * x * y +
        t[5] * y * y + t[6] * x * x * x + t[7] * x * x * y + t[8] * x * y * y + t[9] * y * y * y;
      const double dx =
        t[1] + 2. * t[3] * x + t[4] * y + 3. * t[6] * x * x + 2. * t[7] * x * y + t[8] * y * y;
      const double dy =
        t[2] + t[4] * x + 2. * t[5] * y + t[7] * x * x + 2. * t[8] * x * y + 3. * t[9] * y * y;
      // The distance to the tangent plane of the surface.
      sum += (z - height) * (z - height) / (1. + dx * dx + dy * dy);
    });
  return sum * unit * unit;
}

/// Examines one edge: finds the points of both sides and the angle between them.
class EdgeExam
{
public:
  EdgeExam(const FacePlanes& planes, const PointCloud& cloud, double leastAngle)
    : planes_(planes)
    , cloud_(cloud)
    , leastAngle_(leastAngle)
    , takenBy_(planes.triangles().all().size(), 0)
  {
  }

  void run(std::array<std::uint32_t, 2> triangles, const Eigen::Vector3d& middle, double length,
    CreaseEdge& edge)
  {
    edge.angle = degrees(
      angleBetween(planes_.planeOf(triangles[0]).normal, planes_.planeOf(triangles[1]).normal));
    for (const double reach : Reaches)
    {
      gather(triangles, middle, reach * length);
      const double noise = std::max(noiseOfTaken(), LeastNoise * LeastNoise * length * length);
      if (reach < Reaches.back() && reach * length < NoisesOfReach * std::sqrt(noise))
      {
        continue;
      }
      const auto bend = findBend(triangles, middle, length, edge.sides);
      if (!bend)
      {
        continue;
      }
      const double count = pointCount();
      if (bend->residual / count > noise * (MostMisfit + ChanceOfMisfit * std::sqrt(2. / count)))
      {
        return;
      }
      edge.angle = degrees(bend->angle);
      const double error = degrees(bend->error);
      const double ofPlanes = degrees(angleBetween(edge.sides[0].normal, edge.sides[1].normal));
      edge.isConfirmed = edge.angle < ofPlanes + MostGuessed &&
        edge.angle - StandardErrors * error > leastAngle_ &&
        isCrease(bend->residual, edge.sides, length);
      if (edge.isConfirmed || edge.angle + error < leastAngle_)
      {
        return;
      }
    }
  }

private:
  struct Bend
  {
    double angle = 0.;
    double error = 0.;
    double residual = 0.; ///< of the points, squared and summed
  };

  /// Measures the angle between the two sides by the points that were gathered.
  std::optional<Bend> findBend(std::array<std::uint32_t, 2> triangles,
    const Eigen::Vector3d& middle, double length, std::array<SidePlane, 2>& sides)
  {
    for (unsigned round = 0; round <= RoundsOfSorting; ++round)
    {
      const auto first = planeThrough(points_[0], planes_.planeOf(triangles[0]).normal);
      const auto second = planeThrough(points_[1], planes_.planeOf(triangles[1]).normal);
      if (!first || !second)
      {
        return {};
      }
      sides = { *first, *second };
      if (!findMeeting(sides, middle, length))
      {
        return {};
      }
      if (round < RoundsOfSorting)
      {
        sort(sides);
      }
    }
    const auto first = slopeOf(points_[0], sides[0], along_, origin_, length);
    const auto second = slopeOf(points_[1], sides[1], along_, origin_, length);
    if (!first || !second)
    {
      return {};
    }
    return Bend{ angleBetween(first->normal, second->normal),
      std::sqrt(first->variance + second->variance), first->residual + second->residual };
  }

  double pointCount() const { return double(points_[0].size() + points_[1].size()); }

  /// Whether two surfaces fit better than a smooth one across both sides.
  bool isCrease(double residual, const std::array<SidePlane, 2>& sides, double length) const
  {
    const Eigen::Vector3d normal = (sides[0].normal + sides[1].normal).normalized();
    const double ofOne = residualOfOneSurface(points_, normal, along_, origin_, length);
    return ofOne > WorseWithoutCrease * residual &&
      (ofOne - residual) * pointCount() > ChanceOfCrease * residual;
  }

  /// The median of the noise on the triangles; 0 if they have too few points.
  double noiseOfTaken()
  {
    noises_.clear();
    for (const std::uint32_t triangle : taken_)
    {
      if (const double noise = planes_.noiseOn(triangle); std::isfinite(noise))
      {
        noises_.push_back(noise);
      }
    }
    if (noises_.empty())
    {
      return 0.;
    }
    const auto middle = noises_.begin() + std::ptrdiff_t(noises_.size() / 2);
    std::nth_element(noises_.begin(), middle, noises_.end());
    return *middle;
  }

  /// Spreads from both triangles over those whose planes turn little from either side. This leaves
  /// out a third side. Each triangle goes to the side that it resembles more, but sort() assigns
  /// the points again: sorted by likeness, noise alone would form two slopes.
  void gather(std::array<std::uint32_t, 2> triangles, const Eigen::Vector3d& middle, double reach)
  {
    const std::array normals{ planes_.planeOf(triangles[0]).normal,
      planes_.planeOf(triangles[1]).normal };
    const double turn = std::max(radians(TurnOfSide), 0.5 * angleBetween(normals[0], normals[1]));
    const double least = std::cos(std::min(turn, std::numbers::pi / 2.));
    ++gathering_;
    taken_.assign(triangles.begin(), triangles.end());
    side_.assign({ 0, 1 });
    takenBy_[triangles[0]] = takenBy_[triangles[1]] = gathering_;
    for (std::size_t next = 0; next < taken_.size(); ++next)
    {
      const unsigned side = side_[next];
      for (unsigned corner = 0; corner < 3; ++corner)
      {
        const std::uint32_t beyond = planes_.beyond(taken_[next], corner);
        if (beyond == FacePlanes::None || takenBy_[beyond] == gathering_ ||
          (planes_.centerOf(beyond) - middle).norm() > reach)
        {
          continue;
        }
        const Eigen::Vector3d& normal = planes_.planeOf(beyond).normal;
        const double own = normal.dot(normals[side]);
        const double other = normal.dot(normals[1 - side]);
        if (std::max(own, other) >= least)
        {
          taken_.push_back(beyond);
          takenBy_[beyond] = gathering_;
          side_.push_back(own >= other ? side : 1 - side);
        }
      }
    }
    points_[0].clear();
    points_[1].clear();
    for (std::size_t i = 0; i < taken_.size(); ++i)
    {
      for (const std::uint32_t point : planes_.pointsOn(taken_[i]))
      {
        points_[side_[i]].push_back(cloud_.points()[point].toDouble());
      }
    }
  }

  /// Finds the point next to the edge where both planes meet. Returns false if it is far off.
  bool findMeeting(
    const std::array<SidePlane, 2>& sides, const Eigen::Vector3d& middle, double length)
  {
    const Eigen::Vector3d& a = sides[0].normal;
    const Eigen::Vector3d& b = sides[1].normal;
    const Eigen::Vector3d cross = a.cross(b);
    const double squaredSine = cross.squaredNorm();
    if (!(squaredSine > 1e-4))
    {
      return false;
    }
    along_ = cross / std::sqrt(squaredSine);
    const double cosine = a.dot(b);
    const double da = sides[0].distance(middle);
    const double db = sides[1].distance(middle);
    origin_ = middle - ((da - cosine * db) * a + (db - cosine * da) * b) / squaredSine;
    return (origin_ - middle).norm() <= FarthestMeeting * length;
  }

  /// Divides the points by the plane that halves the angle, as the edge of the mesh may lie beside
  /// the crease. Divided by the nearer side, noise would form a roof.
  void sort(const std::array<SidePlane, 2>& sides)
  {
    std::array<Eigen::Vector3d, 2> away;
    for (unsigned side = 0; side < 2; ++side)
    {
      away[side] = along_.cross(sides[side].normal);
      if (away[side].dot(sides[side].center - origin_) < 0.)
      {
        away[side] = -away[side];
      }
    }
    const Eigen::Vector3d over = away[1] - away[0];
    std::array<Points, 2> sorted;
    for (const Points& points : points_)
    {
      for (const Eigen::Vector3d& point : points)
      {
        sorted[over.dot(point - origin_) > 0. ? 1 : 0].push_back(point);
      }
    }
    points_ = std::move(sorted);
  }

  const FacePlanes& planes_;
  const PointCloud& cloud_;
  double leastAngle_;
  std::uint32_t gathering_ = 0;
  std::vector<std::uint32_t> takenBy_; ///< of each triangle, the last gathering that took it
  std::vector<std::uint32_t> taken_;
  std::vector<unsigned> side_;
  std::vector<double> noises_;
  std::array<Points, 2> points_;
  Eigen::Vector3d along_;
  Eigen::Vector3d origin_;
};

/// The edges between triangles whose planes differ, each with its triangles.
struct CandidateEdge
{
  std::array<std::uint32_t, 2> triangles{};
  unsigned corner = 0; ///< of the first triangle, where the edge begins
};

std::vector<CandidateEdge> candidatesOf(const FacePlanes& planes, double leastAngle)
{
  const double most = std::cos(radians(PartOfAngle * leastAngle));
  std::vector<CandidateEdge> result;
  for (std::uint32_t t = 0; t < planes.triangles().all().size(); ++t)
  {
    for (unsigned corner = 0; corner < 3; ++corner)
    {
      const std::uint32_t beyond = planes.beyond(t, corner);
      if (beyond == FacePlanes::None || beyond < t)
      {
        continue;
      }
      const SidePlane& a = planes.planeOf(t);
      const SidePlane& b = planes.planeOf(beyond);
      if (a.isKnown() && b.isKnown() && a.normal.dot(b.normal) < most)
      {
        result.push_back({ { t, beyond }, corner });
      }
    }
  }
  return result;
}
}

std::vector<CreaseEdge> findCreaseEdges(const FacePlanes& planes, const CloudPlaces& places,
  double leastAngle, const Progress& progress, const Executor& executor)
{
  const std::vector<CandidateEdge> candidates = candidatesOf(planes, leastAngle);
  const std::size_t count = candidates.size();
  std::vector<CreaseEdge> result(count);
  const Mesh& mesh = places.mesh();
  const auto examine = [&](std::size_t begin, std::size_t end)
  {
    EdgeExam exam(planes, places.cloud(), leastAngle);
    for (std::size_t i = begin; i < end; ++i)
    {
      const auto& [triangles, corner] = candidates[i];
      const Triangle& corners = planes.triangles().all()[triangles[0]];
      result[i].ends = { corners[corner], corners[(corner + 1) % 3] };
      const Eigen::Vector3d a = mesh.position(result[i].ends[0]).toDouble();
      const Eigen::Vector3d b = mesh.position(result[i].ends[1]).toDouble();
      const double area =
        0.25 * (planes.normalOf(triangles[0]).norm() + planes.normalOf(triangles[1]).norm());
      // The edge, or the side of an equilateral triangle of this area if that is longer.
      const double length = std::max((b - a).norm(), std::sqrt(area / 0.433));
      exam.run(triangles, 0.5 * (a + b), length, result[i]);
    }
  };
  for (std::size_t first = 0; first < count && progress(double(first) / double(count));
       first += EdgesPerAbortCheck)
  {
    executor.forEachRange(std::min(EdgesPerAbortCheck, count - first), EdgesPerRange,
      [&](std::size_t begin, std::size_t end) { examine(first + begin, first + end); });
  }
  return result;
}
}
