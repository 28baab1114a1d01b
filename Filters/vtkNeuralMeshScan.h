// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshScan
 * @brief   the point cloud that a scan of a surface might give
 *
 * vtkNeuralMeshScan draws points evenly over the area of a surface, as a scanner might measure them:
 * with noise and outliers, with holes, and, if Occlusion is on, without what cannot be seen from
 * where the scanner stands. To try vtkNeuralMesh on shapes that are known, and to compare the result
 * with them by vtkNeuralMeshComparison.
 *
 * @par Input
 * vtkPolyData. Polygons are taken as fans of triangles, strips taken apart. Triangles without area,
 * and those with a corner that is not finite, are left out. Coordinates may be large against the
 * extent (UTM, say).
 * An input without cells and points gives an empty output. It is an error if otherwise no triangle
 * has an area, or a cell refers to a point that is not there.
 *
 * @par Output
 * vtkPolyData with the points, of the precision of the input, in random order, and one cell of type
 * vtkPolyVertex with all of them. Lengths are told as fractions of the diagonal of the bounding box
 * of the triangles. In this order: points are drawn, those out of sight are taken away, then those
 * in holes; noise is added to what is left, and outliers come to it. Each step has random numbers of
 * its own: with another noise, say, the points underneath are the same.
 *
 * The same input and seed give the same bytes.
 *
 * @par Abort
 * SetAbortExecute(1), from an observer of ProgressEvent, say, ends the run and leaves the output
 * empty. The flag is cleared when it has been obeyed.
 *
 * A property out of its range is clamped, with a warning; NaN leaves it as it is.
 *
 * @par What it does not do
 * It is no model of a certain scanner: points are as dense far from it as near, noise is the same in
 * all directions, and there is no point data. For scans from several places append several.
 * Points without noise, all over a surface, are given by vtkPolyDataPointSampler, too.
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
   * How many points are drawn on the surface, before any are taken away.
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
   * Outliers, as a fraction of the points that are left; they are spread evenly in the bounding box.
   * Default 0, range 0 to 10.
   */
  vtkNeuralMeshSetClampMacro(Outliers, double, 0.0, 10.0);
  vtkGetMacro(Outliers, double);
  ///@}

  ///@{
  /**
   * The number of holes: balls around random points, in which all points are taken away.
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
   * Whether points are taken away that cannot be seen from Viewpoint: those with a triangle in
   * between, whichever way it is oriented. Default off.
   */
  vtkNeuralMeshSetClampMacro(Occlusion, vtkTypeBool, 0, 1);
  vtkGetMacro(Occlusion, vtkTypeBool);
  vtkBooleanMacro(Occlusion, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Where the scanner stands, with Occlusion, in coordinates of the input. It is an error if it is
   * not finite then. Default (0, 0, 0), from where a shape around the origin is seen from inside.
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
