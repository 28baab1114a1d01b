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
/// A mesh that is learnt while points arrive. Samples are drawn from a reservoir of all points that
/// have come, so that memory is bounded however many those are.
///
/// The mesh follows in two ways. Where points come that it does not reach, or twice as many as it was
/// begun with, it is begun anew from the space that the reservoir occupies: only that tells handles,
/// pieces and openings. In between it grows, and once it has all its vertices, they wander: the
/// laziest go where the mesh is busiest.
///
/// The same calls give the same mesh.
class StreamingReconstruction
{
public:
  /// For the noise-filtering variant with exact counters. Samples are drawn evenly: curvature density
  /// does not count, nor do stopping rules but the number of vertices.
  StreamingReconstruction(const Parameters& parameters, std::size_t reservoirSize);

  /// The direction in which the surface looks at a point, by its index among those that are added; of
  /// any length, 0 or not finite if that is not known.
  using DirectionOf = std::function<Eigen::Vector3d(std::size_t)>;

  /// Why a stream cannot be learnt with these parameters, in a sentence; empty if it can.
  static std::string errorOf(const Parameters& parameters);

  /// Points that are not finite are dropped.
  void addPoints(const PointSpans& points, const DirectionOf& directionOf = {});
  /// The surface looks at where a point was seen from, or in the direction of its normal. Of several
  /// viewpoints without a view of each point mesh() is to be told: it finds out what was seen from where.
  void addPoints(const PointSpans& points, const OrientationHints& hints);

  /// Learns so many samples, of all points that have come, and returns how many they were: fewer if
  /// `progress` ends it, none if there are too few points for a mesh.
  std::uint64_t learn(std::uint64_t samples, const Progress& progress);
  /// The same for so many seconds, to some thousand samples.
  std::uint64_t learnFor(double seconds, const Progress& progress);

  bool hasMesh() const { return learner_ != nullptr; }
  /// The mesh as it is, if there is one. With `isFinished` it is fitted to the points of the last
  /// learn() by FitRounds, opened and repaired, and measured, unless `progress` ends that; and if it
  /// has all its vertices, it has as many as were asked for. Without rounds it is only measured. What is
  /// measured has warnings, too. The stream itself stays as it is. The mesh is turned to its outer side by
  /// `hints`, of which viewpoints and up direction count, and by the directions of the points.
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
