// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/LearningCurve.h"
#include "learn/StoppingRules.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// Where a run leaves its state, so that another one can go on from there.
struct CheckpointPlan
{
  std::string path;      ///< of the file; empty: nowhere
  double interval = 60.; ///< seconds from one to the next
  /// Told once, in words, if the file cannot be written later on: learning goes on without.
  std::function<void(const std::string&)> warn = [](const std::string&) {};
  // A run that was cut short before it began, and so ends at once, goes on from its checkpoint all the
  // same.
  /// Not if the mesh to start from was cut short: it is not compared then.
  bool isStartWhole = true;
  /// Not if the choice of parameters was: those that tune() chooses are not compared then.
  bool areParametersChosen = true;
};

/// All that learning changes.
struct LearningState
{
  Learner& learner;
  StoppingRules& rules;
  LearningCurve& curve;
  StopReason reason = StopReason::None; ///< once learning is over

  void exchange(Archive& archive);
};

/// The checkpoint of a run: a file with the state of learning, in which the run that wrote it, or the
/// same one in another process, goes on to the same bytes as without a break. The same one is that of
/// the same points, weights, start and parameters, but for the time limit, by the same version of
/// the program. The file is replaced as a whole or not at all. One in which nothing is learnt is that
/// of any run: it says no more than that a run has not come to its end.
class Checkpoint
{
public:
  /// Throws std::runtime_error, with a message that names the file, if it cannot be written, or
  /// if one is there that is damaged or that of another run: then it says what differs.
  Checkpoint(CheckpointPlan plan, const PointCloud& cloud, const Parameters& parameters);

  /// Reads the file, if there is one, into a state in which nothing is learnt yet. Returns how many
  /// samples are learnt then. Throws as the constructor; that learning starts from another mesh does
  /// not count if the start was cut short, for then the run is to be ended at once.
  std::uint64_t resume(LearningState& state, bool isStartWhole);

  /// Writes the file if it is time to, or if learning has ended: to be called between batches. Not
  /// if nothing was learnt since the last time, but if learning has ended the file is there.
  void saveIfDue(LearningState& state);

private:
  using Clock = std::chrono::steady_clock;

  bool isOn() const { return !plan_.path.empty(); }
  void read(const std::function<void(Archive&)>& use) const;
  bool exchangeRun(Archive& archive, bool isLearnt) const;
  void write(LearningState& state);

  CheckpointPlan plan_;
  Parameters parameters_;
  std::vector<std::pair<std::string, std::uint64_t>> input_; ///< names and checksums
  std::uint64_t start_ = 0; ///< checksum of what learning starts from
  std::uint64_t savedIterations_ = 0;
  bool isThere_ = false;
  bool goesOn_ = false; ///< whether something is learnt in the file that was found
  bool hasWarned_ = false;
  Clock::time_point saveTime_ = Clock::now();
};
}
