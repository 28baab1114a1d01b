// SPDX-License-Identifier: BSD-3-Clause
#include "fit/SurfaceFit.h"

#include "base/Median.h"
#include "base/TouchedVector.h"
#include "cloud/OppositeLayer.h"
#include "cloud/VertexGrid.h"
#include "mesh/EachVertex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The weight of a distance along the surface, relative to one across it: at first, and once the
/// places have settled.
constexpr double Slip = 0.01;
constexpr double SettledSlip = 0.001;
/// The weight, relative to a sample, that then keeps a vertex near its position.
constexpr float AnchorWeight = 0.01f;
/// The weight that keeps a vertex where it is.
constexpr float WeightOfKept = 1e4f;
/// Rings around a boundary that is kept, which stay with it.
constexpr int KeptRings = 2;
/// A sample within so many mean edges is no outlier. More are allowed in the first round, as the
/// mesh does not fit yet.
constexpr float FirstOutlierEdges = 1.f;
constexpr float LaterOutlierEdges = 0.5f;
/// A sample among sparse ones is no outlier either within so many times the local distance between
/// samples.
constexpr float OutlierSpacings = 3.f;
constexpr std::size_t SamplesPerAbortCheck = 262144;
/// A place elsewhere on the mesh counts if its squared distance is less than this part of the
/// present one.
constexpr double NearerPart = 0.9;
/// The solver stops at this part of the largest residual that the equations had at the start of a
/// round.
constexpr double Tolerance = 1e-3;

// The pull at boundaries
/// The probability that a strip along a boundary has no sample although the surface continues
/// there.
constexpr double ChanceOfEmptyStrip = 0.05;
/// Samples beyond a boundary count as farther away by this part of their distance. The whole
/// distance would move the boundary too far.
constexpr float PartBeyond = 0.8f;
/// A shorter normal, in units of the cloud, has no direction.
constexpr float LeastNormal = 1e-15f;
/// If a triangle at the boundary has no sample, its boundary edge moves by this part towards the
/// opposite corner.
constexpr double RetreatOfEmpty = 0.5;

/// The part of the choice of lambda in the time of moveVertices().
constexpr double PartOfChoice = 0.6;
}

SurfaceFit::SurfaceFit(const PointCloud& cloud, Mesh& mesh, std::size_t sampleCount,
  const Executor& executor, const PointNormals& normalOf, const PointViews& viewOf)
  : cloud_(cloud)
  , mesh_(mesh)
  , executor_(executor)
  , samples_(cloud, sampleCount)
{
  const std::size_t count = samples_.size();
  std::vector<Vector4> normals;
  normals.reserve(normalOf ? count : 0);
  for (std::size_t i = 0; i < count && (normalOf || viewOf || !cloud.weights().empty()); ++i)
  {
    const std::size_t point = samples_.index(i);
    if (normalOf)
    {
      normals.push_back(normalOf(point));
    }
    if (viewOf)
    {
      views_.push_back(viewOf(point));
    }
    if (!cloud.weights().empty())
    {
      weights_.push_back(cloud.weights()[point]);
    }
  }
  normals_ = GivenNormals(std::move(normals));
  places_ = ZeroedArray<PlaceOnMesh>(count);
  isUsed_.resize(count);
}

