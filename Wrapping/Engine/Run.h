// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Arrays.h"
#include "Call.h"
#include "Sides.h"

#include "base/ThreadPool.h"
#include "cloud/CloudPlaces.h"
#include "cloud/PointCloud.h"
#include "run/EnsembleParameters.h"
#include "run/Reconstruction.h"
#include "run/SizeChoice.h"
#include "run/Tuning.h"
#include "start/VoxelMajority.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neuralmesh::binding
{
/// A run over a cloud in NumPy arrays, which stay where they are: what vtkNeuralMesh does with them.
class Run
{
public:
  /// What is to be done; numbers by the names of the properties of vtkNeuralMesh.
  struct Plan
  {
    nanobind::dict parameters;
    std::optional<nanobind::dict> ensemble; ///< of vtkNeuralMeshEnsemble
    std::optional<TriangleMesh> firstMesh;
    SizeGoal size; ///< if the parameters have no number of vertices, or it has a tolerance
    bool isAutomatic = false;
    bool explainsAll = false;
    double endOfMesh = 1.; ///< fraction of progress; what is left is for the data of points
    std::string checkpoint;
    double checkpointInterval = 60.;
    std::size_t snapshots = 0;
    std::vector<std::uint64_t> levels; ///< vertices of each; none: those of the parameters
    /// The first mesh is a surface, and the points are samples of it: what must be known of that, which may be nothing.
    std::optional<std::string> warningOfSurface;
    nanobind::object takeSnapshot;
    /// Called with what is said meanwhile, its kind first: "warning", "step" or "choice".
    nanobind::object tell;
  };

  /// Throws std::invalid_argument where no run can be made of the points.
  Run(std::vector<AnyArray> points, std::optional<ArrayOf<double>> weights, Sides sides,
    bool keepsOrigins, unsigned threads);

  /// Whether floats do not hold a mesh of so many vertices.
  bool needsDoubles(std::size_t vertices) const;

  /// Learns, unless the levels, the checkpoint or the first mesh do not go with it: then throws
  /// std::invalid_argument. Warnings are a list of texts.
  void learn(Plan plan, Call& call);

  /// The meshes of all levels but the last.
  std::size_t smallerLevels() const { return smaller_.size(); }
  /// Has what follows be about a level, from 0 on; at first it is the last one, as it is without levels.
  void show(std::size_t level) { shown_ = level; }

  nanobind::dict mesh(bool isDouble) const;
  nanobind::dict average(bool isDouble) const; ///< of an ensemble; empty if there is none
  /// Likewise: the share of the members that hold each voxel, the first voxel, and their width.
  nanobind::dict votes() const;
  nanobind::dict curve() const;
  nanobind::dict explained() const;
  /// Of the mesh, those sharper than an angle in degrees; empty if that was ended.
  nanobind::dict featureLines(
    double angle, bool isDouble, Call& call, double begin, double end) const;
  nanobind::dict times() const;
  std::vector<std::string> warnings() const;
  std::string stopReason() const;
  bool isComplete() const { return result_.isComplete(); }
  std::uint64_t resumedIterations() const { return result_.resumedIterations; }

  /// Finds where points lie on the mesh, for what follows. Returns whether it came to its end.
  bool findPlaces(Call& call, double begin, double end);
  /// Values of shape (N, K) at the vertices, fitted; NaN where points have none.
  nanobind::object fit(const ArrayOf<double>& values) const;
  /// Of the kind of each point, a number below that of the points: for each vertex the first point of the
  /// kind that most of its points have; 4294967295 where there is none.
  nanobind::object vote(const ArrayOf<std::uint32_t>& kinds) const;

private:
  void requirePointData(std::size_t rows) const;
  using Tell = std::function<void(const char* kind, const std::string& text)>;

  std::optional<Mesh> firstMeshOf(std::optional<TriangleMesh> triangles) const;
  double startFrom(const EnsembleParameters& ensemble, Parameters& parameters,
    CheckpointPlan& checkpoint, std::optional<Mesh>& first, const Tell& tell, Call& call);
  void warn(const std::vector<std::string>& texts, const Tell& tell);
  void tellWarnings(const Reconstruction& result, const std::string& of, const Tell& tell);
  const Reconstruction& shown() const
  {
    return shown_ < smaller_.size() ? smaller_[shown_] : result_;
  }

  std::vector<AnyArray> points_;
  Sides sides_;
  OrientationHints hints_;
  std::size_t pointCount_;
  ThreadPool executor_;
  PhaseTimes times_;
  std::optional<PointCloud> cloud_;
  std::vector<Reconstruction> smaller_; ///< levels
  Reconstruction result_;
  std::size_t shown_ = 0;
  std::optional<Tuning> tuning_;
  std::optional<VoxelVotes> votes_;
  std::optional<TriangleMesh> average_;
  std::vector<std::string> warnings_;
  std::vector<std::string> resultWarnings_;     ///< that meshes have
  std::vector<std::string> checkpointWarnings_; ///< of the run, and not of the mesh
  std::uint64_t seed_ = 0;
  std::optional<CloudPlaces> places_;
};
}
