// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Choices.h"
#include "base/Executor.h"
#include "base/Progress.h"
#include "fit/SurfaceFit.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Rounds of the fit that come after the first ones, when places have settled; what they do depends on
/// whether the cloud is clean.
///
/// Of a clean cloud, edges are flipped to the samples, vertices go to creases and corners and from where the
/// surface is flat to where samples are far from it, and then all move, with creases held less smooth.
///
/// Of a noisy one, places are found on a smoother mesh, where they do not follow the noise, samples are
/// moved against what noise does in bends, and lambda is chosen anew, by the risk and for each part of the
/// surface. Boundaries stay where they are.
class FidelityRounds
{
public:
  /// `vertexCount` is that of the mesh in the end, which may be missing some now. With `keepsPlaces` vertices
  /// do not go to creases, nor to where they are needed more.
  FidelityRounds(Mesh& mesh, SurfaceFit& fit, std::size_t vertexCount, bool keepsPlaces,
    const Executor& executor)
    : mesh_(mesh)
    , fit_(fit)
    , vertexCount_(vertexCount)
    , keepsPlaces_(keepsPlaces)
    , executor_(executor)
  {
  }

  /// On a noisy cloud, beyond so many deviations of the usual bend is a crease.
  static constexpr double DeviationsOfCreaseIfNoisy = 3.;

  /// How many rounds there are.
  static int count(Fidelity fidelity, bool isClean);

  /// So many of a clean or a noisy cloud. Begins with `lambda`, that of the rounds before; where it is fixed, it is not
  /// chosen anew. Returns false if it was ended before.
  bool run(Fidelity fidelity, int rounds, bool isClean, bool isFixed, double lambda,
    const Progress& progress);

  /// From now on broken triangles are left to the repair in the end: the rounds before have held vertices there, and
  /// would hold what a repair rounds off.
  void stayUnbroken() { staysUnbroken_ = true; }

  /// Whether it is known that no triangles of the mesh intersect or fold, as the last round has seen.
  bool isUnbroken() const { return isUnbroken_; }
  double lambda() const { return lambda_; }
  std::size_t heldVertices() const { return heldVertices_; }
  /// Of a noisy cloud.
  const NoiseParts& noiseParts() const { return noiseParts_; }

private:
  bool sharpen(bool distributes, const Progress& progress);
  bool sharpenCorners(const Progress& progress);
  bool smooth(bool isFirst, bool isFixed, const Progress& progress);
  double firstLambda() const;
  bool move(double lambda, const Progress& progress);
  bool move(double lambda, const Progress& progress, PackedVectors& before);

  Mesh& mesh_;
  SurfaceFit& fit_;
  std::size_t vertexCount_;
  bool keepsPlaces_;
  const Executor& executor_;
  bool mayBeBroken_ = true; ///< by intersections or folds
  bool isUnbroken_ = false;
  bool staysUnbroken_ = false;
  double lambda_ = 0.;
  double least_ = 0.; ///< lambda once the mesh has settled
  std::size_t heldVertices_ = 0;
  NoiseParts noiseParts_;
};
}
