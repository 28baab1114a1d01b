// SPDX-License-Identifier: BSD-3-Clause
#include "learn/NoiseFilter.h"

#include <limits>

namespace neuralmesh
{
namespace
{
/// The window of the statistics spans about four batches: batches are sorted, so the last so many
/// samples would all lie in one corner of the cloud.
constexpr std::size_t ObservationsPerBatch = 250;

/// Where outliers are rejected, distances count as at most so many epsilon_t in the statistics:
/// otherwise outliers raise the very limit beyond which they are rejected.
constexpr float ObservationLimit = 1.5f;
}

NoiseFilter::NoiseFilter(const Parameters& parameters)
  : filters_(parameters.filtersNoise())
  , tolerance_(parameters.noiseTolerance)
  , outlierLimit_(parameters.outlierLimit)
  , outlierLimitVertices_(std::size_t(parameters.outlierLimitVertices))
  , distances_(std::size_t(parameters.noiseWindow))
{
}

void NoiseFilter::beginBatch(std::size_t samples, std::size_t vertices)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  observationStride_ = 1 + samples / ObservationsPerBatch;
  threshold_ = infinity;
  observationLimit_ = infinity;
  squaredRejectionLimit_ = infinity;
  if (filters_ && distances_.isFull())
  {
    // epsilon_t = M_d + alpha_f sigma_d
    threshold_ = float(distances_.mean() + tolerance_ * distances_.deviation());
    if (outlierLimit_ > 0. && vertices >= outlierLimitVertices_)
    {
      observationLimit_ = ObservationLimit * threshold_;
      const float limit = float(outlierLimit_) * threshold_;
      squaredRejectionLimit_ = limit * limit;
    }
  }
}
}
