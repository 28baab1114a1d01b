// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMesh
 * @brief   triangle mesh of a wanted size from a raw point cloud, by learning
 *
 * vtkNeuralMesh turns an unorganised point cloud into a triangle mesh with as many vertices as are
 * asked for. It needs no normals and no connectivity, and it averages noise out. The mesh starts as
 * a coarse surface of the space that the cloud occupies. Again and again a random point of the cloud, the sample, is drawn; the vertex
 * closest to it, the winner, moves towards it, and the neighbours of the winner are smoothed. Where
 * vertices win often, the mesh grows by a vertex split; where they hardly ever win, by half-edge
 * collapses it shrinks. So the vertices come to be spread as the points of the cloud are. In the
 * end all are fitted to the cloud by least squares.
 *
 * The time grows as n log n with the number n of vertices, and hardly with the number of points.
 *
 * @par Input
 * Any vtkPointSet, of which points and point data count, or a composite dataset, of which all point
 * sets are taken as one cloud (other leaves are left out with a warning). Ghost points and blanked
 * points are skipped. Points with NaN or infinity, and those farther than 10^6 times the size of
 * the cloud's bulk from it, are dropped and counted. Duplicates do no harm. Coordinates may be
 * large against the extent (UTM, say): the filter computes in coordinates of its own.
 * An input without points gives an empty output. An input whose points all coincide, or of which
 * none is finite, is an error. Instead of an input, PointFileName may name a file.
 *
 * Input port 1, optional: a vtkPolyData with triangles to start from instead,
 * see SetFirstMeshConnection().
 *
 * @par Output
 * vtkPolyData with triangles: an oriented 2-manifold without unused points; closed components are
 * oriented outwards. Point data:
 * - `Normals` (float, 3 components): area-weighted unit normals, the active normals;
 * - `Activity` (double): the counter of the vertex, in wins, or in the normal-based variant in wins
 *   of average change; with the activity list, the place of the vertex in it, above 0 (laziest) up
 *   to 1;
 * - `FeatureStrength` (double), if ComputeFeatureStrength is on: about 0 where the surface is flat,
 *   up to GainLimit at edges and corners;
 * - the arrays of the input, see CarryPointData.
 *
 * Field data, one value each: `NumberOfVertices`, `Iterations` (samples drawn), `Seed`,
 * `StopReason` (a string: see GetStopReason()), `DroppedPoints`. And unless the run was aborted, a
 * report on the quality of the mesh. How it stands for the cloud (double):
 * - `Residual`: distance to the mesh of a twentieth of the points, which the fit did not see,
 *   without outliers: root of the mean square, in units of the input;
 * - `Noise`: what the fit holds the standard deviation of the points across the surface to be, in
 *   units of the input; NaN without a finished fit;
 * - `OutlierShare`: part of these points that are outliers, farther from the mesh than five times
 *   the median and than half a mean edge; 0 to 1.
 *
 * What it is by itself: `RegularRatio` (of vertices with valence 6, on a boundary 4), from 0 to 1,
 * and `TriangleQuality` (mean of twice the radius of the inscribed over that of the circumscribed
 * circle, 1 for equilateral triangles), both double; and the integers `Components`, `Genus`
 * (handles; -1 where it is not defined), `BoundaryLoops`, `FoldedEdges` (whose triangles turn by
 * more than 150 degrees) and `IntersectingTriangles` (which cut others and could not be repaired; -1
 * without a finished fit: nobody has looked).
 *
 * Output port 1 is a vtkTable, the learning curve: a row for every twentieth more samples and one
 * for the end, with the columns `Iteration`, `Vertices`, `Seconds` (since the start of learning),
 * `SampleDistanceMean` and `SampleDistanceDeviation` (of the distance from sample to winner over
 * the last NoiseWindow observations, in units of the input), `NormalChangeMean` (M_delta of (8.2),
 * over the last ChangeWindow observations), `RegularRatio` (of vertices with valence 6, on a
 * boundary 4), and the counts so far: `Additions`, `Removals`, `Flips`,
 * `RejectedSamples`, `IllegalOperations` (splits and collapses that were due, but not legal); and
 * of topology learning `RemovedTriangles`, `MergedBoundaries` (pairs) and `FilledBoundaries`.
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
 * The result has the topology that the coarse grid of the start finds, or that of the first mesh:
 * handles narrower than about 3 % of the longest side are closed at first; see Documentation/Start.md.
 * TopologyLearning changes it while the mesh learns: see Documentation/Topology.md.
 * The mesh approximates: vertices lie near the points, not on them. Interpolation of the points is
 * done by vtkDelaunay3D or vtkSurfaceReconstructionFilter; where there are reliable oriented
 * normals, vtkSignedDistance with vtkExtractSurface is an alternative.
 *
 * @par Sources
 * W. Saleem, A flexible framework for learning-based surface reconstruction, Universitaet des
 * Saarlandes and MPI Informatik, 2004. Equation numbers below are of this thesis. The basic method:
 * I. Ivrissimtzis, W.-K. Jeong, H.-P. Seidel, Using growing cell structures for surface
 * reconstruction, Shape Modeling International 2003; the noise filter: I. Ivrissimtzis, W.-K.
 * Jeong, S. Lee, Y. Lee, H.-P. Seidel, Neural meshes: surface reconstruction with a learning
 * algorithm, 2004.
 *
 * @sa vtkPNeuralMesh vtkNeuralMeshFileSampler vtkSurfaceReconstructionFilter vtkExtractSurface
 * vtkHausdorffDistancePointSetFilter
 */