bool SurfaceFit::findPlaces(const Progress& progress)
{
  const VertexGrid grid = hasPlaces_ ? VertexGrid() : gridOf(mesh_, cloud_, executor_);
  if (!hasPlaces_)
  {
    opposite_ = oppositeVertices(mesh_, grid, executor_);
  }
  ZeroedArray<float> distances(samples_.size());
  const std::size_t count = samples_.size();
  for (std::size_t first = 0; first < count; first += SamplesPerAbortCheck)
  {
    if (!progress(double(first) / double(count)))
    {
      return false;
    }
    executor_.forEachRange(std::min(SamplesPerAbortCheck, count - first), SamplesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = first + begin; i < first + end; ++i)
        {
          findPlace(i, grid);
          distances[i] = places_[i].squaredDistance;
        }
      });
  }
  if (surface_ && normals_.any())
  {
    findNearerPlaces();
  }
  const float edges = hasPlaces_ ? LaterOutlierEdges : FirstOutlierEdges;
  hasPlaces_ = hasDistances_ = true;
  medianDistance_ =
    std::sqrt(medianOf(std::span<const float>(distances.data(), distances.size()), executor_));
  outlierDistance_ = surface_
    ? std::numeric_limits<float>::max()
    : neuralmesh::outlierDistance(medianDistance_, mesh_.meanEdge(executor_), edges);
  chooseUsed(edges);
  return true;
}

/// The first place of a sample is on the layer that faces it. If a sample of a thin part is later
/// closer to the other layer, it may belong to either one, so it is not used.
void SurfaceFit::findPlace(std::size_t sample, const VertexGrid& grid)
{
  const Vector4 point = samples_[sample];
  PlaceOnMesh& place = places_[sample];
  isUsed_[sample] = 1;
  if (!hasPlaces_)
  {
    const VertexIndex closest = grid.closest(point, mesh_.positions());
    place = facingPlace(point, mesh_, closest, opposite_[closest]);
    return;
  }
  const VertexIndex opposite = opposite_[place.triangle[0]];
  if (opposite == NoVertex)
  {
    const VertexIndex closest = closestVertexFrom(point, mesh_, place.triangle[0]);
    place =
      isExact_ ? closestPlaceAround(point, mesh_, closest) : closestPlaceAt(point, mesh_, closest);
    return;
  }
  place = closestPlaceOnLayer(point, mesh_, place.triangle[0]);
  const PlaceOnMesh other = closestPlaceOnLayer(point, mesh_, opposite);
  isUsed_[sample] = other.squaredDistance < place.squaredDistance ? 0 : 1;
}

/// Searches the whole mesh for nearer places, as the nearest place of a coarse mesh may be
/// elsewhere. Places on the other side of a thin part do not count.
void SurfaceFit::findNearerPlaces()
{
  const TriangleMesh triangles = trianglesIn(mesh_, executor_);
  const NearestTriangle nearest(triangles, executor_);
  executor_.forEachRange(samples_.size(), SamplesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const Vector4 point = samples_[i];
        const double most = NearerPart * double(places_[i].squaredDistance);
        const NearestTriangle::Found found = nearest.find(point.toDouble(), most);
        if (found.triangle != NearestTriangle::None)
        {
          const PlaceOnMesh place =
            closestPlaceAt(point, mesh_, triangles.triangles[found.triangle][0]);
          if (dot(normalAt(place, mesh_.positions()), normals_.at(i)) > 0.f)
          {
            places_[i] = place;
            isUsed_[i] = 1;
          }
        }
      }
    });
}

void SurfaceFit::chooseUsed(float edges)
{
  LocalSpacing& spacing = spacing_.emplace(mesh_, places_, executor_);
  const float usual = spacing.usual();
  executor_.forEachRange(places_.size(), SamplesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const PlaceOnMesh& place = places_[i];
        const auto isWithin = [&place](float distance)
        { return place.squaredDistance <= distance * distance; };
        const auto isNearForSparse = [&]
        {
          const float local = spacing.samplesAt(place);
          return local > SparseSpacings * usual &&
            (isWithin(edges * spacing.edgeAt(place)) || isWithin(OutlierSpacings * local));
        };
        isUsed_[i] = isUsed_[i] != 0 && (isWithin(outlierDistance_) || isNearForSparse()) ? 1 : 0;
      }
    });
  spacing.forgetEdges();
}

