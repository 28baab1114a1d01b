// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceFit.h"

#include "Median.h"
#include "VertexGrid.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// What a distance along the surface counts, against one across it.
constexpr double Slip = 0.01;
/// In the first round samples are no outliers up to so many edges: the mesh does not fit yet.
constexpr float FirstOutlierEdges = 1.f;
constexpr float LaterOutlierEdges = 0.5f;
constexpr std::size_t SamplesPerAbortCheck = 65536;
// Parts for the executor.
constexpr std::size_t FitSamplesPerRange = 1024;
constexpr std::size_t FitVerticesPerRange = 4096;
/// Of the residual of the equations, against the largest at the start of a round.
constexpr double Tolerance = 1e-3;
/// While lambda is chosen, against that at the start.
constexpr double ToleranceOfChoice = 1e-2;

// The pull inwards at boundaries
/// Chance at which a strip along a boundary has no sample although there is data.
constexpr double ChanceOfEmptyStrip = 0.05;
/// Where a whole triangle is without, how far its edge goes towards the corner within.
constexpr double RetreatOfEmpty = 0.5;

// The choice of lambda
constexpr double FirstSmoothness = 1000.;
constexpr double MostSmoothness = 1e4;
/// A bit more: too rough a surface would follow the noise all the way.
constexpr double SmoothnessFactor = 1.1;
constexpr int MostChoices = 8;
/// It is found if it changes by no more than that.
constexpr double NearPart = 0.85;
/// Of the time of moveVertices().
constexpr double PartOfChoice = 0.6;

Vector4 normalAt(const PlaceOnMesh& place, std::span<const Vector4> positions)
{
  const Vector4 a = positions[place.triangle[0]];
  return cross(positions[place.triangle[1]] - a, positions[place.triangle[2]] - a);
}

bool isOpen(const Mesh& mesh)
{
  VertexIndex v = 0;
  while (v < mesh.indexEnd() && !mesh.isBoundary(v))
  {
    ++v;
  }
  return v < mesh.indexEnd();
}
}

SurfaceFit::SurfaceFit(
  const PointCloud& cloud, Mesh& mesh, std::size_t sampleCount, const Executor& executor)
  : cloud_(cloud)
  , mesh_(mesh)
  , executor_(executor)
{
  const std::size_t all = cloud.points().size();
  const std::size_t fitted = all - all / HeldOutStride;
  const std::size_t count = std::min(fitted, sampleCount);
  this->samples_.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t chosen = i * fitted / count;
    // One is passed over behind each group of those that are fitted.
    const std::size_t point = chosen + chosen / (HeldOutStride - 1);
    this->samples_.push_back(cloud.points()[point]);
    if (!cloud.weights().empty())
    {
      this->weights_.push_back(cloud.weights()[point]);
    }
  }
  this->places_.resize(count);
}

bool SurfaceFit::findPlaces(const Progress& progress)
{
  const VertexGrid grid = this->hasPlaces_ ? VertexGrid() : gridOf(this->mesh_, this->cloud_);
  std::vector<float> distances(this->samples_.size());
  const std::size_t count = this->samples_.size();
  for (std::size_t first = 0; first < count; first += SamplesPerAbortCheck)
  {
    if (!progress(double(first) / double(count)))
    {
      return false;
    }
    this->executor_.forEachRange(std::min(SamplesPerAbortCheck, count - first), FitSamplesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = first + begin; i < first + end; ++i)
        {
          PlaceOnMesh& place = this->places_[i];
          place = this->hasPlaces_
            ? closestPlaceFrom(this->samples_[i], this->mesh_, place.triangle[0])
            : closestPlace(this->samples_[i], this->mesh_, grid);
          distances[i] = place.squaredDistance;
        }
      });
  }
  const float edges = this->hasPlaces_ ? LaterOutlierEdges : FirstOutlierEdges;
  this->hasPlaces_ = true;
  this->medianDistance_ = std::sqrt(medianOf(distances, this->executor_));
  this->outlierDistance_ =
    neuralmesh::outlierDistance(this->medianDistance_, this->mesh_.meanEdge(), edges);
  this->fillSystem();
  return true;
}

