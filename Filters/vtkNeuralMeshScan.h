// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshScan
 * @brief   simulates the point cloud of a scan of a surface
 *
 * vtkNeuralMeshScan draws points evenly over the area of a surface, as a scanner measures them: with
 * noise, outliers and holes. With Occlusion it leaves out what the scanner cannot see. Use it to try
 * vtkNeuralMesh on known shapes, and vtkNeuralMeshComparison to compare the result with them.
 *
 * @par Input
 * vtkPolyData. Polygons become fans of triangles, and strips become triangles. Triangles without area,
 * and those with a corner that is not finite, are left out. Coordinates may be large against the
 * extent, as in UTM.
 * An input without cells and points gives an empty output. Otherwise it is an error if no triangle
 * has an area, or a cell refers to a point that does not exist.
 *
 * @par Output
 * vtkPolyData with the points, of the precision of the input, in random order, and one cell of type
 * vtkPolyVertex with all of them. Lengths are fractions of the diagonal of the bounding box of the
 * triangles. The steps are, in this order: draw points, remove those out of sight, remove those in
 * holes, add noise, add outliers. Each step has its own random numbers: another noise, for example,
 * does not change which points are drawn.
 *
 * The same input and seed give the same bytes.
 *
 * @par Abort
 * SetAbortExecute(1), for example from an observer of ProgressEvent, ends the run and leaves the
 * output empty. The filter then clears the flag.
 *
 * A property out of its range is clamped, with a warning; NaN does not change it.
 *
 * @par Limits
 * It models no particular scanner: the density does not depend on the distance, noise is the same in
 * all directions, and there is no point data. For scans from several positions, append several.
 * vtkPolyDataPointSampler gives points without noise all over a surface, too.
 *
 * @sa vtkNeuralMesh vtkNeuralMeshComparison vtkPolyDataPointSampler
 */

#ifndef vtkNeuralMeshScan_h
#define vtkNeuralMeshScan_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkNeuralMeshSetClampMacro.h"
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshScan : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshScan* New();
  vtkTypeMacro(vtkNeuralMeshScan, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number of points drawn on the surface, before any are removed.
   * Default 200000, range 1 to 100000000.
   */
  vtkNeuralMeshSetClampMacro(NumberOfPoints, vtkIdType, 1, 100000000);
  vtkGetMacro(NumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * Seed of the random numbers. Default 1, at least 0.
   */
  vtkNeuralMeshSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Standard deviation of the Gaussian noise of each coordinate, as a fraction of the diagonal.
   * Default 0, range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(Noise, double, 0.0, 1.0);
  vtkGetMacro(Noise, double);
  ///@}

  ///@{
  /**
   * Outliers, as a fraction of the remaining points; they are spread evenly in the bounding box.
   * Default 0, range 0 to 10.
   */
  vtkNeuralMeshSetClampMacro(Outliers, double, 0.0, 10.0);
  vtkGetMacro(Outliers, double);
  ///@}

  ///@{
  /**
   * Number of holes: balls around random points, in which all points are removed.
   * Default 0, range 0 to 1000.
   */
  vtkNeuralMeshSetClampMacro(Holes, int, 0, 1000);
  vtkGetMacro(Holes, int);
  ///@}

  ///@{
  /**
   * Radius of the holes, as a fraction of the diagonal. Default 0.03, range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(HoleRadius, double, 0.0, 1.0);
  vtkGetMacro(HoleRadius, double);
  ///@}

  ///@{
  /**
   * Whether points that cannot be seen from Viewpoint are removed: those with a triangle in between,
   * of either orientation. Default off.
   */
  vtkNeuralMeshSetClampMacro(Occlusion, vtkTypeBool, 0, 1);
  vtkGetMacro(Occlusion, vtkTypeBool);
  vtkBooleanMacro(Occlusion, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Position of the scanner, with Occlusion, in coordinates of the input. It must be finite. Default
   * (0, 0, 0), from which a shape around the origin is seen from inside.
   */
  vtkSetVector3Macro(Viewpoint, double);
  vtkGetVector3Macro(Viewpoint, double);
  ///@}

protected:
  vtkNeuralMeshScan();
  ~vtkNeuralMeshScan() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshScan(const vtkNeuralMeshScan&) = delete;
  void operator=(const vtkNeuralMeshScan&) = delete;

  vtkIdType NumberOfPoints = 200000;
  int Seed = 1;
  double Noise = 0.0;
  double Outliers = 0.0;
  int Holes = 0;
  double HoleRadius = 0.03;
  vtkTypeBool Occlusion = 0;
  double Viewpoint[3] = { 0.0, 0.0, 0.0 };
};

#endif
