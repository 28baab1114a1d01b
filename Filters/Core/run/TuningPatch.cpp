// SPDX-License-Identifier: BSD-3-Clause
#include "run/TuningPatch.h"

#include "base/Median.h"
#include "base/Random.h"
#include "base/UnitVector.h"
#include "cloud/PlaceOnMesh.h"
#include "learn/StoppingRules.h"
#include "start/OutlierClusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t PatchCount = 4;
constexpr std::size_t PointsPerHeldOut = 5;
/// A patch has at least so many different points: points that coincide count once.
constexpr std::size_t LeastPointsOfPatch = 1000;
/// Points beyond this part of the radius are not measured, as the rim of the mesh is there.
constexpr float InnerPart = 0.8f;

/// The radius of a ball that holds this share of the points.
float radiusOf(const PointCloud& cloud, Vector4 center, double share)
{
  constexpr std::size_t Enough = 50000;
  const std::size_t stride = 1 + cloud.points().size() / Enough;
  std::vector<float> squared;
  squared.reserve(cloud.points().size() / stride + 1);
  for (std::size_t i = 0; i < cloud.points().size(); i += stride)
  {
    squared.push_back(squaredNorm(cloud.points()[i] - center));
  }
  const auto rank = squared.begin() + std::ptrdiff_t(double(squared.size() - 1) * share);
  std::nth_element(squared.begin(), rank, squared.end());
  return std::sqrt(*rank);
}

/// Unit normals of the vertices, averaged over a few rings: they follow the large shape, not the
/// roughness, which differs between fits.
std::vector<Vector4> normalsAtLarge(const Mesh& mesh)
{
  constexpr int Rounds = 10;
  std::vector<Vector4> normals(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    normals[v] = unit(mesh.normal(v));
  }
  for (int round = 0; round < Rounds; ++round)
  {
    std::vector<Vector4> next = normals;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const Ring& ring = mesh.ring(v);
      for (unsigned slot = 0; slot < ring.size(); ++slot)
      {
        next[v] += normals[ring[slot]];
      }
      next[v] = unit(next[v]);
    }
    normals.swap(next);
  }
  return normals;
}
}

TuningPatch::TuningPatch(
  const PointCloud& cloud, Vector4 center, float radius, std::uint64_t vertices)
  : cloud_(
      cloud.without([&](Vector4 point) { return squaredNorm(point - center) > radius * radius; }))
  , center_(center)
  , radius_(radius)
  , vertices_(vertices)
{
  std::size_t index = 0;
  cloud_ = cloud_.without(
    [&](Vector4 point)
    {
      const bool isHeldOut = index++ % PointsPerHeldOut == 0;
      // Equal points are neighbours in Morton order. Each counts once.
      if (isHeldOut && (heldOut_.empty() || squaredNorm(point - heldOut_.back()) > 0.f))
      {
        heldOut_.push_back(point);
      }
      return isHeldOut;
    });
}

std::vector<TuningPatch> TuningPatch::patchesOf(
  const PointCloud& cloud, const Parameters& parameters)
{
  const double share = double(PatchVertices) / double(parameters.numberOfVertices);
  std::vector<TuningPatch> patches;
  const auto add = [&](Vector4 center, float radius, std::uint64_t vertices)
  {
    TuningPatch patch(cloud, center, radius, vertices);
    if (patch.cloud().differentCount() >= LeastPointsOfPatch)
    {
      patches.push_back(std::move(patch));
    }
  };
  if (share >= 0.5)
  {
    add(0.5f * (cloud.bulkMin() + cloud.bulkMax()), std::numeric_limits<float>::max(),
      parameters.numberOfVertices);
    return patches;
  }
  constexpr std::uint64_t Stream = 11;
  constexpr float LargestOverMedian = 1.5f;
  Random random(parameters.seed, Stream);
  std::vector<std::pair<float, Vector4>> balls;
  std::vector<float> radii;
  for (std::size_t i = 0; i < 3 * PatchCount; ++i)
  {
    const Vector4 center = cloud.points()[random.below64(cloud.points().size())];
    radii.push_back(radiusOf(cloud, center, share));
    balls.emplace_back(radii.back(), center);
  }
  const float largest = LargestOverMedian * medianOf(radii);
  for (const auto& [radius, center] : balls)
  {
    if (radius <= largest && patches.size() < PatchCount)
    {
      add(center, radius, PatchVertices);
    }
  }
  return patches;
}

Parameters TuningPatch::own(Parameters parameters) const
{
  parameters.numberOfVertices = vertices_;
  return learnable(parameters, cloud_);
}

