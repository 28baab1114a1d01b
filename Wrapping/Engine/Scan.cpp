// SPDX-License-Identifier: BSD-3-Clause
#include "Scan.h"

#include "mesh/MeasuredSurface.h"

#include <stdexcept>
#include <vector>

namespace nb = nanobind;

namespace neuralmesh::binding
{
CloudOptions scanOptionsOf(const nb::dict& properties)
{
  CloudOptions options;
  options.count = nb::cast<std::size_t>(properties["NumberOfPoints"]);
  options.seed = nb::cast<std::uint64_t>(properties["Seed"]);
  options.noise = nb::cast<double>(properties["Noise"]);
  options.outliers = nb::cast<double>(properties["Outliers"]);
  options.holes = nb::cast<unsigned>(properties["Holes"]);
  options.holeRadius = nb::cast<double>(properties["HoleRadius"]);
  return options;
}

nb::object scan(TriangleMesh surface, CloudOptions options,
  const std::optional<ArrayOf<double>>& viewpoint, bool isDouble, Call& call)
{
  std::vector<Eigen::Vector3d> points;
  {
    const nb::gil_scoped_release unlocked;
    MeasuredSurface measured(std::move(surface));
    // In coordinates of its own: the bounding box around the origin, with a diagonal of 1.
    const Eigen::AlignedBox3d box = measured.box();
    const double unit = box.isEmpty() ? 0. : box.diagonal().stableNorm();
    if (unit > 0.)
    {
      measured.transform(box.center(), unit);
    }
    if (!(unit > 0.) || !measured.hasArea())
    {
      throw std::invalid_argument("The surface has no triangle with an area.");
    }
    if (viewpoint)
    {
      options.viewpoint = (placesOf(*viewpoint).at(0) - box.center()) / unit;
    }
    points = generateCloud(measured.mesh(), options, call.part(0., 1.));
    for (Eigen::Vector3d& point : points)
    {
      point = box.center() + unit * point;
    }
  }
  return isDouble ? rowsOf<double>(points) : rowsOf<float>(points);
}
}
