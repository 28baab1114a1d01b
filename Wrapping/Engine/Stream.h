// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Arrays.h"
#include "Call.h"
#include "Sides.h"

#include "run/StreamingReconstruction.h"

#include <cstdint>
#include <mutex>

namespace neuralmesh::binding
{
/// A mesh that is learnt while points arrive: what vtkNeuralMeshStream does.
class Stream
{
public:
  Stream(const Parameters& parameters, std::size_t reservoirSize);

  void addPoints(const std::vector<AnyArray>& points, const Sides& sides);
  std::uint64_t learn(std::uint64_t samples, Call& call);
  std::uint64_t learnForSeconds(double seconds, Call& call);
  /// Points, triangles, data and warnings; empty as long as there is no mesh. Viewpoints and up
  /// direction are what is known now.
  nanobind::dict mesh(bool isFinished, const Sides& sides, Call& call) const;

  /// What `use` tells of the stream as it is.
  template <typename Use>
  auto look(const Use& use) const
  {
    const nanobind::gil_scoped_release unlocked;
    const std::lock_guard alone(mutex_);
    return use(engine_);
  }

private:
  StreamingReconstruction engine_;
  /// Several threads of Python may call at a time, and a function of progress may look. It is locked without
  /// Python's own lock.
  mutable std::recursive_mutex mutex_;
};
}
