// SPDX-License-Identifier: BSD-3-Clause
#include "base/Checksum.h"
#include "base/Random.h"
#include "run/Checkpoint.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include <unistd.h>

namespace neuralmesh::testing
{
namespace
{
namespace fs = std::filesystem;

/// As a process that is killed: nothing that would come after the moment is done.
struct Killed : std::exception
{
};

enum class Ending
{
  Kill,
  Cancel
};

/// A folder for the checkpoint of a test.
class Checkpoints : public ::testing::Test
{
protected:
  Checkpoints()
    : folder_(fs::temp_directory_path() / ("neuralmesh-checkpoints." + std::to_string(getpid())))
  {
    fs::create_directories(this->folder_);
  }
  ~Checkpoints() override { fs::remove_all(this->folder_); }

  /// A checkpoint whenever one can be made.
  CheckpointPlan plan() const
  {
    CheckpointPlan result;
    result.path = this->path();
    result.interval = 0.;
    return result;
  }
  std::string path() const { return (this->folder_ / "run.checkpoint").string(); }

  std::string contents() const
  {
    std::ifstream file(this->path(), std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }
  void setContents(const std::string& bytes) const
  {
    std::ofstream(this->path(), std::ios::binary) << bytes;
  }

  /// Runs until progress has been told `calls` times; nothing if it was killed then.
  std::optional<Reconstruction> run(const PointCloud& cloud, const Parameters& parameters,
    std::uint32_t calls = std::numeric_limits<std::uint32_t>::max(),
    Ending ending = Ending::Kill) const
  {
    const auto progress = [&calls, ending](double)
    {
      if (calls > 0)
      {
        --calls;
        return true;
      }
      if (ending == Ending::Kill)
      {
        throw Killed();
      }
      return false;
    };
    try
    {
      return reconstruct(cloud, parameters, progress, {}, {}, this->plan());
    }
    catch (const Killed&)
    {
      return {};
    }
  }

  /// What is wrong with the checkpoint for this run; empty if it goes on.
  std::string refusal(const PointCloud& cloud, const Parameters& parameters) const
  {
    try
    {
      this->run(cloud, parameters);
      return "";
    }
    catch (const std::runtime_error& error)
    {
      return error.what();
    }
  }

  fs::path folder_;
};

/// All but the times.
void expectSame(const Reconstruction& a, const Reconstruction& b)
{
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.activities, b.activities);
  EXPECT_EQ(a.featureStrengths, b.featureStrengths);
  EXPECT_EQ(a.stopReason, b.stopReason);
  const auto numbers = [](const LearningCurve::Row& row)
  {
    const RunCounts& counts = row.counts;
    return std::vector<double>{ double(counts.iterations), double(counts.rejectedSamples),
      double(counts.additions), double(counts.removals), double(counts.flips),
      double(counts.illegalOperations), double(counts.removedTriangles),
      double(counts.mergedBoundaries), double(counts.filledBoundaries), double(row.vertices),
      row.sampleDistanceMean, row.sampleDistanceDeviation, row.normalChangeMean, row.regularRatio };
  };
  ASSERT_EQ(a.curve.rows().size(), b.curve.rows().size());
  for (std::size_t i = 0; i < a.curve.rows().size(); ++i)
  {
    EXPECT_EQ(numbers(a.curve.rows()[i]), numbers(b.curve.rows()[i])) << "row " << i;
    EXPECT_TRUE(i == 0 || b.curve.rows()[i - 1].seconds <= b.curve.rows()[i].seconds);
  }
  EXPECT_EQ(a.counts.iterations, b.counts.iterations);
}

/// A hemisphere with noise and outliers: with a boundary, and something to reject.
const PointCloud& hardCloud()
{
  static const PointCloud cloud = []
  {
    CloudOptions options;
    options.count = 6000;
    options.noise = 0.005;
    options.outliers = 0.02;
    std::vector<Eigen::Vector3d> points = sphereCloud(options);
    std::erase_if(points, [](const Eigen::Vector3d& point) { return point.z() < -0.2; });
    return PointCloud(points);
  }();
  return cloud;
}

struct Case
{
  Preset preset;
  Variant variant;
  Order order;
  bool topology;
  bool features;
};

Parameters parametersOf(const Case& which)
{
  Parameters parameters = Parameters::of(which.preset, which.variant, which.order);
  parameters.numberOfVertices = 700;
  parameters.listVertices = 300;
  parameters.topologyLearning = which.topology;
  parameters.computeFeatureStrength = which.features;
  parameters.featureSamples = 20.;
  parameters.start = Start::Tetrahedron;
  parameters.fitRounds = 0;
  return parameters;
}

std::vector<Case> allCases()
{
  std::vector<Case> cases;
  for (const Preset preset : { Preset::Default, Preset::Thesis })
  {
    for (const Variant variant : { Variant::Basic, Variant::NoiseFiltering, Variant::NormalBased })
    {
      for (const Order order : { Order::Exact, Order::List })
      {
        for (const bool topology : { false, true })
        {
          for (const bool features : { false, true })
          {
            if (!topology || variant != Variant::NormalBased)
            {
              cases.push_back({ preset, variant, order, topology, features });
            }
          }
        }
      }
    }
  }
  return cases;
}

std::string caseName(const ::testing::TestParamInfo<Case>& info)
{
  const auto [preset, variant, order, topology, features] = info.param;
  return std::string(preset == Preset::Default ? "Default" : "Thesis") +
    (variant == Variant::Basic            ? "Basic"
        : variant == Variant::NormalBased ? "NormalBased"
                                          : "NoiseFiltering") +
    (order == Order::List ? "List" : "") + (topology ? "Topology" : "") +
    (features ? "Features" : "");
}

class EveryCheckpoint
  : public Checkpoints
  , public ::testing::WithParamInterface<Case>
{
};
INSTANTIATE_TEST_SUITE_P(Checkpoint, EveryCheckpoint, ::testing::ValuesIn(allCases()), caseName);

Parameters fewVertices()
{
  Parameters parameters;
  parameters.numberOfVertices = 200;
  parameters.start = Start::Tetrahedron;
  parameters.fitRounds = 0;
  return parameters;
}
}

// A run that is killed or cancelled again and again ends with the same bytes as an unbroken one.
TEST_P(EveryCheckpoint, GoesOnToTheSameBytes)
{
  const Parameters parameters = parametersOf(this->GetParam());
  const Reconstruction unbroken = reconstruct(hardCloud(), parameters, goOn);
  Random random(unbroken.counts.iterations);
  std::optional<Reconstruction> result;
  std::uint64_t learnt = 0, resumed = 0;
  for (int tries = 0; !result || result->stopReason == StopReason::Cancelled; ++tries)
  {
    ASSERT_LT(tries, 100);
    const Ending ending = random.below(2) == 0 ? Ending::Kill : Ending::Cancel;
    result = this->run(hardCloud(), parameters, 2 + random.below(5 + 3 * unsigned(tries)), ending);
    if (result)
    {
      EXPECT_GE(result->resumedIterations, learnt);
      resumed += result->resumedIterations > 0;
      learnt = result->counts.iterations;
    }
  }
  EXPECT_GT(resumed, 0u);
  expectSame(unbroken, *result);
  // Once more, from the end of learning.
  result = this->run(hardCloud(), parameters);
  EXPECT_EQ(result->resumedIterations, unbroken.counts.iterations);
  expectSame(unbroken, *result);
}

// So does one that is broken anywhere in its start, in learning or in the finish.
TEST_F(Checkpoints, CoverTheWholeRun)
{
  Parameters parameters;
  parameters.numberOfVertices = 400;
  int calls = 0;
  const Reconstruction unbroken =
    reconstruct(hardCloud(), parameters, [&](double) { return ++calls > 0; });
  for (const Ending ending : { Ending::Kill, Ending::Cancel })
  {
    for (int part = 0; part < 8; ++part)
    {
      fs::remove(this->path());
      this->run(hardCloud(), parameters, std::uint32_t(calls * part / 8), ending);
      this->run(hardCloud(), parameters, std::uint32_t(calls / 2), ending);
      expectSame(unbroken, *this->run(hardCloud(), parameters));
    }
  }
}

// So do runs that end by another rule, also where that is not met any more when it is asked again.
TEST_F(Checkpoints, GoOnWithEveryStoppingRule)
{
  Parameters many = fewVertices();
  many.numberOfVertices = 3000;
  std::vector<Parameters> cases(4, many);
  cases[0].targetCloudDistance = 0.02;
  cases[1].targetSampleDistance = 0.06;
  cases[2].maximumIterations = 20011;
  cases[3].samplesPerAddition = 10000;
  cases[3].stallPatience = 300.;
  for (const Parameters& parameters : cases)
  {
    const Reconstruction unbroken = reconstruct(hardCloud(), parameters, goOn);
    EXPECT_NE(unbroken.stopReason, StopReason::Vertices);
    fs::remove(this->path());
    EXPECT_FALSE(this->run(hardCloud(), parameters, 1));
    expectSame(unbroken, *this->run(hardCloud(), parameters));
    expectSame(unbroken, *this->run(hardCloud(), parameters));
  }
}

// The weights of the points count, and a run that was ended by the time limit goes on with a longer
// one; time in between does not count, time before does.
TEST_F(Checkpoints, GoOnAfterTheTimeLimit)
{
  const std::vector<Eigen::Vector3d> points = sphereCloud({ .count = 3000 });
  std::vector<double> weights(points.size());
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    weights[i] = 1. + double(i % 3);
  }
  const PointCloud cloud(points, weights);
  Parameters parameters = fewVertices();
  parameters.numberOfVertices = 2000;
  const Reconstruction unbroken = reconstruct(cloud, parameters, goOn);
  parameters.timeLimit = 1e-3;
  auto first = this->run(cloud, parameters);
  // On a busy machine the time may be over before anything is learnt: there is nothing to go on from.
  while (first->counts.iterations == 0)
  {
    fs::remove(this->path());
    parameters.timeLimit *= 2.;
    first = this->run(cloud, parameters);
  }
  ASSERT_EQ(first->stopReason, StopReason::TimeLimit);
  const auto second = this->run(cloud, parameters);
  EXPECT_EQ(second->stopReason, StopReason::TimeLimit);
  EXPECT_EQ(second->counts.iterations, first->counts.iterations);
  parameters.timeLimit = 1e6;
  const auto last = this->run(cloud, parameters);
  EXPECT_EQ(last->resumedIterations, first->counts.iterations);
  expectSame(unbroken, *last);
  EXPECT_NE(this->refusal(PointCloud(points), parameters).find("the weights"), std::string::npos);
}

