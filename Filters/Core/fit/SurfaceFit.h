// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "base/Progress.h"
#include "base/ZeroedArray.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/PointCloud.h"
#include "fit/ChangedVertices.h"
#include "fit/FitSystem.h"
#include "fit/GivenNormals.h"
#include "fit/HeldOutPoints.h"
#include "fit/LocalSpacing.h"
#include "fit/SamplePoints.h"
#include "fit/SharedNoise.h"
#include "fit/StoredPlaces.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"
#include "mesh/NearestTriangle.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// Moves all vertices of a mesh to where the surface is closest to its cloud: to the positions x
/// that minimise
///
///   sum over samples p of w_p |p - b_p x|^2  +  lambda sum over vertices |L x|^2
///
/// where b_p x is the place on the mesh that is closest to p, w_p is the weight of the point (0 for
/// outliers), and L is the umbrella Laplacian. A distance along the surface counts little, as another
/// place is then closer. Places change with the positions, so that it takes rounds of finding places
/// and solving for positions. The topology stays as it is.
class SurfaceFit
{
public:
  /// The least lambda that is worth trying: with less, triangles would fold.
  static constexpr double LeastSmoothness = 0.03;
  /// With a lambda by the data below this one, the cloud counts as clean.
  static constexpr double CleanSmoothness = 0.2;

  /// Takes so many points of the cloud, evenly picked but for those held out, as samples. No vertex
  /// may be erased. `normalOf` gives the normal that came with a point of the cloud, if there are some, and
  /// `viewOf` its view. Cloud, mesh and executor must outlive the fit.
  SurfaceFit(const PointCloud& cloud, Mesh& mesh, std::size_t sampleCount,
    const Executor& executor = Executor::sequential(), const PointNormals& normalOf = {},
    const PointViews& viewOf = {});

  /// From now on a round brings boundaries all the way to the end of the samples, not half of it. Not before
  /// holes are filled in which there are samples: their sides would run into each other.
  void reachTheEnd() { reachesTheEnd_ = true; }

  bool hasPlaces() const { return hasPlaces_; }
  /// Finds the places of the samples on the mesh as it is now. Returns false if it was ended before.
  bool findPlaces(const Progress& progress);
  /// Moves the vertices. With `lambda` 0 chooses it first. Vertices stay where they are if samples
  /// around them would be lost: farther from the mesh than some distances between samples, though
  /// they were closer. Returns false, and moves none, if it was ended before.
  bool moveVertices(double lambda, const Progress& progress);
  /// Follows a change of the mesh since findPlaces(): indices of erased vertices are given up, and samples on
  /// what has changed get new places near by.
  void follow(const ChangedVertices& changed);
  /// Vertices at creases, where the surface bends more sharply than usual by some `deviations`, are held less
  /// smooth from the next moveVertices() on, but for those with few samples.
  void relaxCreases(double deviations);
  /// From the next moveVertices() on, samples count as moved against what noise of this variance does where the
  /// surface bends: more of it lies on the outer side there. The bends are those of the mesh as it is.
  void shiftAgainstNoise(double variance);
  /// From the next moveVertices() on the surface turns to the normals that came with the samples, as far as they
  /// are to be trusted, for samples whose distances have this variance.
  void turnToNormals(double variance);
  /// Chooses lambda by the risk of the surface that it gives, with places as they are, and how much of it
  /// counts at each vertex; goes down from `first`. Returns false if it was ended before.
  bool chooseSmoothnessByRisk(double first, const Progress& progress);
  /// From now on the surface slides less below its samples, and vertices keep to where they are where nothing
  /// pulls them: for rounds that come after the places have settled.
  void settle() { isSettled_ = true; }
  /// From now on vertices that lie beyond the samples, at tips and in pits, are pulled to where these end; see
  /// EmptyCaps.h.
  void endWithSamples() { endsWithSamples_ = true; }
  /// From now on places are looked for beyond the triangles of the closest vertex, too.
  void findExactly() { isExact_ = true; }
  /// The samples are those of a surface, in the coordinates of the cloud, which must outlive the fit: none is an outlier,
  /// their places are looked for all over the mesh, if they have normals, and no vertex leaves the surface for where
  /// nothing holds it.
  void keepTo(const NearestTriangle& surface) { surface_ = &surface; }
  /// From now on the boundaries, and what is next to them, stay where they are.
  void keepBoundaries();
  /// ... and so do the vertices for which this is not 0.
  void keep(std::span<const std::uint8_t> vertices);
  /// From now on moveVertices() tells each vertex its lambda, in this property of the mesh.
  void tellSmoothness(VertexProperty<float> property) { smoothnessOfVertices_ = property; }
  /// The lambda of the last moveVertices().
  double smoothness() const { return smoothness_; }
  /// Whether it is that of a cloud without noise to speak of.
  bool isClean() const { return smoothness_ < CleanSmoothness * partOfUsualSamples(); }