#ifndef vtkNeuralMesh_h
#define vtkNeuralMesh_h

#include "vtkCommand.h"                 // For UserEvent
#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshAlgorithm.h"

#include <memory>
#include <string>
#include <vector>

class vtkNeuralMeshGrowth;
class vtkPointCloudCollector;
class vtkTable;
struct vtkNeuralMeshRun;
namespace neuralmesh
{
struct CheckpointPlan;
struct GrowthWatch;
}

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMesh : public vtkNeuralMeshAlgorithm
{
public:
  static vtkNeuralMesh* New();
  vtkTypeMacro(vtkNeuralMesh, vtkNeuralMeshAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Input port 1, the first mesh: triangles from which learning starts, in the coordinates of the
   * cloud; to go on with the result of an earlier run, to refine an earlier mesh by a new scan, or
   * to give the topology, which the result then has. Default none: see Start, and Documentation/FirstMesh.md.
   *
   * It must be an oriented 2-manifold, with or without boundary, and lie at the cloud. An error
   * that names the points is given where it is not: no triangles; an edge of more than two
   * triangles; two triangles that run along their edge in the same direction; triangles at a point
   * that are not one fan; a triangle that is there twice or uses a point twice, or a point that
   * does not exist; a point that is not finite, or farther from the cloud than 10^6 times its size.
   * vtkCleanPolyData and vtkPolyDataNormals mend some of that.
   *
   * Polygons become fans of triangles and strips are taken apart; vtkTriangleFilter does it better
   * for polygons that are not convex. Lines, vertices, attributes and points that no triangle uses
   * are left out. Vertices of more than 15 neighbours are split; so are boundary edges of a mesh
   * that could not grow otherwise, such as a single triangle.
   *
   * All vertices start with the activity of one win. A first mesh that has NumberOfVertices
   * vertices or more is not learnt: it comes out as it is, with a warning if it has more. As in any
   * run, parts of it that are far from all points are removed in time, and closed components are
   * turned outwards.
   */
  void SetFirstMeshConnection(vtkAlgorithmOutput* port);
  void SetFirstMeshData(vtkPolyData* mesh);
  vtkPolyData* GetFirstMesh();
  ///@}

  ///@{
  /**
   * A file from which points are drawn where they lie, in place of the input: for clouds larger than
   * the memory. MaximumPoints of them are drawn, or all if there are no more, as by
   * vtkNeuralMeshFileSampler, which tells what files there may be: binary .ply, .vtp appended raw.
   * (For raw coordinates, give the output of that class to the input.) It is an error to have both
   * the file and an input, or neither, or if the file cannot be used; and, in vtkPNeuralMesh and
   * vtkPNeuralMeshEnsemble, to have it with more than one process. Default none.
   */
  void SetPointFileName(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetPointFileName() const { return this->PointFileName.c_str(); }
  ///@}

  ///@{
  /**
   * From how many points the mesh is made, about, where the cloud is the file PointFileName, and in
   * vtkPNeuralMesh and vtkPNeuralMeshEnsemble whatever it is; from all if there are no more. More
   * than 50 per vertex hardly change it, as no more samples are drawn. 0, the default, stands for
   * 50 per vertex, but at least 1000000. At least 0.
   */
  vtkNeuralMeshSetClampMacro(MaximumPoints, vtkIdType, 0, VTK_UNSIGNED_INT_MAX);
  vtkGetMacro(MaximumPoints, vtkIdType);
  ///@}

  /** MaximumPoints, or what 0 stands for. */
  vtkIdType GetUsedMaximumPoints() const;

  ///@{
  /**
   * Whether the point data of the input arrives on the mesh, each array with its name, its
   * component names and its type. Default on. Takes no time where there are no arrays.
   * - float and double, and unsigned char of 3 or 4 components (colours): a least-squares fit,
   *   which averages noise out and stays within the range of the values. Points with a value that
   *   is not finite are left out; NaN where no others are near.
   * - All other numbers, strings and variants: the most frequent tuple among the points on the
   *   triangles of a vertex; of equally frequent ones that of the first point.
   *
   * Outliers do not count; weights do. The active scalars of the input are those of the output. The
   * mesh has its own normals, so that the active normals are left out, as are ghost arrays, global
   * and pedigree ids, and, of composite datasets, what not all blocks with points have in the same
   * type and number of components. An array that is called `Normals`, `Activity` or
   * `FeatureStrength` gets `_Input` behind its name. An aborted run carries nothing over, or not all.
   * See Documentation/PointData.md.
   */
  vtkSetMacro(CarryPointData, vtkTypeBool);
  vtkGetMacro(CarryPointData, vtkTypeBool);
  vtkBooleanMacro(CarryPointData, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The point array of weights, of any numeric type and one component: how much the points are
   * trusted. A point is drawn with a probability proportional to its weight, and weighs so much in
   * the fit and where point data is carried over. Only ratios count. Points whose weight is
   * negative, 0, NaN or infinite are as if they were not there, and are not among DroppedPoints. It
   * is an error if no weight is positive, or if there is no such array in all blocks with points.
   * Default none (an empty name, for which null may be given, too): all points weigh alike.
   * The same as SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name),
   * which may be used instead, with an attribute, too.
   */
  void SetWeightArrayName(const char* name);
  const char* GetWeightArrayName();
  ///@}

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
   * Stopping rule: end when M_delta of (8.2), the mean change of the winner's normal (1 - cosine of
   * the angle by which a move turns it, see ChangeWindow), is at most this; 0 for never. It
   * falls while the mesh learns, and ever slower; which values occur is told by the learning curve.
   * Default 0, range 0 to 2.
   */
  vtkNeuralMeshSetClampMacro(TargetNormalChange, double, 0.0, 2.0);
  vtkGetMacro(TargetNormalChange, double);
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
   * How many threads may work at the same time: on the search for winners, on the fit, on members of
   * an ensemble and on point data. 0 for as many as the machine runs at once, or as the environment
   * variable VTK_SMP_MAX_THREADS allows. The mesh is the same to the byte with any number. They are
   * threads of the filter's own, which end with the run; the backend of vtkSMPTools does not matter.
   * Default 0, range 0 to 1024.
   */
  vtkNeuralMeshSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
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

  ///@{
  /**
   * Whether the growth of the mesh is offered as time steps, to be played: NumberOfSnapshots of
   * them, at the times 0, 1, 2 and so on. The first one is what learning starts from, the last one
   * the finished mesh, to the byte that of a run without them, and what comes out where no time is
   * asked for; their numbers of vertices rise by about the same factor. Steps between have
   * `Normals` and `Activity`, and the field data `NumberOfVertices`, `Iterations` and `Seed`, but
   * no other arrays and no report. A run of few vertices, or one that ends early, has fewer
   * snapshots; the steps that remain show the finished mesh.
   *
   * The mesh is learnt once, at the first step asked for, and anew only where the input or a
   * property has changed. The input stays at its first time step: its own time is hidden. Without
   * GrowthAsTime it passes through. An aborted run has no steps.
   *
   * A snapshot is kept in 40 bytes a vertex: all together in at most 40 NumberOfSnapshots bytes for
   * each of the NumberOfVertices, and in less than half of that where learning starts from the
   * occupied space. Nothing is kept without GrowthAsTime.
   * Defaults: off; 24, range 2 to 100.
   */
  vtkSetMacro(GrowthAsTime, vtkTypeBool);
  vtkGetMacro(GrowthAsTime, vtkTypeBool);
  vtkBooleanMacro(GrowthAsTime, vtkTypeBool);
  vtkNeuralMeshSetClampMacro(NumberOfSnapshots, int, 2, 100);
  vtkGetMacro(NumberOfSnapshots, int);
  ///@}

  ///@{
  /**
   * Whether FitRounds, FitSmoothness and CurvatureDensity are chosen for the cloud, before learning, by
   * short runs on parts of it, some of whose points are held out; what they are set to is then where
   * the search begins, and stays. Takes some seconds, however large cloud and mesh are. Field data
   * `ChosenParameters` (strings NAME=VALUE) and `ReasonsOfChoice` say what was chosen and why, as VTK's
   * log does. FitSmoothness is chosen only if it is 0. Default: off. See Documentation/Automatic.md.
   */
  vtkSetMacro(Automatic, vtkTypeBool);
  vtkGetMacro(Automatic, vtkTypeBool);
  vtkBooleanMacro(Automatic, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The file in which the run leaves its state, every CheckpointInterval seconds (default 60, range
   * 0 to 1000000), once learning is over, and when it is aborted: so that another execution, in
   * another process, say, goes on from there, to the same mesh to the byte as without a break. Where
   * there is no such file learning starts at its beginning. Default none (an empty name, for which
   * null may be given, too).
   *
   * It is an error if the file is damaged, or if it is that of another run: other points, weights or
   * first mesh, another version, or a property on which the mesh depends; the message says which.
   * TimeLimit may be another one, and counts what all executions have learnt. The file is replaced
   * as a whole, so that one is there at any moment; if it cannot be written while learning goes on,
   * there is a warning. It is removed once the mesh is the output, unless the run was aborted or has
   * met TimeLimit, or KeepCheckpoint (default off) is on: for whoever has yet to write the mesh, and
   * then calls RemoveCheckpoint().
   *
   * What learning starts from is found anew, as are the members of vtkNeuralMeshEnsemble.
   * Checkpoints hold no snapshots: with GrowthAsTime they are an error. See
   * Documentation/Checkpoints.md.
   */
  void SetCheckpointFileName(const char* name);
  const char* GetCheckpointFileName() const { return this->CheckpointFileName.c_str(); }
  vtkNeuralMeshSetClampMacro(CheckpointInterval, double, 0.0, 1e6);
  vtkGetMacro(CheckpointInterval, double);
  vtkSetMacro(KeepCheckpoint, vtkTypeBool);
  vtkGetMacro(KeepCheckpoint, vtkTypeBool);
  vtkBooleanMacro(KeepCheckpoint, vtkTypeBool);
  ///@}

  /**
   * Removes the file, if it is there, and what executions have left beside it that were killed while
   * they wrote it.
   */
  void RemoveCheckpoint();

  /**
   * How many samples had been learnt where the last run went on from a checkpoint; 0 if it began at
   * the beginning.
   */
  vtkIdType GetResumedIterations() const { return this->ResumedIterations; }

  /** Events beside those of VTK. */
  enum EventIds
  {
    /**
     * Invoked while the mesh is learnt, for each snapshot but the last one as soon as it is there,
     * with and without GrowthAsTime: callData is a vtkPolyData as that step has it, without `Seed`,
     * that the observer may keep. The observer must not execute the filter.
     */
    SnapshotEvent = vtkCommand::UserEvent + 2004
  };

  /**
   * Output port 1, see above.
   */
  vtkTable* GetLearningCurve();

  /**
   * Why the last run ended: "vertices", "iterations", "sample distance", "cloud distance",
   * "normal change", "time limit", "stalled" or "cancelled"; "none" before the first.
   */
  const char* GetStopReason() const { return this->StopReason; }

  ///@{
  /**
   * CPU seconds of the process that the last run spent on drawing points from PointFileName, making
   * the cloud ready, choosing parameters, finding what to start from, learning, and the finish. They stand nowhere in the
   * output.
   */
  double GetDrawingTime() const { return this->DrawingTime; }
  double GetCloudTime() const { return this->CloudTime; }
  double GetChoiceTime() const { return this->ChoiceTime; }
  double GetStartTime() const { return this->StartTime; }
  double GetLearningTime() const { return this->LearningTime; }
  double GetFinishTime() const { return this->FinishTime; }
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkNeuralMesh();
  ~vtkNeuralMesh() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Called by RequestData before learning: puts the mesh to start from, if there is one, into
   * `run`; here it is that of input port 1. Throws std::runtime_error if it is none to start from.
   */
  virtual void PrepareRun(
    vtkNeuralMeshRun& run, vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  /** Whether this process helps another one up to there, and has no result of its own. */
  virtual bool IsHelper() const { return false; }

  /** Weights of the collected points; none if all weigh alike. An error if they are not there. */
  bool CollectWeights(const vtkPointCloudCollector& collector, std::vector<double>& weights);

  const char* StopReason = "none"; ///< of the core: it is never freed

private:
  int ExecuteOnCloud(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  vtkInformation* GetWeightArrayInformation();
  neuralmesh::GrowthWatch WatchGrowth(int precision);
  neuralmesh::CheckpointPlan PlanCheckpoint();

  vtkNeuralMesh(const vtkNeuralMesh&) = delete;
  void operator=(const vtkNeuralMesh&) = delete;

  std::string PointFileName;
  vtkIdType MaximumPoints = 0;
  vtkTypeBool CarryPointData = 1;
  vtkIdType NumberOfVertices = 20000;
  int Seed = 1;
  vtkIdType MaximumIterations = 0;
  double TargetSampleDistance = 0.0;
  double TargetCloudDistance = 0.0;
  double TargetNormalChange = 0.0;
  double TimeLimit = 0.0;
  double StallPatience;
  int NumberOfThreads = 0;

  vtkTypeBool Automatic = 0;
  vtkTypeBool GrowthAsTime = 0;
  int NumberOfSnapshots = 24;
  std::unique_ptr<vtkNeuralMeshGrowth> Growth;
  std::string CheckpointFileName;
  double CheckpointInterval = 60.0;
  vtkTypeBool KeepCheckpoint = 0;
  vtkIdType ResumedIterations = 0;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  double DrawingTime = 0.0;
  double CloudTime = 0.0;
  double ChoiceTime = 0.0;
  double StartTime = 0.0;
  double LearningTime = 0.0;
  double FinishTime = 0.0;
};

#endif
