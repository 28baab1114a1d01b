// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Mean and standard deviation over the last so many observations.
class MovingStatistics
{
public:
  explicit MovingStatistics(std::size_t window)
    : observations_(window, 0.)
  {
  }

  void add(double observation)
  {
    double& oldest = this->observations_[this->next_];
    this->sum_ += observation - oldest;
    this->sumOfSquares_ += observation * observation - oldest * oldest;
    oldest = observation;
    if (++this->next_ == this->observations_.size())
    {
      this->next_ = 0;
      this->full_ = true;
      this->sumAnew();
    }
  }

  std::size_t count() const { return this->full_ ? this->observations_.size() : this->next_; }
  bool isFull() const { return this->full_; }
  double mean() const { return this->count() > 0 ? this->sum_ / double(this->count()) : 0.; }
  double deviation() const
  {
    const double mean = this->mean();
    const double count = double(this->count());
    return count > 0. ? std::sqrt(std::fmax(0., this->sumOfSquares_ / count - mean * mean)) : 0.;
  }

  template <typename Archive>
  void exchange(Archive& archive)
  {
    std::span<double> observations(this->observations_);
    archive(observations, this->next_, this->full_, this->sum_, this->sumOfSquares_);
    archive.require(this->next_ < observations.size());
  }

private:
  /// Once a window, so that rounding errors do not add up.
  void sumAnew()
  {
    this->sum_ = 0.;
    this->sumOfSquares_ = 0.;
    for (const double observation : this->observations_)
    {
      this->sum_ += observation;
      this->sumOfSquares_ += observation * observation;
    }
  }

  std::vector<double> observations_;
  std::size_t next_ = 0;
  bool full_ = false;
  double sum_ = 0.;
  double sumOfSquares_ = 0.;
};
}