void SurfaceFit::keepBoundaries()
{
  if (!mesh_.isOpen())
  {
    return;
  }
  isKept_.assign(mesh_.indexEnd(), 0);
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    isKept_[v] = mesh_.isBoundary(v) ? 1 : 0;
  }
  for (int ring = 0; ring < KeptRings; ++ring)
  {
    const std::vector<std::uint8_t> before = isKept_;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      for (const VertexIndex neighbor : mesh_.ring(v))
      {
        isKept_[v] = isKept_[v] | before[neighbor];
      }
    }
  }
}

void SurfaceFit::keep(std::span<const std::uint8_t> vertices)
{
  isKept_.resize(mesh_.indexEnd());
  for (std::size_t v = 0; v < vertices.size(); ++v)
  {
    isKept_[v] |= vertices[v];
  }
}

void SurfaceFit::fillSystem()
{
  // What takes memory itself comes before the equations.
  const std::vector<Tip> tips = endsWithSamples_ ? findTips() : std::vector<Tip>();
  const bool isOpen = mesh_.isOpen(executor_);
  // The matrix is new each time, as edges may have been flipped.
  released_.reset();
  system_.emplace(mesh_, isSettled_ ? SettledSlip : Slip, executor_);
  released_ = std::make_unique<RingsReleased>(mesh_, system_->rings(), executor_);
  system_->setSmoothnessParts(smoothnessParts_);
  system_->expectBends(bends_);
  if (isSettled_ || !isKept_.empty())
  {
    forEachVertex(mesh_, executor_, VerticesPerRange,
      [&](VertexIndex v)
      {
        const bool isKept = !isKept_.empty() && isKept_[v] != 0;
        system_->addAnchor(v, mesh_.position(v),
          isKept         ? WeightOfKept
            : isSettled_ ? AnchorWeight
                         : 0.f);
      });
  }
  forEachUsed([this](const FitSystem::Rows& rows, std::size_t sample) { fillRows(rows, sample); });
  usedCount_ = std::size_t(executor_.sum(
    places_.size(), SamplesPerRange, [this](std::size_t i) { return isUsed(i) ? 1. : 0.; }));
  if (isOpen)
  {
    pullBoundariesIn();
  }
  for (const Tip& tip : tips)
  {
    system_->add(tip.place, tip.end.position, tip.normal, tip.end.weight);
  }
}

void SurfaceFit::dropSystem()
{
  released_.reset();
  system_.reset();
}

/// Samples beyond a boundary are on average half as far from it as the end of the data. So a step
/// to that end is twice as long, along the surface.
Vector4 SurfaceFit::beyondBoundary(
  const Vector4& sample, const PlaceOnMesh& place, const Vector4& normal) const
{
  const Vector4 away = sample - pointAt(place, mesh_.positions());
  const float length = std::sqrt(squaredNorm(normal));
  if (!reachesTheEnd_ || !(length > LeastNormal))
  {
    return sample;
  }
  const Vector4 unit = 1.f / length * normal;
  return sample + PartBeyond * (away - dot(away, unit) * unit);
}

void SurfaceFit::fillRows(const FitSystem::Rows& rows, std::size_t sample)
{
  const PlaceOnMesh& place = places_[sample];
  const Vector4 normal = normalAt(place, mesh_.positions());
  if (isOnBoundary(place, system_->rings()))
  {
    // Beyond a boundary, the distance along the surface counts in full: the sample has no closer
    // place.
    system_->add(
      place, beyondBoundary(samples_[sample], place, normal), Vector4(), weight(sample), rows);
    return;
  }
  system_->add(place, shifted(sample), normal, weight(sample), rows);
  if (normalWeight_ > 0.)
  {
    system_->addNormal(place, normals_.at(sample), float(normalWeight_) * weight(sample), rows);
  }
}