void SurfaceFit::fillSystem()
{
  // Anew, as edges may have been flipped.
  this->system_.emplace(this->mesh_, Slip, this->executor_);
  this->forEachRows([this](const FitSystem::Rows& rows) { this->fillRows(rows); });
  this->usedCount_ = std::size_t(this->executor_.sum(this->places_.size(), FitSamplesPerRange,
    [this](std::size_t i) { return this->isUsed(this->places_[i]) ? 1. : 0.; }));
  if (isOpen(this->mesh_))
  {
    this->pullBoundariesIn();
  }
}

/// Each part goes through all samples for its rows: so these add up in the same order however many
/// parts there are.
template <typename Body>
void SurfaceFit::forEachRows(const Body& body) const
{
  const std::size_t parts = this->executor_.threadCount(), rows = this->mesh_.indexEnd();
  this->executor_.forEachPart(parts,
    [&](std::size_t part)
    {
      body(FitSystem::Rows{
        VertexIndex(part * rows / parts), VertexIndex((part + 1) * rows / parts) });
    });
}

void SurfaceFit::fillRows(const FitSystem::Rows& rows)
{
  for (std::size_t i = 0; i < this->samples_.size(); ++i)
  {
    const PlaceOnMesh& place = this->places_[i];
    const auto& [a, b, c] = place.triangle;
    if (this->isUsed(place) && (rows.has(a) || rows.has(b) || rows.has(c)))
    {
      // Beyond a boundary the distance along the surface counts in full: there is no other place.
      const Vector4 normal =
        isOnBoundary(place, this->mesh_) ? Vector4() : normalAt(place, this->mesh_.positions());
      this->system_->add(place, this->samples_[i], normal, this->weight(i), rows);
    }
  }
}

/// Samples beyond a boundary pull it outwards, but where it is beyond the samples there are none to
/// pull it back. So from each triangle at a boundary that has no samples in a strip along it, one is
/// added for the edge, where the samples begin.
void SurfaceFit::pullBoundariesIn()
{
  /// Samples on the triangle at a boundary edge.
  struct Strip
  {
    std::uint32_t samples = 0;
    float width = 1.f; ///< without samples, against the height of the triangle
  };
  const Mesh& mesh = this->mesh_;
  std::vector<Strip> strips(mesh.indexEnd()); // of the edges to the first neighbour
  const auto measure = [&](const PlaceOnMesh& place, const FitSystem::Rows& rows)
  {
    for (unsigned i = 0; i < 3; ++i)
    {
      const VertexIndex from = place.triangle[(i + 1) % 3], to = place.triangle[(i + 2) % 3];
      if (rows.has(from) && mesh.isBoundary(from) && mesh.ring(from).front() == to)
      {
        Strip& strip = strips[from];
        ++strip.samples;
        strip.width = std::min(strip.width, place.weights[int(i)]);
      }
    }
  };
  this->forEachRows(
    [&](const FitSystem::Rows& rows)
    {
      for (const PlaceOnMesh& place : this->places_)
      {
        if (this->isUsed(place))
        {
          measure(place, rows);
        }
      }
    });
  const double samplesPerTriangle = double(this->usedCount_) / (2. * double(mesh.vertexCount()));
  const double logarithm = std::log(ChanceOfEmptyStrip);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (!mesh.isBoundary(v))
    {
      continue;
    }
    const double samples = strips[v].samples, width = strips[v].width;
    double retreat = 0.;
    if (samples > 0. && 2. * samples * std::log(1. - width) < logarithm)
    {
      // What the strip would be on average if the edge were where the data ends.
      retreat = width - 1. / (2. * samples + 1.);
    }
    else if (samples == 0. && -samplesPerTriangle < logarithm)
    {
      retreat = RetreatOfEmpty;
    }
    if (retreat > 0.)
    {
      const Ring& ring = mesh.ring(v);
      const PlaceOnMesh place{ { v, ring[0], ring[1] }, Vector4(0.5f, 0.5f, 0.f), 0.f };
      const Vector4 edge = pointAt(place, mesh.positions());
      this->system_->add(place, edge + float(retreat) * (mesh.position(ring[1]) - edge), Vector4(),
        float(std::max(1., samples)));
    }
  }
}

