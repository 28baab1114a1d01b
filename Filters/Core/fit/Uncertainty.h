// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "fit/Finish.h"
#include "fit/SurfaceFit.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
struct UncertaintyPlan
{
  std::size_t samples = 0; ///< of the cloud, as the fit took them
  std::uint64_t seed = 1;
};

/// Where views lie apart by more than what is told of them explains.
struct ViewDisagreement
{
  double share = 0.; ///< of the vertices
  Vector4 place;     ///< where most
};

/// How far each vertex of a finished mesh may lie off the surface, across it: the standard deviation of the
/// posterior of the fit. With Gaussian noise of the samples and bends L x that scatter as its lambda supposes, the
/// covariance of the vertices is the inverse of the matrix of the fit. Vertices are drawn from it: other samples are
/// put at the same places, and other bends at the vertices, by as much as they scatter, and the same equations are
/// solved for them. What these vertices scatter by is told.
///
/// How much samples scatter is measured around each vertex. Where samples tell how the surface bends, what smoothness
/// takes from it is told by the surface and by the residuals. From the surface, the equations would take something once
/// more. In the residuals is what they took; with less smoothness they find some of it, beside noise. What noise leaves
/// there is told by the draws, and taken off. What all points of a view are off together does not average out, and is
/// added; of a clean cloud so is what triangles are too coarse for.
///
/// The same to the bit with any number of threads.
class Uncertainty
{
public:
  /// The report must have the lambda of each vertex of the mesh, which stays as it is. All must outlive this.
  Uncertainty(const PointCloud& cloud, Mesh& mesh, const FinishReport& report,
    const UncertaintyPlan& plan, const Executor& executor = Executor::sequential(),
    const PointViews& viewOf = {});

  /// Returns false if it was ended before.
  bool run(const Progress& progress);

  /// Whether there is an answer: a round of the fit was done, and left.
  bool isTold() const { return !deviations_.empty(); }
  /// Of each vertex, in units of the cloud.
  std::span<const float> deviations() const { return deviations_; }
  /// Nothing unless views are known.
  const ViewDisagreement& disagreement() const { return disagreement_; }

private:
  bool findPlaces(const Progress& progress);
  void measureNoise();
  void measureBends();
  FitSystem systemOfFit();
  bool addDraws(FitSystem& system, const Progress& progress);
  std::vector<Vector4> drawErrors(std::uint64_t draw) const;
  void drawBends(FitSystem& system, std::uint64_t draw) const;
  template <typename Pull>
  void addPulls(FitSystem& system, const Pull& pullOf) const;
  bool solveResiduals(
    FitSystem& system, std::vector<Vector4>& left, const Progress& progress) const;
  bool addBias(FitSystem& system, const Progress& progress);
  bool takeOnceMore(FitSystem& system, std::vector<Vector4>& taken, const Progress& progress);
  void addCoarseness();
  void addSharedNoise();
  float acrossAt(VertexIndex v, Vector4 vector) const;
  template <typename Body>
  void forEachWithin(const Body& body) const;

  Mesh& mesh_;
  const FinishReport& report_;
  UncertaintyPlan plan_;
  const Executor& executor_;
  std::vector<std::uint32_t> views_; ///< of the samples; empty if none is known
  SurfaceFit fit_;
  std::vector<float> noise_; ///< of the samples around each vertex, as a standard deviation
  std::vector<float> bends_; ///< by how much they may scatter at each vertex, likewise
  std::vector<float> smoothnessParts_;  ///< of lambda, at each vertex; the equations look there
  std::vector<float> variances_;        ///< of each vertex
  std::vector<float> squaredResiduals_; ///< what smoothness left in them, without noise
  std::vector<float> deviations_;
  ViewDisagreement disagreement_;
};
}
