// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/Learner.h"

#include <vector>

namespace neuralmesh
{
/// How a run went: what was so at a number of moments.
class LearningCurve
{
public:
  struct Row
  {
    RunCounts counts;
    std::size_t vertices = 0;
    double seconds = 0.;            ///< since the start of the run
    double sampleDistanceMean = 0.; ///< of |s - v_w| over the window, in units of the input
    double sampleDistanceDeviation = 0.;
    double normalChangeMean = 0.; ///< M_delta of (8.2)
    double regularRatio = 0.;     ///< vertices of valence 6, on a boundary 4

    template <typename Archive>
    void exchange(Archive& archive)
    {
      archive(counts, vertices, seconds, sampleDistanceMean);
      archive(sampleDistanceDeviation, normalChangeMean, regularRatio);
    }
  };

  /// Whether it is time for a row: each comes a twentieth later than the one before, so that all
  /// together cost no more than a few passes over the final mesh.
  bool isRowDue(const Learner& learner) const;
  /// Adds a row, unless the last one is of this iteration.
  void add(const Learner& learner, double unit, double seconds);

  /// The last row tells of what became of the mesh that was learnt, if it was simplified.
  void endWith(const Mesh& simplified);

  const std::vector<Row>& rows() const { return rows_; }

  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(rows_);
  }

private:
  std::vector<Row> rows_;
};
}
