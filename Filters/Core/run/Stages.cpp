// SPDX-License-Identifier: BSD-3-Clause
#include "run/Stages.h"

#include "base/InterruptibleExecutor.h"
#include "cloud/MeshBuilder.h"
#include "cloud/RepeatedPoints.h"
#include "fit/CreaseRefinement.h"
#include "fit/NeededPieces.h"
#include "fit/Uncertainty.h"
#include "learn/SequentialLearner.h"
#include "mesh/QuadricSimplification.h"
#include "mesh/SmallPieces.h"
#include "run/MeshOrientation.h"
#include "run/NoiseWebs.h"
#include "run/ScatteredPoints.h"
#include "run/SpannedGaps.h"
#include "start/CurvatureDensity.h"
#include "start/FirstSurface.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// An advancing front may make a first surface with this part of the vertices. Learning adds the
/// others.
constexpr double PartOfFront = 0.75;

/// Exponents of the curvature in the density of the samples.
constexpr double UsualDensityExponent = 0.5;
constexpr double DensityExponentIfOpen = 0.25;
/// A piece with little area stays if its part of the vertices is so many times the part KeepPieces:
/// its points are too dense for outliers.
constexpr double VerticesOfDensePiece = 100.;
/// In a mesh with fewer vertices, claws and ears are no wider than edges: with an even density,
/// growth loses them.
constexpr std::uint64_t FewestDistributedLater = 10000;

/// Of the progress of an explanation.
constexpr double EndOfMeasuring = 0.7, EndOfExplaining = 0.85;

/// A mesh that is finished again is close to its points already. More rounds gain almost nothing.
constexpr int FidelityRoundsAgain = 2;

/// So many points are explained if only their numbers are wanted. They are as many as the fit uses,
/// as a part that is lost may have only a few points.
constexpr std::size_t FewestExplained = 10000;
constexpr std::size_t PointsPerVertexExplained = 10;
/// With so many points per vertex, almost every vertex rests on some.
constexpr std::size_t PointsPerVertexOfSupport = 4;

/// For each point of a cloud, 1 if it is not in `left`, which has some of the points in the same
/// order.
std::vector<std::uint8_t> leftOutOf(const PointCloud& cloud, const PointCloud& left)
{
  std::vector<std::uint8_t> result(cloud.points().size(), 1);
  for (std::size_t i = 0, kept = 0; i < cloud.points().size() && kept < left.points().size(); ++i)
  {
    if (!(squaredNorm(cloud.points()[i] - left.points()[kept]) > 0.f))
    {
      result[i] = 0;
      ++kept;
    }
  }
  return result;
}

/// Points that were counted to the wrong one of two close layers seem to go on where it ends.
void confirmTears(
  const Mesh& mesh, const PointCloud& cloud, Explanation& explanation, const Executor& executor)
{
  if (explanation.torn.any())
  {
    explanation.torn = findTornParts(
      cloud, exactly(explanation.asked, mesh, cloud, executor),
      [&](std::size_t i) { return explanation.reasons[i] == Reason::Explained; }, executor);
  }
}

/// Of points along a curve through space, the one in the middle most likely has others around it.
void findLeftOut(
  const PointCloud& cloud, const std::vector<std::uint8_t>& isLeftOut, Explanation& explanation)
{
  std::vector<std::size_t> leftOut;
  for (std::size_t i = 0; i < isLeftOut.size(); ++i)
  {
    if (isLeftOut[i] != 0)
    {
      leftOut.push_back(i);
    }
  }
  explanation.leftOutPoints = leftOut.size();
  if (!leftOut.empty())
  {
    explanation.leftOutPlace = cloud.toInput(cloud.points()[leftOut[leftOut.size() / 2]]);
  }
}

