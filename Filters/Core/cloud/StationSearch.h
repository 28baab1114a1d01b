// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/DensityProbes.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Places from which a surface was scanned, each in even angles: stations. One leaves the points as dense as the cosine
/// between its look and the normal, over the square of the distance. Several, whose scans were joined, leave the sum.
struct Stations
{
  std::vector<Eigen::Vector3d> places;
  double variance = 0.; ///< of the logarithm of the density: what they leave of it
};

/// A piece whose normals face stations if `facing` is 1, and look away from them if it is -1.
struct FacingPiece
{
  std::size_t piece;
  int facing;
};

/// Searches them in a box, one after the other, and moves all to where they explain most each time. With the second one,
/// pairs are tried, too.
class StationSearch
{
public:
  /// Pieces but for `hull` may face stations and look away from them. Only places that `isAsked` are looked at, where it
  /// is given. Probes, and what runs on threads, are referred to.
  StationSearch(const std::vector<DensityProbe>& probes, std::optional<FacingPiece> hull,
    const Eigen::AlignedBox3d& box, const Executor& executor,
    std::function<bool(const Eigen::Vector3d&)> isAsked = {});

  /// Of as many as were added. None explain nothing.
  const Stations& stations() const { return stations_; }

  /// Whether a further one explains clearly more.
  bool add();

private:
  using Densities = std::vector<double>;

  std::vector<Eigen::Vector3d> gridOf(int placesAmong, int placesAround) const;
  Densities densitiesFrom(
    const Eigen::Vector3d& station, std::span<const DensityProbe> probes) const;
  double varianceBeside(const Densities& densities, std::span<const DensityProbe> probes) const;
  std::vector<Stations> withOneMore() const;
  std::vector<Stations> bestPairs() const;
  void improve(Stations& stations) const;

  const std::vector<DensityProbe>& probes_;
  std::optional<FacingPiece> hull_;
  Eigen::AlignedBox3d box_, bounds_;
  std::function<bool(const Eigen::Vector3d&)> isAsked_;
  const Executor& executor_;
  double diagonal_;
  std::vector<Eigen::Vector3d> grid_;
  Stations stations_;
};
}
