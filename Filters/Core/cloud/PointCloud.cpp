// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointCloud.h"

#include "base/BucketOrder.h"
#include "base/Morton.h"
#include "base/OrderStatistics.h"
#include "base/TouchedVector.h"
#include "mesh/BoxTree.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Points of a part for the executor.
constexpr std::size_t PointsPerRange = std::size_t(1) << 18;
/// Brought into the cache before its turn: the points of a bucket lie anywhere in the input.
constexpr std::size_t PointsAhead = 24;
/// So many points of a surface are in a bucket, about: few enough to be sorted in the cache.
constexpr std::size_t PointsPerBucket = 2048;

/// Buckets are cubes along the Morton curve. Of a grid of 4^k cells along each axis, a surface takes
/// about 4 * 16^k.
int bucketBits(std::size_t points)
{
  int bitsPerAxis = 2;
  while (bitsPerAxis < 6 && (PointsPerBucket << (2 * bitsPerAxis + 2)) < points)
  {
    ++bitsPerAxis;
  }
  return 3 * bitsPerAxis;
}

/// Points are far off if there is nothing else from the farthest of the others to so many times its
/// distance from the middle, and if they are no more than this part of all, or ...
constexpr double FarGap = 4.;
constexpr double PartOfFar = 0.0005;
/// ... of few points one of so many, up to some.
constexpr std::size_t PointsPerFar = 20;
constexpr std::size_t FarOfFew = 32;

/// A key along a Morton curve, and the place of a point.
using KeyAndPlace = std::pair<std::uint64_t, std::uint32_t>;
/// Where more points share a cell of the curve, they follow a finer one.
constexpr std::size_t MostInCell = 64;

/// Sorts by keys, and what is crowded into one cell by those of a curve through the box around it: with
/// most of a cloud in one place, its neighbours in space would be anywhere in that cell.
void sortAlongCurve(std::span<KeyAndPlace> order, std::span<const Vector4> points)
{
  std::sort(order.begin(), order.end());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end)
  {
    while (end < order.size() && order[end].first == order[begin].first)
    {
      ++end;
    }
    if (end - begin <= MostInCell)
    {
      continue;
    }
    const std::span<KeyAndPlace> crowd = order.subspan(begin, end - begin);
    Box box;
    for (const KeyAndPlace& at : crowd)
    {
      box.extend(points[at.second]);
    }
    const MortonCurve finer(box.low, box.high);
    if (finer.key(box.low) < finer.key(box.high))
    {
      for (KeyAndPlace& at : crowd)
      {
        at.first = finer.key(points[at.second]);
      }
      sortAlongCurve(crowd, points);
    }
  }
}
}

/// What a cloud is made of.
struct PointCloud::Input
{
  Input(const PointSpans& inputPoints, std::span<const double> inputWeights,
    const Executor& inputExecutor)
    : points(inputPoints)
    , weights(inputWeights)
    , executor(inputExecutor)
  {
  }

  const PointSpans& points;
  std::span<const double> weights;
  const Executor& executor;

  bool isThere(std::size_t index) const
  {
    return (weights.empty() || (weights[index] > 0. && std::isfinite(weights[index]))) &&
      (isOfPile_.empty() || !isOfPile_[index]);
  }

  /// Calls `use(index, point)` for the points of a range that are finite, have a weight, and are not
  /// left out.
  template <typename Use>
  void forEachFinite(std::size_t begin, std::size_t end, Use use) const
  {
    points.forEach(begin, end,
      [&](std::size_t index, const Eigen::Vector3d& point)
      {
        if (isThere(index) && point.allFinite() && isInReach(point))
        {
          use(index, point);
        }
      });
  }

  /// The same for all points, in their order. An interruption comes between ranges.
  template <typename Use>
  void forEachFinite(Use use) const
  {
    for (std::size_t begin = 0; begin < points.size(); begin += PointsPerRange)
    {
      const std::size_t end = std::min(points.size(), begin + PointsPerRange);
      executor.forEachPart(1, [&](std::size_t) { forEachFinite(begin, end, use); });
    }
  }

  std::size_t finiteCount() const
  {
    std::size_t count = 0;
    forEachFinite([&](std::size_t, const Eigen::Vector3d&) { ++count; });
    return count;
  }

