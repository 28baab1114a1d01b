// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDistributedRun
 * @brief   what vtkPNeuralMesh and vtkPNeuralMeshEnsemble share: one run on all processes
 *
 * Internal to the module. Each process has a part of the cloud. The class selects points, moves
 * them to process 0 and starts learning there. The other processes wait, receive its progress and
 * may abort it.
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

class vtkDataArray;
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

  /** What the other processes do while process 0 learns. */
  enum class Others
  {
    Wait,
    Help ///< by `learn` with the points of process 0, before they wait
  };

  /** Takes about as many points as the filter is to use. */
  vtkDistributedRun(
    vtkNeuralMesh* filter, vtkMultiProcessController* controller, Others others = Others::Wait);
  ~vtkDistributedRun();

  /** To be called by all processes. Returns what RequestData() returns, the same on all. */
  int Execute(vtkInformationVector** inputVector, const WeightsFunction& collectWeights,
    const LearnFunction& learn);

  /** Whether this process learns, and the others help or wait. */
  bool IsRoot() const;
  /** While all processes learn, they look after progress and aborts by themselves. */
  void SetAllLearn(bool allLearn) { this->AllLearn = allLearn; }

  /** The stop reason of process 0, on all processes. */
  const char* ShareStopReason(const char* reason);

  /** What all processes have sent to each other, if this is process 0: points and their data. */
  vtkIdType GetMovedBytes() const { return this->MovedBytes; }
  vtkMultiProcessController* GetController() const { return this->Controller; }

private:
  /** Properties of the parts, as numbers that are added up. */
  struct Census;

  void Count(const std::vector<double>& weights, Census& census);
  bool IsUsable(std::size_t point, const std::vector<double>& weights) const;
  vtkSmartPointer<vtkPolyData> MakePart(
    const std::vector<std::size_t>& points, bool hasWeights, bool areDouble) const;
  vtkDataArray* WeightsOf(vtkPolyData* part) const;
  bool HasPoints(const Census& census) const;
  int Lead(const Census& census, vtkInformationVector** inputVector, const LearnFunction& learn);
  int Follow(vtkInformationVector** inputVector, const LearnFunction& learn);
  void TellProgress();

  vtkNeuralMesh* Filter;
  vtkNew<vtkDummyController> Alone;
  vtkMultiProcessController* Controller;
  Others OfOthers;
  bool AllLearn = false;
  vtkPointGatherer Gatherer;
  vtkPointCloudCollector Collector;
  vtkIdType MovedBytes = 0;
};

#endif
