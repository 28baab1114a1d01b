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
    double& oldest = observations_[next_];
    sum_ += observation - oldest;
    sumOfSquares_ += observation * observation - oldest * oldest;
    oldest = observation;
    if (++next_ == observations_.size())
    {
      next_ = 0;
      full_ = true;
      sumAnew();
    }
  }

  std::size_t count() const { return full_ ? observations_.size() : next_; }
  bool isFull() const { return full_; }
  double mean() const { return count() > 0 ? sum_ / double(count()) : 0.; }
  double deviation() const
  {
    const double average = mean();
    const double number = double(count());
    return number > 0. ? std::sqrt(std::fmax(0., sumOfSquares_ / number - average * average)) : 0.;
  }

  template <typename Archive>
  void exchange(Archive& archive)
  {
    std::span<double> observations(observations_);
    archive(observations, next_, full_, sum_, sumOfSquares_);
    archive.require(next_ < observations.size());
  }

private:
  /// Once a window, so that rounding errors do not add up.
  void sumAnew()
  {
    sum_ = 0.;
    sumOfSquares_ = 0.;
    for (const double observation : observations_)
    {
      sum_ += observation;
      sumOfSquares_ += observation * observation;
    }
  }

  std::vector<double> observations_;
  std::size_t next_ = 0;
  bool full_ = false;
  double sum_ = 0.;
  double sumOfSquares_ = 0.;
};
}