// A run that was cut short before it began ends at once, with what was learnt; what then differs does
// not count, and the file stays as it is. Else it does count.
TEST_F(Checkpoints, StayWhereTheBeginningIsCutShort)
{
  const Parameters parameters = fewVertices();
  ASSERT_FALSE(this->run(hardCloud(), parameters, 3));
  const std::string before = this->contents();
  Parameters unchosen = parameters;
  unchosen.fidelity = Fidelity::High;
  const Mesh other = Mesh::tetrahedron(Vector4(0.1f, 0.f, 0.f), 0.2f);
  const auto stop = [](double) { return false; };
  EXPECT_THROW(reconstruct(hardCloud(), unchosen, stop, {}, {}, this->plan()), std::runtime_error);
  EXPECT_THROW(
    reconstruct(hardCloud(), parameters, stop, other, {}, this->plan()), std::runtime_error);
  CheckpointPlan cut = this->plan();
  cut.isStartWhole = cut.areParametersChosen = false;
  const Reconstruction result = reconstruct(hardCloud(), unchosen, stop, other, {}, cut);
  EXPECT_EQ(result.stopReason, StopReason::Cancelled);
  EXPECT_GT(result.resumedIterations, 0u);
  EXPECT_EQ(this->contents(), before);
  unchosen.seed = 2;
  EXPECT_THROW(reconstruct(hardCloud(), unchosen, stop, other, {}, cut), std::runtime_error);
  expectSame(reconstruct(hardCloud(), parameters, goOn), *this->run(hardCloud(), parameters));
}

