// SPDX-License-Identifier: BSD-3-Clause
#include "WinGain.h"

#include "VertexMove.h"

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
  this->setWeights(normalBased ? 0. : 1., normalBased ? 1. : 0., 0., 0.);
}

void WinGain::enterList()
{
  switch (this->parameters_.jump)
  {
    case Jump::Constant:
      break;
    case Jump::NormalActivity:
      this->setWeights(0., 1., 0., 0.);
      break;
    case Jump::AreaChange:
      this->setWeights(0., 0., 1., 0.);
      break;
    case Jump::VolumeChange:
      this->setWeights(0., 0., 0., 1.);
      break;
    case Jump::Weighted:
      this->setWeights(this->parameters_.constantWeight, this->parameters_.normalWeight,
        this->parameters_.areaWeight, this->parameters_.volumeWeight);
      break;
  }
}

void WinGain::setWeights(double constant, double normal, double area, double volume)
{
  const double sum = constant + normal + area + volume;
  this->constantWeight_ = constant / sum;
  this->normal_.weight = normal / sum;
  this->area_.weight = area / sum;
  this->volume_.weight = volume / sum;
  const bool measuresAll = constant < sum || this->parameters_.computeFeatureStrength;
  this->iterationMask_ = measuresAll ? 0 : StrideForCurve - 1;
}

void WinGain::beginBatch(std::size_t stride)
{
  this->stride_ = std::max<std::size_t>(1, stride / (this->iterationMask_ + 1));
  for (Figure* figure : { &this->normal_, &this->area_, &this->volume_ })
  {
    figure->mean = figure->changes.mean();
  }
}

double WinGain::ofMove(const Mesh& mesh, VertexIndex winner, Vector4 position)
{
  const bool isObserved = this->untilObservation_ == 0;
  this->untilObservation_ = isObserved ? this->stride_ - 1 : this->untilObservation_ - 1;
  this->normalGain_ =
    this->relative(this->normal_, normalChange(mesh, winner, position), isObserved);
  double gain = this->constantWeight_ + this->normal_.weight * this->normalGain_;
  if (this->area_.weight > 0.)
  {
    gain += this->area_.weight *
      this->relative(this->area_, areaChange(mesh, winner, position), isObserved);
  }
  if (this->volume_.weight > 0.)
  {
    gain += this->volume_.weight *
      this->relative(this->volume_, volumeChange(mesh, winner, position), isObserved);
  }
  return gain;
}

double WinGain::relative(Figure& figure, double change, bool isObserved) const
{
  // The limit holds in the mean, too: else what is far beyond it would raise it.
  const double limit = this->parameters_.gainLimit;
  const bool isLimited = limit > 0. && figure.changes.isFull() && figure.mean > 0.;
  const double counted = isLimited ? std::min(change, limit * figure.mean) : change;
  if (isObserved)
  {
    figure.changes.add(counted);
  }
  // Where nothing changes, all moves are alike.
  return figure.mean > 0. ? counted / figure.mean : 1.;
}
}
