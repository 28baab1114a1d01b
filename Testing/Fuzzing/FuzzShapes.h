// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CloudGenerator.h"
#include "FuzzInput.h"
#include "ManifoldCheck.h"
#include "Mesh.h"
#include "MeshTools.h"
#include "Parameters.h"
#include "Shapes.h"
#include "TriangleMesh.h"

#include <cstdio>
#include <cstdlib>

namespace neuralmesh::testing
{
/// Ends the process if a promise is broken.
inline void require(bool holds, const char* promise)
{
  if (!holds)
  {
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
  }
}

inline void requireSound(const Mesh& mesh)
{
  const std::string defect = defectOf(mesh);
  require(defect.empty(), defect.c_str());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    require(!mesh.isAlive(v) || mesh.position(v).toDouble().allFinite(), "positions are finite");
  }
}

inline void requireSound(const TriangleMesh& mesh)
{
  const std::string defect = checkManifold(mesh.points.size(), mesh.triangles).defect;
  require(defect.empty(), defect.c_str());
  for (const Eigen::Vector3d& point : mesh.points)
  {
    require(point.allFinite(), "points of a mesh are finite");
  }
}

inline Eigen::Vector3d pointOnGrid(FuzzInput& input)
{
  const unsigned cells = 1u << (input.byte() % 5);
  const double x = input.below(cells), y = input.below(cells), z = input.below(cells);
  return { x, y, z };
}

/// Some points: any numbers, those of a grid (many are equal), or a shape as a scanner sees it.
inline std::vector<Eigen::Vector3d> somePoints(FuzzInput& input)
{
  std::vector<Eigen::Vector3d> points;
  const unsigned kind = input.below(4);
  if (kind < 2)
  {
    const std::size_t count = input.below(100);
    while (points.size() < count && !input.isEmpty())
    {
      if (kind == 0)
      {
        points.push_back(pointOnGrid(input));
        continue;
      }
      const double x = input.anyNumber(), y = input.anyNumber(), z = input.anyNumber();
      points.emplace_back(x, y, z);
    }
    return points;
  }
  CloudOptions options;
  options.count = input.below(2000);
  options.seed = input.byte();
  options.noise = input.number(0., 0.2);
  options.outliers = input.number(0., 1.);
  options.holes = input.below(10);
  options.holeRadius = input.number(0., 1.);
  options.gradient = input.number(1., 100.);
  options.gradientAxis = input.below(3);
  if (input.flag())
  {
    options.viewpoint = 4. * (pointOnGrid(input) - Eigen::Vector3d(1., 1., 1.));
  }
  const unsigned shape = input.below(3);
  points = generateCloud(shape == 0 ? makeCube()
      : shape == 1                  ? makeSphere(8)
                                    : makeTorus(input.number(0.05, 0.9), 8),
    options);
  // Flat, thin, far off, tiny or huge.
  const Eigen::Vector3d stretch(
    input.number(0., 1.), input.number(0., 1.), std::pow(10., input.whole(-30, 30)));
  const double offset = input.flag() ? input.number(0., 1e8) : 0.;
  const bool isStretched = input.flag();
  for (Eigen::Vector3d& point : points)
  {
    point = isStretched ? Eigen::Vector3d(point.cwiseProduct(stretch)) : point;
    point.array() += offset;
  }
  return points;
}

/// Triangles of some points that are no mesh, most of the time.
inline TriangleMesh someTriangles(FuzzInput& input)
{
  TriangleMesh mesh;
  const unsigned kind = input.below(4);
  if (kind > 0)
  {
    mesh = kind == 1 ? makeCube(1 + input.below(4)) : kind == 2 ? makeSphere(2) : makeTorus(0.4, 4);
  }
  else
  {
    mesh.points = somePoints(input);
    mesh.triangles.resize(mesh.points.empty() ? 0 : input.below(60));
    for (auto& triangle : mesh.triangles)
    {
      for (std::uint32_t& corner : triangle)
      {
        corner = input.below(std::uint32_t(mesh.points.size()));
      }
    }
  }
  for (unsigned changes = input.below(8); changes > 0 && !mesh.triangles.empty(); --changes)
  {
    const auto place = mesh.triangles.begin() + input.below(std::uint32_t(mesh.triangles.size()));
    switch (input.below(4))
    {
      case 0:
        mesh.triangles.erase(place);
        break;
      case 1:
        (*place)[input.below(3)] = input.below(std::uint32_t(mesh.points.size()));
        break;
      case 2:
        std::swap((*place)[0], (*place)[1]);
        break;
      default:
        mesh.points[(*place)[0]] =
          input.flag() ? pointOnGrid(input) : Eigen::Vector3d::Constant(input.anyNumber());
    }
  }
  return mesh;
}

