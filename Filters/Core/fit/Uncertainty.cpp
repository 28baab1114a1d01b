// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Uncertainty.h"

#include "base/Median.h"
#include "base/Random.h"
#include "fit/FidelityRounds.h"
#include "fit/FitSystem.h"
#include "mesh/RingMeans.h"
#include "mesh/UmbrellaLaplacian.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace neuralmesh
{
namespace
{
// Draws
/// Streams of random numbers, for each draw: of samples, and of bends.
constexpr std::uint64_t StreamOfSamples = 20;
constexpr std::uint64_t StreamOfBends = 21;
/// Each solution of the equations has three draws, one in each coordinate.
constexpr int Solutions = 6;
/// Of the residual of the equations.
constexpr double ToleranceOfDraws = 1e-2;
/// The variance is a mean over so many rings.
constexpr int RingsOfVariance = 1;

// Noise
/// That of the samples in so many rings, and of so many of all the cloud.
constexpr int RingsOfNoise = 4;
constexpr double SamplesOfAll = 1.;
/// What smoothness takes once more holds the rest of its variance: the surface follows noise.
constexpr float PartOfVariance = 0.9f;

// What smoothness takes
/// Where a vertex has this part of the usual samples, they tell how the surface bends. Where it has none, bends scatter
/// by more than the variance by lambda: those of a gap are alike.
constexpr float EnoughSamples = 0.5f;
constexpr float TimesOfBendsUntold = 2.f;
/// What smoothness would take once more is less than what it took, and is a mean over so many rings.
constexpr float TimesOfTakenOnceMore = 1.8f;
constexpr int RingsOfTakenOnceMore = 3;
/// What it took altogether is still in the residuals. This part of lambda brings out more of it than lambda, and more
/// noise, which so many draws tell. The rest is a mean over so many rings.
constexpr double PartOfLambdaForResiduals = 1. / 3.;
constexpr int SolutionsOfResiduals = 3;
constexpr float TimesOfResiduals = 1.2f;
constexpr int RingsOfResiduals = 6;

/// Vertices on a clean cloud lie outside of a bend, so that triangles lie on either side of it, by this part of L x:
/// exactly that where six equal triangles lie in a sphere.
constexpr float PartOfBendsOutside = 0.25f;

// Views
/// Samples of a view count over so many rings, which have about as many times the samples of a vertex.
constexpr int RingsOfViews = 6;
constexpr float VerticesOfViews = 37.f;
/// Of the variance that views share, where it is not known which view sees what: two or three see it.
constexpr float PartIfUnknown = 0.4f;
constexpr std::size_t MostViews = 256;
/// Samples of a view around a vertex, at least, that tell where it lies.
constexpr float LeastOfViewAround = 3.f;
/// By so many times the variance that is expected, views lie apart by more than what is told of them.
constexpr float TimesExpected = 4.f;

/// Of the time.
constexpr double PartOfUncertainPlaces = 0.3;

/// Three signs by chance: of all numbers with a variance of 1, these tell a variance best.
Vector4 signsOf(const Random& random, std::uint64_t index)
{
  const std::uint64_t bits = random.ahead(index).next();
  const auto sign = [&](int bit) { return ((bits >> bit) & 1u) != 0 ? 1.f : -1.f; };
  return { sign(63), sign(62), sign(61) };
}
}

Uncertainty::Uncertainty(const PointCloud& cloud, Mesh& mesh, const FinishReport& report,
  const UncertaintyPlan& plan, const Executor& executor, const PointViews& viewOf)
  : mesh_(mesh)
  , report_(report)
  , plan_(plan)
  , executor_(executor)
  , fit_(cloud, mesh, plan.samples, executor, {},
      viewOf ? PointViews(
                 [&](std::size_t point)
                 {
                   // The fit asks for each of its samples.
                   views_.push_back(viewOf(point));
                   return views_.back();
                 })
             : PointViews())
{
}

bool Uncertainty::run(const Progress& progress)
{
  if (!report_.smoothnessOfVertices || !(report_.smoothness > 0.))
  {
    return true;
  }
  if (!findPlaces(partOf(progress, 0., PartOfUncertainPlaces)))
  {
    return false;
  }
  measureNoise();
  measureBends();
  const Progress solving = partOf(progress, PartOfUncertainPlaces, 1.);
  constexpr double EndOfDraws =
    double(Solutions + SolutionsOfResiduals) / (Solutions + SolutionsOfResiduals + 2);
  FitSystem system = systemOfFit();
  if (!addDraws(system, partOf(solving, 0., EndOfDraws)) ||
    !addBias(system, partOf(solving, EndOfDraws, 1.)))
  {
    return false;
  }
  addCoarseness();
  addSharedNoise();
  deviations_.resize(variances_.size());
  std::transform(variances_.begin(), variances_.end(), deviations_.begin(),
    [](float variance) { return std::sqrt(variance); });
  return true;
}

bool Uncertainty::findPlaces(const Progress& progress)
{
  // On the layers that face the samples, and then where they are closest.
  fit_.findExactly();
  return fit_.findPlaces(partOf(progress, 0., 0.6)) && fit_.findPlaces(partOf(progress, 0.6, 1.));
}

/// Calls `body(sample, place, weight)` for the samples that are used, but for those beyond boundaries.
template <typename Body>
void Uncertainty::forEachWithin(const Body& body) const
{
  const PlacedSamples samples = fit_.placedSamples();
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.isUsed[i] != 0 && !isOnBoundary(samples.places[i], mesh_))
    {
      body(i, samples.places[i], samples.weight(i));
    }
  }
}

