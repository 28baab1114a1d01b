// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "base/Progress.h"
#include "base/ZeroedArray.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/PointCloud.h"
#include "fit/ChangedVertices.h"
#include "fit/EmptyCaps.h"
#include "fit/FitSystem.h"
#include "fit/GivenNormals.h"
#include "fit/HeldOutPoints.h"
#include "fit/LocalSpacing.h"
#include "fit/SamplePoints.h"
#include "fit/SharedNoise.h"
#include "fit/StoredPlaces.h"
#include "fit/TriangleSamples.h"
#include "mesh/CompactRings.h"
#include "mesh/Mesh.h"
#include "mesh/NearestTriangle.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// Moves all vertices of a mesh to where the surface is closest to its cloud: to the positions x
/// that minimise
///
///
/// where b_p x is the place on the mesh that is closest to p, w_p is the weight of the point (0 for
/// outliers), and L is the umbrella Laplacian. A distance along the surface counts little, as a
/// sample then has a closer place elsewhere. Places change with the positions. So a fit takes
/// rounds: each finds places and solves for positions. The topology does not change.
class SurfaceFit
{
public:
  /// The least lambda. With a smaller one, triangles fold.
  static constexpr double LeastSmoothness = 0.03;
  /// A cloud is clean if the lambda that was chosen for it is smaller.
  static constexpr double CleanSmoothness = 0.2;
  /// Where noise is large against edges, the search for lambda begins with a surface that bends over so many of its
  /// deviations. Over fewer, samples pull a mesh that was learnt from noise back into it.
  static constexpr double FirstDeviationsOfBend = 2.;

  /// Picks so many samples evenly from the points of the cloud that are not held out. No vertex may
  /// be erased. `normalOf` returns the given normal of a point of the cloud, `viewOf` its view;
  /// both may be empty. Cloud, mesh and executor must outlive the fit.
  SurfaceFit(const PointCloud& cloud, Mesh& mesh, std::size_t sampleCount,
    const Executor& executor = Executor::sequential(), const PointNormals& normalOf = {},
    const PointViews& viewOf = {});

  /// From now on, a round moves boundaries all the way to the end of the samples, not half of it.
  /// Fill holes with samples in them first: otherwise their sides run into each other.
  void reachTheEnd() { reachesTheEnd_ = true; }

  bool hasPlaces() const { return hasPlaces_; }
  /// Finds the places of the samples on the mesh as it is now. Returns false if `progress` ended
  /// it.
  bool findPlaces(const Progress& progress);
  /// Moves the vertices. If `lambda` is 0, chooses it first. A vertex stays where it is if samples
  /// around it would be lost: farther from the mesh than some distances between samples, although
  /// they were closer. Returns false and moves no vertex if `progress` ended it.
  bool moveVertices(double lambda, const Progress& progress)
  {
    PackedVectors before;
    return moveVertices(lambda, progress, before);
  }
  /// The same. Gives the positions from which the vertices have moved.
  bool moveVertices(double lambda, const Progress& progress, PackedVectors& before);
  /// Follows a change of the mesh since findPlaces(): drops erased vertices, and finds new places
  /// for the samples on triangles that have changed.
  void follow(const ChangedVertices& changed);
  /// From the next moveVertices() on, lambda is smaller at creases, where the bend exceeds so many
  /// `deviations` of the usual one. Vertices with few samples keep it.
  void relaxCreases(double deviations);
  /// From the next moveVertices() on, samples are shifted against the bias of noise with this
  /// variance: at a bend, more of it lies on the outer side. The bends are those of the mesh as it
  /// is now.
  void shiftAgainstNoise(double variance);
  /// A sample, as it was shifted.
  Vector4 shifted(std::size_t sample) const
  {
    return shifts_.empty() ? samples_[sample]
                           : samples_[sample] + pointAt(places_[sample], shifts_);
  }
  /// From the next moveVertices() on, L x is smoothed towards what it is expected to be instead of to 0, by the mesh as
  /// it is now: see ExpectedBends.h. Beyond so many `deviations` of the usual bend is a crease.
  void expectBends(double deviations);
  /// What L x is expected to be at each vertex; empty: 0.
  std::span<const Vector4> expectedBends() const { return bends_; }
  /// From the next moveVertices() on, the surface turns to the given normals of the samples. Their
  /// weight follows from their errors and from the variance of the distances of samples.
  void turnToNormals(double variance);
  /// Chooses lambda and its part at each vertex by the risk of the surface, with the places as they
  /// are. The search goes down from `first`. Returns false if `progress` ended it.
  bool chooseSmoothnessByRisk(double first, const Progress& progress);
  /// From now on, the surface slides less below its samples, and vertices without samples stay near
  /// their positions. For rounds after the places have settled.
  void settle() { isSettled_ = true; }
  /// From now on vertices that lie beyond the samples, at tips and in pits, are pulled to where these end; see
  /// EmptyCaps.h.
  void endWithSamples() { endsWithSamples_ = true; }
  /// From now on the search for lambda begins near its end where bends of the mesh are shape, not from a smooth surface.
  /// That is quicker, but thin parts come out a little worse.
  void searchNear() { searchesNear_ = true; }
  /// From now on places are looked for beyond the triangles of the closest vertex, too.
  void findExactly() { isExact_ = true; }
  /// From now on, the samples are those of a surface, in the coordinates of the cloud. No sample is
  /// an outlier, places are searched on the whole mesh if samples have normals, and no vertex
  /// overshoots the surface. The surface must outlive the fit.
  void keepTo(const NearestTriangle& surface) { surface_ = &surface; }
  /// From now on, the boundaries and the vertices near them stay where they are.
  void keepBoundaries();
  /// From now on, the vertices whose value is not 0 stay where they are.
  void keep(std::span<const std::uint8_t> vertices);
  /// From now on, moveVertices() stores the lambda of each vertex in this property of the mesh.
  void tellSmoothness(VertexProperty<float> property) { smoothnessOfVertices_ = property; }
  /// The lambda of the last moveVertices().
  double smoothness() const { return smoothness_; }
  /// The lambda with which the surface bends over so many deviations of this noise, and no less.
  double smoothnessOver(double deviations, double noise) const;
  /// The lambda for the next moveVertices() of a clean cloud, once the mesh has settled.
  double settledSmoothness() const;
  /// Whether the last lambda is one of a clean cloud.
  bool isClean() const { return smoothness_ < CleanSmoothness * partOfUsualSamples(); }

