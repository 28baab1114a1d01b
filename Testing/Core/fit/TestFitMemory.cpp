// SPDX-License-Identifier: BSD-3-Clause
// What large fits take of memory, and that what is laid aside for it comes back.
#include "fit/DataGaps.h"
#include "fit/StoredPlaces.h"
#include "fit/SurfaceFit.h"

#include "AnonymousBytes.h"
#include "base/ThreadPool.h"
#include "cloud/MeshBuilder.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#ifdef __GLIBC__
#include <malloc.h>
#if __GLIBC_PREREQ(2, 33)
#define TELLS_BYTES_IN_USE
#endif
#endif

namespace neuralmesh::testing
{
namespace
{
#ifdef TELLS_BYTES_IN_USE
/// Without what was freed and waits to be used again.
double bytesInUse()
{
  const struct mallinfo2 info = mallinfo2();
  return double(info.uordblks) + double(info.hblkhd);
}

/// Looks before and after each part how much memory is in use.
class WatchedExecutor final : public Executor
{
public:
  unsigned threadCount() const override { return 1; }
  double mostBytes() const { return mostBytes_; }

protected:
  void run(std::size_t count, Part part, const void* context) const override
  {
    look();
    for (std::size_t i = 0; i < count; ++i)
    {
      part(context, i);
      look();
    }
  }

private:
  void look() const { mostBytes_ = std::max(mostBytes_, bytesInUse()); }

  mutable double mostBytes_ = 0.;
};
#endif

PointCloud sphereOf(std::size_t count)
{
  CloudOptions options;
  options.count = count;
  return PointCloud(sphereCloud(options));
}
}

// Places come back as they were but for their distances, however far apart their corners are in number, on any number
// of threads.
TEST(FitMemory, PlacesComeBack)
{
  Random random(1);
  const auto anyVertex = [&] { return VertexIndex(random.below(0xffffffffu) >> random.below(32)); };
  ZeroedArray<PlaceOnMesh> places(200000);
  for (PlaceOnMesh& place : places)
  {
    place = { { anyVertex(), anyVertex(), anyVertex() }, float(random.uniform()),
      -float(random.uniform()), 1.f };
  }
  const ThreadPool threads(3);
  StoredPlaces stored(ZeroedArray<PlaceOnMesh>(places), threads);
  StoredPlaces storedToo(ZeroedArray<PlaceOnMesh>(places), Executor::sequential());
  const auto again = stored.takePlaces(Executor::sequential());
  const auto parallel = storedToo.takePlaces(threads);
  ASSERT_EQ(again.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    ASSERT_EQ(again[i].triangle, places[i].triangle);
    ASSERT_EQ(again[i].second, places[i].second);
    ASSERT_EQ(again[i].third, places[i].third);
    ASSERT_EQ(again[i].squaredDistance, 0.f);
    ASSERT_EQ(parallel[i].triangle, places[i].triangle);
  }
}

#ifdef __linux__
// While the equations of a large fit are solved, they take at most 300 bytes a vertex with ten samples for each, and the
// distances of the places are those that were found.
TEST(FitMemory, ALargeFitTakesLittle)
{
  const PointCloud cloud = sphereOf(570000);
  Mesh mesh = buildMesh(makeSphere(100), cloud);
  const double before = anonymousBytes();
  SurfaceFit fit(cloud, mesh, 10 * mesh.vertexCount());
  ASSERT_TRUE(fit.findPlaces(goOn));
  const std::vector<PlaceOnMesh> found(fit.places().begin(), fit.places().end());
  ASSERT_GE(found.size(), 500000u);
  const double copied = double(found.size() * sizeof(PlaceOnMesh));
  double most = 0.;
  ASSERT_TRUE(fit.moveVertices(1.,
    [&](double)
    {
      most = std::max(most, anonymousBytes());
      return true;
    }));
  EXPECT_GT(most, 0.);
  EXPECT_LT((most - copied - before) / double(mesh.vertexCount()), 300.);
  ASSERT_EQ(fit.places().size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_EQ(fit.places()[i].triangle, found[i].triangle);
    ASSERT_EQ(fit.places()[i].squaredDistance, found[i].squaredDistance);
  }
}
#endif

#ifdef TELLS_BYTES_IN_USE
// While a large mesh is searched for gaps in the data, with ten samples a vertex of a cloud that has more, that takes
// at most 160 bytes a vertex: no point is copied, and what told gaps apart is free once webs are looked for.
TEST(FitMemory, ASearchForGapsTakesLittle)
{
  CloudOptions options;
  options.count = 600000;
  std::vector<Eigen::Vector3d> points = sphereCloud(options);
  std::erase_if(points, [](const Eigen::Vector3d& point) { return std::abs(point.z()) > 0.99; });
  const PointCloud cloud(points);
  Mesh mesh = buildMesh(makeSphere(100), cloud);
  SurfaceFit fit(cloud, mesh, 10 * mesh.vertexCount());
  ASSERT_TRUE(fit.findPlaces(goOn));
  ASSERT_LT(fit.places().size(), points.size());
  const WatchedExecutor executor;
  const double before = bytesInUse();
  const auto gaps = findDataGaps(cloud, mesh, fit.places(), fit.medianDistance(), {}, executor);
  EXPECT_GT(gaps.size(), 100u);
  EXPECT_LT((executor.mostBytes() - before) / double(mesh.vertexCount()), 160.);
}
#endif
}