/// The noise of all is that of the fit, which knows what vertices have followed of it.
void Uncertainty::measureNoise()
{
  std::vector<float> squares(mesh_.indexEnd()), loads(mesh_.indexEnd());
  double sum = 0., count = 0.;
  forEachWithin(
    [&](std::size_t, const PlaceOnMesh& place, float weight)
    {
      sum += double(weight) * double(place.squaredDistance);
      count += double(weight);
      for (int corner = 0; corner < 3; ++corner)
      {
        const float share = weight * place.weights()[corner];
        squares[place.triangle[std::size_t(corner)]] += share * place.squaredDistance;
        loads[place.triangle[std::size_t(corner)]] += share;
      }
    });
  const double mean = count > 0. ? sum / count : 0.;
  const double factor = mean > 0. ? report_.noise * report_.noise / mean : 1.;
  averageOverRings(mesh_, squares, RingsOfNoise, executor_);
  averageOverRings(mesh_, loads, RingsOfNoise, executor_);
  noise_.resize(squares.size());
  for (std::size_t v = 0; v < noise_.size(); ++v)
  {
    const double around =
      (double(squares[v]) + SamplesOfAll * mean) / (double(loads[v]) + SamplesOfAll);
    noise_[v] = float(std::sqrt(factor * around));
  }
}

/// By the lambda of each vertex, for edges of the usual length: longer ones bend more, by their square.
void Uncertainty::measureBends()
{
  const std::span<const float> smoothness = mesh_.values(*report_.smoothnessOfVertices);
  std::vector<float> edges(mesh_.indexEnd()), loads(mesh_.indexEnd());
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      edges[v] += squaredNorm(mesh_.position(neighbor) - mesh_.position(v));
    }
    edges[v] /= float(mesh_.valence(v));
  }
  double sum = 0.;
  forEachWithin(
    [&](std::size_t, const PlaceOnMesh& place, float weight)
    {
      sum += double(weight);
      for (int corner = 0; corner < 3; ++corner)
      {
        loads[place.triangle[std::size_t(corner)]] += weight * place.weights()[corner];
      }
    });
  const float usual = medianOf(edges, executor_);
  const float enough = EnoughSamples * float(sum / double(mesh_.vertexCount()));
  bends_.resize(edges.size());
  for (std::size_t v = 0; v < bends_.size(); ++v)
  {
    const float told = enough > 0.f ? std::min(1.f, loads[v] / enough) : 0.f;
    const float part = (1.f - told) * TimesOfBendsUntold;
    const float longer = usual > 0.f ? edges[v] / usual : 1.f;
    bends_[v] = smoothness[v] > 0.f ? std::sqrt(part / smoothness[v]) * noise_[v] * longer : 0.f;
  }
}

