// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshComparison
 * @brief   how far a mesh is from a reference, over the surfaces and both ways
 *
 * vtkNeuralMeshComparison draws points evenly over the area of two surfaces and measures the
 * distance of each to the nearest point of the other surface. For each direction it gives mean,
 * root mean square, 99 % and maximum. Distances from the result to the reference show what is
 * superfluous in the result. Those from the reference to the result show what it misses. Both
 * directions together give the usual measures: Chamfer distance, F-score, normal consistency,
 * Hausdorff distance, and the distance between the sharp edges.
 * vtkHausdorffDistancePointSetFilter measures at vertices only: its figures depend on the spacing of
 * the vertices, and it misses what a large triangle cuts off.
 *
 * @par Input
 * Port 0: the result; port 1: the reference; vtkPolyData both. Polygons become fans of triangles,
 * and strips become triangles. Triangles without area, and those with a corner that is not finite,
 * are left out. Coordinates may be large against the extent, as in UTM, and of any unit.
 * Two inputs without cells and points give empty outputs. Otherwise it is an error if one of them
 * has no triangle with an area, or a cell refers to a point that does not exist.
 *
 * @par Output
 * Port 0: the result, port 1: the reference, each with the point data `Distance` (double), the
 * distance of each point to the nearest point of the other surface, in units of the input, as the
 * active scalars; NaN for points that are not finite. Port 2: a vtkTable of the figures with a row
 * for each direction, the columns being
 * - `Direction`: "reference to result", "result to reference";
 * - `Mean`, `RMS`, `Percentile99`, `Maximum` in units of the input;
 * - `MeanPercent`, `RMSPercent`, `Percentile99Percent`, `MaximumPercent`, in percent of the
 *   diagonal of the bounding box of the reference;
 * - `NormalAngle`, in degrees; `NormalConsistency`, 0 to 1;
 * - `EdgeMean`, `EdgeToSurface`, `EdgeLength` in units of the input, and `EdgeMeanPercent`,
 *   `EdgeToSurfacePercent`: of the sharp edges.
 *
 * Values of both directions together are field data of that table, a double each: `Hausdorff`,
 * `HausdorffPercent`, `NormalAngle`, `NormalConsistency`, `Chamfer`, `ChamferPercent`,
 * `ChamferSquared`, `Precision0_1`, `Recall0_1`, `FScore0_1` at 0.1 % of the diagonal,
 * `Precision0_5`, `Recall0_5`, `FScore0_5` at 0.5 %, `EdgeChamfer`, `EdgeChamferPercent`.
 *
 * The same inputs and seed give the same figures, with any number of threads. If triangles are
 * equally near, the normal of the first counts.
 *
 * @par Limits
 * The filter does not align the surfaces. The maximum is a lower bound, in practice a close one. An
 * abort takes effect after some thousands of distances and leaves the outputs empty.
 *
 * @sa vtkHausdorffDistancePointSetFilter vtkDistancePolyDataFilter vtkNeuralMesh
 */

#ifndef vtkNeuralMeshComparison_h
#define vtkNeuralMeshComparison_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkNeuralMeshSetClampMacro.h"
#include "vtkPolyDataAlgorithm.h"

#include <array>  // For ivars
#include <limits> // For ivars

