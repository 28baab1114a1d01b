// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/CloudPlaces.h"
#include "mesh/NumberedTriangles.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The triangles of a mesh with the points on each, and a plane through the points around it.
///
/// A triangle near an edge of the shape has points of both sides around it, and a triangle across
/// the edge lies on neither side. So a triangle takes the plane of one of the patches near it. It
/// takes the plane that fits best both the points of the patch and its own points. The planes of
/// neighbouring triangles are then either almost the same or those of the two sides, even if the
/// mesh rounds the edge. A patch consists of the triangles within some rings of vertices around a
/// triangle. The number of rings is such that most patches are wide compared to the noise.
class FacePlanes
{
public:
  struct Plane
  {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< outwards; zero if unknown
    Eigen::Vector3d center = Eigen::Vector3d::Zero();

    bool isKnown() const { return !normal.isZero(); }
    double distance(const Eigen::Vector3d& point) const { return normal.dot(point - center); }
  };
  static constexpr std::uint32_t None = 0xffffffffu;

  /// The mesh of the places and their cloud must outlive this.
  FacePlanes(const CloudPlaces& places, const Executor& executor);

  const NumberedTriangles& triangles() const { return triangles_; }
  /// The points on a triangle, by their index in the cloud.
  std::span<const std::uint32_t> pointsOn(std::uint32_t triangle) const
  {
    return std::span(points_).subspan(first_[triangle], first_[triangle + 1] - first_[triangle]);
  }
  /// The triangle beyond the edge that follows a corner; None beyond a boundary.
  std::uint32_t beyond(std::uint32_t triangle, unsigned corner) const
  {
    return beyond_[triangle][corner];
  }
  /// The number of rings of vertices in a patch.
  unsigned rings() const { return rings_; }
  const Plane& planeOf(std::uint32_t triangle) const { return patches_[chosen_[triangle]].plane; }
  /// The variance of the points on a triangle across the plane that fits them best; NaN if they are
  /// too few. The median over several triangles is the variance of the noise.
  double noiseOn(std::uint32_t triangle) const { return noise_[triangle]; }
  /// Twice the area, as a vector.
  Eigen::Vector3d normalOf(std::uint32_t triangle) const;
  Eigen::Vector3d centerOf(std::uint32_t triangle) const;

private:
  /// Sums over points.
  struct Moments
  {
    double weight = 0.;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    std::size_t count = 0;

    void add(const Eigen::Vector3d& point, double pointWeight);
    void add(const Moments& others);
  };
  struct Patch
  {
    Plane plane;
    double variance = 0.; ///< of the points, across the plane
    double flatness = 1.; ///< this over the variance along the shorter side of the patch
  };

  void sortPoints(const CloudPlaces& places);
  void findNeighbours();
  double noiseAcross(std::uint32_t triangle, const Moments& own) const;
  std::vector<std::uint32_t> around(std::uint32_t triangle, unsigned rings) const;
  Patch patchAround(std::uint32_t triangle, std::span<const Moments> moments) const;
  double misfit(std::uint32_t triangle, const Plane& plane, const Moments& own) const;
  std::uint32_t bestPatch(std::uint32_t triangle, const Moments& own) const;
  void shortenBorders(std::span<const Moments> moments);

  const CloudPlaces& places_;
  NumberedTriangles triangles_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> points_;
  std::vector<std::array<std::uint32_t, 3>> beyond_;
  std::vector<double> noise_;
  unsigned rings_ = 1;
  std::vector<Patch> patches_;
  std::vector<std::uint32_t> chosen_;
};
}