  std::size_t thereCount() const
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      count += isThere(i) ? 1 : 0;
    }
    return count;
  }

  /// Whether coordinates are numbers in single precision, by some of them: they may come as others.
  bool hasFloats() const
  {
    bool result = true;
    const std::size_t stride = 1 + points.size() / SampleSize;
    for (std::size_t i = 0; result && i < points.size(); i += stride)
    {
      forEachFinite(i, i + 1,
        [&](std::size_t, const Eigen::Vector3d& point)
        { result = (point.array() == point.cast<float>().cast<double>().array()).all(); });
    }
    return result;
  }

  /// Of `count` finite points, the coordinates that come at these places if each axis is sorted by itself.
  std::vector<Eigen::Vector3d> sortedAt(
    const std::vector<std::size_t>& ranks, std::size_t count) const
  {
    std::vector<Eigen::Vector3d> result(ranks.size());
    executor.forEachPart(3,
      [&](std::size_t part)
      {
        const auto axis = Eigen::Index(part);
        const std::vector<double> sample = sortedSample(axis);
        std::vector<OrderStatisticSearch> searches;
        searches.reserve(ranks.size());
        for (const std::size_t rank : ranks)
        {
          searches.emplace_back(rank, bracketOf(rank, count, sample));
        }
        while (!std::all_of(searches.begin(), searches.end(),
          [](const OrderStatisticSearch& search) { return search.isFound(); }))
        {
          forEachFinite(
            [&](std::size_t, const Eigen::Vector3d& point)
            {
              for (OrderStatisticSearch& search : searches)
              {
                search.add(point[axis]);
              }
            });
          for (OrderStatisticSearch& search : searches)
          {
            search.endSweep();
          }
        }
        for (std::size_t i = 0; i < ranks.size(); ++i)
        {
          result[i][axis] = searches[i].value();
        }
      });
    return result;
  }

  /// Leaves out the few that are by far farther from the others than these are from each other, and
  /// tells how many of `count` there are. `median` is that of all.
  std::size_t leaveOutFar(std::size_t count, const Eigen::Vector3d& median)
  {
    const std::size_t most =
      std::max(std::size_t(PartOfFar * double(count)), std::min(count / PointsPerFar, FarOfFew));
    const std::vector<double> distances = farthestFrom(median, most + 1);
    for (std::size_t far = most; far > 0; --far)
    {
      if (distances[far] > 0. && distances[far - 1] >= FarGap * distances[far])
      {
        center_ = median;
        reach_ = distances[far];
        return far;
      }
    }
    return 0;
  }

  /// The indices of those.
  std::vector<std::uint32_t> leftOut() const
  {
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Eigen::Vector3d point = points[i];
      if (isThere(i) && point.allFinite() && !isInReach(point))
      {
        result.push_back(std::uint32_t(i));
      }
    }
    return result;
  }

  /// From now on, of each pile only the first point is there. Tells how many are not. What was far may be near
  /// without them.
  std::size_t leaveOut(std::span<const Pile> piles)
  {
    reach_ = Everywhere;
    std::vector<bool> isOfPile(points.size(), false), isFound(piles.size(), false);
    std::size_t count = 0;
    forEachFinite(
      [&](std::size_t index, const Eigen::Vector3d& point)
      {
        const std::size_t pile = pileAt(point, piles);
        if (pile < piles.size())
        {
          isOfPile[index] = isFound[pile];
          count += isFound[pile] ? 1 : 0;
          isFound[pile] = true;
        }
      });
    isOfPile_ = std::move(isOfPile);
    return count;
  }

