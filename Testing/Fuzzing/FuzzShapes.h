// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AnyParameters.h"
#include "cloud/CloudGenerator.h"
#include "FuzzInput.h"
#include "ManifoldCheck.h"
#include "mesh/Mesh.h"
#include "mesh/TriangleMesh.h"
#include "MeshTools.h"
#include "Shapes.h"

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
inline Parameters someParameters(FuzzInput& input) { return anyParameters(input, 4); }
}
