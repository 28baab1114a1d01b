// SPDX-License-Identifier: BSD-3-Clause
#include "base/InterruptibleExecutor.h"
#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "cloud/CloudPlaces.h"
#include "run/Reconstruction.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::array<unsigned, 5> ThreadCounts{ 1, 2, 3, 7, 16 };

/// Whether two arrays hold the same bytes.
template <typename Array>
void expectSameBytes(const Array& a, const Array& b)
{
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])), 0);
}
}

// Promise: every part is run once, on any number of threads, however many parts there are.
TEST(ThreadPool, RunsEveryPartOnce)
{
  for (const unsigned threads : ThreadCounts)
  {
    const ThreadPool pool(threads);
    EXPECT_EQ(pool.threadCount(), threads);
    for (const std::size_t count : { 0, 1, 2, 7, 1000 })
    {
      std::vector<std::atomic<int>> calls(count);
      pool.forEachPart(count, [&](std::size_t part) { ++calls[part]; });
      for (const std::atomic<int>& number : calls)
      {
        EXPECT_EQ(number, 1);
      }
    }
  }
}

// Promise: ranges make up the whole, and none is longer than the grain.
TEST(ThreadPool, RangesMakeUpTheWhole)
{
  const ThreadPool pool(3);
  std::vector<int> calls(1000, 0);
  pool.forEachRange(calls.size(), 64,
    [&](std::size_t begin, std::size_t end)
    {
      EXPECT_LE(end - begin, 64u);
      for (std::size_t i = begin; i < end; ++i)
      {
        ++calls[i];
      }
    });
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
}

// Promise: parts do run at the same time: each of two waits for the other.
TEST(ThreadPool, PartsRunAtTheSameTime)
{
  const ThreadPool pool(2);
  std::atomic<int> arrived = 0;
  pool.forEachPart(2,
    [&](std::size_t)
    {
      ++arrived;
      while (arrived < 2)
      {
        std::this_thread::yield();
      }
    });
  EXPECT_EQ(arrived, 2);
}

// Promise: a thread gets the same parts, side by side, each time, so that it finds in its cache what it wrote; what
// it has no time for is done by others.
TEST(ThreadPool, ThreadsKeepTheirParts)
{
  constexpr std::size_t Half = 8;
  const ThreadPool pool(2);
  std::array<std::thread::id, 2 * Half> doer;
  for (const bool isHeld : { false, true })
  {
    std::atomic<std::size_t> begun = 0, left = 2 * Half;
    pool.forEachPart(2 * Half,
      [&](std::size_t part)
      {
        doer[part] = std::this_thread::get_id();
        --left;
        // The first part of each half waits for that of the other, and if it is held, for all other parts.
        if (part % Half == 0)
        {
          ++begun;
          while (begun < 2 || (isHeld && part > 0 && left > 0))
          {
            std::this_thread::yield();
          }
        }
      });
    EXPECT_EQ(doer[0], std::this_thread::get_id());
    EXPECT_NE(doer[Half], doer[0]);
    if (isHeld)
    {
      EXPECT_EQ(std::count(doer.begin(), doer.end(), doer[Half]), 1);
    }
  }
}

// Promise: a sum has the same bits on any number of threads, where another order would have others.
TEST(ThreadPool, SumsAreTheSameOnAnyNumberOfThreads)
{
  const auto term = [](std::size_t i) { return 1. / double(i + 1); };
  const double expected = Executor::sequential().sum(100000, 100, term);
  EXPECT_NEAR(expected, 12.0901461298634, 1e-12);
  for (const unsigned threads : ThreadCounts)
  {
    EXPECT_EQ(ThreadPool(threads).sum(100000, 100, term), expected);
  }
}

// Promise: who asks while the pool is at work, a part among them, is served all the same.
TEST(ThreadPool, PartsMayAskAgain)
{
  const ThreadPool pool(3);
  std::atomic<int> calls = 0;
  pool.forEachPart(10, [&](std::size_t) { pool.forEachPart(10, [&](std::size_t) { ++calls; }); });
  EXPECT_EQ(calls, 100);
}

// Promise: what a part throws arrives at who has asked, and the pool works on.
TEST(ThreadPool, PassesErrorsOn)
{
  const ThreadPool pool(3);
  const auto fail = [](std::size_t part)
  {
    if (part == 5)
    {
      throw std::runtime_error("five");
    }
  };
  EXPECT_THROW(pool.forEachPart(100, fail), std::runtime_error);
  EXPECT_THROW(Executor::sequential().forEachPart(100, fail), std::runtime_error);
  std::atomic<int> calls = 0;
  pool.forEachPart(100, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 100);
}