private:
  static constexpr std::size_t SampleSize = 8192;
  static constexpr std::size_t MostParts = 16;

  static double distanceBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
  {
    return (a - b).cwiseAbs().maxCoeff(); // a square may be beyond all numbers
  }

  bool isInReach(const Eigen::Vector3d& point) const
  {
    return reach_ == Everywhere || distanceBetween(point, center_) <= reach_;
  }

  /// The largest distances of points, the largest first.
  std::vector<double> farthestFrom(const Eigen::Vector3d& place, std::size_t most) const
  {
    const std::size_t parts = std::clamp<std::size_t>(points.size() / PointsPerRange, 1, MostParts);
    std::vector<std::vector<double>> largest(parts); // heaps with the smallest on top
    executor.forEachPart(parts,
      [&](std::size_t part)
      {
        std::vector<double>& heap = largest[part];
        forEachFinite(part * points.size() / parts, (part + 1) * points.size() / parts,
          [&](std::size_t, const Eigen::Vector3d& point)
          {
            const double distance = distanceBetween(point, place);
            if (heap.size() == most && distance > heap.front())
            {
              std::pop_heap(heap.begin(), heap.end(), std::greater<>());
              heap.pop_back();
            }
            if (heap.size() < most)
            {
              heap.push_back(distance);
              std::push_heap(heap.begin(), heap.end(), std::greater<>());
            }
          });
      });
    std::vector<double> result;
    for (const std::vector<double>& heap : largest)
    {
      result.insert(result.end(), heap.begin(), heap.end());
    }
    std::sort(result.begin(), result.end(), std::greater<>());
    result.resize(std::min(result.size(), most));
    return result;
  }

  /// Coordinates of points that are spread over the input.
  std::vector<double> sortedSample(Eigen::Index axis) const
  {
    std::vector<double> result;
    const std::size_t stride = 1 + points.size() / SampleSize;
    for (std::size_t i = 0; i < points.size(); i += stride)
    {
      forEachFinite(i, i + 1,
        [&](std::size_t, const Eigen::Vector3d& point) { result.push_back(point[axis]); });
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  /// Where the sample lets one expect that place: six standard deviations of it to either side.
  static OrderStatisticSearch::Bracket bracketOf(
    std::size_t rank, std::size_t count, const std::vector<double>& sample)
  {
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    const double part = double(rank) / double(count), size = double(sample.size());
    const double margin = 2. + 6. * std::sqrt(size * part * (1. - part));
    const double first = size * part - margin, last = size * part + margin;
    const auto most = std::size_t(2. * (2. * margin + 2.) / std::max(1., size) * double(count));
    return { first < 0. ? -Infinity : sample[std::size_t(first)],
      last >= size ? Infinity : sample[std::size_t(last)], std::min(count, most) + 1 };
  }

  static constexpr double Everywhere = std::numeric_limits<double>::infinity();
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double reach_ = Everywhere;
  std::vector<bool> isOfPile_; ///< and left out; empty if none is
};

PointCloud::PointCloud(const PointSpans& points, std::span<const double> weights, bool keepsOrigins,
  const Executor& executor)
{
  Input input(points, weights, executor);
  const bool needsOrigins = keepsOrigins || !weights.empty();
  PileSearch search;
  arrange(input, needsOrigins, search);
  if (const std::vector<Pile> piles = search.find(); !piles.empty())
  {
    *this = PointCloud(PointSpans());
    coincidingCount_ = input.leaveOut(piles);
    pileCount_ = piles.size();
    largestPile_ = *std::max_element(
      piles.begin(), piles.end(), [](const Pile& a, const Pile& b) { return a.count < b.count; });
    PileSearch ofRest;
    arrange(input, needsOrigins, ofRest);
    droppedCount_ += coincidingCount_;
  }
  if (!weights.empty())
  {
    takeWeights(input);
  }
  if (!keepsOrigins)
  {
    std::vector<std::uint32_t>().swap(origins_);
  }
}

/// All but the weights.
void PointCloud::arrange(Input& input, bool keepsOrigins, PileSearch& piles)
{
  std::size_t finite = input.finiteCount();
  droppedCount_ = input.thereCount() - finite;
  if (finite == 0)
  {
    return;
  }
  // Without the outermost hundredth at each side of each axis.
  const auto bulkRanks = [](std::size_t count) {
    return std::vector<std::size_t>{ count / 100, count - 1 - count / 100, count / 2 };
  };
  std::vector<Eigen::Vector3d> places = input.sortedAt(bulkRanks(finite), finite);
  if (const std::size_t far = input.leaveOutFar(finite, places.back()); far > 0)
  {
    farPoints_ = input.leftOut();
    finite -= far;
    places = input.sortedAt(bulkRanks(finite), finite);
  }
  Eigen::AlignedBox3d bulk(places[0], places[1]);
  if (!(bulk.diagonal().norm() > 0.))
  {
    // Nearly all points on one spot: the rest is what there is.
    input.forEachFinite([&](std::size_t, const Eigen::Vector3d& point) { bulk.extend(point); });
  }
  center_ = bulk.center();
  const double size = bulk.diagonal().stableNorm();
  size_ = size > 0. && std::isfinite(size) ? size : 1.;
  findBoxes(input, bulk);
  findFloatStep(input, bulk);
  takePoints(input, keepsOrigins, piles);
  differentCount_ = piles.differentCount();
  droppedCount_ += finite - points_.size();
}

/// Diagonal and box of the bulk.
void PointCloud::findBoxes(const Input& input, const Eigen::AlignedBox3d& bulk)
{
  Eigen::AlignedBox3d box;
  input.forEachFinite(
    [&](std::size_t, const Eigen::Vector3d& point)
    {
      if (takesIn(point))
      {
        box.extend(Eigen::Vector3d((point - center_) / size_));
      }
    });
  if (box.isEmpty())
  {
    return; // the extent of all of them is beyond all numbers
  }
  diagonal_ = box.diagonal().norm();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.25);
  Eigen::AlignedBox3d enlarged(
    (bulk.min() - center_) / size_ - margin, (bulk.max() - center_) / size_ + margin);
  enlarged = enlarged.intersection(box);
  bulkMin_ = Vector4(enlarged.min());
  bulkMax_ = Vector4(enlarged.max());
}