/// An even density is enough where later rounds of the fidelity move vertices to where they are
/// needed. These rounds keep boundaries as they are.
double densityExponent(const Parameters& parameters, const Mesh& first)
{
  if (parameters.curvatureDensity >= 0.)
  {
    return parameters.curvatureDensity;
  }
  if (parameters.numberOfVertices < FewestDistributedLater || parameters.fitRounds == 0 ||
    parameters.fidelity == Fidelity::Draft)
  {
    return UsualDensityExponent;
  }
  return first.isOpen() ? DensityExponentIfOpen : 0.;
}

std::size_t mostOfFront(const Parameters& parameters)
{
  return std::size_t(PartOfFront * double(parameters.numberOfVertices));
}

Beginning beginningWith(FirstSurface surface, const PointCloud& cloud, const Parameters& parameters,
  const Executor& executor)
{
  Beginning result;
  result.mesh = std::move(surface.mesh);
  result.isFromGrid = surface.resolution > 0;
  if (parameters.boundaries == Boundaries::Keep && surface.bridgeWidth > 0.)
  {
    result.gaps = GapPlan{ surface.bridgeWidth, result.isFromGrid, parameters.keepPieces };
  }
  const double density = densityExponent(parameters, *result.mesh);
  // The normal-based variant makes the mesh dense at bends by itself. Feature strength finds edges
  // best on an even mesh.
  if (density > 0. && parameters.variant != Variant::NormalBased &&
    !parameters.computeFeatureStrength)
  {
    result.weights = curvatureDensity(cloud, *result.mesh, density, executor);
  }
  return result;
}

/// The views of the points of a cloud by their indices in the cloud; `hints` have the indices of
/// the input.
PointViews viewsOf(const PointCloud& cloud, const OrientationHints& hints)
{
  return hints.viewOf && !cloud.origins().empty() ? [&](std::size_t point)
  { return hints.viewOf(cloud.origins()[point]); }
                                                  : PointViews();
}

FinishPlan finishPlan(const Parameters& parameters)
{
  return { .rounds = parameters.fitRounds,
    .fidelity = parameters.fidelity,
    .keepsPlaces = parameters.computeFeatureStrength,
    .smoothness = parameters.fitSmoothness,
    .searchesNear = parameters.fidelity == Fidelity::Draft,
    .tellsSmoothness = parameters.computeUncertainty,
    .samplesPerVertex = parameters.fitSamples,
    .gaps = {} };
}

/// If no round of the fidelity moves vertices to creases, one more plain round brings those near a
/// crease closer to it.
void addPlainRound(FinishPlan& plan) { plan.rounds += plan.rounds > 0 ? 1 : 0; }

/// For a mesh that is simplified afterwards, or was before: rounds of the fidelity would fit the
/// larger mesh.
void leaveOutFidelity(FinishPlan& plan)
{
  plan.fidelity = Fidelity::Draft;
  plan.residualTo = DistanceTo::TrianglesAtClosestVertex;
  addPlainRound(plan);
}

/// A vector with length 1; 0 if the given one is zero or not finite.
Vector4 givenDirection(const Eigen::Vector3d& vector)
{
  const double length = vector.stableNorm();
  return length > 0. && vector.allFinite() ? Vector4(Eigen::Vector3d(vector / length)) : Vector4();
}

/// The normals that came with the points of a cloud, by their indices in the cloud.
PointNormals normalsOf(const PointCloud& cloud, const OrientationHints& hints)
{
  return hints.normalOf && !cloud.origins().empty() ? [&](std::size_t point)
  { return givenDirection(hints.normalOf(cloud.origins()[point])); }
                                                    : PointNormals();
}

/// The first finish of a learnt mesh: without odd pieces, and with gaps opened and holes closed.
std::optional<FinishReport> finishFirst(LearntMesh& learnt, FinishPlan plan,
  const PointCloud& cloud, const Parameters& parameters, const std::optional<GapPlan>& gaps,
  const Progress& progress, const Executor& executor, const OrientationHints& hints)
{
  plan.gaps = gaps;
  plan.closedOutline = parameters.closeHolesBelow / cloud.unit();
  dropPieces(learnt.mesh,
    withoutNeeded(findOddPieces(learnt.mesh, parameters.keepPieces,
                    VerticesOfDensePiece * parameters.keepPieces, executor),
      learnt.mesh, cloud, parameters.keepPieces, executor));
  const std::optional<PointCloud> once = withoutRepetitions(cloud);
  const PointCloud& fitted = once ? *once : cloud;
  Finish finish(
    fitted, learnt.mesh, plan, executor, normalsOf(fitted, hints), viewsOf(fitted, hints));
  return progress(0.) && finish.run(progress) ? std::optional(finish.report()) : std::nullopt;
}
}