/// Samples beyond a boundary pull it outwards, but no sample pulls a boundary back that lies beyond
/// the data. So each boundary triangle with an empty strip along its edge gets an equation that
/// pulls the edge to where the samples begin.
void SurfaceFit::pullBoundariesIn()
{
  /// Samples on the triangle at a boundary edge.
  struct Strip
  {
    std::uint32_t samples = 0;
    float width = 1.f; ///< without samples, against the height of the triangle
  };
  const CompactRings& rings = system_->rings();
  std::vector<Strip> strips(rings.size()); // of the edges to the first neighbour
  forEachUsed(
    [&](const FitSystem::Rows& rows, std::size_t sample)
    {
      const PlaceOnMesh& place = places_[sample];
      for (unsigned i = 0; i < 3; ++i)
      {
        const VertexIndex from = place.triangle[(i + 1) % 3], to = place.triangle[(i + 2) % 3];
        if (rows.has(from) && rings.isOpen(from) && rings[from].front() == to)
        {
          Strip& strip = strips[from];
          ++strip.samples;
          strip.width = std::min(strip.width, place.weights()[int(i)]);
        }
      }
    });
  const double samplesPerTriangle = double(usedCount_) / (2. * double(mesh_.vertexCount()));
  const double logarithm = std::log(ChanceOfEmptyStrip);
  for (VertexIndex v = 0; v < rings.size(); ++v)
  {
    if (!rings.isOpen(v))
    {
      continue;
    }
    const double samples = strips[v].samples, width = strips[v].width;
    double retreat = 0.;
    if (samples > 0. && 2. * samples * std::log(1. - width) < logarithm)
    {
      // Subtracts the mean width of the strip for an edge at the end of the data.
      retreat = width - 1. / (2. * samples + 1.);
    }
    else if (samples == 0. && -samplesPerTriangle < logarithm)
    {
      retreat = RetreatOfEmpty;
    }
    if (retreat > 0.)
    {
      const std::span<const VertexIndex> ring = rings[v];
      const PlaceOnMesh place{ { v, ring[0], ring[1] }, 0.5f, 0.f, 0.f };
      const Vector4 edge = pointAt(place, mesh_.positions());
      system_->add(place, edge + float(retreat) * (mesh_.position(ring[1]) - edge), Vector4(),
        float(std::max(1., samples)));
    }
  }
}

/// From each vertex beyond the samples one is added, where they end.
std::vector<SurfaceFit::Tip> SurfaceFit::findTips() const
{
  const EmptyCaps caps(mesh_, placedSamples(), variance(), executor_);
  std::vector<std::vector<Tip>> ranges(
    (mesh_.indexEnd() + VerticesPerRange - 1) / VerticesPerRange);
  forEachVertex(mesh_, executor_, VerticesPerRange,
    [&](VertexIndex v)
    {
      if (const std::optional<EmptyCaps::End> end = caps.endAt(v))
      {
        const PlaceOnMesh place{ { v, mesh_.ring(v)[0], mesh_.ring(v)[1] }, 0.f, 0.f, 0.f };
        ranges[v / VerticesPerRange].push_back({ place, mesh_.normal(v), *end });
      }
    });
  std::vector<Tip> tips;
  for (const std::vector<Tip>& range : ranges)
  {
    tips.insert(tips.end(), range.begin(), range.end());
  }
  return tips;
}