// Promise: a run is asked for only on its own thread, and ends within its parts; what runs afterwards, as what must not
// throw, runs to its end.
TEST(InterruptibleExecutor, AsksOnItsThread)
{
  const ThreadPool pool(3);
  const std::thread::id thread = std::this_thread::get_id();
  std::atomic<int> asked = 0;
  const InterruptibleExecutor executor(pool,
    [&]
    {
      EXPECT_EQ(std::this_thread::get_id(), thread);
      return ++asked < 3;
    });
  EXPECT_EQ(executor.threadCount(), 3u);
  std::atomic<int> parts = 0;
  const auto takeTime = [&](std::size_t)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ++parts;
  };
  executor.uninterrupted().forEachPart(30, takeTime);
  EXPECT_EQ(parts, 30);
  EXPECT_EQ(asked, 0);
  EXPECT_THROW(executor.forEachPart(300, takeTime), Interrupted);
  EXPECT_LT(parts, 330);
  EXPECT_EQ(asked, 3);
  parts = 0;
  executor.forEachPart(30, takeTime);
  EXPECT_EQ(parts, 30);
  EXPECT_EQ(asked, 3);
}

// Promise: without a number, there are as many threads as the machine runs at once.
TEST(ThreadPool, TakesTheWholeMachine)
{
  EXPECT_EQ(ThreadPool().threadCount(), std::max(1u, std::thread::hardware_concurrency()));
}

// Promise: signals to the process are for the threads of the application, which are as before;
// faults are for the thread that makes them.
TEST(ThreadPool, TakesNoSignals)
{
  const auto isBlocked = [](int signal)
  {
    sigset_t blocked;
    return pthread_sigmask(SIG_BLOCK, nullptr, &blocked) == 0 && sigismember(&blocked, signal) == 1;
  };
  const ThreadPool pool(2);
  std::array<std::atomic<bool>, 2> isInterruptible{};
  std::array<std::atomic<bool>, 2> isFaultBlocked{};
  std::atomic<int> arrived = 0;
  pool.forEachPart(2,
    [&, caller = std::this_thread::get_id()](std::size_t)
    {
      const std::size_t here = std::this_thread::get_id() == caller ? 0 : 1;
      isInterruptible[here] = !isBlocked(SIGINT);
      isFaultBlocked[here] = isBlocked(SIGBUS);
      // One part a thread.
      ++arrived;
      while (arrived < 2)
      {
        std::this_thread::yield();
      }
    });
  EXPECT_TRUE(isInterruptible[0]);
  EXPECT_FALSE(isInterruptible[1]);
  EXPECT_FALSE(isFaultBlocked[0]);
  EXPECT_FALSE(isFaultBlocked[1]);
}

// Promise: a cloud with weights, its mesh and the places of its points are the same to the byte at
// 1, 2, 3, 7 and 16 threads as without any, gaps in the scan and all.
TEST(ThreadPool, SameMeshOnAnyNumberOfThreads)
{
  CloudOptions options;
  options.count = 30000;
  options.holes = 2;
  options.noise = 0.001;
  const std::vector<Eigen::Vector3d> points = generateCloud(makeTorus(), options);
  std::vector<double> weights;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    weights.push_back(1. + double(i % 3));
  }
  Parameters parameters;
  parameters.numberOfVertices = 4000;
  const auto run = [&](const Executor& executor)
  {
    const PointCloud cloud(points, weights, true, executor);
    Reconstruction result = reconstruct(cloud, parameters, testing::goOn, {}, {}, {}, executor);
    const CloudPlaces places(cloud, result.surface, testing::goOn, executor);
    std::vector<double> numbers = result.activities;
    places.forEach(
      [&](std::size_t point, const CloudPlaces::Corners& corners)
      {
        numbers.push_back(double(point));
        numbers.push_back(double(corners[0].vertex));
        numbers.push_back(corners[1].weight);
      });
    return std::pair(std::move(result.mesh), std::move(numbers));
  };
  const auto [mesh, numbers] = run(Executor::sequential());
  EXPECT_EQ(mesh.points.size(), 4000u);
  for (const unsigned threads : ThreadCounts)
  {
    const auto [otherMesh, otherNumbers] = run(ThreadPool(threads));
    expectSameBytes(otherMesh.points, mesh.points);
    expectSameBytes(otherMesh.triangles, mesh.triangles);
    expectSameBytes(otherNumbers, numbers);
  }
}
}
