// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/MovingStatistics.h"
#include "learn/Parameters.h"

#include <cmath>
#include <cstddef>

namespace neuralmesh
{
/// How far samples usually are from their winners, and what is made of those that are farther: they
/// pull less, (9.1) and (9.2), or count as outliers, of which nothing is learnt. What is usual stays
/// as it is during a batch of samples, which comes sorted: else each corner of the cloud would be
/// measured by itself.
class NoiseFilter
{
public:
  /// In other variants than the noise-filtering one it observes, and lets every sample pass.
  explicit NoiseFilter(const Parameters& parameters);

  /// Before each batch of so many samples, by the size of the mesh.
  void beginBatch(std::size_t samples, std::size_t vertices);

  /// Takes in |d|^2 of a sample, now and then.
  void observeNowAndThen(float squaredDistance)
  {
    if (untilObservation_-- == 0)
    {
      untilObservation_ = observationStride_ - 1;
      observe(squaredDistance);
    }
  }
  void observe(float squaredDistance)
  {
    distances_.add(std::min(std::sqrt(squaredDistance), observationLimit_));
  }

  /// Whether a sample counts as an outlier.
  bool rejects(float squaredDistance) const { return squaredDistance > squaredRejectionLimit_; }
  /// F(|d|) of (9.2).
  float pull(float squaredDistance) const
  {
    return squaredDistance > threshold_ * threshold_ ? threshold_ / std::sqrt(squaredDistance)
                                                     : 1.f;
  }

  /// One of so many samples of the batch is observed.
  std::size_t observationStride() const { return observationStride_; }
  /// |d| over the window, in units of the cloud; clipped where outliers are rejected.
  const MovingStatistics& distances() const { return distances_; }

  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(distances_, untilObservation_);
  }

private:
  bool filters_;
  double tolerance_;    ///< alpha_f
  double outlierLimit_; ///< multiple of epsilon_t; 0 = none
  std::size_t outlierLimitVertices_;
  MovingStatistics distances_;
  float threshold_ = 0.f; ///< epsilon_t of (9.2)
  float observationLimit_ = 0.f;
  float squaredRejectionLimit_ = 0.f;
  std::size_t observationStride_ = 1;
  std::size_t untilObservation_ = 0;
};
}
