// SPDX-License-Identifier: BSD-3-Clause
#include "fit/SharedNoise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::uint32_t NoPatch = std::numeric_limits<std::uint32_t>::max();
/// A patch grows until it has so many samples, and counts if it has half of them. So many patches tell something.
constexpr std::uint32_t SamplesOfPatch = 40;
constexpr double LeastOfPatch = 0.5 * SamplesOfPatch;
constexpr double LeastPatches = 20.;
/// Of what chance gives.
constexpr double DeviationsOfChance = 4.;

// By views
/// On a patch.
constexpr double LeastOfView = 3.;

// By layers
/// Farther than so many deviations, told by the median, it is an outlier of its patch.
constexpr double DeviationsOfOutlier = 5.;
constexpr double MedianOfNoise = 0.6745;
/// Patches with more of the usual variance are those that the mesh does not fit.
constexpr double MostOfUsualVariance = 2.;
/// The fourth cumulant of layers, against the square of the variance by which they lie apart.
constexpr double CumulantOfLayers = -1.25;
/// Against the square of the variance: noise that is as wide as the surface bends, or what the mesh does not show, has
/// that much.
constexpr double LeastCumulant = -0.15;
/// Of the variance of layers, what is about the mean of the usual number of them.
constexpr double PartAboutMean = 0.7;

/// How far a sample is from the mesh, across it, the patch on which it lies, and its view.
struct PatchSample
{
  double distance;
  std::uint32_t patch;
  std::uint32_t view;
};

VertexIndex nearestCorner(const PlaceOnMesh& place)
{
  const Vector4 weights = place.weights();
  std::size_t nearest = weights[1] > weights[0] ? 1 : 0;
  nearest = weights[2] > weights[int(nearest)] ? 2 : nearest;
  return place.triangle[nearest];
}

/// For each vertex, the patch of which it is a part. Patches grow ring by ring.
std::vector<std::uint32_t> patchesOf(
  const Mesh& mesh, std::span<const std::uint32_t> counts, std::span<const std::uint8_t> isLeftOut)
{
  std::vector<std::uint32_t> patches(mesh.indexEnd(), NoPatch);
  std::vector<VertexIndex> patch;
  std::uint32_t number = 0, samples = 0;
  const auto take = [&](VertexIndex v)
  {
    if (patches[v] == NoPatch && isLeftOut[v] == 0)
    {
      patches[v] = number;
      patch.push_back(v);
      samples += counts[v];
    }
  };
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    patch.clear();
    samples = 0;
    take(v);
    for (std::size_t next = 0; next < patch.size() && samples < SamplesOfPatch; ++next)
    {
      const VertexIndex at = patch[next];
      for (const VertexIndex neighbor : mesh.ring(at))
      {
        if (samples < SamplesOfPatch)
        {
          take(neighbor);
        }
      }
    }
    number += patch.empty() ? 0 : 1;
  }
  return patches;
}

/// In the order of patches, and of views on each.
std::vector<PatchSample> samplesOnPatches(const Mesh& mesh, const PlacedSamples& samples,
  std::span<const std::uint8_t> isLeftOut, std::span<const std::uint32_t> views)
{
  std::vector<std::uint32_t> counts(mesh.indexEnd());
  std::vector<VertexIndex> corners(samples.points.size(), NoVertex);
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const PlaceOnMesh& place = samples.places[i];
    const VertexIndex corner = nearestCorner(place);
    if (samples.isUsed[i] != 0 && isLeftOut[corner] == 0 && !isOnBoundary(place, mesh) &&
      squaredNorm(normalAt(place, mesh.positions())) > 0.f)
    {
      corners[i] = corner;
      ++counts[corner];
    }
  }
  const std::vector<std::uint32_t> patches = patchesOf(mesh, counts, isLeftOut);
  std::vector<std::size_t> ends(mesh.indexEnd() + std::size_t(1));
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    ends[patches[v] == NoPatch ? mesh.indexEnd() : patches[v]] += counts[v];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::size_t> next = ends;
  std::vector<PatchSample> result(ends.back());
  for (std::size_t i = corners.size(); i-- > 0;)
  {
    if (corners[i] != NoVertex)
    {
      const PlaceOnMesh& place = samples.places[i];
      const Vector4 normal = normalAt(place, mesh.positions());
      const Vector4 away = samples.points[i] - mesh.position(place.triangle[0]);
      const std::uint32_t patch = patches[corners[i]];
      result[--next[patch]] = { double(dot(away, normal)) / std::sqrt(double(squaredNorm(normal))),
        patch, views.empty() ? UnknownView : views[i] };
    }
  }
  for (std::size_t patch = 0; patch < ends.size() && !views.empty(); ++patch)
  {
    std::stable_sort(result.begin() + std::ptrdiff_t(next[patch]),
      result.begin() + std::ptrdiff_t(ends[patch]),
      [](const PatchSample& a, const PatchSample& b) { return a.view < b.view; });
  }
  return result;
}

struct PatchOfLayers
{
  double count = 0.;
  double variance = 0.;
  double cumulant = 0.; ///< the fourth
};

