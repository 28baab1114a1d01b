// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace neuralmesh
{
/// A place of the input where far more points lie than anywhere else, such as the origin, where depth
/// cameras leave what they have not seen.
struct Pile
{
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::size_t count = 0; ///< of its points
};

/// The pile at a place, by its index; as many as there are if there is none. `piles` are as find() has them.
std::size_t pileAt(const Eigen::Vector3d& place, std::span<const Pile> piles);

/// Counts the places of a cloud, in parts and on any thread, and finds its piles.
class PileSearch
{
public:
  /// A pile has more points than this, ...
  static constexpr std::size_t MostAtPlace = 100;
  /// ... and more than so many times as many as a place has on average, where the points of larger piles
  /// count as one each: a cloud may have each of its points many times.
  static constexpr std::size_t TimesUsual = 10;

  /// Takes in so many points, all that lie at their places. `isLikeLast(i)` tells whether the i-th may
  /// coincide with the one before, after those that do; `placeOf(i)` is its place in the input.
  template <typename IsLikeLast, typename PlaceOf>
  void add(std::size_t count, const IsLikeLast& isLikeLast, const PlaceOf& placeOf)
  {
    std::size_t places = 0, different = 0;
    for (std::size_t begin = 0, end = 0; begin < count; begin = end)
    {
      do
      {
        ++end;
      } while (end < count && isLikeLast(end));
      places += end - begin > 1 ? addAlike(begin, end, placeOf) : 1;
      ++different;
    }
    points_.fetch_add(count, std::memory_order_relaxed);
    places_.fetch_add(places, std::memory_order_relaxed);
    different_.fetch_add(different, std::memory_order_relaxed);
  }

  /// How many are unlike the one before.
  std::size_t differentCount() const { return different_; }

  /// The piles, in the order of their places; the same whatever the parts are.
  std::vector<Pile> find() const;

private:
  /// Tells how many places they have.
  template <typename PlaceOf>
  std::size_t addAlike(std::size_t begin, std::size_t end, const PlaceOf& placeOf)
  {
    const Eigen::Vector3d first = placeOf(begin);
    std::size_t same = begin + 1;
    while (same < end && placeOf(same) == first)
    {
      ++same;
    }
    if (same == end)
    {
      addPlace({ first, end - begin });
      return 1;
    }
    // Single precision does not tell them apart.
    std::vector<Eigen::Vector3d> all;
    all.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i)
    {
      all.push_back(placeOf(i));
    }
    return addDifferent(all);
  }

  std::size_t addDifferent(std::vector<Eigen::Vector3d>& all);
  void addPlace(const Pile& place)
  {
    if (place.count > MostAtPlace)
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      // The sum makes one zero of two.
      crowded_.push_back({ place.place.array() + 0., place.count });
    }
  }

  std::atomic<std::size_t> points_ = 0;
  std::atomic<std::size_t> places_ = 0;
  std::atomic<std::size_t> different_ = 0;
  std::mutex mutex_;
  std::vector<Pile> crowded_; ///< of more than MostAtPlace
};
}
