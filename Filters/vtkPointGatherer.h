// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointGatherer
 * @brief   points and their data, moved from all processes to process 0, and back
 *
 * Internal to the module. Each function is to be called by all processes, in the same order.
 */

#ifndef vtkPointGatherer_h
#define vtkPointGatherer_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkAbstractArray;
class vtkDataArray;
class vtkMultiProcessController;
class vtkPolyData;

class vtkPointGatherer
{
public:
  explicit vtkPointGatherer(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  /**
   * Leaves those point arrays in the part of each process that the parts of all processes that have
   * points have with the same name, type and number of components, in the order of the first.
   */
  void AgreeOnArrays(vtkPolyData* part, bool hasPoints);

  /** On process 0 the part becomes that of all processes, in their order. Arrays must agree. */
  void GatherPoints(vtkPolyData* part);

  /** On all processes the part becomes that of process 0, with only this one of its arrays. */
  void HandOut(vtkPolyData* part, vtkDataArray* array);

  /**
   * On process 0, the surface of the pieces of all processes, joined where points of several pieces
   * coincide; null elsewhere.
   */
  vtkSmartPointer<vtkPolyData> GatherSurface(vtkPolyData* piece);

  /** What this process has sent so far. */
  vtkIdType GetSentBytes() const { return this->SentBytes; }

private:
  bool IsRoot() const;
  void GatherArray(vtkAbstractArray* array, const std::vector<vtkIdType>& counts);
  void HandOutArray(vtkDataArray* array);
  void Send(vtkAbstractArray* batch);
  void Receive(vtkAbstractArray* batch, vtkIdType count, int process);

  vtkMultiProcessController* Controller;
  vtkIdType SentBytes = 0;
};

#endif
