// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshExplanation
 * @brief   distance from a mesh for each point of a cloud, and the reason why it is left out
 *
 * vtkNeuralMeshExplanation shows which points of a cloud a triangle mesh leaves out. Any program may
 * have made the mesh. A point is *away* from the mesh if its distance exceeds two limits: three times
 * its mean distance to its six nearest neighbours, and eight times the median distance of all points.
 *
 * @par Input
 * Port 0: the cloud, as that of vtkNeuralMesh. Port 1: a vtkPolyData with polygons or strips, in the
 * coordinates of the cloud; polygons become fans of triangles. It may be no manifold. It is an error
 * if it has no triangle with an area, if the cloud has no finite point, or if all points coincide.
 *
 * @par Output
 * vtkPolyData with the points of the cloud, in the order of its blocks, without ghost and blanked
 * ones, as one cell, and the point data
 * - `Distance` (double): to the mesh, in units of the input; NaN where Reason is 4;
 * - `Reason` (unsigned char), the scalars, with these values:
 *   - 0, explained: not away;
 *   - 1, outlier: away, and three times as far from its neighbours as these are from theirs, or
 *     farther than usual and in no layer with them;
 *   - 2, small piece: away, with less than the part SmallestPiece of all points;
 *   - 3, unreachable: away, with as many points or more;
 *   - 4, dropped: NaN, infinite, farther from the bulk of the cloud than 10^6 times its size, or at
 *     one place with more than 100 others, see vtkNeuralMesh.
 *
 * Points that are away form one piece if they are closer than two mean edges of the mesh, or two and a
 * half of their distances to their neighbours.
 *
 * Field data: `ReasonNames` (strings, by the number of the reason); the counts `OutlierPoints`,
 * `SmallPiecePoints`, `UnreachablePoints`, and `UnexplainedPoints`, the sum of the last two;
 * `UnexplainedShare` (double, 0 to 1: of all points that were not dropped). For the unreachable
 * pieces, the largest first: `MissedPieceCenters` (double, 3 components) and `MissedPiecePoints`.
 *
 * An abort leaves the output empty.
 *
 * @sa vtkNeuralMesh vtkNeuralMeshComparison
 */

#ifndef vtkNeuralMeshExplanation_h
#define vtkNeuralMeshExplanation_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkNeuralMeshSetClampMacro.h"
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshExplanation : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshExplanation* New();
  vtkTypeMacro(vtkNeuralMeshExplanation, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Input port 1. */
  void SetMeshConnection(vtkAlgorithmOutput* port);
  void SetMeshData(vtkPolyData* mesh);
  vtkPolyData* GetMesh();
  ///@}

  ///@{
  /**
   * Part of all points below which points that are away are a small piece. Default 0.0005; 0 to 1,
   * clamped with a warning.
   */
  vtkNeuralMeshSetClampMacro(SmallestPiece, double, 0.0, 1.0);
  vtkGetMacro(SmallestPiece, double);
  ///@}

protected:
  vtkNeuralMeshExplanation();
  ~vtkNeuralMeshExplanation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshExplanation(const vtkNeuralMeshExplanation&) = delete;
  void operator=(const vtkNeuralMeshExplanation&) = delete;

  double SmallestPiece = 0.0005;
};

#endif