class vtkTable;

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshComparison : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshComparison* New();
  vtkTypeMacro(vtkNeuralMeshComparison, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The reference, input port 1.
   */
  void SetReferenceConnection(vtkAlgorithmOutput* port);
  void SetReferenceData(vtkPolyData* reference);
  ///@}

  ///@{
  /**
   * How many points are drawn on each surface. The error of the mean falls with the root of the
   * number; the time is in proportion. Default 200000, range 1000 to 100000000.
   */
  vtkNeuralMeshSetClampMacro(NumberOfSamples, vtkIdType, 1000, 100000000);
  vtkGetMacro(NumberOfSamples, vtkIdType);
  ///@}

  ///@{
  /**
   * Seed of the random numbers: which points are drawn. Default 1, at least 0.
   */
  vtkNeuralMeshSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  /** The two ways in which distances are measured. */
  enum DirectionType
  {
    REFERENCE_TO_RESULT,
    RESULT_TO_REFERENCE
  };

  ///@{
  /**
   * The figures of the last run, by direction, in units of the input: mean, root mean square, the
   * distance that 99 % of the samples do not exceed, and the maximum over samples and vertices, and
   * over what is found by climbing on from the farthest samples. NaN if there was no run, or it
   * failed, or `direction` is no DirectionType.
   */
  double GetMean(int direction);
  double GetRMS(int direction);
  double GetPercentile99(int direction);
  double GetMaximum(int direction);
  ///@}

  ///@{
  /**
   * The mean angle, in degrees from 0 to 90, between the normals of the triangles at a sample and
   * at the nearest point of the other surface, whichever way the triangles are oriented. Over
   * 20000 of the samples. Without a direction the mean of both, the usual figure. NaN as above.
   */
  double GetNormalAngle(int direction);
  double GetNormalAngle();
  ///@}

  ///@{
  /**
   * Normal consistency: the mean of |n . n'|, 0 to 1, n and n' being the normals of the triangles at
   * a sample and at the nearest point of the other surface. It is absolute: orientation does not
   * matter. At the samples that GetNormalAngle() takes. Without a direction the mean of both, the
   * usual figure (L. Mescheder, M. Oechsle, M. Niemeyer, S. Nowozin, A. Geiger, Occupancy Networks,
   * CVPR 2019). NaN as above.
   */
  double GetNormalConsistency(int direction);
  double GetNormalConsistency();
  ///@}

  ///@{
  /**
   * Sharp edges of the surface from which a direction starts, between triangles whose planes turn by
   * more than 30 degrees, whichever way they are oriented; points at the same place
   * are one here, and boundaries are not sharp. GetEdgeLength() is their length, 0 without any.
   * GetEdgeMean() is the mean distance of 20000 points (NumberOfSamples, if that is less), drawn
   * evenly over that length, from the nearest sharp edge of the other surface, and NaN if one of
   * both has none. GetEdgeToSurface() is the mean distance of these points from the other surface,
   * wherever: what is cut off or rounded at the edges; NaN if there are none. In units of the input.
   * NaN as above.
   */
  double GetEdgeLength(int direction);
  double GetEdgeMean(int direction);
  double GetEdgeToSurface(int direction);
  ///@}

  ///@{
  /**
   * Chamfer distance: half of the sum of the means of both directions, in units of the input (the
   * Chamfer-L1 of Mescheder and others, above). Squared: the sum of the mean squares of both
   * directions, in squares of these units (H. Fan, H. Su, L. Guibas, A Point Set Generation Network
   * for 3D Object Reconstruction from a Single Image, CVPR 2017, with means in place of sums). NaN
   * as above.
   */
  double GetChamferDistance();
  double GetSquaredChamferDistance();
  ///@}

  /** The larger maximum of both directions, in units of the input. NaN as above. */
  double GetHausdorffDistance();

  /** The distances of scores, in percent of GetReferenceDiagonal(): 0.1 and 0.5. */
  enum ThresholdType
  {
    TENTH_PERCENT,
    HALF_PERCENT
  };

  ///@{
  /**
   * Precision is the part, 0 to 1, of the samples of the result that are nearer to the reference
   * than a distance, recall the part of those of the reference that are nearer to the result. The
   * F-score is their harmonic mean, 2 P R / (P + R), and 0 where both are 0 (A. Knapitsch, J. Park,
   * Q.-Y. Zhou, V. Koltun, Tanks and Temples, ACM Transactions on Graphics 36(4), 2017; for meshes
   * M. Tatarchenko and others, What Do Single-view 3D Reconstruction Networks Learn?, CVPR 2019).
   * NaN as above, or if `threshold` is no ThresholdType.
   */
  double GetPrecision(int threshold);
  double GetRecall(int threshold);
  double GetFScore(int threshold);
  ///@}

  /**
   * Half of the sum of GetEdgeMean() of both directions, in units of the input; NaN if one of the
   * surfaces has no sharp edges, and as above. After the edge Chamfer distance of Z. Chen,
   * A. Tagliasacchi, H. Zhang, BSP-Net, CVPR 2020, and Z. Chen, H. Zhang, Neural Marching Cubes, ACM
   * Transactions on Graphics 40(6), 2021. They take samples of the surface whose neighbours have
   * other normals for points of edges; here the points lie on the edges, so that the same mesh has
   * a distance of 0.
   */
  double GetEdgeChamferDistance();

  /**
   * Diagonal of the bounding box of the triangles of the reference, in units of the input, to which
   * percentages refer. NaN as above.
   */
  double GetReferenceDiagonal();

  ///@{
  /**
   * The outputs of port 1 and 2; that of port 0 is GetOutput().
   */
  vtkPolyData* GetReferenceOutput();
  vtkTable* GetTableOutput();
  ///@}

protected:
  vtkNeuralMeshComparison();
  ~vtkNeuralMeshComparison() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshComparison(const vtkNeuralMeshComparison&) = delete;
  void operator=(const vtkNeuralMeshComparison&) = delete;

  struct Figures
  {
    double Mean = std::numeric_limits<double>::quiet_NaN();
    double RMS = std::numeric_limits<double>::quiet_NaN();
    double Percentile99 = std::numeric_limits<double>::quiet_NaN();
    double Maximum = std::numeric_limits<double>::quiet_NaN();
    double NormalAngle = std::numeric_limits<double>::quiet_NaN();
    double NormalConsistency = std::numeric_limits<double>::quiet_NaN();
    double EdgeMean = std::numeric_limits<double>::quiet_NaN();
    double EdgeToSurface = std::numeric_limits<double>::quiet_NaN();
    double EdgeLength = std::numeric_limits<double>::quiet_NaN();
  };

  struct Score
  {
    double Precision = std::numeric_limits<double>::quiet_NaN();
    double Recall = std::numeric_limits<double>::quiet_NaN();
    double FScore = std::numeric_limits<double>::quiet_NaN();
  };

  struct BothWaysFigures
  {
    double Chamfer = std::numeric_limits<double>::quiet_NaN();
    double ChamferSquared = std::numeric_limits<double>::quiet_NaN();
    double Hausdorff = std::numeric_limits<double>::quiet_NaN();
    double NormalAngle = std::numeric_limits<double>::quiet_NaN();
    double NormalConsistency = std::numeric_limits<double>::quiet_NaN();
    double EdgeChamfer = std::numeric_limits<double>::quiet_NaN();
    std::array<Score, 2> Scores;
  };

  /** Reports how much is done. Returns whether to go on. */
  bool Advance(double progress);
  Figures GetFigures(int direction) const;
  Score GetScore(int threshold) const;
  void FillTable(vtkTable* table) const;
  void FillFieldData(vtkTable* table) const;

  vtkIdType NumberOfSamples = 200000;
  int Seed = 1;
  std::array<Figures, 2> FiguresOfDirections;
  BothWaysFigures BothWays;
  double ReferenceDiagonal = std::numeric_limits<double>::quiet_NaN();
};

#endif