Beginning begin(const PointCloud& cloud, const Parameters& parameters, const Progress& progress,
  const Executor& executor)
{
  if (parameters.start == Start::Tetrahedron)
  {
    return {};
  }
  const std::optional<PointCloud> once = withoutRepetitions(cloud);
  auto surface = firstSurface(once ? *once : cloud,
    firstVertices(parameters.numberOfVertices, parameters.fidelity), mostOfFront(parameters),
    parameters.boundaries, progress, executor, parameters.keepPieces);
  return surface ? beginningWith(std::move(*surface), cloud, parameters, executor) : Beginning();
}

std::optional<Beginning> beginWithNarrowParts(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const Executor& executor)
{
  const std::optional<PointCloud> once = withoutRepetitions(cloud);
  auto surface = surfaceWithNarrowParts(once ? *once : cloud, mostOfFront(parameters),
    parameters.boundaries, progress, executor, parameters.keepPieces);
  return surface ? std::optional(beginningWith(std::move(*surface), cloud, parameters, executor))
                 : std::nullopt;
}

std::unique_ptr<Learner> learnerFrom(Beginning beginning, const PointCloud& cloud,
  const Parameters& parameters, const Executor& executor)
{
  return beginning.mesh
    ? Learner::from(*beginning.mesh, beginning.weights, cloud, parameters, executor)
    : std::make_unique<SequentialLearner>(cloud, parameters, executor);
}

StopReason ruleMet(const Learner& learner, StoppingRules& rules, const Progress& progress)
{
  return progress(rules.progress(learner)) ? rules.check(learner) : StopReason::Cancelled;
}

StopReason learn(Learner& learner, StoppingRules& rules, const Parameters& parameters,
  std::uint64_t samples, const Progress& progress, const std::function<void()>& afterBatch)
{
  samples = std::max<std::uint64_t>(samples, learner.batchSize());
  if (parameters.maximumIterations > 0)
  {
    samples = std::min(samples, parameters.maximumIterations - learner.counts().iterations);
  }
  learner.learn(samples, afterBatch);
  return ruleMet(learner, rules, progress);
}

std::optional<FinishReport> finish(LearntMesh& learnt, const PointCloud& cloud,
  const Parameters& parameters, const std::optional<GapPlan>& gaps, std::size_t vertexCount,
  const Progress& progress, const Executor& executor, const OrientationHints& hints)
{
  if (learnt.mesh.vertexCount() > vertexCount)
  {
    constexpr double EndOfFirst = 0.5;
    const std::optional<FinishReport> report = finishToSimplify(
      learnt, cloud, parameters, gaps, partOf(progress, 0., EndOfFirst), executor, hints);
    return report ? finishSimplified(learnt, *report, cloud, parameters, vertexCount,
                      partOf(progress, EndOfFirst, 1.), executor, hints)
                  : std::nullopt;
  }
  FinishPlan plan = finishPlan(parameters);
  plan.vertexCount = vertexCount;
  if (plan.keepsPlaces)
  {
    addPlainRound(plan);
  }
  return finishFirst(learnt, plan, cloud, parameters, gaps, progress, executor, hints);
}

std::optional<FinishReport> finishToSimplify(LearntMesh& learnt, const PointCloud& cloud,
  const Parameters& parameters, const std::optional<GapPlan>& gaps, const Progress& progress,
  const Executor& executor, const OrientationHints& hints)
{
  FinishPlan plan = finishPlan(parameters);
  plan.vertexCount = learnt.mesh.vertexCount();
  leaveOutFidelity(plan);
  return finishFirst(learnt, plan, cloud, parameters, gaps, progress, executor, hints);
}

