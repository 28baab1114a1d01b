// SPDX-License-Identifier: BSD-3-Clause
#include "learn/WinGain.h"

#include "mesh/VertexMove.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Where moves are measured for the learning curve alone, every so-many-th is; a power of 2.
constexpr std::uint64_t StrideForCurve = 64;
}

WinGain::WinGain(const Parameters& parameters)
  : parameters_(parameters)
  , normal_{ .changes = MovingStatistics(std::size_t(parameters.changeWindow)) }
  , area_(normal_)
  , volume_(normal_)
{
  const bool normalBased = parameters.variant == Variant::NormalBased;
  setWeights(normalBased ? 0. : 1., normalBased ? 1. : 0., 0., 0.);
}

void WinGain::enterList()
{
  switch (parameters_.jump)
  {
    case Jump::Constant:
      break;
    case Jump::NormalActivity:
      setWeights(0., 1., 0., 0.);
      break;
    case Jump::AreaChange:
      setWeights(0., 0., 1., 0.);
      break;
    case Jump::VolumeChange:
      setWeights(0., 0., 0., 1.);
      break;
    case Jump::Weighted:
      setWeights(parameters_.constantWeight, parameters_.normalWeight, parameters_.areaWeight,
        parameters_.volumeWeight);
      break;
  }
}

void WinGain::setWeights(double constant, double normal, double area, double volume)
{
  const double sum = constant + normal + area + volume;
  constantWeight_ = constant / sum;
  normal_.weight = normal / sum;
  area_.weight = area / sum;
  volume_.weight = volume / sum;
  const bool measuresAll = constant < sum || parameters_.computeFeatureStrength;
  iterationMask_ = measuresAll ? 0 : StrideForCurve - 1;
}

void WinGain::beginBatch(std::size_t stride)
{
  stride_ = std::max<std::size_t>(1, stride / (iterationMask_ + 1));
  for (RelativeChange* relativeChange : { &normal_, &area_, &volume_ })
  {
    relativeChange->mean = relativeChange->changes.mean();
  }
}

double WinGain::ofMove(const Mesh& mesh, VertexIndex winner, Vector4 position)
{
  const bool isObserved = untilObservation_ == 0;
  untilObservation_ = isObserved ? stride_ - 1 : untilObservation_ - 1;
  normalGain_ = relative(normal_, normalChange(mesh, winner, position), isObserved);
  double gain = constantWeight_ + normal_.weight * normalGain_;
  if (area_.weight > 0.)
  {
    gain += area_.weight * relative(area_, areaChange(mesh, winner, position), isObserved);
  }
  if (volume_.weight > 0.)
  {
    gain += volume_.weight * relative(volume_, volumeChange(mesh, winner, position), isObserved);
  }
  return gain;
}

double WinGain::relative(RelativeChange& relativeChange, double change, bool isObserved) const
{
  // The limit holds in the mean, too: else what is far beyond it would raise it.
  const double limit = parameters_.gainLimit;
  const bool isLimited = limit > 0. && relativeChange.changes.isFull() && relativeChange.mean > 0.;
  const double counted = isLimited ? std::min(change, limit * relativeChange.mean) : change;
  if (isObserved)
  {
    relativeChange.changes.add(counted);
  }
  // Where nothing changes, all moves are alike.
  return relativeChange.mean > 0. ? counted / relativeChange.mean : 1.;
}
}