bool SurfaceFit::moveVertices(double lambda, const Progress& progress)
{
  this->smoothness_ = lambda;
  const double choice = lambda > 0. ? 0. : PartOfChoice;
  if (lambda <= 0. && !this->chooseSmoothness(partOf(progress, 0., choice)))
  {
    return false;
  }
  std::vector<Vector4> positions(this->mesh_.positions().begin(), this->mesh_.positions().end());
  if (!this->system_->solve(
        this->smoothness_, Tolerance, this->scale_, positions, partOf(progress, choice, 1.)))
  {
    return false;
  }
  this->noise_ = std::sqrt(this->residualVariance(positions, this->smoothness_));
  for (VertexIndex v = 0; v < positions.size(); ++v)
  {
    this->mesh_.setPosition(v, positions[v]);
  }
  return true;
}

/// With Gaussian noise of variance s^2 and a surface whose L x has the variance r^2 across it, the
/// most probable positions are those for lambda = s^2 / r^2. Both are measured, beginning with a
/// smooth surface: on a rough one, noise would pass for shape.
bool SurfaceFit::chooseSmoothness(const Progress& progress)
{
  this->smoothness_ = FirstSmoothness;
  std::vector<Vector4> positions(this->mesh_.positions().begin(), this->mesh_.positions().end());
  for (int i = 0; i < MostChoices; ++i)
  {
    double scale = 0.;
    if (!this->system_->solve(this->smoothness_, ToleranceOfChoice, scale, positions,
          partOf(progress, double(i) / MostChoices, double(i + 1) / MostChoices)))
    {
      return false;
    }
    const double rough = this->roughness(positions);
    const double ratio =
      rough > 0. ? this->residualVariance(positions, this->smoothness_) / rough : MostSmoothness;
    const double before = this->smoothness_;
    const double next = SmoothnessFactor * ratio;
    const bool isNear = next > NearPart * before;
    // From far away it falls further yet.
    this->smoothness_ =
      std::clamp(isNear ? next : next * std::sqrt(next / before), LeastSmoothness, MostSmoothness);
    if (isNear)
    {
      break;
    }
  }
  return true;
}

double SurfaceFit::residualVariance(std::span<const Vector4> positions, double lambda) const
{
  const auto squaredDistance = [&](std::size_t i)
  {
    const PlaceOnMesh& place = this->places_[i];
    if (!this->isUsed(place))
    {
      return 0.;
    }
    const Vector4 normal = normalAt(place, positions);
    const Vector4 offset = this->samples_[i] - positions[place.triangle[0]];
    const float across = dot(offset, normal);
    const float squared = squaredNorm(normal);
    return double(this->weight(i)) *
      (squared > 0.f ? double(across * across / squared) : double(squaredNorm(offset)));
  };
  const double sum =
    this->executor_.sum(this->samples_.size(), FitSamplesPerRange, squaredDistance);
  // Vertices follow noise, the less the smoother they are held: so many of them do (a curve through
  // traces of the solution, measured for 2 to 20 samples a vertex).
  const auto vertices = double(positions.size());
  const auto samples = double(std::max<std::size_t>(1, this->usedCount_));
  const double followers = vertices / (1. + std::pow(2. * lambda * vertices / samples, 0.75));
  return sum / std::max(0.25 * samples, samples - followers);
}

double SurfaceFit::roughness(std::span<const Vector4> positions) const
{
  std::vector<Vector4> laplacian(positions.size());
  this->system_->applyLaplacian(positions, laplacian);
  const auto squaredAcross = [&](std::size_t vertex)
  {
    const auto v = VertexIndex(vertex);
    const Ring& ring = this->mesh_.ring(v);
    Vector4 normal;
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      normal += cross(
        positions[ring[slot]] - positions[v], positions[ring[ring.after(slot)]] - positions[v]);
    }
    const float across = dot(laplacian[v], normal);
    const float squared = squaredNorm(normal);
    return squared > 0.f ? double(across * across / squared) : 0.;
  };
  return this->executor_.sum(positions.size(), FitVerticesPerRange, squaredAcross) /
    double(positions.size());
}

double SurfaceFit::distanceEvenness() const
{
  double sum = 0., squares = 0., count = 0.;
  for (const PlaceOnMesh& place : this->places_)
  {
    if (this->isUsed(place) && !isOnBoundary(place, this->mesh_))
    {
      sum += std::sqrt(double(place.squaredDistance));
      squares += double(place.squaredDistance);
      count += 1.;
    }
  }
  return squares > 0. ? sum / std::sqrt(count * squares) : 0.;
}

double SurfaceFit::outlierShare() const
{
  return 1. - double(this->usedCount_) / double(this->samples_.size());
}
}