std::optional<FinishReport> finishSimplified(LearntMesh& learnt, const FinishReport& before,
  const PointCloud& cloud, const Parameters& parameters, std::size_t vertexCount,
  const Progress& progress, const Executor& executor, const OrientationHints& hints)
{
  if (!simplifyByQuadrics(learnt.mesh, vertexCount, partOf(progress, 0., 0.)))
  {
    return {};
  }
  FinishPlan plan = finishPlan(parameters);
  leaveOutFidelity(plan);
  plan.vertexCount = learnt.mesh.vertexCount();
  const std::optional<PointCloud> once = withoutRepetitions(cloud);
  const PointCloud& fitted = once ? *once : cloud;
  Finish finish(
    fitted, learnt.mesh, plan, executor, normalsOf(fitted, hints), viewsOf(fitted, hints));
  if (!finish.run(progress))
  {
    return {};
  }
  // The figures of the fit are those of the larger mesh.
  FinishReport report = before;
  report.repaired = finish.report().repaired;
  report.left = finish.report().left;
  report.heldVertices = finish.report().heldVertices;
  report.smoothnessOfVertices = finish.report().smoothnessOfVertices;
  return report;
}

std::optional<FinishReport> finishAgain(LearntMesh& learnt, const FinishReport& before,
  const PointCloud& cloud, const Parameters& parameters, std::size_t vertexCount,
  const Progress& progress, const Executor& executor, const OrientationHints& hints)
{
  FinishPlan plan = finishPlan(parameters);
  plan.rounds = std::min(plan.rounds, 1);
  plan.mostFidelityRounds = FidelityRoundsAgain;
  const bool isSimplified = learnt.mesh.vertexCount() > vertexCount;
  if (isSimplified)
  {
    if (!simplifyByQuadrics(learnt.mesh, vertexCount, partOf(progress, 0., 0.)))
    {
      return {};
    }
    // On a clean cloud, the vertices are where they are needed already.
    plan.fidelity = before.isClean ? Fidelity::Draft : plan.fidelity;
  }
  plan.vertexCount = std::max(vertexCount, learnt.mesh.vertexCount());
  const std::optional<PointCloud> once = withoutRepetitions(cloud);
  const PointCloud& fitted = once ? *once : cloud;
  Finish finish(
    fitted, learnt.mesh, plan, executor, normalsOf(fitted, hints), viewsOf(fitted, hints));
  if (!finish.run(progress))
  {
    return {};
  }
  // After a simplification, the figures of the fit are those of the finer mesh.
  const bool isTold = !isSimplified && finish.report().roundsTakenBack == 0;
  FinishReport report = isTold ? finish.report() : before;
  report.gapTriangles = before.gapTriangles;
  report.repaired = finish.report().repaired;
  report.left = finish.report().left;
  report.heldVertices = finish.report().heldVertices;
  report.smoothnessOfVertices = finish.report().smoothnessOfVertices;
  return report;
}

bool refineFinished(LearntMesh& learnt, const PointCloud& cloud, const Parameters& parameters,
  std::size_t vertexCount, FinishReport& report, const Progress& progress, const Executor& executor)
{
  const std::optional<PointCloud> once = withoutRepetitions(cloud);
  return refineBesideCreases(once ? *once : cloud, learnt.mesh, vertexCount, parameters.fitSamples,
    report, executor, progress);
}

