// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshRun
 * @brief   what vtkNeuralMesh and its subclasses share while they execute
 *
 * Internal to the module.
 */

#ifndef vtkNeuralMeshRun_h
#define vtkNeuralMeshRun_h

#include "base/Executor.h"
#include "base/Progress.h"
#include "base/ProgressThrottle.h"
#include "cloud/OrientationHints.h"
#include "cloud/PointCloud.h"
#include "learn/Parameters.h"
#include "mesh/Mesh.h"
#include "run/SizeChoice.h"
#include "run/Tuning.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;

/** How many threads a property NumberOfThreads stands for: with 0 as many as the process may run
 * at once, VTK_SMP_MAX_THREADS at most. */
unsigned vtkNeuralMeshThreads(int wanted);

/// Reports the progress of a filter, not too often, and asks whether to go on.
class vtkNeuralMeshProgress
{
public:
  explicit vtkNeuralMeshProgress(vtkAlgorithm* filter)
    : Filter(filter)
  {
  }

  /** From now on, fractions count within this part of the whole. */
  void EnterPart(double begin, double end);
  /** How much of the part is done, 0 to 1. Returns false if the filter is to abort. */
  bool Report(double fraction);
  /** What the core reports to within this part of the whole; not to be kept longer than this object. */
  neuralmesh::Progress GetPart(double begin, double end);
  /** Has the filter abort, as another process does. */
  void Abort();
  /** Since the start. */
  double GetSeconds() const;

private:
  using Clock = std::chrono::steady_clock;

  vtkAlgorithm* Filter;
  double Begin = 0.0;
  double End = 1.0;
  neuralmesh::ProgressThrottle Throttle;
  Clock::time_point Start = Clock::now();
};

struct vtkNeuralMeshRun
{
  const neuralmesh::PointCloud& Cloud;
  neuralmesh::Parameters Parameters;
  int PointsPrecision; ///< of the output
  vtkNeuralMeshProgress Progress;
  std::optional<neuralmesh::Mesh> FirstMesh;
  const neuralmesh::Executor& Executor;
  std::optional<neuralmesh::Tuning> Tuning; ///< if parameters were chosen
  double EndOfMesh; ///< as a fraction of the run; then arrays are carried over
  neuralmesh::OrientationHints Hints;
  std::vector<std::string> Warnings{}; ///< that the filter has given
  bool IsStartWhole = true;            ///< not if making the first mesh was cut short
  /// If the number of vertices is to be found.
  std::optional<neuralmesh::SizeGoal> SizeGoal{};
};

#endif
