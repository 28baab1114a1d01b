// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPNeuralMeshEnsemble
 * @brief   one mesh by an ensemble, from a point cloud that is distributed over processes
 *
 * vtkPNeuralMeshEnsemble is vtkNeuralMeshEnsemble for a distributed cloud, as vtkPNeuralMesh is
 * vtkNeuralMesh for one: see there. The processes share the members: each gets the selected points and
 * learns its members on its threads, and the votes are added up. Process 0 refines. The votes are on
 * all processes, the average mesh is on process 0.
 *
 * @sa vtkNeuralMeshEnsemble vtkPNeuralMesh vtkMultiProcessController
 */

#ifndef vtkPNeuralMeshEnsemble_h
#define vtkPNeuralMeshEnsemble_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshEnsemble.h"

class vtkDistributedRun;
class vtkMultiProcessController;

class VTKFILTERSNEURALMESH_EXPORT vtkPNeuralMeshEnsemble : public vtkNeuralMeshEnsemble
{
public:
  static vtkPNeuralMeshEnsemble* New();
  vtkTypeMacro(vtkPNeuralMeshEnsemble, vtkNeuralMeshEnsemble)
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
   * Number of bytes sent in the last run: of points and point data to process 0, and of points and
   * weights from there to the others; known there, 0 elsewhere.
   */
  vtkIdType GetMovedBytes() const { return this->MovedBytes; }

protected:
  vtkPNeuralMeshEnsemble();
  ~vtkPNeuralMeshEnsemble() override;

  vtkMultiProcessController* GetMemberController() override { return this->Controller; }
  bool IsHelper() const override;
  void PrepareRun(vtkNeuralMeshRun& run, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPNeuralMeshEnsemble(const vtkPNeuralMeshEnsemble&) = delete;
  void operator=(const vtkPNeuralMeshEnsemble&) = delete;

  vtkMultiProcessController* Controller = nullptr;
  vtkDistributedRun* Run = nullptr; ///< while it executes
  vtkIdType MovedBytes = 0;
};

#endif