/// Without bias (k-statistics).
PatchOfLayers cumulantsOf(std::span<const PatchSample> patch)
{
  std::vector<double> values(patch.size());
  const auto median = [&values]
  {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  std::transform(patch.begin(), patch.end(), values.begin(),
    [](const PatchSample& sample) { return sample.distance; });
  const double center = median();
  std::transform(patch.begin(), patch.end(), values.begin(),
    [&](const PatchSample& sample) { return std::abs(sample.distance - center); });
  const double most = DeviationsOfOutlier / MedianOfNoise * median();
  double n = 0., mean = 0., squares = 0., fourths = 0.;
  for (const PatchSample& sample : patch)
  {
    const double distance = sample.distance - center;
    n += std::abs(distance) <= most ? 1. : 0.;
    mean += std::abs(distance) <= most ? distance : 0.;
  }
  mean /= n;
  for (const PatchSample& sample : patch)
  {
    const double distance = sample.distance - center;
    const double square = (distance - mean) * (distance - mean);
    squares += std::abs(distance) <= most ? square : 0.;
    fourths += std::abs(distance) <= most ? square * square : 0.;
  }
  if (n < LeastOfPatch)
  {
    return {};
  }
  return { n, squares / (n - 1.),
    (n * (n + 1.) * fourths - 3. * (n - 1.) * squares * squares) /
      ((n - 1.) * (n - 2.) * (n - 3.)) };
}

/// Of samples in the order of their patches.
NoiseParts partsByLayers(std::span<const PatchSample> samples, double step)
{
  std::vector<PatchOfLayers> patches;
  std::vector<double> variances;
  double count = 0., variance = 0.;
  for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end)
  {
    while (end < samples.size() && samples[end].patch == samples[begin].patch)
    {
      ++end;
    }
    const PatchOfLayers patch = cumulantsOf(samples.subspan(begin, end - begin));
    if (patch.count > 0.)
    {
      patches.push_back(patch);
      variances.push_back(patch.variance);
      count += patch.count;
      variance += patch.count * patch.variance;
    }
  }
  if (double(patches.size()) < LeastPatches || !(variance > 0.))
  {
    return {};
  }
  variance /= count;
  const auto middle = variances.begin() + std::ptrdiff_t(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  double usual = 0., squares = 0., cumulant = 0., chance = 0.;
  for (const PatchOfLayers& patch : patches)
  {
    if (patch.variance <= MostOfUsualVariance * *middle)
    {
      usual += patch.count;
      squares += patch.count * patch.variance;
      cumulant += patch.count * patch.cumulant;
      chance += patch.count * patch.count * patch.cumulant * patch.cumulant;
    }
  }
  if (squares < usual * step * step)
  {
    return { std::sqrt(variance), 0. };
  }
  // Against the square of the variance.
  const double square = squares * squares / usual;
  const double limit = std::min(LeastCumulant, -DeviationsOfChance * std::sqrt(chance) / square);
  const double part =
    cumulant / square < limit ? std::sqrt(cumulant / square / CumulantOfLayers) : 0.;
  return { std::sqrt(variance * std::max(0., 1. - PartAboutMean * part)),
    std::sqrt(variance * part) };
}

/// The samples of a view on a patch.
struct ViewOnPatch
{
  double count = 0.;
  double mean = 0.;
};

/// Nothing is told by patches that one view alone sees.
NoiseParts partsByViews(std::span<const PatchSample> samples)
{
  double within = 0., freeWithin = 0., between = 0., freeBetween = 0., ownBetween = 0.;
  std::vector<ViewOnPatch> views;
  const auto endPatch = [&]
  {
    const auto n = double(views.size());
    double mean = 0., inverse = 0.;
    for (const ViewOnPatch& view : views)
    {
      mean += view.mean / n;
      inverse += 1. / view.count;
    }
    if (views.size() > 1)
    {
      for (const ViewOnPatch& view : views)
      {
        between += (view.mean - mean) * (view.mean - mean);
      }
      freeBetween += n - 1.;
      ownBetween += (1. - 1. / n) * inverse;
    }
    views.clear();
  };
  for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end)
  {
    double sum = 0.;
    for (; end < samples.size() && samples[end].patch == samples[begin].patch &&
         samples[end].view == samples[begin].view;
         ++end)
    {
      sum += samples[end].distance;
    }
    const auto count = double(end - begin);
    if (samples[begin].view != UnknownView && count >= LeastOfView)
    {
      const double mean = sum / count;
      for (std::size_t i = begin; i < end; ++i)
      {
        within += (samples[i].distance - mean) * (samples[i].distance - mean);
      }
      freeWithin += count - 1.;
      views.push_back({ count, mean });
    }
    if (end == samples.size() || samples[end].patch != samples[begin].patch)
    {
      endPatch();
    }
  }
  if (freeBetween < LeastPatches)
  {
    return {};
  }
  const double own = within / freeWithin, explained = own * ownBetween;
  const double chance = DeviationsOfChance * explained * std::sqrt(2. / freeBetween);
  const double shared = between - explained > chance ? (between - explained) / freeBetween : 0.;
  return { std::sqrt(own), std::sqrt(shared) };
}
}

NoiseParts noisePartsOf(const Mesh& mesh, const PlacedSamples& samples,
  std::span<const std::uint8_t> isLeftOut, std::span<const std::uint32_t> views, double step)
{
  const std::vector<PatchSample> onPatches = samplesOnPatches(mesh, samples, isLeftOut, views);
  return views.empty() ? partsByLayers(onPatches, step) : partsByViews(onPatches);
}
}
