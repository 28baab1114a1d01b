// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshInformation
 * @brief   checks whether a mesh is sound, and how good its triangles are
 *
 * vtkNeuralMeshInformation passes a mesh through and adds the report of `neuralmesh info` to its field
 * data. Any program may have made the mesh. vtkNeuralMeshComparison measures the distance to a reference.
 *
 * @par Input
 * vtkPolyData of any quality. Polygons become fans of triangles, and strips become triangles; lines and
 * vertices are left out. Without cells and points the report has zeros. It is an error if a cell refers to
 * a point that does not exist: then the output is empty.
 *
 * @par Output
 * The input, with all its data, and the field data, one value each unless noted:
 * - `Vertices`, points that triangles use, and `Triangles`;
 * - `RegularRatio` (double, 0 to 1): the share of the vertices with valence 6, or 4 on the boundary;
 * - `Valences` (2 components): a valence, and how many vertices have it;
 * - `TriangleQuality` (double): the mean of twice the radius of the inscribed over that of the circumscribed
 *   circle, 1 for an equilateral triangle, 0 for one without area;
 * - `Closed`, `EdgeManifold`, `VertexManifold`, `Oriented` (unsigned char, 1 or 0); without triangles
 *   `Closed` is 0;
 * - `Components`, pieces that edges hold together; `Genus`, the handles of all of them, with the holes taken
 *   as capped; `BoundaryLoops`;
 * - `BoundaryEdges`, of one triangle; `FoldedEdges`, where the surface turns by more than 150 degrees;
 *   `NonManifoldEdges`, `NonManifoldVertices`, `InconsistentEdges`: the counterexamples of the flags above;
 * - `SurfaceArea`, `Volume`, `BoundingBoxDiagonal` (double) in units of the input; the volume is positive if
 *   the normals point outwards;
 * - `DegenerateTriangles`, without area; `UnusedPoints`; `NonFinitePoints`.
 *
 * `Genus` is missing if the mesh is not manifold or cannot be oriented, `Volume` if it is not closed or not
 * oriented. Field data of these names in the input is replaced.
 *
 * @sa vtkNeuralMeshComparison vtkNeuralMesh vtkMeshQuality
 */

#ifndef vtkNeuralMeshInformation_h
#define vtkNeuralMeshInformation_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshInformation : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshInformation* New();
  vtkTypeMacro(vtkNeuralMeshInformation, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkNeuralMeshInformation();
  ~vtkNeuralMeshInformation() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshInformation(const vtkNeuralMeshInformation&) = delete;
  void operator=(const vtkNeuralMeshInformation&) = delete;
};

#endif