/// Across the surface, for each coordinate of what is solved alike.
FitSystem Uncertainty::systemOfFit()
{
  FitSystem system(mesh_, 1., executor_);
  const std::span<const float> smoothness = mesh_.values(*report_.smoothnessOfVertices);
  smoothnessParts_.resize(smoothness.size());
  std::transform(smoothness.begin(), smoothness.end(), smoothnessParts_.begin(),
    [&](float lambda) { return lambda / float(report_.smoothness); });
  system.setSmoothnessParts(smoothnessParts_);
  const PlacedSamples samples = fit_.placedSamples();
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.isUsed[i] != 0)
    {
      system.add(samples.places[i], Vector4(), Vector4(), samples.weight(i));
    }
  }
  return system;
}

bool Uncertainty::addDraws(FitSystem& system, const Progress& progress)
{
  variances_.assign(mesh_.indexEnd(), 0.f);
  squaredResiduals_.assign(mesh_.indexEnd(), 0.f);
  constexpr double Steps = Solutions + SolutionsOfResiduals;
  double scale = 0., step = 0.;
  for (int draw = 0; draw < Solutions; ++draw)
  {
    const std::vector<Vector4> errors = drawErrors(std::uint64_t(draw));
    addPulls(system, [&](std::size_t i, const PlaceOnMesh&) { return errors[i]; });
    drawBends(system, std::uint64_t(draw));
    std::vector<Vector4> drawn(mesh_.indexEnd());
    if (!system.solve(report_.smoothness, ToleranceOfDraws, scale, drawn,
          partOf(progress, step / Steps, (step + 1.) / Steps)))
    {
      return false;
    }
    step += 1.;
    for (std::size_t v = 0; v < drawn.size(); ++v)
    {
      variances_[v] += PartOfVariance * squaredNorm(drawn[v]) / float(3 * Solutions);
    }
    if (draw >= SolutionsOfResiduals)
    {
      continue;
    }
    addPulls(system,
      [&](std::size_t i, const PlaceOnMesh& place) { return errors[i] - pointAt(place, drawn); });
    std::vector<Vector4> left;
    if (!solveResiduals(system, left, partOf(progress, step / Steps, (step + 1.) / Steps)))
    {
      return false;
    }
    step += 1.;
    for (std::size_t v = 0; v < left.size(); ++v)
    {
      squaredResiduals_[v] -= squaredNorm(left[v]) / float(3 * SolutionsOfResiduals);
    }
  }
  averageOverRings(mesh_, variances_, RingsOfVariance, executor_);
  return true;
}

/// What samples are off by chance.
std::vector<Vector4> Uncertainty::drawErrors(std::uint64_t draw) const
{
  const PlacedSamples samples = fit_.placedSamples();
  const Random random(plan_.seed, StreamOfSamples + 2 * draw);
  std::vector<Vector4> errors(samples.points.size());
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    // Weights that are far below the others are 0 in single precision.
    if (samples.isUsed[i] != 0 && samples.weight(i) > 0.f)
    {
      const PlaceOnMesh& place = samples.places[i];
      const float noise = place.weights()[0] * noise_[place.triangle[0]] +
        place.weights()[1] * noise_[place.triangle[1]] +
        place.weights()[2] * noise_[place.triangle[2]];
      errors[i] = noise / std::sqrt(samples.weight(i)) * signsOf(random, i);
    }
  }
  return errors;
}

