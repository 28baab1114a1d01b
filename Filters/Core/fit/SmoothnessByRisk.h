// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "base/Progress.h"
#include "fit/FitSystem.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Chooses lambda for noisy samples by the risk of the surface that it gives: what a sample that was not
/// fitted is expected to be off, told from the residual of those that were and from how much vertices follow
/// them (generalised cross-validation, Craven and Wahba 1979; a robust form of it, Lukas 2006). Places
/// and normals are kept. Then the same around each vertex, near to the lambda of all: so a flat face is held
/// smoother than a bend.
class SmoothnessByRisk
{
public:
  /// `samples` have their places on the mesh, and count as moved by the `shifts` of its vertices, unless that is empty;
  /// `creases` tells for each vertex what part of lambda counts there already: what lies at creases tells little of how
  /// smooth the rest is. All must outlive this.
  SmoothnessByRisk(const Mesh& mesh, const FitSystem& system, const PlacedSamples& samples,
    std::span<const Vector4> shifts, std::span<const float> creases, const Executor& executor);

  /// Looks for lambda around `first`. Returns false if it was ended before.
  bool run(double first, const Progress& progress);

  double lambda() const { return lambda_; }
  /// What part of lambda counts at each vertex, or how many times it.
  const std::vector<float>& localParts() const { return localParts_; }

private:
  /// A lambda, and the surface that it gives.
  struct Candidate
  {
    double lambda = 0.;
    double residual = 0.;  ///< mean squared distance across the surface
    double followers = 0.; ///< vertices that follow noise, against the samples
    double risk = 0.;
    std::vector<float> residuals; ///< around each vertex
  };

  bool tryOne(double lambda, std::span<Vector4> positions, const Progress& progress);
  void measure(Candidate& candidate, std::span<const Vector4> positions) const;
  const Candidate& best() const;
  double lowestPoint() const;
  double varianceOfNoise() const;
  float localRisk(const Candidate& candidate, std::size_t v, double variance) const;
  double shareHeldByFirst() const;
  void chooseLocally();
  void spreadAttention(std::vector<float>& values) const;

  const Mesh& mesh_;
  const FitSystem& system_;
  PlacedSamples samples_;
  std::span<const Vector4> shifts_;
  const Executor& executor_;
  PackedVectors unitNormals_;         ///< of the places; 0 where samples do not count
  std::vector<float> attention_;      ///< of each vertex: less at creases
  std::vector<float> loads_;          ///< of samples around each vertex
  std::vector<Candidate> candidates_; ///< from smooth to rough
  int rings_ = 0;                     ///< over which the risk is averaged
  double scale_ = 0.;                 ///< of the residual of the equations
  double lambda_ = 0.;
  std::vector<float> localParts_;
};
}