void PointCloud::findFloatStep(const Input& input, const Eigen::AlignedBox3d& bulk)
{
  constexpr double Step = std::numeric_limits<float>::epsilon();
  const double largest =
    std::max(bulk.min().cwiseAbs().maxCoeff(), bulk.max().cwiseAbs().maxCoeff());
  floatStep_ = input.hasFloats() ? std::max(Step, Step * largest / size_) : Step;
}

/// The points in Morton order, and where they come from: first by buckets that follow each other along
/// the curve, then in order within each.
void PointCloud::takePoints(const Input& input, bool keepsOrigins, PileSearch& piles)
{
  const Executor& executor = input.executor;
  const MortonCurve curve(bulkMin_, bulkMax_);
  const int bits = bucketBits(input.points.size());
  const auto forEachNear = [&](std::size_t begin, std::size_t end, const auto& use)
  {
    input.forEachFinite(begin, end,
      [&](std::size_t index, const Eigen::Vector3d& point)
      {
        const Eigen::Vector3d p = scaled(point);
        if (isNear(p))
        {
          use(index, std::size_t(curve.key(Vector4(p)) >> (MortonCurve::KeyBits - bits)));
        }
      });
  };
  const BucketOrder buckets(
    input.points.size(), PointsPerRange, std::size_t(1) << bits, forEachNear, executor);
  points_ = touchedVector<LargeVector<Vector4>>(buckets.itemCount(), executor);
  origins_.resize(keepsOrigins ? buckets.itemCount() : 0);
  executor.forEachPart(buckets.bucketCount(),
    [&](std::size_t bucket)
    {
      const std::span<const std::uint32_t> items = buckets.items(bucket);
      std::vector<Vector4> points;
      std::vector<KeyAndPlace> order;
      points.reserve(items.size());
      order.reserve(items.size());
      for (std::size_t i = 0; i < items.size(); ++i)
      {
        if (i + PointsAhead < items.size())
        {
          input.points.prefetch(items[i + PointsAhead]);
        }
        points.push_back(fromInput(input.points[items[i]]));
        order.emplace_back(curve.key(points.back()), std::uint32_t(order.size()));
      }
      sortAlongCurve(order, points);
      std::size_t next = buckets.begin(bucket);
      for (const auto& [key, place] : order)
      {
        points_[next] = points[place];
        if (keepsOrigins)
        {
          origins_[next] = items[place];
        }
        ++next;
      }
      // In Morton order, equal ones are neighbours.
      const auto taken =
        std::span<const Vector4>(points_).subspan(buckets.begin(bucket), order.size());
      piles.add(
        taken.size(), [&](std::size_t i) { return !isApart(taken[i], taken[i - 1]); },
        [&](std::size_t i) { return input.points[items[order[i].second]]; });
    });
}

void PointCloud::takeWeights(const Input& input)
{
  // Divided by the largest first, as their sum may be beyond all numbers.
  double largest = 0., sum = 0.;
  const auto forEachTaken = [&](const auto& use)
  {
    input.forEachFinite(
      [&](std::size_t index, const Eigen::Vector3d& point)
      {
        if (takesIn(point))
        {
          use(input.weights[index]);
        }
      });
  };
  forEachTaken([&](double weight) { largest = std::max(largest, weight); });
  forEachTaken([&](double weight) { sum += weight / largest; });
  const double mean = sum / double(origins_.size());
  weights_.reserve(origins_.size());
  for (const std::uint32_t origin : origins_)
  {
    weights_.push_back(float(input.weights[origin] / largest / mean));
  }
}
}
