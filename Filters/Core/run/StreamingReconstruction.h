// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Reservoir.h"
#include "learn/Learner.h"
#include "run/Reconstruction.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neuralmesh
{
/// A mesh that learns while points arrive. Samples are drawn from a reservoir of all points so far,
/// so that memory is bounded.
///
/// The mesh follows new points in two ways. If they lie beyond the mesh, or there are twice as many
/// as at its start, a new mesh starts from the space that the reservoir occupies, as only this
/// shows handles, pieces and openings. Otherwise the mesh grows. Once it has all its vertices, the
/// least active ones move to where the mesh is most active.
///
/// The same calls give the same mesh.
class StreamingReconstruction
{
public:
  /// Takes the parameters of the noise-filtering variant with exact counters. Samples are drawn
  /// evenly, so the curvature density does not count. Of the stopping rules, only the number of
  /// vertices counts.
  StreamingReconstruction(const Parameters& parameters, std::size_t reservoirSize);

  /// The direction in which the surface looks at a point, by the index of the point among the added
  /// ones. It has any length; 0 or not finite if it is unknown.
  using DirectionOf = std::function<Eigen::Vector3d(std::size_t)>;

  /// The reason why a stream with these parameters is impossible, as a sentence; empty if it is
  /// possible.
  static std::string errorOf(const Parameters& parameters);

  /// Adds points. Those that are not finite are dropped.
  void addPoints(const PointSpans& points, const DirectionOf& directionOf = {});
  /// Adds points with a viewpoint or with normals, towards which the surface looks. If several
  /// viewpoints have no view of each point, give them to mesh(), which finds the viewpoint of each
  /// point.
  void addPoints(const PointSpans& points, const OrientationHints& hints);

  /// Learns so many samples of all points so far. Returns their number: fewer if `progress` ends
  /// it, none if there are too few points for a mesh.
  std::uint64_t learn(std::uint64_t samples, const Progress& progress);
  /// Learns for so many seconds, to some thousand samples.
  std::uint64_t learnFor(double seconds, const Progress& progress);

  bool hasMesh() const { return learner_ != nullptr; }
  /// Returns the present mesh, if there is one. With `isFinished`, it is fitted in FitRounds rounds
  /// to the points of the last learn(), opened, repaired and measured, unless `progress` ends that.
  /// If it has learnt all vertices, it has the number that was asked for. Without rounds it is only
  /// measured. A measured mesh has warnings. The stream itself does not change. The viewpoints and
  /// the up direction of `hints`, and the directions of the points, turn the mesh to its outer
  /// side.
  Reconstruction mesh(
    bool isFinished, const Progress& progress, const OrientationHints& hints = {}) const;

  std::uint64_t pointCount() const { return reservoir_.seen(); } ///< that came and are finite
  std::uint64_t droppedCount() const { return droppedCount_; }
  std::uint64_t sampleCount() const;
  std::size_t beginnings() const { return beginnings_; }
  std::size_t vertexCount() const;
  /// Length of the unit of lengths in the finish report, in the units of the input; of a mesh only.
  double unit() const { return cloud_->unit(); }

private:
  bool takeInPoints(const Progress& progress);
  bool mustBegin(const PointCloud& cloud) const;
  bool beginAnew(const PointCloud& cloud, const Parameters& parameters, const Progress& progress);

  Parameters parameters_;
  Reservoir reservoir_;
  std::uint64_t droppedCount_ = 0;
  std::uint64_t takenIn_ = 0; ///< how many had come when the cloud was made
  std::uint64_t clouds_ = 0;
  std::unique_ptr<PointCloud> cloud_;
  std::optional<PointCloud> withClusters_;  ///< the same with clusters of outliers, if it has some
  std::vector<Eigen::Vector3f> directions_; ///< of what the cloud was made of
  std::unique_ptr<Learner> learner_;
  std::optional<GapPlan> gaps_;
  std::size_t pointsAtBeginning_ = 0;
  double uncoveredAtBeginning_ = 0.;
  std::size_t beginnings_ = 0;
  std::uint64_t earlierSamples_ = 0; ///< of meshes that were given up
};
}
