// SPDX-License-Identifier: BSD-3-Clause
// The public calls of the engine, with anything that their documentation allows.
#include "AnyOperation.h"
#include "cloud/AttributeFit.h"
#include "cloud/CloudSelection.h"
#include "cloud/MeshBuilder.h"
#include "cloud/Visibility.h"
#include "fit/IntersectionRepair.h"
#include "fit/MeshQuality.h"
#include "fit/SurfaceFit.h"
#include "FuzzShapes.h"
#include "FuzzTarget.h"
#include "mesh/Orientation.h"
#include "mesh/SurfaceReport.h"
#include "run/Ensemble.h"
#include "run/Reconstruction.h"
#include "start/DepthBufferVoxelizer.h"
#include "start/OutlierClusters.h"

#include <stdexcept>

namespace neuralmesh::testing
{
namespace
{
/// Ends what takes long: after so many reports at most.
Progress someProgress(FuzzInput& input)
{
  return [left = 1 + input.below(3000)](double fraction) mutable
  {
    require(fraction >= 0. && fraction <= 1., "progress goes from 0 to 1");
    return left > 0 && --left > 0;
  };
}

PointCloud someCloud(FuzzInput& input)
{
  const std::vector<Eigen::Vector3d> points = somePoints(input);
  std::vector<double> weights(input.below(4) == 0 ? points.size() : 0);
  for (double& weight : weights)
  {
    weight = input.flag() ? input.anyNumber() : 1.;
  }
  return PointCloud(points, weights, input.flag());
}

/// A first mesh, if the triangles are one.
std::optional<Mesh> someMesh(FuzzInput& input, const PointCloud& cloud)
{
  try
  {
    Mesh mesh = buildMesh(someTriangles(input), cloud);
    requireSound(mesh);
    return mesh;
  }
  catch (const std::runtime_error&)
  {
    return std::nullopt;
  }
}

void runAll(FuzzInput& input)
{
  Parameters parameters = someParameters(input);
  const PointCloud cloud = someCloud(input);
  parameters.warnings(cloud.points().size());
  if (!cloud.hasExtent() || !parameters.errors().empty())
  {
    return;
  }
  const std::optional<Mesh> first = input.below(4) == 0 ? someMesh(input, cloud) : std::nullopt;
  GrowthWatch watch;
  watch.snapshots = input.below(6);
  watch.take = [](const GrowthSnapshot& snapshot) { requireSound(snapshot.mesh()); };
  const Reconstruction result = reconstruct(cloud, parameters, someProgress(input), first, watch);
  requireSound(result.surface);
  requireSound(result.mesh);
  require(result.mesh.points.size() <=
      std::max<std::size_t>(parameters.numberOfVertices, first ? first->vertexCount() : 4),
    "no more vertices than were asked for");
  require(result.activities.size() == result.mesh.points.size(), "an activity a vertex");
}

void operateOn(Mesh& mesh, FuzzInput& input)
{
  AnyOperation<FuzzInput> any(mesh, input);
  while (!input.isEmpty() && mesh.vertexCount() > 0 && mesh.vertexCount() < 500)
  {
    any.operate();
    requireSound(mesh);
  }
}

/// What is done with a mesh that is there: most of it as in the finish of a run.
void workOnMesh(FuzzInput& input)
{
  const PointCloud cloud = someCloud(input);
  std::optional<Mesh> mesh = cloud.hasExtent() ? someMesh(input, cloud) : std::nullopt;
  if (!mesh)
  {
    return;
  }
  while (!input.isEmpty())
  {
    switch (input.below(8))
    {
      case 0:
      {
        SurfaceFit fit(cloud, *mesh, 1 + input.below(3000));
        if (fit.findPlaces(someProgress(input)))
        {
          fit.moveVertices(input.flag() ? 0. : input.number(0., 1e6), someProgress(input));
        }
        break;
      }
      case 1:
        repairIntersections(*mesh, someProgress(input));
        break;
      case 2:
        orientOutwards(*mesh);
        break;
      case 3:
        flipEdges(*mesh);
        break;
      case 4:
        refine(*mesh, std::min<std::size_t>(500, mesh->vertexCount() + input.below(50)),
          someProgress(input));
        break;
      case 5:
        simplify(*mesh, input.below(100));
        break;
      case 6:
      {
        const CloudPlaces places(cloud, *mesh, someProgress(input));
        AttributeFit fit(*mesh);
        const AttributeFit::Values values(1., -1., input.anyNumber(), input.number(0., 1e9));
        places.forEach([&](std::size_t point, const CloudPlaces::Corners& corners)
          { fit.add(corners, double(cloud.weight(point)), values); });
        require(fit.solve().size() == mesh->vertexCount(), "a value a vertex");
        break;
      }
      default:
        measureQuality(cloud, *mesh, trianglesOf(*mesh, cloud));
    }
    requireSound(*mesh);
  }
  operateOn(*mesh, input);
}

void operateOnMesh(FuzzInput& input)
{
  Mesh mesh = Mesh::tetrahedron({}, 1.f);
  operateOn(mesh, input);
}

/// What takes triangles of any quality.
void measureTriangles(FuzzInput& input)
{
  TriangleMesh mesh = someTriangles(input);
  const SurfaceReport report = reportSurface(mesh);
  require(report.triangles == mesh.triangles.size(), "all triangles are counted");
  pointNormals(mesh);
  CloudSelection selection(input.byte(), mesh.points.size(), input.below(200));
  std::erase_if(mesh.triangles,
    [&](const auto& triangle)
    {
      return std::any_of(triangle.begin(), triangle.end(),
        [&](std::uint32_t point) { return !mesh.points[point].allFinite(); });
    });
  std::vector<Eigen::Vector3d> finite = mesh.points;
  std::erase_if(finite, [](const Eigen::Vector3d& point) { return !point.allFinite(); });
  selection.arrange(finite, [](std::size_t a, std::size_t b) { return a < b; });
  if (finite.size() < mesh.points.size())
  {
    return;
  }
  CloudOptions options;
  options.count = input.below(500);
  options.seed = input.byte();
  options.noise = input.number(0., 10.);
  options.holes = input.below(4);
  options.gradient = input.number(1e-3, 1e3);
  options.viewpoint = pointOnGrid(input);
  generateCloud(mesh, options, someProgress(input));
  const Visibility visibility(mesh);
  visibility.isSeen(pointOnGrid(input), pointOnGrid(input));
  VoxelGrid grid;
  grid.first = -pointOnGrid(input);
  grid.width = input.number(1e-3, 10.);
  grid.counts = { 1 + input.below(20), 1 + input.below(20), 1 + input.below(20) };
  require(voxelize(mesh, grid).size() == grid.size(), "a voxel for each of the grid");
}

void runEnsemble(FuzzInput& input)
{
  const PointCloud cloud = someCloud(input);
  if (!cloud.hasExtent())
  {
    return;
  }
  withoutClusters(cloud);
  EnsembleParameters parameters;
  parameters.seed = input.byte();
  parameters.numberOfMembers = 1 + input.below(3);
  parameters.verticesPerMember = 50 + input.below(50);
  parameters.memberSamplesPerAddition = input.whole(1, 50);
  parameters.memberRemovalPatience = input.number(0.01, 1e6);
  parameters.gridResolution = 4 + input.below(12);
  Ensemble ensemble(cloud, parameters, { 0, 1 });
  for (unsigned turn = input.below(200); turn > 0 && !ensemble.isLearnt(); --turn)
  {
    ensemble.learn(turn % ensemble.size());
  }
  for (std::size_t member = 0; member < ensemble.size(); ++member)
  {
    requireSound(ensemble.renumberedMesh(member));
    ensemble.findPhantoms(member);
  }
  ensemble.makeGrid(ensemble.boxes());
  for (std::size_t member = 0; member < ensemble.size(); ++member)
  {
    ensemble.voxelize(member);
  }
  ensemble.votes();
}
}

std::vector<std::vector<std::uint8_t>> fuzzSeeds()
{
  std::vector<std::vector<std::uint8_t>> seeds;
  Random random(1);
  for (unsigned i = 0; i < 120; ++i)
  {
    std::vector<std::uint8_t> seed(20 + random.below(600));
    std::generate(seed.begin(), seed.end(), [&] { return std::uint8_t(random.below(256)); });
    seed[0] = std::uint8_t(i);
    seeds.push_back(std::move(seed));
  }
  return seeds;
}
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace neuralmesh::testing;
  FuzzInput input({ data, size });
  constexpr std::array calls{ runAll, runAll, workOnMesh, operateOnMesh, measureTriangles,
    runEnsemble };
  calls[input.below(calls.size())](input);
  return 0;
}