bool tellUncertainty(LearntMesh& learnt, const PointCloud& cloud, const Parameters& parameters,
  Reconstruction& result, const Progress& progress, const Executor& executor,
  const OrientationHints& hints)
{
  const std::optional<PointCloud> once = withoutRepetitions(cloud);
  const PointCloud& fitted = once ? *once : cloud;
  const UncertaintyPlan plan{ .samples = std::size_t(
                                parameters.fitSamples * double(learnt.mesh.vertexCount())),
    .seed = std::uint64_t(parameters.seed) };
  Uncertainty uncertainty(
    fitted, learnt.mesh, *result.finish, plan, executor, viewsOf(fitted, hints));
  if (!uncertainty.run(progress))
  {
    return false;
  }
  if (uncertainty.isTold())
  {
    learnt.uncertainty = learnt.mesh.addProperty(0.f, OnSplit::Copy);
    std::copy(uncertainty.deviations().begin(), uncertainty.deviations().end(),
      learnt.mesh.values(*learnt.uncertainty).begin());
    result.disagreeingShare = uncertainty.disagreement().share;
    result.disagreement = uncertainty.disagreement().place;
  }
  return true;
}

void describe(LearntMesh learnt, const PointCloud& cloud, const PointCloud* all,
  const OrientationHints& hints, Reconstruction& result, const Progress& progress,
  const Executor& executor)
{
  // A run that is ended here has a mesh without a report.
  bool goesOn = progress(0.);
  result.orientation = orientMesh(learnt.mesh, cloud, hints, executor.uninterrupted());
  goesOn = goesOn && progress(0.);
  result.mesh = trianglesOf(learnt.mesh, cloud, executor.uninterrupted());
  const auto activities = learnt.mesh.values(learnt.activity);
  result.activities.assign(activities.begin(), activities.end());
  if (learnt.featureStrength)
  {
    const auto strengths = learnt.mesh.values(*learnt.featureStrength);
    result.featureStrengths.assign(strengths.begin(), strengths.end());
  }
  if (learnt.uncertainty)
  {
    const auto deviations = learnt.mesh.values(*learnt.uncertainty);
    result.uncertainties.resize(deviations.size());
    std::transform(deviations.begin(), deviations.end(), result.uncertainties.begin(),
      [&](float deviation) { return float(double(deviation) * cloud.unit()); });
  }
  if (all && goesOn && progress(0.))
  {
    result.quality = unlessInterrupted(
      [&]
      {
        return measureQuality(
          *all, learnt.mesh, result.mesh, executor, DistanceTo::SurfaceAgain, progress);
      });
  }
  // Measuring takes more memory.
  result.normals = pointNormals(result.mesh);
  result.surface = std::move(learnt.mesh);
}

bool explainPoints(const PointCloud& cloud, const PointCloud* left, double leastPiece,
  bool explainsAll, Reconstruction& result, const Progress& progress, const Executor& executor)
{
  ExplanationRules rules;
  rules.leastPiece = leastPiece;
  if (left)
  {
    rules.isLeftOut = leftOutOf(cloud, *left);
  }
  const std::size_t vertices = result.surface.vertexCount();
  const auto mostOf = [&](std::size_t some) { return explainsAll ? cloud.points().size() : some; };
  rules.usuallyAsked = std::max(FewestExplained, PointsPerVertexExplained * vertices);
  std::optional<MeasuredPoints> measured = measurePoints(result.surface, cloud,
    { mostOf(rules.usuallyAsked), mostOf(PointsPerVertexOfSupport * vertices), rules.usuallyAsked },
    partOf(progress, 0., EndOfMeasuring), executor);
  if (!measured || !progress(EndOfMeasuring))
  {
    return false;
  }
  result.explanation = explain(cloud, std::move(measured->distances), rules, executor);
  confirmTears(result.surface, cloud, *result.explanation, executor);
  findLeftOut(cloud, rules.isLeftOut, *result.explanation);
  result.explanation->scatteredShare = scatteredShare(cloud, executor);
  if (!progress(EndOfExplaining))
  {
    return false;
  }
  // An interruption leaves neither.
  result.gaps = spannedGaps(result.surface, measured->support, measured->onTriangles, cloud,
    result.explanation->asked, executor);
  if (result.finish && !result.finish->isClean)
  {
    result.noiseWebs = findNoiseWebs(result.surface, measured->support, cloud, executor);
  }
  result.support = std::move(measured->support);
  return progress(1.);
}
}