  /// The root mean square distance of used samples to the planes of their triangles, plus the noise
  /// that the vertices have followed. It consists of the noise of the cloud and of the error of
  /// coarse triangles.
  double noise() const { return noise_; }
  /// The noise of single points, and the noise that the points of a view share, measured on the
  /// mesh as it is. The mesh must be smoother than the noise: otherwise it follows the views.
  NoiseParts noiseParts() const;
  /// Number of vertices that the last moveVertices() left where they were, so that no samples were
  /// lost.
  std::size_t heldCount() const { return heldCount_; }
  /// Moves vertices back to their positions in `before`, a mesh of the same vertices, if samples
  /// around them are lost now. Returns how many. Places must then be found again.
  std::size_t holdAgainst(const Mesh& before);
  /// The part of the samples that are outliers.
  double outlierShare() const;
  /// Beyond this distance a sample is an outlier. Where samples are sparse, it must also be farther
  /// than some local edges and local distances between samples.
  float outlierDistance() const { return outlierDistance_; }
  /// The mean distance of samples to the mesh over the root mean square: 0.8 for noise, 1 for equal
  /// distances.
  double distanceEvenness() const;
  /// The part of the vertices that lie between two layers of samples: samples on both sides, all at
  /// nearly the same distance. Only vertices with enough samples on their triangles count.
  double shareBetweenLayers() const;
  /// The median distance of the samples to the mesh.
  float medianDistance() const { return medianDistance_; }
  /// The variance of the samples about the surface, by their median distance.
  double variance() const;
  /// The places of the samples at the last findPlaces().
  std::span<const PlaceOnMesh> places() const { return places_; }
  PlacedSamples placedSamples() const { return { samples_, places_, isUsed_, weights_ }; }

private:
  // Sizes of parts for the executor.
  static constexpr std::size_t SamplesPerRange = 1024;
  static constexpr std::size_t VerticesPerRange = 4096;
  /// The median of the square of a Gaussian variable, over its variance.
  static constexpr double MedianOfSquares = 0.455;
  /// With fewer samples, memory does not matter.
  static constexpr std::size_t LeastLaidAside = 500'000;
  /// Samples that are so many times farther from each other than usual are sparse.
  static constexpr float SparseSpacings = 2.f;

  /// A vertex beyond the samples, and where these end.
  struct Tip
  {
    PlaceOnMesh place;
    Vector4 normal;
    EmptyCaps::End end;
  };