/// Values from all over the documented ranges, but for a run that ends soon.
inline Parameters someParameters(FuzzInput& input)
{
  const auto preset = input.flag() ? Preset::Thesis : Preset::Default;
  const auto variant = Variant(input.below(3));
  Parameters parameters = Parameters::of(preset, variant, Order(input.below(2)));
  parameters.seed = input.byte();
  parameters.start = Start(input.below(2));
  parameters.boundaries = Boundaries(input.below(2));
  parameters.topologyLearning = input.flag();
  parameters.topologyRules = TopologyRules(input.below(2));
  parameters.jump = Jump(input.below(5));
  parameters.additionOperation = AdditionOperation(input.below(2));
  parameters.removalOperation = RemovalOperation(input.below(3));
  parameters.computeFeatureStrength = input.flag();
  parameters.edgeFlips = input.flag();
  parameters.numberOfVertices = 4 + input.below(400);
  parameters.maximumIterations = 1 + input.below(20000);
  parameters.listVertices = 4 + int(input.below(200));
  parameters.fitRounds = int(input.below(4));
  // Each other value as it is, or from its range.
  const auto vary = [&](auto& value, double low, double high)
  {
    if (input.below(4) == 0)
    {
      value = static_cast<std::remove_reference_t<decltype(value)>>(input.number(low, high));
    }
  };
  vary(parameters.curvatureDensity, 0., 1.);
  vary(parameters.winnerRate, 0., 1.);
  vary(parameters.smoothingRate, 0., 1.);
  vary(parameters.smoothingIterations, 0., 100.);
  vary(parameters.counterDecay, 0.01, 1.);
  vary(parameters.counterHalfLife, 0.01, 1e6);
  vary(parameters.noiseTolerance, 0., 1000.);
  vary(parameters.noiseWindow, 2., 1e6);
  vary(parameters.outlierLimit, 0., 1e6);
  vary(parameters.outlierLimitVertices, 4., 1e9);
  vary(parameters.changeWindow, 2., 1e6);
  vary(parameters.gainLimit, 0., 1e9);
  vary(parameters.featureMemory, 0., 1.);
  vary(parameters.featureSamples, 0., 1e6);
  vary(parameters.samplesPerAddition, 1., 1e6);
  vary(parameters.earlyPatience, 0.01, 1000.);
  vary(parameters.earlyVertices, 0., 1e9);
  vary(parameters.additionsPerRemoval, 1., 1e6);
  vary(parameters.removalPatience, 0.01, 1e6);
  vary(parameters.removalLimit, 0., 1000.);
  vary(parameters.topologyPatience, 0.01, 1e6);
  vary(parameters.triangleRemovalFactor, 1., 1e9);
  vary(parameters.boundaryMergingFactor, 0., 1e9);
  vary(parameters.jumpFraction, 0., 1.);
  vary(parameters.constantWeight, 0., 1000.);
  vary(parameters.normalWeight, 0., 1000.);
  vary(parameters.areaWeight, 0., 1000.);
  vary(parameters.volumeWeight, 0., 1000.);
  vary(parameters.fitSmoothness, 0., 1e6);
  vary(parameters.fitSamples, 1., 1000.);
  vary(parameters.batchSize, 1., 1048576.);
  vary(parameters.targetSampleDistance, 0., 1.);
  vary(parameters.targetCloudDistance, 0., 1.);
  vary(parameters.targetNormalChange, 0., 2.);
  vary(parameters.stallPatience, 1., 1e9);
  return parameters;
}
}
