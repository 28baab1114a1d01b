// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "learn/Parameters.h"
#include "mesh/Mesh.h"
#include "run/Ensemble.h"
#include "run/EnsembleParameters.h"
#include "start/VoxelMajority.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace neuralmesh
{
/// The communication of processes that share the members of an ensemble. All of them make the same
/// calls with as many numbers. This class is for a single process.
class EnsembleProcesses
{
public:
  EnsembleProcesses() = default;
  EnsembleProcesses(const EnsembleProcesses&) = delete;
  EnsembleProcesses& operator=(const EnsembleProcesses&) = delete;
  virtual ~EnsembleProcesses() = default;

  virtual EnsembleShare share() const { return {}; }
  /// Replaces each number by the largest, or by the sum, of the numbers of all processes in its
  /// place.
  virtual void findLargest(std::span<int> /*numbers*/) const {}
  virtual void addUp(std::span<double> /*numbers*/) const {}
  virtual void addUp(std::span<std::uint8_t> /*numbers*/) const {}
};

/// The steps of Algorithm 5.
enum class EnsembleStep
{
  Population,
  Averaging,
  Refinement
};

/// "Learning the members", "Averaging", "Refining".
std::string_view name(EnsembleStep step);

/// The results of the first two steps of Algorithm 5, with which the third one begins.
struct EnsembleStart
{
  /// The votes of all members; nothing if there was no time for all of them, or `progress` ended
  /// the run.
  std::optional<VoxelVotes> votes;
  /// The average mesh; without votes, the first member as it is. Nothing if the members agree on
  /// too little, or if another process makes the average: then learning starts as the parameters
  /// say.
  std::optional<Mesh> mesh;
  std::string warning;      ///< a sentence, if the members do not agree well; else empty
  bool isCancelled = false; ///< whether the progress of any process ended the run
  double timeLimit = 0.;    ///< seconds that are left for the refinement; 0: no limit
  double end = 0.;          ///< end of these steps, as a fraction of the whole run

  bool isAverage() const { return votes && mesh; }
};

/// Learns the members of an ensemble at the same time, and averages them. `refinement` are the
/// parameters of the third step; their time limit holds for all three steps. `progress` is that of
/// the whole run. `enter` is called when a step begins. Both are called on the calling thread only.
/// The result has the same bytes with any executor and any number of processes, unless the time
/// limit or `progress` ends the run. Only the process with index 0 makes the average.
EnsembleStart startByEnsemble(const PointCloud& cloud, const EnsembleParameters& parameters,
  const Parameters& refinement, const Progress& progress,
  const std::function<void(EnsembleStep)>& enter, const Executor& executor = Executor::sequential(),
  const EnsembleProcesses& processes = EnsembleProcesses());
}