  bool isUsed(std::size_t sample) const { return isUsed_[sample] != 0; }
  float weight(std::size_t sample) const { return weights_.empty() ? 1.f : weights_[sample]; }
  void findPlace(std::size_t sample, const VertexGrid& grid);
  void findNearerPlaces();
  /// Finds outliers by the distance between samples around their places.
  void chooseUsed(float edges);
  /// Until dropSystem(), the rings of the mesh are released: the equations have them, too.
  void fillSystem();
  void dropSystem();
  std::span<const VertexIndex> ringOf(VertexIndex v) const
  {
    return released_ ? system_->rings()[v] : std::span(mesh_.ring(v).begin(), mesh_.ring(v).end());
  }
  bool isOpenAt(VertexIndex v) const
  {
    return released_ ? system_->rings().isOpen(v) : mesh_.isBoundary(v);
  }
  /// Calls `solve()` and returns its answer. Meanwhile the places are packed, as the equations take most of the
  /// memory. `positions` are those to which the places belong.
  template <typename Positions, typename Solve>
  bool laidAside(const Positions& positions, const Solve& solve)
  {
    if (!hasDistances_ || places_.size() < LeastLaidAside)
    {
      return solve();
    }
    StoredPlaces stored(std::exchange(places_, {}), executor_);
    const bool isDone = solve();
    places_ = stored.takePlaces(executor_);
    executor_.forEachRange(places_.size(), SamplesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          places_[i].squaredDistance = squaredNorm(samples_[i] - pointAt(places_[i], positions));
        }
      });
    return isDone;
  }
  /// Calls `body(rows, sample)` for the samples that are used, and the rows of those of their corners that a part has:
  /// these add up in the order of the samples, however many parts there are.
  template <typename Body>
  void forEachUsed(const Body& body) const
  {
    forEachPlaceByRows(
      places_, RowParts(mesh_.indexEnd(), executor_), executor_,
      [this](std::size_t i) { return isUsed(i); }, body);
  }
  void fillRows(const FitSystem::Rows& rows, std::size_t sample);
  Vector4 beyondBoundary(
    const Vector4& sample, const PlaceOnMesh& place, const Vector4& normal) const;
  void pullBoundariesIn();
  std::vector<Tip> findTips() const;
  // In SurfaceFitHold.cpp
  bool isLost(std::size_t sample, float squaredBefore) const;
  template <typename Distance>
  std::vector<std::uint8_t> verticesWithLostSamples(const Distance& squaredBefore) const;
  template <typename Positions, typename Distance>
  std::size_t hold(const Positions& before, const Distance& squaredBefore);
  std::size_t holdLost(const PackedVectors& before);
  std::size_t holdOvershot(const PackedVectors& before);
  // In SurfaceFitSmoothness.cpp
  bool chooseSmoothness(const Progress& progress);
  double firstSmoothness() const;
  std::vector<float> squaredBends(std::span<const Vector4> positions) const;
  std::vector<float> supports() const;
  std::vector<float> creaseParts(double deviations) const;
  double partOfUsualSamples() const;
  double meanSquaredDistance() const;
  double residualVariance(std::span<const Vector4> positions, double lambda) const;
  double roughness(std::span<const Vector4> positions) const;

  const PointCloud& cloud_;
  Mesh& mesh_;
  const Executor& executor_;
  std::optional<FitSystem> system_;
  std::unique_ptr<RingsReleased> released_; ///< of the mesh; those of the system stand for them
  SamplePoints samples_;
  GivenNormals normals_;
  double normalWeight_ = 0.;
  std::vector<float> weights_;       ///< of the samples; empty if all weigh alike
  std::vector<std::uint32_t> views_; ///< likewise; empty if none is known
  ZeroedArray<PlaceOnMesh> places_;
  /// Of the samples, those that are no outliers, and have not switched to the other side of a thin part.
  std::vector<std::uint8_t> isUsed_;
  std::vector<VertexIndex> opposite_; ///< for each vertex, see OppositeLayer.h
  bool hasPlaces_ = false;
  bool hasDistances_ = false; ///< whether the distances of the places are those to the present mesh
  bool reachesTheEnd_ = false;
  bool isSettled_ = false;
  bool endsWithSamples_ = false;
  bool isExact_ = false;
  bool searchesNear_ = false;
  const NearestTriangle* surface_ = nullptr; ///< from which the samples come; null: from a cloud
  std::vector<std::uint8_t> isKept_;   ///< for each vertex, whether it stays; empty: all may move
  std::vector<Vector4> shifts_;        ///< of the samples at each vertex; empty: none
  std::vector<Vector4> bends_;         ///< that are expected of each vertex; empty: 0
  std::vector<float> smoothnessParts_; ///< the part of lambda at each vertex; empty: all 1
  std::vector<float> localParts_;      ///< the same as chosen by the risk
  std::optional<VertexProperty<float>> smoothnessOfVertices_;
  std::optional<LocalSpacing> spacing_; ///< at the last findPlaces()
  std::size_t usedCount_ = 0;
  std::size_t heldCount_ = 0;
  float outlierDistance_ = 0.f;
  float medianDistance_ = 0.f;
  double smoothness_ = 0.;
  double scale_ = 0.; ///< of the residual of the equations
  double noise_ = 0.;
};
}