/// What bends are off by chance.
void Uncertainty::drawBends(FitSystem& system, std::uint64_t draw) const
{
  const Random random(plan_.seed, StreamOfBends + 2 * draw);
  std::vector<Vector4> bends(mesh_.indexEnd());
  for (std::size_t v = 0; v < bends.size(); ++v)
  {
    bends[v] = bends_[v] * signsOf(random, v);
  }
  system.addBends(report_.smoothness, bends);
}

/// Pulls by `pullOf(sample, place)` alone.
template <typename Pull>
void Uncertainty::addPulls(FitSystem& system, const Pull& pullOf) const
{
  system.clearPulls();
  const PlacedSamples samples = fit_.placedSamples();
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.isUsed[i] != 0)
    {
      system.addPull(samples.places[i], samples.weight(i) * pullOf(i, samples.places[i]));
    }
  }
}

bool Uncertainty::solveResiduals(
  FitSystem& system, std::vector<Vector4>& left, const Progress& progress) const
{
  left.assign(mesh_.indexEnd(), Vector4());
  double scale = 0.;
  return system.solve(
    PartOfLambdaForResiduals * report_.smoothness, ToleranceOfDraws, scale, left, progress);
}

/// What smoothness took from the surface.
bool Uncertainty::addBias(FitSystem& system, const Progress& progress)
{
  std::vector<Vector4> taken, left;
  if (!takeOnceMore(system, taken, partOf(progress, 0., 0.5)))
  {
    return false;
  }
  // The fit of a draft does not shift them: what that costs it is found, too.
  fit_.shiftAgainstNoise(report_.noise * report_.noise);
  addPulls(system,
    [&](std::size_t i, const PlaceOnMesh& place)
    { return fit_.shifted(i) - pointAt(place, mesh_.positions()); });
  if (!solveResiduals(system, left, partOf(progress, 0.5, 1.)))
  {
    return false;
  }
  std::vector<float> squares(mesh_.indexEnd());
  for (VertexIndex v = 0; v < squares.size(); ++v)
  {
    const float takenAcross = acrossAt(v, taken[v]), leftAcross = acrossAt(v, left[v]);
    squares[v] = takenAcross * takenAcross;
    squaredResiduals_[v] += leftAcross * leftAcross;
  }
  averageOverRings(mesh_, squares, RingsOfTakenOnceMore, executor_);
  averageOverRings(mesh_, squaredResiduals_, RingsOfResiduals, executor_);
  for (std::size_t v = 0; v < squares.size(); ++v)
  {
    variances_[v] +=
      TimesOfTakenOnceMore * squares[v] + TimesOfResiduals * std::max(0.f, squaredResiduals_[v]);
  }
  return true;
}

/// What the equations would take from the surface, if it were the samples. They do not take the bends that they
/// expect.
bool Uncertainty::takeOnceMore(
  FitSystem& system, std::vector<Vector4>& taken, const Progress& progress)
{
  std::vector<Vector4> laplacian(mesh_.indexEnd());
  applyUmbrella<float>(mesh_, mesh_.positions(), std::span(laplacian), 0, laplacian.size());
  if (!report_.isClean && report_.fidelityRounds > 0)
  {
    fit_.expectBends(FidelityRounds::DeviationsOfCreaseIfNoisy);
    for (VertexIndex v = 0; v < laplacian.size(); ++v)
    {
      laplacian[v] = laplacian[v] - fit_.expectedBends()[v];
    }
  }
  system.clearPulls();
  system.addBends(report_.smoothness, laplacian);
  taken.assign(mesh_.indexEnd(), Vector4());
  double scale = 0.;
  return system.solve(report_.smoothness, ToleranceOfDraws, scale, taken, progress);
}