// The file is there until the run is done, also if it ends before anything is learnt: any run goes on
// from such a file, from its own beginning.
TEST_F(Checkpoints, AreThereUntilTheRunIsDone)
{
  Parameters parameters = fewVertices();
  const Reconstruction unbroken = reconstruct(hardCloud(), parameters, goOn);
  EXPECT_EQ(this->run(hardCloud(), parameters, 0, Ending::Cancel)->counts.iterations, 0u);
  EXPECT_TRUE(fs::exists(this->path()));
  fs::remove(this->path());
  parameters.timeLimit = 1e-9;
  EXPECT_EQ(this->run(hardCloud(), parameters)->stopReason, StopReason::TimeLimit);
  EXPECT_TRUE(fs::exists(this->path()));
  parameters.seed = 2;
  EXPECT_EQ(this->run(hardCloud(), parameters)->resumedIterations, 0u);
  EXPECT_TRUE(fs::exists(this->path()));
  parameters.seed = 1;
  parameters.timeLimit = 0.;
  expectSame(unbroken, *this->run(hardCloud(), parameters));
}

// Another cloud, the same in another place or unit, and other parameters are refused, and it is
// said what differs.
TEST_F(Checkpoints, RefuseAnotherRun)
{
  const std::vector<Eigen::Vector3d> points = sphereCloud({ .count = 3000 });
  const PointCloud cloud(points);
  const Parameters parameters = fewVertices();
  ASSERT_TRUE(this->run(cloud, parameters));

  std::vector<Eigen::Vector3d> other = points;
  other[7] *= 1.01;
  EXPECT_NE(
    this->refusal(PointCloud(other), parameters).find("differ: the points"), std::string::npos);
  for (Eigen::Vector3d& point : other = points)
  {
    point = 2. * point;
  }
  EXPECT_NE(this->refusal(PointCloud(other), parameters).find("differ: the place of the points"),
    std::string::npos);
  Parameters changed = parameters;
  changed.seed = 2;
  changed.winnerRate = 0.25;
  EXPECT_EQ(this->refusal(cloud, changed),
    "the run cannot go on from " + this->path() +
      ": it is that of another run, from which these differ: Seed (1 there, 2 here), WinnerRate "
      "(0.1 there, 0.25 here)");
  const Mesh first = Mesh::tetrahedron(Vector4(0.1f, 0.f, 0.f), 0.2f);
  EXPECT_THROW(reconstruct(cloud, parameters, goOn, first, {}, this->plan()), std::runtime_error);
  EXPECT_EQ(this->refusal(cloud, parameters), "");
}