  /// Of samples in use, to the planes of their triangles, root of the mean square, with what the
  /// vertices have followed of it added: the noise of the cloud, and what the triangles are too
  /// coarse for.
  double noise() const { return noise_; }
  /// What each point has of it for itself, and what the points of a view share, told on the mesh as it is. The mesh
  /// must be smooth against the noise: else it follows the views.
  NoiseParts noiseParts() const;
  /// Vertices that the last moveVertices() has not moved, so that no samples were lost.
  std::size_t heldCount() const { return heldCount_; }
  /// Moves vertices back to where they were in `before`, a mesh of the same vertices, if samples around
  /// them are lost now. Returns how many. Then places must be found anew.
  std::size_t holdAgainst(const Mesh& before);
  /// Part of the samples that are outliers.
  double outlierShare() const;
  /// Beyond this distance a sample is an outlier; where points are sparse, beyond some edges around its
  /// place, and some distances between samples there.
  float outlierDistance() const { return outlierDistance_; }
  /// Mean over root mean square of the distances of samples to the mesh: 0.8 for noise, 1 if all are
  /// as far away.
  double distanceEvenness() const;
  /// Of the vertices with enough samples on their triangles, the part that lies between two layers of them:
  /// at either side of the surface, all nearly as far from it.
  double shareBetweenLayers() const;
  /// Of the samples to the mesh.
  float medianDistance() const { return medianDistance_; }
  /// Of the samples about the surface, by their median distance.
  double variance() const;
  /// Of the samples, at the last findPlaces().
  std::span<const PlaceOnMesh> places() const { return places_; }
  PlacedSamples placedSamples() const { return { samples_, places_, isUsed_, weights_ }; }

private:
  // Parts for the executor.
  static constexpr std::size_t SamplesPerRange = 1024;
  static constexpr std::size_t VerticesPerRange = 4096;
  /// Median of the square of a Gaussian variable, against its variance.
  static constexpr double MedianOfSquares = 0.455;
  /// With fewer samples memory does not matter.
  static constexpr std::size_t LeastLaidAside = 500'000;
  /// Samples that are so many times farther from each other than usual are sparse.
  static constexpr float SparseSpacings = 2.f;

  bool isUsed(std::size_t sample) const { return isUsed_[sample] != 0; }
  float weight(std::size_t sample) const { return weights_.empty() ? 1.f : weights_[sample]; }
  void findPlace(std::size_t sample, const VertexGrid& grid);
  void findNearerPlaces();
  /// Tells outliers by how far samples are from each other around their places.
  void chooseUsed(float edges);
  void fillSystem();
  /// The answer of `solve()`, while which the rings of the mesh and the places are laid aside, as the equations take
  /// most of the memory. `positions` are those for which the places are.
  template <typename Positions, typename Solve>
  bool laidAside(const Positions& positions, const Solve& solve)
  {
    const RingsReleased released(mesh_, system_->rings(), executor_);
    if (!hasDistances_ || places_.size() < LeastLaidAside)
    {
      return solve();
    }
    const StoredPlaces stored(places_, executor_);
    places_ = ZeroedArray<PlaceOnMesh>();
    const bool isDone = solve();
    places_ = stored.places(executor_);
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
  /// Calls `body(v)` for all vertices, threads of the executor at the same time.
  template <typename Body>
  void forEachVertex(const Body& body) const
  {
    executor_.forEachRange(mesh_.indexEnd(), VerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          body(v);
        }
      });
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
  void pullTipsIn();
  // In SurfaceFitHold.cpp
  bool isLost(std::size_t sample, float squaredBefore) const;
  template <typename Distance>
  std::vector<std::uint8_t> lostPlaces(const Distance& squaredBefore) const;
  template <typename Positions, typename Distance>
  std::size_t hold(const Positions& before, const Distance& squaredBefore);
  std::size_t holdLost(const PackedVectors& before);
  std::size_t holdOvershot(const PackedVectors& before);
  // In SurfaceFitSmoothness.cpp
  bool chooseSmoothness(const Progress& progress);
  std::vector<float> squaredBends(std::span<const Vector4> positions) const;
  std::vector<float> supports() const;
  std::vector<float> creaseParts(double deviations) const;
  /// A sample, moved against what noise does.
  Vector4 shifted(std::size_t sample) const
  {
    return shifts_.empty() ? samples_[sample]
                           : samples_[sample] + pointAt(places_[sample], shifts_);
  }
  double partOfUsualSamples() const;
  double meanSquaredDistance() const;
  double residualVariance(std::span<const Vector4> positions, double lambda) const;
  double roughness(std::span<const Vector4> positions) const;

  const PointCloud& cloud_;
  Mesh& mesh_;
  const Executor& executor_;
  std::optional<FitSystem> system_;
  SamplePoints samples_;
  GivenNormals normals_;
  double normalWeight_ = 0.;
  std::vector<float> weights_;       ///< of the samples; empty if all weigh alike
  std::vector<std::uint32_t> views_; ///< likewise; empty if none is known
  ZeroedArray<PlaceOnMesh> places_;
  /// Of the samples, those that are no outliers, and have not switched to the other side of a thin part.
  std::vector<std::uint8_t> isUsed_;
  std::vector<VertexIndex> opposite_; ///< of each vertex, see OppositeLayer.h
  bool hasPlaces_ = false;
  bool hasDistances_ = false; ///< whether those of the places are still those to the mesh
  bool reachesTheEnd_ = false;
  bool isSettled_ = false;
  bool endsWithSamples_ = false;
  bool isExact_ = false;
  const NearestTriangle* surface_ = nullptr; ///< of which the samples are; null: of none
  std::vector<std::uint8_t>
    isKept_;                    ///< of each vertex, whether it stays where it is; empty: none does
  std::vector<Vector4> shifts_; ///< of samples, at each vertex; empty: none
  std::vector<float> localParts_;      ///< by the risk, likewise
  std::vector<float> smoothnessParts_; ///< of lambda, for each vertex; empty: all 1
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