/// Under noise what smoothness takes has that already, unless bends are expected.
void Uncertainty::addCoarseness()
{
  const std::span<const Vector4> expected = fit_.expectedBends();
  for (VertexIndex v = 0; v < mesh_.indexEnd() && (report_.isClean || !expected.empty()); ++v)
  {
    const Vector4 bend =
      expected.empty() ? umbrella<float>(mesh_, mesh_.positions(), v) : expected[v];
    const float outside = PartOfBendsOutside * acrossAt(v, bend);
    variances_[v] += outside * outside;
  }
}

/// As many errors as there are views around a vertex, each as much as the view has samples there. And what lies apart
/// by more than such errors is told.
void Uncertainty::addSharedNoise()
{
  const auto sharedByAll = float(report_.sharedNoise * report_.sharedNoise);
  // No more than there is of all noise.
  const auto sharedAt = [&](std::size_t v) { return std::min(sharedByAll, noise_[v] * noise_[v]); };
  const auto own = float(report_.ownNoise * report_.ownNoise);
  std::vector<std::uint32_t> seen;
  std::copy_if(views_.begin(), views_.end(), std::back_inserter(seen),
    [](std::uint32_t view) { return view != UnknownView; });
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  if (seen.empty() || seen.size() > MostViews)
  {
    for (std::size_t v = 0; v < variances_.size(); ++v)
    {
      variances_[v] += PartIfUnknown * sharedAt(v);
    }
    return;
  }
  const std::size_t end = mesh_.indexEnd();
  const PlacedSamples samples = fit_.placedSamples();
  std::vector<float> counts(end), squaredCounts(end), views(end), sums(end), squares(end);
  for (const std::uint32_t view : seen)
  {
    std::vector<float> count(end), sum(end);
    forEachWithin(
      [&](std::size_t i, const PlaceOnMesh& place, float)
      {
        const Vector4 normal = normalAt(place, mesh_.positions());
        const float length = std::sqrt(squaredNorm(normal));
        if (views_[i] == view && length > 0.f)
        {
          const float across =
            dot(samples.points[i] - mesh_.position(place.triangle[0]), normal) / length;
          for (int corner = 0; corner < 3; ++corner)
          {
            count[place.triangle[std::size_t(corner)]] += place.weights()[corner];
            sum[place.triangle[std::size_t(corner)]] += place.weights()[corner] * across;
          }
        }
      });
    averageOverRings(mesh_, count, RingsOfViews, executor_);
    averageOverRings(mesh_, sum, RingsOfViews, executor_);
    for (std::size_t v = 0; v < end; ++v)
    {
      if (VerticesOfViews * count[v] > LeastOfViewAround)
      {
        counts[v] += count[v];
        squaredCounts[v] += count[v] * count[v];
        views[v] += 1.f;
        sums[v] += sum[v];
        squares[v] += sum[v] * sum[v] / count[v];
      }
    }
  }
  float most = 0.f;
  double disagreeing = 0.;
  for (VertexIndex v = 0; v < end; ++v)
  {
    const float n = counts[v];
    const float alike = n > 0.f ? squaredCounts[v] / (n * n) : 1.f;
    variances_[v] += alike * sharedAt(v);
    if (views[v] > 1.f)
    {
      // Of the means of views about that of all.
      const float apart = squares[v] / n - sums[v] * sums[v] / (n * n);
      const float expected =
        (1.f - alike) * sharedByAll + (views[v] - 1.f) * own / (VerticesOfViews * n);
      const float times = expected > 0.f ? apart / expected : 0.f;
      disagreeing += times > TimesExpected ? 1. : 0.;
      if (times > most)
      {
        most = times;
        disagreement_.place = mesh_.position(v);
      }
    }
  }
  disagreement_.share = disagreeing / double(mesh_.vertexCount());
}

/// Of a vector at a vertex, what is across the surface.
float Uncertainty::acrossAt(VertexIndex v, Vector4 vector) const
{
  const Vector4 normal = mesh_.normal(v);
  const float length = std::sqrt(squaredNorm(normal));
  return length > 0.f ? dot(vector, normal) / length : 0.f;
}
}