// A file that is cut off, changed in a byte, longer, or something else, is refused.
TEST_F(Checkpoints, RefuseDamagedFiles)
{
  const PointCloud cloud(sphereCloud({ .count = 1000 }));
  Parameters parameters = fewVertices();
  parameters.numberOfVertices = 60;
  parameters.noiseWindow = parameters.changeWindow = 10;
  ASSERT_TRUE(this->run(cloud, parameters));
  const std::string whole = this->contents();
  ASSERT_GT(whole.size(), 1000u);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 500)
  {
    this->setContents(whole.substr(0, size));
    EXPECT_NE(this->refusal(cloud, parameters), "") << size << " bytes";
  }
  for (std::size_t place = 0; place < whole.size(); place += 1 + place / 500)
  {
    std::string changed = whole;
    changed[place] ^= char(1 << (place % 8));
    this->setContents(changed);
    EXPECT_NE(this->refusal(cloud, parameters), "") << "byte " << place;
  }
  for (const std::string& other : { whole + "x", whole + whole, std::string("a text\n"),
         std::string(5000, '\0'), std::string(5000, '\xff') })
  {
    this->setContents(other);
    EXPECT_NE(this->refusal(cloud, parameters), "");
  }
  fs::remove(this->path());
  fs::create_directory(this->path());
  EXPECT_NE(this->refusal(cloud, parameters), "");
  fs::remove(this->path());
  EXPECT_EQ(this->refusal(cloud, parameters), "");
}

