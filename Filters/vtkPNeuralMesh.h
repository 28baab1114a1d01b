// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPNeuralMesh
 * @brief   one triangle mesh from a point cloud that lies on many processes
 *
 * vtkPNeuralMesh is vtkNeuralMesh for a cloud of which each process of the Controller has a part, as
 * in pvserver and pvbatch under MPI. Learning needs samples, never the whole cloud: points move only
 * once, and no more than MaximumPoints or so, however large the cloud is. Process 0 learns; the mesh
 * is on process 0, and the outputs of the others are empty. Documentation/Cluster.md tells how it is
 * run, and what is moved.
 *
 * @par Selection
 * Of a cloud of more than MaximumPoints points each is taken or not by a random number that follows
 * from Seed and its coordinates alone, so that each has the same chance. Points on the same spot are
 * taken together, but 1000 of them at most. On process 0 they are brought into the order of these
 * numbers; points on the same spot into that of the bytes of their point data. So the same cloud and
 * seed give the same mesh to the byte on any number of processes, however the cloud is divided and
 * in whatever order the points are. The mesh is that of vtkNeuralMesh, too, if all points are taken,
 * there are no weights, and no two points are closer together than a 65536th of the extent; else
 * sums have another order.
 *
 * @par Processes
 * All processes must execute the filter, with the same properties. A process may have no points, or
 * no data arrays then. Point data arrives that all parts with points have, see CarryPointData; the
 * weights must have one type on all, and normals that are named must be on all. The first mesh may
 * lie on one process, or on all in pieces, which are joined where points coincide. An error on one
 * process ends the run on all, with a message on each. SetAbortExecute(1) on any process, from an
 * observer of ProgressEvent, say, ends the run on all, and the mesh learnt so far is on process 0;
 * selecting the points is not cut. Points that are not finite, wherever they are, are among
 * DroppedPoints; of those too far off only the ones that were selected.
 *
 * With one process it is what has been said, without any communication.
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
   * How many bytes of points and point data the other processes sent to process 0 in the last run;
   * known there, 0 elsewhere.
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
