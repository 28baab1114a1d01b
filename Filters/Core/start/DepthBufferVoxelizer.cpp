// SPDX-License-Identifier: BSD-3-Clause
#include "start/DepthBufferVoxelizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// How voxels are seen from one side and its opposite: integer steps of the pixel (u, v) and of the
/// depth with each step along x, y, z. Pixels are lines through the centres of voxels.
struct View
{
  std::array<int, 3> u;
  std::array<int, 3> v;
  std::array<int, 3> depth;
};

/// Along the axes, the diagonals of the sides of a voxel, and those of the voxel.
constexpr std::array<View, 13> Views{ {
  { { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } },
  { { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } },
  { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
  { { 1, -1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } },
  { { 1, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } },
  { { 1, 0, -1 }, { 0, 1, 0 }, { 1, 0, 0 } },
  { { 1, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 } },
  { { 0, 1, -1 }, { 1, 0, 0 }, { 0, 1, 0 } },
  { { 0, 1, 1 }, { 1, 0, 0 }, { 0, 1, 0 } },
  { { 1, 0, -1 }, { 0, 1, -1 }, { 0, 0, 1 } },
  { { 1, 0, 1 }, { 0, 1, 1 }, { 0, 0, 1 } },
  { { 1, 0, 1 }, { 0, 1, -1 }, { 0, 0, 1 } },
  { { 1, 0, -1 }, { 0, 1, 1 }, { 0, 0, 1 } },
} };

/// A corner of a triangle as a view has it.
struct ProjectedCorner
{
  double u;
  double v;
  double depth;
};
using ProjectedTriangle = std::array<ProjectedCorner, 3>;

double sum(const std::array<int, 3>& steps, const Eigen::Vector3d& point)
{
  return steps[0] * point[0] + steps[1] * point[1] + steps[2] * point[2];
}

/// On which side of the line a-b a pixel lies, times the length of a-b. For b-a it is the same
/// number with the other sign, to the bit, so that no pixel falls between two triangles.
double side(const ProjectedCorner& a, const ProjectedCorner& b, double u, double v)
{
  const bool isTurned = b.u < a.u || (b.u == a.u && b.v < a.v);
  const ProjectedCorner &from = isTurned ? b : a, &to = isTurned ? a : b;
  const double value = (to.u - from.u) * (v - from.v) - (to.v - from.v) * (u - from.u);
  return isTurned ? -value : value;
}

/// The values that an integer sum of steps takes over the grid.
struct PixelRange
{
  PixelRange(const VoxelGrid& grid, const std::array<int, 3>& steps)
  {
    std::ptrdiff_t last = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::ptrdiff_t reach = steps[axis] * (std::ptrdiff_t(grid.counts[axis]) - 1);
      (reach < 0 ? first : last) += reach;
    }
    count = last - first + 1;
  }

  /// The pixels between three coordinates, from the first one on.
  std::array<std::ptrdiff_t, 2> covered(double a, double b, double c) const
  {
    const auto offset = double(first), size = double(count);
    const double begin = std::clamp(std::ceil(std::min({ a, b, c })) - offset, 0., size);
    const double end = std::clamp(std::floor(std::max({ a, b, c })) - offset + 1., begin, size);
    return { std::ptrdiff_t(begin), std::ptrdiff_t(end) };
  }

  std::ptrdiff_t first = 0;
  std::ptrdiff_t count;
};

/// First and last depth of a surface along the lines of voxels of a view.
class DepthBuffers
{
public:
  DepthBuffers(const VoxelGrid& grid, const View& view)
    : view_(view)
    , u_(grid, view.u)
    , v_(grid, view.v)
    , pixels_(std::size_t(u_.count * v_.count))
  {
  }

  /// `points` are the corners in voxels, the centre of the first one being the origin.
  void draw(const std::array<Eigen::Vector3d, 3>& points, bool isPhantom)
  {
    ProjectedTriangle corners;
    std::transform(points.begin(), points.end(), corners.begin(),
      [this](const Eigen::Vector3d& point) {
        return ProjectedCorner{ sum(view_.u, point), sum(view_.v, point), sum(view_.depth, point) };
      });
    const auto [uBegin, uEnd] = u_.covered(corners[0].u, corners[1].u, corners[2].u);
    const auto [vBegin, vEnd] = v_.covered(corners[0].v, corners[1].v, corners[2].v);
    for (std::ptrdiff_t v = vBegin; v < vEnd; ++v)
    {
      for (std::ptrdiff_t u = uBegin; u < uEnd; ++u)
      {
        drawPixel(corners, u, v, isPhantom);
      }
    }
  }

  /// Empties the voxels that can be seen from outside.
  void carve(const VoxelGrid& grid, std::vector<std::uint8_t>& inside) const
  {
    forEachVoxel(grid,
      [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
      {
        const auto at = [&](const std::array<int, 3>& steps)
        {
          return steps[0] * std::ptrdiff_t(x) + steps[1] * std::ptrdiff_t(y) +
            steps[2] * std::ptrdiff_t(z);
        };
        const std::ptrdiff_t pixel = (at(view_.v) - v_.first) * u_.count + at(view_.u) - u_.first;
        const Pixel& line = pixels_[std::size_t(pixel)];
        const auto depth = double(at(view_.depth));
        inside[index] &= line.isReal && depth >= line.first && depth <= line.last;
      });
  }

private:
  struct Pixel
  {
    double first = std::numeric_limits<double>::infinity();
    double last = -std::numeric_limits<double>::infinity();
    bool isReal = false; ///< whether other triangles than phantoms were drawn
  };

  void drawPixel(
    const ProjectedTriangle& corners, std::ptrdiff_t u, std::ptrdiff_t v, bool isPhantom)
  {
    const auto [a, b, c] = corners;
    const auto atU = double(u + u_.first), atV = double(v + v_.first);
    const double ofA = side(b, c, atU, atV), ofB = side(c, a, atU, atV), ofC = side(a, b, atU, atV);
    const bool isBeside = std::min({ ofA, ofB, ofC }) < 0. && std::max({ ofA, ofB, ofC }) > 0.;
    const double whole = ofA + ofB + ofC;
    if (isBeside || whole == 0.)
    {
      return;
    }
    const double depth = (ofA * a.depth + ofB * b.depth + ofC * c.depth) / whole;
    Pixel& pixel = pixels_[std::size_t(v * u_.count + u)];
    pixel.first = std::min(pixel.first, depth);
    pixel.last = std::max(pixel.last, depth);
    pixel.isReal = pixel.isReal || !isPhantom;
  }

  View view_;
  PixelRange u_;
  PixelRange v_;
  std::vector<Pixel> pixels_;
};
}

std::vector<std::uint8_t> voxelize(
  const TriangleMesh& mesh, const VoxelGrid& grid, std::span<const std::uint8_t> isPhantom)
{
  std::vector<Eigen::Vector3d> points(mesh.points.size());
  std::transform(mesh.points.begin(), mesh.points.end(), points.begin(),
    [&](const Eigen::Vector3d& point) -> Eigen::Vector3d
    { return (point - grid.first) / grid.width; });
  std::vector<std::uint8_t> inside(grid.size(), 1);
  for (const View& view : Views)
  {
    DepthBuffers buffers(grid, view);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      const auto& [a, b, c] = mesh.triangles[t];
      if (points[a].allFinite() && points[b].allFinite() && points[c].allFinite())
      {
        buffers.draw({ points[a], points[b], points[c] }, !isPhantom.empty() && isPhantom[t] != 0);
      }
    }
    buffers.carve(grid, inside);
  }
  return inside;
}
}
