// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshAlgorithm
 * @brief   the parameters of learning, for the filters that learn meshes
 *
 * vtkNeuralMeshAlgorithm is the abstract superclass of vtkNeuralMesh. It holds which
 * variant of the method is run and the parameters of learning and growth, with their presets. What
 * they mean is told there and in Documentation/Theory.md; equation numbers are those of W. Saleem,
 * A flexible framework for learning-based surface reconstruction, 2004.
 *
 * A property out of its range is clamped, with a warning; NaN leaves it as it is.
 *
 * @sa vtkNeuralMesh
 */

#ifndef vtkNeuralMeshAlgorithm_h
#define vtkNeuralMeshAlgorithm_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshSetClampMacro.h"
#include "vtkPolyDataAlgorithm.h"

namespace neuralmesh
{
struct Parameters;
}

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkNeuralMeshAlgorithm, vtkPolyDataAlgorithm) void PrintSelf(
    ostream& os, vtkIndent indent) override;

  /** The variants, for SetVariant(). */
  enum VariantType
  {
    BASIC,
    NOISE_FILTERING,
    NORMAL_BASED
  };

  ///@{
  /**
   * Variant of the method. BASIC is Algorithm 1: every sample pulls alike, and vertices that have
   * not won for a while are removed all at once. NOISE_FILTERING (default) is Algorithm 4: samples
   * far from the mesh pull less than their distance would have it, and vertices are removed a few
   * at a time. NORMAL_BASED is Algorithm 3: as BASIC, but the mesh grows where its normals turn, so
   * that it is dense at edges and bends, and sparse where it is flat (Documentation/NormalBased.md).
   */
  vtkNeuralMeshSetClampMacro(Variant, int, BASIC, NORMAL_BASED);
  vtkGetMacro(Variant, int);
  void SetVariantToBasic() { this->SetVariant(BASIC); }
  void SetVariantToNoiseFiltering() { this->SetVariant(NOISE_FILTERING); }
  void SetVariantToNormalBased() { this->SetVariant(NORMAL_BASED); }
  ///@}

  /** The orders, for SetOrder(). */
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
   * counters are as fast and give meshes as good or better (Documentation/ActivityList.md).
   */
  vtkNeuralMeshSetClampMacro(Order, int, EXACT, LIST);
  vtkGetMacro(Order, int);
  void SetOrderToExact() { this->SetOrder(EXACT); }
  void SetOrderToList() { this->SetOrder(LIST); }
  ///@}

  ///@{
  /**
   * Whether the topology of the shape is learnt (chapter 7), in the basic and the noise-filtering
   * variant: triangles that stay large are removed, for there the cloud has no points, and
   * boundaries that come close to each other are joined: so handles and openings come to be. Default
   * off. See Documentation/Topology.md.
   */
  vtkSetMacro(TopologyLearning, vtkTypeBool);
  vtkGetMacro(TopologyLearning, vtkTypeBool);
  vtkBooleanMacro(TopologyLearning, vtkTypeBool);
  ///@}

  /** What learning may start from, for SetStart(). */
  enum StartType
  {
    OCCUPIED_SPACE,
    TETRAHEDRON
  };

  ///@{
  /**
   * What learning starts from, where no first mesh is given. OCCUPIED_SPACE (default): a coarse
   * surface of the space that the cloud occupies or encloses, which has the handles and pieces of
   * the shape, or is one open sheet. TETRAHEDRON, as the thesis has it (its preset sets it), and for
   * clouds of less than 500 points: topology is that of a sphere, unless TopologyLearning is on. See
   * Documentation/Start.md.
   */
  vtkNeuralMeshSetClampMacro(Start, int, OCCUPIED_SPACE, TETRAHEDRON);
  vtkGetMacro(Start, int);
  void SetStartToOccupiedSpace() { this->SetStart(OCCUPIED_SPACE); }
  void SetStartToTetrahedron() { this->SetStart(TETRAHEDRON); }
  ///@}

  /** What may become of gaps, for SetBoundaries(). */
  enum BoundariesType
  {
    KEEP,
    CLOSE
  };

  ///@{
  /**
   * With Start OCCUPIED_SPACE, what becomes of gaps in the scan. KEEP (default): the mesh ends where
   * the data ends, nothing is invented. CLOSE: the mesh is watertight. See Documentation/Start.md.
   */
  vtkNeuralMeshSetClampMacro(Boundaries, int, KEEP, CLOSE);
  vtkGetMacro(Boundaries, int);
  void SetBoundariesToKeep() { this->SetBoundaries(KEEP); }
  void SetBoundariesToClose() { this->SetBoundaries(CLOSE); }
  ///@}

  ///@{
  /**
   * With Start OCCUPIED_SPACE, but neither in the variant NORMAL_BASED nor with
   * ComputeFeatureStrength: how much denser vertices are where the surface bends, the exponent of its
   * mean curvature by which samples are drawn. 0 draws all alike. Default 0.5 (thesis 0), range 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(CurvatureDensity, double, 0.0, 1.0);
  vtkGetMacro(CurvatureDensity, double);
  ///@}

  /** The jump distances, for SetJump(). */
  enum JumpType
  {
    CONSTANT,
    NORMAL_ACTIVITY,
    AREA_CHANGE,
    VOLUME_CHANGE,
    WEIGHTED
  };

  ///@{
  /**
   * Jump distance (11.2.1), with Order LIST only: a winner jumps by JumpFraction of the number of
   * vertices, times what its move changes over what moves change on average. CONSTANT (default): all
   * jump alike, but in the variant NORMAL_BASED as by NORMAL_ACTIVITY. NORMAL_ACTIVITY: by how far
   * the normal at the winner turns (8.1); AREA_CHANGE: by how much the area of its triangles grows or
   * shrinks; VOLUME_CHANGE: by how much the volume does; WEIGHTED: the mean of these four by
   * ConstantWeight, NormalWeight, AreaWeight and VolumeWeight. See Documentation/ActivityList.md.
   */
  vtkNeuralMeshSetClampMacro(Jump, int, CONSTANT, WEIGHTED);
  vtkGetMacro(Jump, int);
  void SetJumpToConstant() { this->SetJump(CONSTANT); }
  void SetJumpToNormalActivity() { this->SetJump(NORMAL_ACTIVITY); }
  void SetJumpToAreaChange() { this->SetJump(AREA_CHANGE); }
  void SetJumpToVolumeChange() { this->SetJump(VOLUME_CHANGE); }
  void SetJumpToWeighted() { this->SetJump(WEIGHTED); }
  ///@}

  /** The operations of Node Addition, for SetAdditionOperation(). */
  enum AdditionOperationType
  {
    VERTEX_SPLIT,
    EDGE_SPLIT
  };

  ///@{
  /**
   * The operation of Node Addition (Figure 6.6). VERTEX_SPLIT (default) shares the edges of the
   * vertex with the new one. EDGE_SPLIT halves its longest edge: the new vertex has valence 4.
   */
  vtkNeuralMeshSetClampMacro(AdditionOperation, int, VERTEX_SPLIT, EDGE_SPLIT);
  vtkGetMacro(AdditionOperation, int);
  void SetAdditionOperationToVertexSplit() { this->SetAdditionOperation(VERTEX_SPLIT); }
  void SetAdditionOperationToEdgeSplit() { this->SetAdditionOperation(EDGE_SPLIT); }
  ///@}

  /** The operations of Node Removal, for SetRemovalOperation(). */
  enum RemovalOperationType
  {
    HALF_EDGE_COLLAPSE,
    FULL_EDGE_COLLAPSE,
    VERTEX_DELETE
  };

  ///@{
  /**
   * The operation of Node Removal (Figure 6.7), along the edge of the least regularity error (6.7).
   * HALF_EDGE_COLLAPSE (default) leaves the neighbour where it is. FULL_EDGE_COLLAPSE moves it to
   * the middle of the edge, unless only one of both ends is on a boundary. VERTEX_DELETE
   * triangulates the polygon that is left anew, towards regular valences.
   */
  vtkNeuralMeshSetClampMacro(RemovalOperation, int, HALF_EDGE_COLLAPSE, VERTEX_DELETE);
  vtkGetMacro(RemovalOperation, int);
  void SetRemovalOperationToHalfEdgeCollapse() { this->SetRemovalOperation(HALF_EDGE_COLLAPSE); }
  void SetRemovalOperationToFullEdgeCollapse() { this->SetRemovalOperation(FULL_EDGE_COLLAPSE); }
  void SetRemovalOperationToVertexDelete() { this->SetRemovalOperation(VERTEX_DELETE); }
  ///@}

  ///@{
  /**
   * Whether the output has the point data `FeatureStrength`, eta of (8.5), in any variant: how far
   * the normal of a vertex turns when it wins, over what normals turn by on average; highest at
   * edges and corners. It takes FeatureSamples more samples, which move the mesh on. Default off.
   */
  vtkSetMacro(ComputeFeatureStrength, vtkTypeBool);
  vtkGetMacro(ComputeFeatureStrength, vtkTypeBool);
  vtkBooleanMacro(ComputeFeatureStrength, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The finish: rounds of a least-squares fit of all vertices to the cloud once they are learnt.
   * FitRounds: 0 for none; default 3 (thesis: 0), range 0 to 100. FitSmoothness: lambda, how smooth
   * the mesh is held; 0 (default) chooses it by the noise of the cloud and the shape, range 0 to
   * 1000000. FitSamples: samples per vertex; default 10, range 1 to 1000. See Documentation/Fit.md.
   */
  vtkNeuralMeshSetClampMacro(FitRounds, int, 0, 100);
  vtkGetMacro(FitRounds, int);
  vtkNeuralMeshSetClampMacro(FitSmoothness, double, 0.0, 1e6);
  vtkGetMacro(FitSmoothness, double);
  vtkNeuralMeshSetClampMacro(FitSamples, double, 1.0, 1000.0);
  vtkGetMacro(FitSamples, double);
  ///@}

  /** The presets, for SetPreset(). */
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
   * gives rounder triangles, takes time and blurs. Default 1 (thesis: 5 in the basic and the
   * normal-based variant without the list, else 1), range 0 to 100.
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
   * lambda of (9.4), noise-filtering and normal-based variant: the number of samples per vertex in
   * which a counter falls to its half; alpha_nc of (8.4) follows from it as alpha_n of (9.4).
   * Default 6 (thesis 6; for the normal-based variant it names none), range 0.01 to 1000000.
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
   * Noise-filtering variant: samples farther from their winner than OutlierLimit times epsilon_t are
   * outliers, from which nothing is learnt; 0 learns from all. Default 5 (thesis 0), range 0 to
   * 1000000. It holds from OutlierLimitVertices on (default 1000, at least 4): before, the mesh does
   * not know the rough shape, and what is far from it need not be an outlier.
   */
  vtkNeuralMeshSetClampMacro(OutlierLimit, double, 0.0, 1e6);
  vtkGetMacro(OutlierLimit, double);
  vtkNeuralMeshSetClampMacro(OutlierLimitVertices, int, 4, VTK_INT_MAX);
  vtkGetMacro(OutlierLimitVertices, int);
  ///@}

  ///@{
  /**
   * C_delta of (8.2): the number of moves behind M_delta, the mean change of the winner's normal, by
   * which changes are divided, and likewise behind the means of the changes of area and volume. In
   * large batches only every so-many-th move is observed, so that they come from everywhere; where
   * nothing but the learning curve and TargetNormalChange depends on them, every 64th.
   * Default 1000 (thesis 1000), range 2 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(ChangeWindow, int, 2, 1000000);
  vtkGetMacro(ChangeWindow, int);
  ///@}

  ///@{
  /**
   * A change counts as this multiple of the mean change at most, in the mean, too; 0 for no limit.
   * A triangle that folds turns a normal a thousand times farther than an edge of the shape does:
   * without a limit the mesh grows in its folds. Default 10 (the thesis names none), 0 to 1e9.
   */
  vtkNeuralMeshSetClampMacro(GainLimit, double, 0.0, 1e9);
  vtkGetMacro(GainLimit, double);
  ///@}

  ///@{
  /**
   * alpha_fd of (8.5): what is left of the feature strength of a vertex when it wins; the rest is
   * that of its move. More averages over more wins. Default 0.995 (the thesis names none), 0 to 1.
   */
  vtkNeuralMeshSetClampMacro(FeatureMemory, double, 0.0, 1.0);
  vtkGetMacro(FeatureMemory, double);
  ///@}

  ///@{
  /**
   * With ComputeFeatureStrength: the number of samples per vertex that are learnt, without growth,
   * once the mesh has all its vertices. While it grows vertices are not yet where they will be; 0
   * takes the strengths as growth leaves them. Default 400 (thesis: none), range 0 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(FeatureSamples, double, 0.0, 1e6);
  vtkGetMacro(FeatureSamples, double);
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
   * SamplesPerAddition, and RemovalPatience unless noise is filtered, are multiplied by this as long
   * as the mesh has less than EarlyVertices vertices: that makes twists and bridges rarer.
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

  /** The rules of topology learning, for SetTopologyRules(). */
  enum TopologyRulesType
  {
    MENDED_RULES,
    THESIS_RULES
  };

  ///@{
  /**
   * Topology learning: by which rules. THESIS_RULES are those of chapter 7 as written. MENDED_RULES
   * (default) are the same with what they need to work.
   */
  vtkNeuralMeshSetClampMacro(TopologyRules, int, MENDED_RULES, THESIS_RULES);
  vtkGetMacro(TopologyRules, int);
  void SetTopologyRulesToMended() { this->SetTopologyRules(MENDED_RULES); }
  void SetTopologyRulesToThesis() { this->SetTopologyRules(THESIS_RULES); }
  ///@}

  ///@{
  /**
   * C_top of chapter 9, topology learning: the number of samples per vertex between two calls.
   * Default 10 (thesis 10), range 0.01 to 1000000.
   */
  vtkNeuralMeshSetClampMacro(TopologyPatience, double, 0.01, 1e6);
  vtkGetMacro(TopologyPatience, double);
  ///@}

  ///@{
  /**
   * alpha_r of (7.4), topology learning: triangles larger than this multiple of the mean area are
   * removed. Less opens more. Default 10 (thesis 10), range 1 to 1e9.
   */
  vtkNeuralMeshSetClampMacro(TriangleRemovalFactor, double, 1.0, 1e9);
  vtkGetMacro(TriangleRemovalFactor, double);
  ///@}

  ///@{
  /**
   * alpha_m of (7.5), topology learning: boundaries are joined whose distance is less than this
   * multiple of the square root of the mean area of a triangle.
   * Default 2.576 (thesis 2.576), range 0 to 1e9.
   */
  vtkNeuralMeshSetClampMacro(BoundaryMergingFactor, double, 0.0, 1e9);
  vtkGetMacro(BoundaryMergingFactor, double);
  ///@}

  ///@{
  /**
   * Jump distance of chapter 11, with the list. JumpFraction: how far a winner jumps, as a fraction
   * of the number of vertices; default 1/3 (thesis 1/3), range 0 to 1. Parts of the four figures in
   * the WEIGHTED Jump, which divides by their sum: one must be above 0; defaults 1, range 0 to 1000.
   */
  vtkNeuralMeshSetClampMacro(JumpFraction, double, 0.0, 1.0);
  vtkGetMacro(JumpFraction, double);
  vtkNeuralMeshSetClampMacro(ConstantWeight, double, 0.0, 1000.0);
  vtkGetMacro(ConstantWeight, double);
  vtkNeuralMeshSetClampMacro(NormalWeight, double, 0.0, 1000.0);
  vtkGetMacro(NormalWeight, double);
  vtkNeuralMeshSetClampMacro(AreaWeight, double, 0.0, 1000.0);
  vtkGetMacro(AreaWeight, double);
  vtkNeuralMeshSetClampMacro(VolumeWeight, double, 0.0, 1000.0);
  vtkGetMacro(VolumeWeight, double);
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
   * Another size gives another mesh, as good. Default 65536 (thesis 1, one by one), 1 to 1048576.
   */
  vtkNeuralMeshSetClampMacro(BatchSize, int, 1, 1048576);
  vtkGetMacro(BatchSize, int);
  ///@}

  /**
   * Whether the properties go together. If not, an error says what does, as it does when the filter
   * is executed: a Jump other than CONSTANT needs Order LIST, and TopologyLearning another variant
   * than NORMAL_BASED.
   */
  bool CheckParameters();

protected:
  vtkNeuralMeshAlgorithm();
  ~vtkNeuralMeshAlgorithm() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override = 0;

  /** Puts the properties above into the parameters of a run. */
  void FillParameters(neuralmesh::Parameters& parameters) const;

private:
  vtkNeuralMeshAlgorithm(const vtkNeuralMeshAlgorithm&) = delete;
  void operator=(const vtkNeuralMeshAlgorithm&) = delete;

  /** Sets what the preset sets. Returns whether anything has changed. */
  bool ApplyPreset();

  int Variant = NOISE_FILTERING;
  int Order = EXACT;
  vtkTypeBool TopologyLearning = 0;
  int Boundaries = KEEP;
  int Jump = CONSTANT;
  int AdditionOperation = VERTEX_SPLIT;
  int RemovalOperation = HALF_EDGE_COLLAPSE;
  vtkTypeBool ComputeFeatureStrength = 0;
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
  int ChangeWindow = 0;
  double GainLimit = 0;
  double FeatureMemory = 0;
  double FeatureSamples = 0;
  int SamplesPerAddition = 0;
  double EarlyPatience = 0;
  int EarlyVertices = 0;
  int AdditionsPerRemoval = 0;
  double RemovalPatience = 0;
  double RemovalLimit = 0;
  vtkTypeBool EdgeFlips = 0;
  int TopologyRules = 0;
  double TopologyPatience = 0;
  double TriangleRemovalFactor = 0;
  double BoundaryMergingFactor = 0;
  double JumpFraction = 0;
  double ConstantWeight = 0;
  double NormalWeight = 0;
  double AreaWeight = 0;
  double VolumeWeight = 0;
  int ListVertices = 0;
  int BatchSize = 0;
  int Start = 0;
  double CurvatureDensity = 0;
  int FitRounds = 0;
  double FitSmoothness = 0;
  double FitSamples = 0;
};

#endif