bool SurfaceFit::moveVertices(double lambda, const Progress& progress, PackedVectors& before)
{
  // Before the equations, beside which there is least memory left.
  if (!spacing_)
  {
    spacing_.emplace(mesh_, places_, executor_).forgetEdges();
  }
  fillSystem();
  if (!progress(0.))
  {
    dropSystem();
    return false;
  }
  smoothness_ = lambda;
  const double choice = lambda > 0. ? 0. : PartOfChoice;
  if (lambda <= 0. && !chooseSmoothness(partOf(progress, 0., choice)))
  {
    dropSystem();
    return false;
  }
  const std::span<Vector4> positions = mesh_.movablePositions();
  before = PackedVectors(positions.size());
  forEachVertex(
    mesh_, executor_, VerticesPerRange, [&](VertexIndex v) { before.set(v, positions[v]); });
  const bool isSolved = laidAside(before,
    [&]
    {
      return system_->solveLast(
        smoothness_, Tolerance, scale_, positions, partOf(progress, choice, 1.));
    });
  dropSystem();
  const double variance = isSolved ? residualVariance(positions, smoothness_) : 0.;
  const bool goesOn = isSolved && progress(1.);
  heldCount_ = 0;
  // On a mesh that is badly broken the solution may leave all bounds.
  if (!goesOn || !std::isfinite(variance))
  {
    for (std::size_t v = 0; v < positions.size(); ++v)
    {
      positions[v] = before[v];
    }
    return goesOn;
  }
  noise_ = std::sqrt(variance);
  for (VertexIndex v = 0; v < positions.size() && smoothnessOfVertices_; ++v)
  {
    const float part = smoothnessParts_.empty() ? 1.f : smoothnessParts_[v];
    mesh_.values(*smoothnessOfVertices_)[v] = float(smoothness_) * part;
  }
  heldCount_ = surface_ ? holdOvershot(before) : 0;
  hasDistances_ = false;
  heldCount_ += holdLost(before);
  return true;
}

void SurfaceFit::follow(const ChangedVertices& changed)
{
  if (!changed.any)
  {
    return;
  }
  ZeroedArray<VertexIndex> newOf(mesh_.indexEnd());
  forEachVertex(
    mesh_, executor_, VerticesPerRange, [&](VertexIndex v) { newOf[v] = changed.alive(mesh_, v); });
  const std::vector<VertexIndex> oldOf = mesh_.dropErased(executor_);
  {
    ZeroedArray<VertexIndex> place(newOf.size());
    forEachVertex(mesh_, executor_, VerticesPerRange, [&](VertexIndex v) { place[oldOf[v]] = v; });
    executor_.forEachRange(newOf.size(), VerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t v = begin; v < end; ++v)
        {
          newOf[v] = place[newOf[v]];
        }
      });
  }
  const auto nowOf = [&](VertexIndex old) { return newOf[old]; };
  auto opposite = touchedVector<std::vector<VertexIndex>>(oldOf.size(), executor_);
  const std::vector<std::uint8_t> wasKept = isKept_;
  isKept_.resize(isKept_.empty() ? 0 : oldOf.size());
  forEachVertex(mesh_, executor_, VerticesPerRange,
    [&](VertexIndex v)
    {
      VertexIndex old = oldOf[v];
      while (old >= opposite_.size())
      {
        old = changed.heir[old];
      }
      opposite[v] = opposite_[old] == NoVertex ? NoVertex : nowOf(opposite_[old]);
    });
  opposite_ = std::move(opposite);
  executor_.forEachRange(places_.size(), SamplesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        Triangle& triangle = places_[i].triangle;
        const bool isChanged = std::any_of(triangle.begin(), triangle.end(),
          [&](VertexIndex v) { return changed.isTouched[v] != 0; });
        std::transform(triangle.begin(), triangle.end(), triangle.begin(), nowOf);
        if (isChanged)
        {
          places_[i] = closestPlaceAround(
            samples_[i], mesh_, closestVertexFrom(samples_[i], mesh_, triangle[0]));
        }
      }
    });
  for (VertexIndex v = 0; v < oldOf.size() && !isKept_.empty(); ++v)
  {
    const bool isNew = oldOf[v] >= wasKept.size();
    isKept_[v] = isNew ? 0 : wasKept[oldOf[v]];
  }
  spacing_.reset();
  smoothnessParts_.clear();
  shifts_.clear();
  bends_.clear();
  localParts_.clear();
}

double SurfaceFit::variance() const
{
  return double(medianDistance_) * double(medianDistance_) / MedianOfSquares;
}

double SurfaceFit::outlierShare() const
{
  return 1. - double(usedCount_) / double(samples_.size());
}
}
