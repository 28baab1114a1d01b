// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMesh
 * @brief   triangle mesh of a wanted size from a raw point cloud, by learning
 *
 * vtkNeuralMesh turns an unorganised point cloud into a triangle mesh with as many vertices as are
 * asked for. It needs no normals and no connectivity, and it averages noise out. The mesh starts as
 * a tetrahedron. Again and again a random point of the cloud, the sample, is drawn; the vertex
 * closest to it, the winner, moves towards it, and the neighbours of the winner are smoothed. Where
 * vertices win often, the mesh grows by a vertex split; where they hardly ever win, by half-edge
 * collapses it shrinks. So the vertices come to be spread as the points of the cloud are.
 *
 * The time grows as n log n with the number n of vertices, and hardly with the number of points.
 *
 * @par Input
 * Any vtkPointSet, of which only the points count, or a composite dataset, of which all point sets
 * are taken as one cloud (other leaves are left out with a warning). Ghost points and blanked
 * points are skipped. Points with NaN or infinity, and those farther than 10^6 times the size of
 * the cloud's bulk from it, are dropped and counted. Duplicates do no harm. Coordinates may be
 * large against the extent (UTM, say): the filter computes in coordinates of its own.
 * An input without points gives an empty output. An input whose points all coincide, or of which
 * none is finite, is an error.
 *
 * @par Output
 * vtkPolyData with triangles: an oriented 2-manifold without unused points; closed components are
 * oriented outwards. Point data:
 * - `Normals` (float, 3 components): area-weighted unit normals, the active normals;
 * - `Activity` (double): the signal counter of the vertex, in wins; with the activity list, the
 *   place of the vertex in it, above 0 (laziest) up to 1.
 *
 * Field data, one value each: `NumberOfVertices`, `Iterations` (samples drawn), `Seed`,
 * `StopReason` (a string: see GetStopReason()), `DroppedPoints`.
 *
 * Output port 1 is a vtkTable, the learning curve: a row for every twentieth more samples and one
 * for the end, with the columns `Iteration`, `Vertices`, `Seconds` (since the start of learning),
 * `SampleDistanceMean` and `SampleDistanceDeviation` (of the distance from sample to winner over
 * the last NoiseWindow observations, in units of the input), `RegularRatio` (of vertices with
 * valence 6, on a boundary 4), and the counts so far: `Additions`, `Removals`, `Flips`,
 * `RejectedSamples`, `IllegalOperations` (splits and collapses that were due, but not legal).
 *
 * The same input and seed give the same mesh to the byte, on any number of threads; another seed
 * gives another mesh of the same quality. This holds as long as TimeLimit is not met and nobody
 * aborts. Of times only the learning curve tells.
 *
 * @par Abort
 * SetAbortExecute(1), from an observer of ProgressEvent, say, ends the run within 0.2 s. The mesh
 * learnt so far, whole and valid, is the output; StopReason is "cancelled". The flag is cleared
 * when it has been obeyed, so that the next execution starts clean. For that, the filter must be
 * modified: as far as the pipeline knows, its output is up to date.
 *
 * A property out of its range is clamped, with a warning; NaN leaves it as it is.
 *
 * @par What it does not do
 * The result has the topology of a sphere: handles and boundaries of the shape are covered by
 * triangles. The mesh approximates: vertices lie near the points, not on them. Interpolation of
 * the points is done by vtkDelaunay3D or vtkSurfaceReconstructionFilter; where there are reliable
 * oriented normals, vtkSignedDistance with vtkExtractSurface is an alternative.
 *
 * @par Sources
 * W. Saleem, A flexible framework for learning-based surface reconstruction, Universitaet des
 * Saarlandes and MPI Informatik, 2004. Equation numbers below are of this thesis. The basic method:
 * I. Ivrissimtzis, W.-K. Jeong, H.-P. Seidel, Using growing cell structures for surface
 * reconstruction, Shape Modeling International 2003; the noise filter: I. Ivrissimtzis, W.-K.
 * Jeong, S. Lee, Y. Lee, H.-P. Seidel, Neural meshes: surface reconstruction with a learning
 * algorithm, 2004.
 *
 * @sa vtkSurfaceReconstructionFilter vtkExtractSurface vtkHausdorffDistancePointSetFilter
 */

#ifndef vtkNeuralMesh_h
#define vtkNeuralMesh_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshSetClampMacro.h"
#include "vtkPolyDataAlgorithm.h"

