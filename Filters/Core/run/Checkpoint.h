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
/// Where and how often a run saves its state, so that another run can continue it.
struct CheckpointPlan
{
  std::string path;      ///< of the file; empty: no checkpoint
  double interval = 60.; ///< seconds between two checkpoints
  /// Called once with a sentence if the file cannot be written later on. Learning continues without
  /// checkpoints.
  std::function<void(const std::string&)> warn = [](const std::string&) {};
  // A run that is ended before it begins still continues its checkpoint, and ends at once. Then its
  // start is incomplete and is not compared with that of the file.
  /// False if `progress` ended the making of the mesh from which learning starts.
  bool isStartWhole = true;
  /// False if `progress` ended the choice of parameters by tune().
  bool areParametersChosen = true;
};

/// The state that learning changes.
struct LearningState
{
  Learner& learner;
  StoppingRules& rules;
  LearningCurve& curve;
  StopReason reason = StopReason::None; ///< once learning is over

  void exchange(Archive& archive);
};

/// The checkpoint of a run: a file with the state of learning. The same run, in this or another
/// process, continues from it to the same bytes as without a break. A run is the same if it has the
/// same points, weights, start and parameters except the time limit, and the same version of the
/// program. The file is replaced as a whole or not at all. A file in which nothing is learnt
/// belongs to any run: it only shows that a run has not ended.
class Checkpoint
{
public:
  /// Throws std::runtime_error, with a message that names the file, if the file cannot be written,
  /// is damaged, or belongs to another run. In the last case the message says what differs.
  Checkpoint(CheckpointPlan plan, const PointCloud& cloud, const Parameters& parameters);

  /// Reads the file, if there is one, into a state in which nothing is learnt yet. Returns the
  /// number of learnt samples. Throws like the constructor. The mesh from which learning starts is
  /// not compared if `isStartWhole` is false, as the run then ends at once.
  std::uint64_t resume(LearningState& state, bool isStartWhole);

  /// Writes the file if the interval has passed or learning has ended. Call it between batches.
  /// Writes nothing if no sample was learnt since the last time, unless learning has ended and
  /// there is no file.
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
  std::uint64_t start_ = 0; ///< checksum of the mesh from which learning starts
  std::uint64_t savedIterations_ = 0;
  bool isThere_ = false;
  bool goesOn_ = false; ///< whether the file that was found has learnt something
  bool hasWarned_ = false;
  Clock::time_point saveTime_ = Clock::now();
};
}