// Bytes that somebody has changed together with the checksum are refused, or learnt from to some
// end; nothing is read or written where it must not be, and no more memory taken than the file has.
TEST_F(Checkpoints, StandHostileFiles)
{
  const PointCloud cloud(sphereCloud({ .count = 1000 }));
  for (const Order order : { Order::Exact, Order::List })
  {
    Parameters parameters = fewVertices();
    parameters.numberOfVertices = 60;
    parameters.order = order;
    parameters.listVertices = 20;
    parameters.topologyLearning = true;
    parameters.noiseWindow = parameters.changeWindow = 10;
    parameters.maximumIterations = 50000;
    fs::remove(this->path());
    ASSERT_FALSE(this->run(cloud, parameters, 1));
    const std::string whole = this->contents();
    Random random(1);
    int refused = 0;
    constexpr int Tries = 1500;
    for (int i = 0; i < Tries; ++i)
    {
      std::string changed = whole.substr(0, whole.size() - sizeof(std::uint64_t));
      // Behind the parameters, whose change is another run.
      const auto place = std::size_t(random.below(std::uint32_t(changed.size() - 400)) + 400);
      const std::uint32_t kind = random.below(3);
      for (std::size_t b = place; b < std::min(place + (kind == 0 ? 1 : 4), changed.size()); ++b)
      {
        changed[b] = kind == 2 ? '\xff' : char(random.below(256));
      }
      Checksum checksum;
      checksum.add(std::as_bytes(std::span(changed)));
      const std::uint64_t value = checksum.value();
      changed.append(reinterpret_cast<const char*>(&value), sizeof(value));
      this->setContents(changed);
      refused += !this->refusal(cloud, parameters).empty();
    }
    EXPECT_GT(refused, Tries / 4);
  }
}

// What cannot be written is told before anything is learnt; if it comes later, a warning is given,
// once, and the run goes on.
TEST_F(Checkpoints, TellWhatCannotBeWritten)
{
  const Parameters parameters = fewVertices();
  CheckpointPlan nowhere = this->plan();
  nowhere.path = (this->folder_ / "none" / "run.checkpoint").string();
  EXPECT_THROW(reconstruct(cleanSphere(), parameters, goOn, {}, {}, nowhere), std::runtime_error);

  const fs::path later = this->folder_ / "later";
  fs::create_directory(later);
  CheckpointPlan gone = this->plan();
  gone.path = (later / "run.checkpoint").string();
  std::vector<std::string> warnings;
  gone.warn = [&](const std::string& text) { warnings.push_back(text); };
  int calls = 0;
  const auto removeFolder = [&](double)
  {
    calls += 1;
    fs::remove_all(later);
    return true;
  };
  const Reconstruction result = reconstruct(cleanSphere(), parameters, removeFolder, {}, {}, gone);
  EXPECT_EQ(result.stopReason, StopReason::Vertices);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(gone.path), std::string::npos);
  EXPECT_GT(calls, 3);
}

// Nothing is left beside the file, nothing is written without a name, and no sooner than asked for.
TEST_F(Checkpoints, AreOneFile)
{
  const Parameters parameters = fewVertices();
  reconstruct(cleanSphere(), parameters, goOn);
  EXPECT_TRUE(fs::is_empty(this->folder_));
  CheckpointPlan rare = this->plan();
  rare.interval = 1e6;
  int seen = 0;
  // At 1 all is learnt, and described.
  const auto look = [&](double fraction)
  {
    seen += fraction < 1. && fs::exists(this->path());
    return true;
  };
  reconstruct(cleanSphere(), parameters, look, {}, {}, rare);
  EXPECT_EQ(seen, 0);
  EXPECT_TRUE(fs::exists(this->path()));
  EXPECT_EQ(std::distance(fs::directory_iterator(this->folder_), {}), 1);
}
}
