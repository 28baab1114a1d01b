// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes.h"

#include <cmath>
#include <map>
#include <numbers>

namespace neuralmesh
{
TriangleMesh makeCube(unsigned resolution)
{
  TriangleMesh mesh;
  // Corners of neighbouring faces are one point: found by their integer coordinates.
  std::map<std::array<unsigned, 3>, std::uint32_t> indices;
  const auto pointAt = [&](const std::array<unsigned, 3>& lattice)
  {
    const auto [place, isNew] = indices.try_emplace(lattice, std::uint32_t(mesh.points.size()));
    if (isNew)
    {
      mesh.points.emplace_back(Eigen::Vector3d(lattice[0], lattice[1], lattice[2]) / resolution -
        Eigen::Vector3d::Constant(0.5));
    }
    return place->second;
  };
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    for (const bool high : { false, true })
    {
      for (unsigned i = 0; i < resolution; ++i)
      {
        for (unsigned j = 0; j < resolution; ++j)
        {
          const auto corner = [&](unsigned di, unsigned dj)
          {
            std::array<unsigned, 3> lattice{};
            lattice[axis] = high ? resolution : 0;
            lattice[(axis + 1) % 3] = i + di;
            lattice[(axis + 2) % 3] = j + dj;
            return pointAt(lattice);
          };
          const auto a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (high)
          {
            mesh.triangles.push_back({ a, b, c });
            mesh.triangles.push_back({ a, c, d });
          }
          else
          {
            mesh.triangles.push_back({ a, c, b });
            mesh.triangles.push_back({ a, d, c });
          }
        }
      }
    }
  }
  return mesh;
}

TriangleMesh makeSphere(unsigned resolution)
{
  TriangleMesh mesh = makeCube(resolution);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point.normalize();
  }
  return mesh;
}

TriangleMesh makeTorus(double tubeRadius, unsigned resolution)
{
  TriangleMesh mesh;
  const unsigned around = 2 * resolution;
  const auto angle = [](unsigned step, unsigned steps)
  { return 2. * std::numbers::pi * step / steps; };
  for (unsigned i = 0; i < around; ++i)
  {
    for (unsigned j = 0; j < resolution; ++j)
    {
      const double phi = angle(i, around);
      const double theta = angle(j, resolution);
      const double radius = 1. + tubeRadius * std::cos(theta);
      mesh.points.emplace_back(
        radius * std::cos(phi), radius * std::sin(phi), tubeRadius * std::sin(theta));
    }
  }
  const auto index = [&](unsigned i, unsigned j)
  { return (i % around) * resolution + j % resolution; };
  for (unsigned i = 0; i < around; ++i)
  {
    for (unsigned j = 0; j < resolution; ++j)
    {
      const auto a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      mesh.triangles.push_back({ a, b, c });
      mesh.triangles.push_back({ a, c, d });
    }
  }
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& other, const Eigen::Vector3d& shift)
{
  const auto first = std::uint32_t(mesh.points.size());
  for (const Eigen::Vector3d& point : other.points)
  {
    mesh.points.push_back(point + shift);
  }
  for (const auto& [a, b, c] : other.triangles)
  {
    mesh.triangles.push_back({ first + a, first + b, first + c });
  }
}
}
