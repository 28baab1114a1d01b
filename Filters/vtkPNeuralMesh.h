// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPNeuralMesh
 * @brief   one triangle mesh from a point cloud that is distributed over processes
 *
 * vtkPNeuralMesh is vtkNeuralMesh for a distributed cloud: each process of the Controller has a part, as
 * in pvserver and pvbatch under MPI. Learning needs only samples: points move once, and at most about
 * MaximumPoints of them. Process 0 learns and has the mesh; the outputs of other processes are empty.
 * See Documentation/Guide/Large.md.
 *
 * @par Selection
 * If the cloud has more than MaximumPoints points, a random number selects each point. It depends
 * only on Seed and the coordinates, so that all points have the same chance. Points at the same place
 * are selected together, but at most 1000 of them. Process 0 sorts the points by these numbers, and
 * points at the same place by the bytes of their point data. So the same cloud and seed give the same
 * mesh, byte for byte, with any number of processes, any distribution of the cloud, and any order of
 * the points. It is also the mesh of vtkNeuralMesh if all points are taken, there are no weights, and
 * no two points are closer together than a 65536th of the extent; otherwise sums have another order.
 *
 * @par Processes
 * All processes must execute the filter, with the same properties. A process may have no points, and
 * then no data arrays. Point data that all parts with points have is carried over, see
 * CarryPointData. The weights must have the same type on all processes, and all must have the normals
 * of SetNormalArrayName(). The first mesh may be on one process, or in pieces on all, which are joined
 * where points coincide. An error on one process ends the run on all, with a message on each.
 * SetAbortExecute(1) on any process, for example from an observer of ProgressEvent, ends the run on
 * all, and the mesh learnt so far is on process 0. The selection of points is not interrupted.
 * DroppedPoints has all points that are not finite, but only those selected of the ones too far off
 * or of many at one place.
 *
 * With one process it does the same without communication.
 *
 * @sa vtkNeuralMesh vtkPNeuralMeshEnsemble vtkMultiProcessController
 */

#ifndef vtkPNeuralMesh_h
#define vtkPNeuralMesh_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMesh.h"

class vtkMultiProcessController;

class VTKFILTERSNEURALMESH_EXPORT vtkPNeuralMesh : public vtkNeuralMesh
{
public:
  static vtkPNeuralMesh* New();
  vtkTypeMacro(vtkPNeuralMesh, vtkNeuralMesh)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The processes. Default vtkMultiProcessController::GetGlobalController(); null for this process
   * alone.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * Number of bytes of points and point data that the other processes sent to process 0 in the last
   * run; known there, 0 elsewhere.
   */
  vtkIdType GetMovedBytes() const { return this->MovedBytes; }

protected:
  vtkPNeuralMesh();
  ~vtkPNeuralMesh() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPNeuralMesh(const vtkPNeuralMesh&) = delete;
  void operator=(const vtkPNeuralMesh&) = delete;

  vtkMultiProcessController* Controller = nullptr;
  vtkIdType MovedBytes = 0;
};

#endif
