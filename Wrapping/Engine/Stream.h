// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Arrays.h"
#include "Call.h"
#include "Sides.h"

#include "run/StreamingReconstruction.h"

#include <cstdint>

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

  const StreamingReconstruction& engine() const { return engine_; }

private:
  StreamingReconstruction engine_;
};
}