class vtkTable;

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMesh : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMesh* New();
  vtkTypeMacro(vtkNeuralMesh, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many vertices the mesh shall have: exactly so many, unless another stopping rule is met
   * first. More than there are points makes sense seldom and gives a warning.
   * Default 20000, at least 4, at most 1000000000.
   */
  vtkNeuralMeshSetClampMacro(NumberOfVertices, vtkIdType, 4, 1000000000);
  vtkGetMacro(NumberOfVertices, vtkIdType);
  ///@}

  ///@{
  /**
   * Seed of the random numbers: which samples are drawn in which order. Default 1, at least 0.
   */
  vtkNeuralMeshSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  enum VariantType
  {
    BASIC,
    NOISE_FILTERING
  };

  ///@{
  /**
   * Variant of the method. BASIC is Algorithm 1: every sample pulls alike, and vertices that have
   * not won for a while are removed all at once. NOISE_FILTERING (default) is Algorithm 4: samples
   * far from the mesh pull less than their distance would have it, and vertices are removed a few
   * at a time.
   */
  vtkNeuralMeshSetClampMacro(Variant, int, BASIC, NOISE_FILTERING);
  vtkGetMacro(Variant, int);
  void SetVariantToBasic() { this->SetVariant(BASIC); }
  void SetVariantToNoiseFiltering() { this->SetVariant(NOISE_FILTERING); }
  ///@}

  enum OrderType
  {
    EXACT,
    LIST
  };

  ///@{
  /**
   * How it is known which vertex is the most active and which the laziest. EXACT (default): by
   * signal counters. LIST: by counters up to ListVertices, then by the activity list (chapter 11),
   * in which a winner jumps forward. The list is the thesis's way to O(n log n); here exact
   * counters are as fast and give meshes that are as good or better, see
   * Documentation/ActivityList.md.
   */
  vtkNeuralMeshSetClampMacro(Order, int, EXACT, LIST);
  vtkGetMacro(Order, int);
  void SetOrderToExact() { this->SetOrder(EXACT); }
  void SetOrderToList() { this->SetOrder(LIST); }
  ///@}

  enum PresetType
  {
    DEFAULT,
    THESIS
  };

  ///@{
  /**
   * Sets all parameters of learning and growth, from WinnerRate to BatchSize below: to the defaults
   * named there, or to those of the thesis for the current variant and order, without anything that
   * the thesis lacks (valence flips, rejection of outliers, patience at first, batches). So choose
   * variant and order first, then the preset, then single values. Default DEFAULT.
   */
  void SetPreset(int preset);
  vtkGetMacro(Preset, int);
  void SetPresetToDefault() { this->SetPreset(DEFAULT); }
  void SetPresetToThesis() { this->SetPreset(THESIS); }
  ///@}

  ///@{
  /**
   * alpha_w of (6.1) and (9.1): how far the winner moves towards the sample, as a fraction of the
   * way. More learns faster and leaves more folds. Default 0.1 (thesis 0.1), range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(WinnerRate, double, 0.0, 1.0);
  vtkGetMacro(WinnerRate, double);
  ///@}

  ///@{
  /**
   * alpha_L of (6.4): how far the neighbours of the winner move along their tangential Laplacian,
   * as a fraction. Default 0.2 (thesis: 0.2 with the list, else 0.05), range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(SmoothingRate, double, 0.0, 1.0);
  vtkGetMacro(SmoothingRate, double);
  ///@}

  ///@{
  /**
   * C_L of chapter 6: how often the neighbours of the winner are smoothed for each sample. More
   * gives rounder triangles, takes time and blurs.
   * Default 1 (thesis: 5 in the basic variant without the list, else 1), range 0 to 100.
   */
  vtkNeuralMeshSetClampMacro(SmoothingIterations, int, 0, 100);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  ///@{
  /**
   * alpha_sc of (6.6), basic variant: what is left of all signal counters after each sample.
   * Default 0.95 (thesis 0.95), range 0.01 to 1.
   */
  vtkNeuralMeshSetClampMacro(CounterDecay, double, 0.01, 1.0);
  vtkGetMacro(CounterDecay, double);
  ///@}

  ///@{
  /**
   * lambda of (9.4), noise-filtering variant: the number of samples per vertex in which a signal
   * counter falls to its half. Default 6 (thesis 6), range 0.01 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(CounterHalfLife, double, 0.01, 1e6);
  vtkGetMacro(CounterHalfLife, double);
  ///@}

  ///@{
  /**
   * alpha_f of section 9, noise-filtering variant: samples farther from their winner than
   * epsilon_t, the mean distance plus so many standard deviations, pull as if they were at
   * epsilon_t (9.2). Default 1 (thesis 1), range 0 to 1000.
   */
  vtkNeuralMeshSetClampMacro(NoiseTolerance, double, 0.0, 1000.0);
  vtkGetMacro(NoiseTolerance, double);
  ///@}

  ///@{
  /**
   * Number of distances between sample and winner behind the mean and the standard deviation above,
   * and behind TargetSampleDistance. In large batches only every so-many-th sample is observed, so
   * that the distances come from everywhere. Default 1000 (thesis 1000), range 2 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(NoiseWindow, int, 2, 1000000);
  vtkGetMacro(NoiseWindow, int);
  ///@}

  ///@{
  /**
   * Noise-filtering variant: samples farther from their winner than this multiple of epsilon_t are
   * outliers, from which nothing is learnt; 0 learns from all. Default 5 (thesis 0), range 0 to
   * 1000000.
   */
  vtkNeuralMeshSetClampMacro(OutlierLimit, double, 0.0, 1e6);
  vtkGetMacro(OutlierLimit, double);
  ///@}

  ///@{
  /**
   * OutlierLimit holds from so many vertices on: before, the mesh does not know the rough shape,
   * and what is far from it need not be an outlier. Default 1000, at least 4.
   */
  vtkNeuralMeshSetClampMacro(OutlierLimitVertices, int, 4, VTK_INT_MAX);
  vtkGetMacro(OutlierLimitVertices, int);
  ///@}

  ///@{
  /**
   * C_vs of chapter 6: the number of samples between two vertex splits. The time is in proportion.
   * More follows the cloud closer; less makes misplaced vertices more frequent, of which the
   * maximum of the distances tells sooner than the mean.
   * Default 50 (thesis 50), range 1 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(SamplesPerAddition, int, 1, 1000000);
  vtkGetMacro(SamplesPerAddition, int);
  ///@}

  ///@{
  /**
   * SamplesPerAddition is multiplied by this as long as the mesh has less than EarlyVertices
   * vertices, while it learns the rough shape: that makes twists and bridges rarer.
   * Default 4 (thesis 1), range 0.01 to 1000.
   */
  vtkNeuralMeshSetClampMacro(EarlyPatience, double, 0.01, 1000.0);
  vtkGetMacro(EarlyPatience, double);
  ///@}

  ///@{
  /**
   * See EarlyPatience. Default 1000, at least 0.
   */
  vtkNeuralMeshSetClampMacro(EarlyVertices, int, 0, VTK_INT_MAX);
  vtkGetMacro(EarlyVertices, int);
  ///@}

  ///@{
  /**
   * C_nr of section 9.1, noise-filtering variant: the number of vertex splits between two removals
   * of the laziest vertices. Default 10 (thesis 125), range 1 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(AdditionsPerRemoval, int, 1, 1000000);
  vtkGetMacro(AdditionsPerRemoval, int);
  ///@}

  ///@{
  /**
   * C_ec of chapters 6 and 9: the number of samples per vertex in which a vertex must win so as not
   * to be removed. Growth needs C_ec > exp(-C_ec) C_vs (6.18); less gives a warning, and maybe a
   * mesh that stalls. Default 10 (thesis 10), range 0.01 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(RemovalPatience, double, 0.01, 1e6);
  vtkGetMacro(RemovalPatience, double);
  ///@}

  ///@{
  /**
   * Noise-filtering variant: the number of vertices removed at a time is at most this multiple of
   * AdditionsPerRemoval; 0 for no limit. Where the cloud is open or falls into pieces, parts of the
   * mesh are always idle: without a limit their removal can outweigh all growth.
   * Default 0.5 (thesis 0), range 0 to 1000.
   */
  vtkNeuralMeshSetClampMacro(RemovalLimit, double, 0.0, 1000.0);
  vtkGetMacro(RemovalLimit, double);
  ///@}

  ///@{
  /**
   * Whether edges are flipped around vertex splits and collapses: where that brings valences closer
   * to 6 without folds, and where an edge is the rim of two sheets that lie back to back, as
   * bridges over gaps are. Default on (thesis off).
   */
  vtkSetMacro(EdgeFlips, vtkTypeBool);
  vtkGetMacro(EdgeFlips, vtkTypeBool);
  vtkBooleanMacro(EdgeFlips, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Jump distance of chapter 11, with the list: how far a winner jumps, as a fraction of the number
   * of vertices. Default 1/3 (thesis 1/3), range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(JumpFraction, double, 0.0, 1.0);
  vtkGetMacro(JumpFraction, double);
  ///@}

  ///@{
  /**
   * With the list: exact counters count until the mesh has so many vertices.
   * Default 1000 (thesis 1000), at least 4.
   */
  vtkNeuralMeshSetClampMacro(ListVertices, int, 4, VTK_INT_MAX);
  vtkGetMacro(ListVertices, int);
  ///@}

  ///@{
  /**
   * The largest number of samples that are drawn at once; there is never more than one for eight
   * vertices. The winners of a batch are searched before it is learnt, which is faster by far.
   * Another size gives another mesh of the same quality. Default 65536 (thesis 1, one by one),
   * range 1 to 1048576.
   */
  vtkNeuralMeshSetClampMacro(BatchSize, int, 1, 1048576);
  vtkGetMacro(BatchSize, int);
  ///@}

  ///@{
  /**
   * Stopping rule: the number of samples to draw at most; 0 for any number. Default 0.
   */
  vtkNeuralMeshSetClampMacro(MaximumIterations, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(MaximumIterations, vtkIdType);
  ///@}

  ///@{
  /**
   * Stopping rule: end when the mean distance between sample and winner over the last NoiseWindow
   * observations is at most this fraction of the diagonal of the cloud's bounding box; 0 for never.
   * Default 0, range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(TargetSampleDistance, double, 0.0, 1.0);
  vtkGetMacro(TargetSampleDistance, double);
  ///@}

  ///@{
  /**
   * Stopping rule: end when the mean distance from the cloud to the surface is at most this
   * fraction of the diagonal of the cloud's bounding box; 0 for never. Measured with 4096 points
   * whenever the mesh has grown by a tenth. Default 0, range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(TargetCloudDistance, double, 0.0, 1.0);
  vtkGetMacro(TargetCloudDistance, double);
  ///@}

  ///@{
  /**
   * Stopping rule: the number of seconds to learn at most; 0 for any. Results then depend on the
   * machine. Default 0, at least 0.
   */
  vtkNeuralMeshSetClampMacro(TimeLimit, double, 0.0, 1e9);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /**
   * Stopping rule: the run has stalled if in so many samples per vertex (of a mesh of at least 100
   * vertices) there was no growth. That gives a warning. Default 200, range 1 to 1e9.
   */
  vtkNeuralMeshSetClampMacro(StallPatience, double, 1.0, 1e9);
  vtkGetMacro(StallPatience, double);
  ///@}

  ///@{
  /**
   * Precision of the output points, a vtkAlgorithm::DesiredOutputPrecision. DEFAULT_PRECISION
   * (default) is that of the input; double if blocks differ. Inside, positions are resolved to
   * about 10^-7 of the extent in any case.
   */
  vtkNeuralMeshSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  /**
   * Output port 1, see above.
   */
  vtkTable* GetLearningCurve();

  /**
   * Why the last run ended: "vertices", "iterations", "sample distance", "cloud distance",
   * "time limit", "stalled" or "cancelled"; "none" before the first.
   */
  const char* GetStopReason() const { return this->StopReason; }

protected:
  vtkNeuralMesh();
  ~vtkNeuralMesh() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMesh(const vtkNeuralMesh&) = delete;
  void operator=(const vtkNeuralMesh&) = delete;

  /** Sets what the preset sets. Returns whether anything has changed. */
  bool ApplyPreset();

  vtkIdType NumberOfVertices = 20000;
  int Seed = 1;
  int Variant = NOISE_FILTERING;
  int Order = EXACT;
  int Preset = DEFAULT;

  // What a preset sets; the values are those of the core's presets.
  double WinnerRate = 0;
  double SmoothingRate = 0;
  int SmoothingIterations = 0;
  double CounterDecay = 0;
  double CounterHalfLife = 0;
  double NoiseTolerance = 0;
  int NoiseWindow = 0;
  double OutlierLimit = 0;
  int OutlierLimitVertices = 0;
  int SamplesPerAddition = 0;
  double EarlyPatience = 0;
  int EarlyVertices = 0;
  int AdditionsPerRemoval = 0;
  double RemovalPatience = 0;
  double RemovalLimit = 0;
  vtkTypeBool EdgeFlips = 0;
  double JumpFraction = 0;
  int ListVertices = 0;
  int BatchSize = 0;

  vtkIdType MaximumIterations = 0;
  double TargetSampleDistance = 0.0;
  double TargetCloudDistance = 0.0;
  double TimeLimit = 0.0;
  double StallPatience;

  int OutputPointsPrecision = DEFAULT_PRECISION;
  const char* StopReason = "none";
};

#endif
