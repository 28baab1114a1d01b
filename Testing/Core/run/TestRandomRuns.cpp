// SPDX-License-Identifier: BSD-3-Clause
// All parameters at once, and clouds of all kinds. The cases are the same each time. There are more of
// them, and each says its number before it begins, with NEURALMESH_RANDOM_RUNS=10000 in the
// environment; NEURALMESH_RANDOM_FIRST is the number of the first one, to see one again.
#include "AnyCloud.h"
#include "AnyParameters.h"
#include "base/ThreadPool.h"
#include "cloud/MeshBuilder.h"
#include "mesh/Simplification.h"
#include "MeshTools.h"
#include "run/Ensemble.h"
#include "run/Reconstruction.h"
#include "run/StreamingReconstruction.h"
#include "SphereRuns.h"
#include "start/VoxelSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>

#include <unistd.h>

namespace neuralmesh::testing
{
namespace
{
/// As a process that is killed.
struct Stopped : std::exception
{
};

std::uint64_t fromEnvironment(const char* name, std::uint64_t otherwise)
{
  const char* const value = std::getenv(name);
  return value ? std::strtoull(value, nullptr, 10) : otherwise;
}

/// Calls `run` with the number of each case, and tells it where an expectation fails.
void forEachCase(std::uint64_t usually, const std::function<void(std::uint64_t)>& run)
{
  const std::uint64_t many = fromEnvironment("NEURALMESH_RANDOM_RUNS", 0);
  const std::uint64_t first = fromEnvironment("NEURALMESH_RANDOM_FIRST", 1);
  for (std::uint64_t i = first; i < first + (many > 0 ? many : usually); ++i)
  {
    if (many > 0)
    {
      std::fprintf(stderr, "case %llu\n", static_cast<unsigned long long>(i));
    }
    SCOPED_TRACE("NEURALMESH_RANDOM_RUNS=1 NEURALMESH_RANDOM_FIRST=" + std::to_string(i));
    run(i);
  }
}

std::string inWords(const Parameters& parameters)
{
  std::ostringstream text;
  text.precision(17);
  forEachParameter(
    [&](const auto& entry)
    {
      if (parameters.*entry.place != Parameters().*entry.place)
      {
        text << entry.name << " " << static_cast<double>(parameters.*entry.place) << ", ";
      }
    });
  return text.str();
}

template <typename Value>
void append(std::string& bytes, const std::vector<Value>& values)
{
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

std::string bytesOf(const Reconstruction& run)
{
  std::string bytes;
  append(bytes, run.mesh.points);
  append(bytes, run.mesh.triangles);
  append(bytes, run.normals);
  append(bytes, run.activities);
  append(bytes, run.featureStrengths);
  append(bytes, run.uncertainties);
  return bytes;
}

void expectSound(const TriangleMesh& mesh)
{
  EXPECT_EQ(checkManifold(mesh.points.size(), mesh.triangles).defect, "");
  EXPECT_TRUE(std::all_of(mesh.points.begin(), mesh.points.end(),
    [](const Eigen::Vector3d& point) { return point.allFinite(); }));
}

void expectFinite(const std::vector<double>& values)
{
  EXPECT_TRUE(std::all_of(values.begin(), values.end(),
    [](double value) { return std::isfinite(value) && value >= 0.; }));
}

/// What every result must be, of so many vertices at most.
void expectSound(const Reconstruction& run, std::size_t mostVertices, bool hasFeatureStrengths)
{
  EXPECT_EQ(defectOf(run.surface), "");
  expectSound(run.mesh);
  const std::size_t vertices = run.mesh.points.size();
  EXPECT_GT(vertices, 0u);
  EXPECT_LE(vertices, mostVertices);
  EXPECT_EQ(run.surface.vertexCount(), vertices);
  EXPECT_EQ(run.normals.size(), vertices);
  EXPECT_EQ(run.activities.size(), vertices);
  EXPECT_EQ(run.featureStrengths.size(), hasFeatureStrengths ? vertices : 0u);
  EXPECT_TRUE(std::all_of(run.normals.begin(), run.normals.end(),
    [](const Eigen::Vector3d& normal) { return normal.allFinite(); }));
  expectFinite(run.activities);
  expectFinite(run.featureStrengths);
  EXPECT_TRUE(run.uncertainties.empty() || run.uncertainties.size() == vertices);
  expectFinite({ run.uncertainties.begin(), run.uncertainties.end() });
  if (run.finish)
  {
    expectFinite({ run.finish->noise, run.finish->smoothness, run.finish->outlierShare });
  }
  if (run.quality)
  {
    expectFinite({ run.quality->residual, run.quality->outlierShare });
  }
}

Parameters parametersOfRun(AnyChoice& choice)
{
  Parameters parameters = anyParameters(choice, 1u << (2 * choice.below(4)));
  if (choice.isOneOf(3))
  {
    // With more passes of smoothing each sample takes longer.
    parameters.maximumIterations =
      1 + parameters.maximumIterations / (1 + std::uint64_t(parameters.smoothingIterations) / 4);
    return parameters;
  }
  // Learning that comes to its end, for what is done with a mesh then.
  parameters.start = choice.isOneOf(4) ? parameters.start : Start::OccupiedSpace;
  parameters.boundaries = choice.isOneOf(4) ? parameters.boundaries : Boundaries::Keep;
  parameters.fitRounds = 1 + int(choice.below(3));
  parameters.numberOfVertices = 100 + choice.below(500);
  parameters.maximumIterations = 40000;
  parameters.samplesPerAddition = 1 + int(choice.below(20));
  parameters.additionsPerRemoval = std::max(parameters.additionsPerRemoval, 2);
  parameters.earlyPatience = 1.;
  parameters.smoothingIterations = int(choice.below(3));
  parameters.featureSamples = std::min(parameters.featureSamples, 10.);
  parameters.computeUncertainty = choice.isOneOf(3);
  return parameters;
}

PointCloud makeCloud(const Points& points, AnyChoice& choice, const Executor& executor)
{
  std::vector<double> weights(choice.isOneOf(4) ? points.size() : 0);
  for (double& weight : weights)
  {
    weight = double(choice.below(4));
  }
  return PointCloud(points, weights, choice.isOneOf(2), executor);
}

/// A shape about as large as the cloud, in most runs none.
std::optional<Mesh> anyFirstMesh(AnyChoice& choice, const PointCloud& cloud)
{
  const std::uint32_t kind = choice.below(24);
  if (kind > 3)
  {
    return std::nullopt;
  }
  const unsigned size = 1 + choice.below(8);
  TriangleMesh shape = kind == 0 ? makeSphere(size)
    : kind == 1                  ? makeTorus(0.4, 2 + size)
    : kind == 2                  ? makeGrid(size)
                                 : makeTriangleFan(2 + size, choice.isOneOf(2));
  for (Eigen::Vector3d& point : shape.points)
  {
    point = cloud.toInput(Vector4(Eigen::Vector3d(0.5 * point)));
  }
  return buildMesh(shape, cloud);
}

/// A run that is stopped, maybe, and goes on from its checkpoint.
Reconstruction runWithCheckpoint(const PointCloud& cloud, const Parameters& parameters,
  const std::optional<Mesh>& first, std::uint32_t stopAfter)
{
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
    ("neuralmesh-random." + std::to_string(getpid()) + ".checkpoint");
  const CheckpointPlan plan{ path.string(), 0. };
  try
  {
    reconstruct(
      cloud, parameters,
      [&](double)
      {
        if (stopAfter-- == 0)
        {
          throw Stopped();
        }
        return true;
      },
      first, {}, plan);
  }
  catch (const Stopped&)
  {
  }
  Reconstruction result = reconstruct(cloud, parameters, goOn, first, {}, plan);
  std::filesystem::remove(path);
  return result;
}
}

// Each parameter that there is is varied by the random runs, within its range.
TEST(RandomRuns, VaryEveryParameter)
{
  std::map<std::string, std::set<double>> seen;
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
  {
    AnyChoice choice(seed);
    const Parameters parameters = anyParameters(choice, 4);
    EXPECT_TRUE(parameters.errors().empty());
    forEachParameter([&](const auto& entry)
      { seen[entry.name].insert(static_cast<double>(parameters.*entry.place)); });
  }
  forEachParameter(
    [&](const auto& entry)
    {
      const std::set<double>& values = seen[entry.name];
      EXPECT_EQ(values.size() > 1u, entry.changesResult) << entry.name;
      EXPECT_GE(*values.begin(), entry.range.low) << entry.name;
      EXPECT_LE(*values.rbegin(), entry.range.high) << entry.name;
    });
}

// Whatever the parameters, the cloud, the weights and the first mesh: the result is an oriented
// manifold of finite numbers, each vertex has what belongs to it, and they are no more than wanted.
// It is the same to the byte on any number of threads, after a break, and if somebody watches.
TEST(RandomRuns, Reconstructions)
{
  forEachCase(50,
    [](std::uint64_t seed)
    {
      AnyChoice choice(seed);
      const Parameters parameters = parametersOfRun(choice);
      SCOPED_TRACE(inWords(parameters));
      const Points points = anyCloud(choice);
      AnyChoice ofCloud(seed);
      const PointCloud cloud = makeCloud(points, ofCloud, Executor::sequential());
      if (!cloud.hasExtent())
      {
        return;
      }
      const std::optional<Mesh> first = anyFirstMesh(choice, cloud);
      const std::size_t mostVertices =
        std::max<std::size_t>(parameters.numberOfVertices, first ? first->vertexCount() : 4);
      const Reconstruction run = reconstruct(cloud, parameters, goOn, first);
      expectSound(run, mostVertices, parameters.computeFeatureStrength);
      const std::string bytes = bytesOf(run);
      const std::uint32_t also = choice.below(8);
      if (also < 3)
      {
        const ThreadPool pool(1 + also);
        AnyChoice ofOther(seed);
        const PointCloud other = makeCloud(points, ofOther, pool);
        EXPECT_TRUE(bytesOf(reconstruct(other, parameters, goOn, first, {}, {}, pool)) == bytes);
      }
      else if (also == 3)
      {
        GrowthWatch watch;
        watch.snapshots = 2 + choice.below(5);
        watch.take = [&](const GrowthSnapshot& snapshot)
        {
          expectSound(snapshot.mesh());
          EXPECT_EQ(snapshot.activities.size(), snapshot.points.size());
        };
        EXPECT_TRUE(bytesOf(reconstruct(cloud, parameters, goOn, first, watch)) == bytes);
      }
      else if (also == 4)
      {
        EXPECT_TRUE(
          bytesOf(runWithCheckpoint(cloud, parameters, first, choice.below(40))) == bytes);
      }
      else if (also == 5)
      {
        std::uint32_t left = choice.below(40);
        const Reconstruction ended = reconstruct(
          cloud, parameters, [&](double) { return left > 0 && --left > 0; }, first);
        expectSound(ended, mostVertices, parameters.computeFeatureStrength);
      }
    });
}

// Whatever the parameters, and whatever comes in whichever parts: the mesh of a stream is sound at any
// time, finished and as it is.
TEST(RandomRuns, Streams)
{
  forEachCase(15,
    [](std::uint64_t seed)
    {
      AnyChoice choice(seed);
      Parameters parameters = parametersOfRun(choice);
      parameters.variant = Variant::NoiseFiltering;
      parameters.order = Order::Exact;
      parameters.jump = Jump::Constant;
      parameters.topologyLearning = false;
      parameters.computeFeatureStrength = false;
      SCOPED_TRACE(inWords(parameters));
      StreamingReconstruction stream(parameters, 100 + choice.below(3000));
      for (std::uint32_t parts = 1 + choice.below(4); parts > 0; --parts)
      {
        const Points points = anyCloud(choice);
        stream.addPoints(std::span(points).first(choice.below(std::uint32_t(points.size()) + 1)));
        stream.learn(choice.below(std::uint32_t(parameters.maximumIterations)), goOn);
        if (stream.hasMesh())
        {
          expectSound(stream.mesh(false, goOn), parameters.numberOfVertices, false);
          expectSound(stream.mesh(true, goOn), parameters.numberOfVertices, false);
        }
      }
    });
}

// Whatever its parameters, what an ensemble agrees on is bounded by a closed manifold, from which
// learning can start, and its members are sound.
TEST(RandomRuns, Ensembles)
{
  forEachCase(8,
    [](std::uint64_t seed)
    {
      AnyChoice choice(seed);
      const PointCloud cloud(anyCloud(choice));
      if (!cloud.hasExtent())
      {
        return;
      }
      EnsembleParameters parameters;
      parameters.seed = seed;
      parameters.numberOfMembers = 1 + choice.below(4);
      parameters.verticesPerMember = 50 + choice.below(100);
      parameters.memberSamplesPerAddition = int(choice.number(1., 50.));
      parameters.memberRemovalPatience = choice.isOneOf(2) ? 10. : choice.number(0.01, 1e6);
      parameters.gridResolution = 4 + choice.below(20);
      Ensemble ensemble(cloud, parameters);
      for (std::size_t turn = 0; turn < 20 && !ensemble.isLearnt(); ++turn)
      {
        ensemble.learn(turn % ensemble.size());
      }
      for (std::size_t member = 0; member < ensemble.size(); ++member)
      {
        EXPECT_EQ(defectOf(ensemble.renumberedMesh(member)), "");
        ensemble.findPhantoms(member);
      }
      ensemble.makeGrid(ensemble.boxes());
      for (std::size_t member = 0; member < ensemble.size(); ++member)
      {
        ensemble.voxelize(member);
      }
      const VoxelVotes votes = ensemble.votes();
      const std::vector<std::uint8_t> solid = averageSolid(votes);
      const TriangleMesh surface = voxelSurface(votes.grid, solid);
      expectSound(surface);
      EXPECT_TRUE(checkManifold(surface.points.size(), surface.triangles).isClosed());
      if (surface.triangles.empty())
      {
        return;
      }
      Parameters ofRun = parametersOfRun(choice);
      SCOPED_TRACE(inWords(ofRun));
      Mesh average = buildMesh(surface, cloud);
      simplify(average, ofRun.numberOfVertices / 2);
      EXPECT_EQ(defectOf(average), "");
      expectSound(reconstruct(cloud, ofRun, goOn, average),
        std::max<std::size_t>(ofRun.numberOfVertices, average.vertexCount()),
        ofRun.computeFeatureStrength);
    });
}
}
