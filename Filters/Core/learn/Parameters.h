// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace neuralmesh
{
enum class Variant
{
  Basic,          ///< Algorithm 1
  NoiseFiltering, ///< Algorithm 4
  NormalBased     ///< Algorithm 3
};

enum class Preset
{
  Default, ///< what measures best
  Thesis   ///< the thesis's own values and nothing that it lacks
};

/// How the activity of the vertices is known.
enum class Order
{
  Exact, ///< counters
  List   ///< the activity list (chapter 11)
};

/// By which rules topology is learnt.
enum class TopologyRules
{
  Mended, ///< the thesis's, with what they need to work
  Thesis  ///< as written (chapter 7)
};

/// How far a winner jumps in the activity list (11.2.1).
enum class Jump
{
  Constant,       ///< all winners alike; in the normal-based variant by normal activity
  NormalActivity, ///< as the move turns the winner's normal
  AreaChange,     ///< as it changes the area of the winner's star
  VolumeChange,   ///< as it changes the enclosed volume
  Weighted        ///< a mean of all these
};

/// What adds a vertex (Figure 6.6).
enum class AdditionOperation
{
  VertexSplit,
  EdgeSplit
};

/// What removes a vertex (Figure 6.7).
enum class RemovalOperation
{
  HalfEdgeCollapse,
  FullEdgeCollapse,
  VertexDelete
};

/// What learning starts from, where no first mesh is given.
enum class Start
{
  OccupiedSpace, ///< a coarse surface of the space that the cloud occupies or encloses
  Tetrahedron    ///< as in the thesis
};

/// What becomes of gaps in the scan.
enum class Boundaries
{
  Keep, ///< the mesh ends where the data ends
  Close ///< the mesh is closed
};

/// All parameters of a run, with the product's defaults. Equation and section numbers are those of
/// W. Saleem, A flexible framework for learning-based surface reconstruction, 2004. Ranges stand
/// with the properties of vtkNeuralMeshAlgorithm and vtkNeuralMesh, which are named alike.
// By concept, not by size: there is one of it in a run.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding)
struct Parameters
{
  Variant variant = Variant::NoiseFiltering;
  Order order = Order::Exact;
  std::uint64_t seed = 1;

  // Start
  Start start = Start::OccupiedSpace;
  Boundaries boundaries = Boundaries::Keep;
  double curvatureDensity = 0.5; ///< exponent; 0 = samples are drawn alike

  // Geometry learning
  double winnerRate = 0.1;         ///< alpha_w (6.1), (9.1)
  double smoothingRate = 0.2;      ///< alpha_L (6.4)
  int smoothingIterations = 1;     ///< C_L
  double counterDecay = 0.95;      ///< alpha_sc (6.6), basic variant
  double counterHalfLife = 6.;     ///< lambda (9.4), samples per vertex; not in the basic variant
  double noiseTolerance = 1.;      ///< alpha_f (9.2)
  int noiseWindow = 1000;          ///< observations behind M_d and sigma_d
  double outlierLimit = 5.;        ///< multiple of epsilon_t beyond which samples are rejected
  int outlierLimitVertices = 1000; ///< no sample is rejected before M has so many vertices

  // What the moves of winners change
  int changeWindow = 1000;             ///< C_delta (8.2), observations
  double gainLimit = 10.;              ///< of a change over its mean; 0 = none
  bool computeFeatureStrength = false; ///< eta (8.5)
  double featureMemory = 0.995;        ///< alpha_fd (8.5)
  double featureSamples = 400.;        ///< samples per vertex for it once M has all its vertices

  // Growth
  int samplesPerAddition = 50;  ///< C_vs
  double earlyPatience = 4.;    ///< C_vs is multiplied by it at first
  int earlyVertices = 1000;     ///< ... until M has so many vertices
  int additionsPerRemoval = 10; ///< C_nr, noise filtering
  double removalPatience = 10.; ///< C_ec, samples per vertex
  double removalLimit = 0.5;    ///< removals per addition at most, noise filtering; 0 = any
  bool edgeFlips = true;        ///< flips towards regular valences around splits, collapses

  AdditionOperation additionOperation = AdditionOperation::VertexSplit;
  RemovalOperation removalOperation = RemovalOperation::HalfEdgeCollapse;

  // Topology learning
  bool topologyLearning = false;
  TopologyRules topologyRules = TopologyRules::Mended;
  double topologyPatience = 10.;        ///< C_top, samples per vertex
  double triangleRemovalFactor = 10.;   ///< alpha_r (7.4)
  double boundaryMergingFactor = 2.576; ///< alpha_m (7.5)

  // The activity list
  Jump jump = Jump::Constant;
  double jumpFraction = 1. / 3.; ///< how far a winner jumps, fraction of n
  double constantWeight = 1.;    ///< shares in a weighted jump
  double normalWeight = 1.;
  double areaWeight = 1.;
  double volumeWeight = 1.;
  int listVertices = 1000; ///< exact counters until M has so many vertices

  // Finish
  int fitRounds = 3;         ///< of the least-squares fit; 0 = none
  double fitSmoothness = 0.; ///< lambda; 0 = by the noise and the shape
  double fitSamples = 10.;   ///< samples per vertex

  // Samples
  int batchSize = 65536; ///< samples whose winners are searched at once, at most

  // Stopping rules; 0 = none, but for the first and the last
  std::uint64_t numberOfVertices = 20000;
  std::uint64_t maximumIterations = 0;
  double targetSampleDistance = 0.; ///< mean |s - v_w|, fraction of the diagonal
  double targetCloudDistance = 0.;  ///< mean distance of P to M, fraction of the diagonal
  double targetNormalChange = 0.;   ///< mean change of the winner's normal, M_delta
  double timeLimit = 0.;            ///< seconds
  double stallPatience = 200.;      ///< samples per vertex without growth

  /// The values of the thesis for a variant and an order, or those of the product.
  static Parameters of(Preset preset, Variant variant, Order order = Order::Exact);

  bool filtersNoise() const { return variant == Variant::NoiseFiltering; }

  /// Which of these values exclude each other, in words; empty if a run can be made of them.
  std::vector<std::string> errors() const;
  /// What does not go together in these values, or with a cloud of so many points, in words; empty
  /// if all is well.
  std::vector<std::string> warnings(std::size_t pointCount) const;
};
}