void TuningPatch::beginFor(const Parameters& parameters, const Progress& progress)
{
  // The automatic density is the same for all meshes as small as that of a patch.
  const double density = parameters.curvatureDensity;
  if (!beginning_)
  {
    cleaned_ = parameters.start == Start::OccupiedSpace && parameters.keepPieces > 0.
      ? withoutClusters(cloud_, partOf(progress, 0., 0.))
      : std::nullopt;
  }
  if (!beginning_ || (density != 0. && density != densityOfBeginning_))
  {
    beginning_ = begin(learntCloud(), parameters, progress);
    densityOfBeginning_ = density;
  }
}

void TuningPatch::learn(const Parameters& wanted, const Progress& progress)
{
  const Parameters parameters = own(wanted);
  beginFor(parameters, progress);
  Beginning beginning = *beginning_;
  if (parameters.curvatureDensity == 0.)
  {
    beginning.weights.clear();
  }
  const std::unique_ptr<Learner> made =
    learnerFrom(std::move(beginning), learntCloud(), parameters);
  Learner& learner = *made;
  StoppingRules rules(learntCloud(), parameters, learner.mesh().vertexCount());
  StopReason reason = ruleMet(learner, rules, progress);
  while (reason == StopReason::None)
  {
    reason = neuralmesh::learn(learner, rules, parameters, SamplesPerCheck, progress);
  }
  learnt_.reset();
  if (reason != StopReason::Cancelled && learner.counts().iterations > 0)
  {
    learner.compact();
    learnt_ = learner.learntMesh();
    hasAllVertices_ = reason == StopReason::Vertices;
  }
}

std::optional<PatchMesh> TuningPatch::finish(
  const Parameters& wanted, const Progress& progress) const
{
  if (!learnt_)
  {
    return {};
  }
  LearntMesh learnt = *learnt_;
  const std::size_t vertices = learnt.mesh.vertexCount();
  const auto report = neuralmesh::finish(learnt, learntCloud(), own(wanted), beginning_->gaps,
    hasAllVertices_ ? std::max(std::size_t(vertices_), vertices) : vertices, progress);
  return report ? std::optional(PatchMesh{ std::move(learnt.mesh), *report }) : std::nullopt;
}

void TuningPatch::aim(const Mesh& mesh)
{
  probes_.clear();
  if (heldOut_.empty() || mesh.vertexCount() == 0)
  {
    return;
  }
  const VertexGrid grid = gridOf(mesh, cloud_);
  std::vector<PlaceOnMesh> places;
  std::vector<float> squared;
  for (const Vector4 point : heldOut_)
  {
    places.push_back(closestPlace(point, mesh, grid));
    squared.push_back(places.back().squaredDistance);
  }
  const float farthest = outlierDistance(std::sqrt(medianOf(squared)), mesh.meanEdge());
  const float inner = InnerPart * radius_;
  const std::vector<Vector4> normals = normalsAtLarge(mesh);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const PlaceOnMesh& place = places[i];
    const Vector4 point = heldOut_[i];
    if (squared[i] > farthest * farthest || squaredNorm(point - center_) > inner * inner ||
      isOnBoundary(place, mesh))
    {
      continue;
    }
    Vector4 direction{};
    for (int corner = 0; corner < 3; ++corner)
    {
      direction += place.weights()[corner] * normals[place.triangle[std::size_t(corner)]];
    }
    probes_.push_back({ point, unit(direction), pointAt(place, mesh.positions()), farthest });
  }
}

std::vector<double> TuningPatch::squaredDistances(const Mesh& mesh) const
{
  constexpr int Steps = 3;
  // The cosine of a triangle that is turned farther away counts as this.
  constexpr float LeastCosine = 0.3f;
  const VertexGrid grid = gridOf(mesh, cloud_);
  std::vector<double> result;
  result.reserve(probes_.size());
  for (const Probe& probe : probes_)
  {
    // Finds where the line through the point meets the mesh: each step intersects it with the
    // triangle closest to the last place.
    Vector4 place = probe.foot;
    double squared = 0.;
    for (int step = 0; step < Steps; ++step)
    {
      const PlaceOnMesh closest = closestPlace(place, mesh, grid);
      if (isOnBoundary(closest, mesh))
      {
        squared = std::numeric_limits<double>::infinity();
        break;
      }
      const Vector4 corner = mesh.position(closest.triangle[0]);
      const Vector4 normal = unit(cross(
        mesh.position(closest.triangle[1]) - corner, mesh.position(closest.triangle[2]) - corner));
      const float cosine = std::max(LeastCosine, dot(normal, probe.direction));
      const float distance =
        std::clamp(dot(normal, probe.point - corner) / cosine, -probe.farthest, probe.farthest);
      place = probe.point - distance * probe.direction;
      squared = double(distance) * double(distance);
    }
    result.push_back(squared);
  }
  return result;
}
}
