// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDistributedRun
 * @brief   what vtkPNeuralMesh and vtkPNeuralMeshEnsemble share: one run on all processes
 *
 * Internal to the module. Selects points of the cloud, of which each process has a part, moves them
 * to process 0 and has that learn, while the others wait, hear of its progress and may abort it.
 */

#ifndef vtkDistributedRun_h
#define vtkDistributedRun_h

#include "vtkNew.h"
#include "vtkPointCloudCollector.h"
#include "vtkPointGatherer.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <functional>
#include <vector>

class vtkDummyController;
class vtkInformationVector;
class vtkMultiProcessController;
class vtkNeuralMesh;
class vtkPolyData;

class vtkDistributedRun
{
public:
  /** Finds the weights of points; false if they are not there. */
  using WeightsFunction =
    std::function<bool(const vtkPointCloudCollector& collector, std::vector<double>& weights)>;
  /** Executes the filter with these inputs on this process alone; 0 if that fails. */
  using LearnFunction = std::function<int(vtkInformationVector** inputVector)>;

  /** Takes about `maximumPoints` points; 0 for as many as the vertices need. */
  vtkDistributedRun(
    vtkNeuralMesh* filter, vtkMultiProcessController* controller, vtkIdType maximumPoints);
  ~vtkDistributedRun();

  /** To be called by all processes. Returns what RequestData() returns, the same on all. */
  int Execute(vtkInformationVector** inputVector, const WeightsFunction& collectWeights,
    const LearnFunction& learn);

  /** The stop reason of process 0, on all processes. */
  const char* ShareStopReason(const char* reason);

  /** What other processes have sent to this one, if it is process 0: points and their data. */
  vtkIdType GetMovedBytes() const { return this->MovedBytes; }
  vtkMultiProcessController* GetController() const { return this->Controller; }

private:
  /** What is to be known of the parts, as numbers that are added up. */
  struct Census;

  bool IsRoot() const;
  void Count(const std::vector<double>& weights, Census& census);
  bool IsUsable(std::size_t point, const std::vector<double>& weights) const;
  vtkSmartPointer<vtkPolyData> MakePart(
    const std::vector<std::size_t>& points, bool hasWeights, bool areDouble) const;
  bool HasPoints(const Census& census) const;
  int Lead(const Census& census, vtkInformationVector** inputVector, const LearnFunction& learn);
  int Follow(vtkInformationVector** inputVector, const LearnFunction& learn);
  void TellProgress();

  vtkNeuralMesh* Filter;
  vtkNew<vtkDummyController> Alone;
  vtkMultiProcessController* Controller;
  vtkIdType MaximumPoints;
  vtkPointGatherer Gatherer;
  vtkPointCloudCollector Collector;
  vtkIdType MovedBytes = 0;
};

#endif
