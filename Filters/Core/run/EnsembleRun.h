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
/// What processes that share the members of an ensemble tell each other. All of them make the same calls, with
/// as many numbers. This one is alone.
class EnsembleProcesses
{
public:
  EnsembleProcesses() = default;
  EnsembleProcesses(const EnsembleProcesses&) = delete;
  EnsembleProcesses& operator=(const EnsembleProcesses&) = delete;
  virtual ~EnsembleProcesses() = default;

  virtual EnsembleShare share() const { return {}; }
  /// Each number becomes the largest, or the sum, of those that the processes have in its place.
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

/// The first two steps of Algorithm 5, and what the third begins with.
struct EnsembleStart
{
  /// Of all members; nothing if there was no time for all of them, or it was ended.
  std::optional<VoxelVotes> votes;
  /// The average mesh; without votes the first member as far as it has come; nothing if the members agree on
  /// too little, or this process helps another one: learning starts as parameters say.
  std::optional<Mesh> mesh;
  std::string warning;      ///< a sentence, if the members do not agree well; else empty
  bool isCancelled = false; ///< by the progress of whatever process
  double timeLimit = 0.;    ///< what is left of it for the refinement, in seconds; 0: there is none
  double end = 0.;          ///< of these steps, as a fraction of the whole run

  bool isAverage() const { return votes && mesh; }
};

/// Learns the members of an ensemble beside each other, and averages them. `refinement` are the parameters of
/// the third step, whose time limit holds for all three. Progress is that of the whole run; it
/// and `enter`, which is told of each step as it begins, are called on the calling thread alone. The same bytes, whatever
/// the executor and however the processes share the members, unless the time limit is met or it is ended.
/// Only the process with index 0 makes the average.
EnsembleStart startByEnsemble(const PointCloud& cloud, const EnsembleParameters& parameters,
  const Parameters& refinement, const Progress& progress,
  const std::function<void(EnsembleStep)>& enter, const Executor& executor = Executor::sequential(),
  const EnsembleProcesses& processes = EnsembleProcesses());
}
