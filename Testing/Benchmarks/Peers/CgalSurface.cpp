// SPDX-License-Identifier: BSD-3-Clause
// Surfaces by CGAL: CgalSurface front|poisson CLOUD.ply MESH.off noisy|clean. Advancing front
// interpolates the points; where they are noisy, outliers are removed and the rest is smoothed
// before, as CGAL's own tutorial does it. Poisson estimates normals and orients them.
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/grid_simplify_point_set.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/read_points.h>
#include <CGAL/jet_estimate_normals.h>
#include <CGAL/jet_smooth_point_set.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/remove_outliers.h>

#include <array>
#include <cstdio>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Oriented = std::pair<Point, Kernel::Vector_3>;
using Facet = std::array<std::size_t, 3>;

constexpr unsigned Neighbors = 24;
constexpr double OutlierPercentage = 2.;

bool writeFront(const std::vector<Point>& points, const std::string& path)
{
  std::vector<Facet> facets;
  CGAL::advancing_front_surface_reconstruction(
    points.begin(), points.end(), std::back_inserter(facets));
  return CGAL::IO::write_OFF(path, points, facets);
}

bool writePoisson(const std::vector<Point>& points, const std::string& path)
{
  std::vector<Oriented> oriented;
  for (const Point& point : points)
  {
    oriented.emplace_back(point, Kernel::Vector_3());
  }
  const auto maps = CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Oriented>())
                      .normal_map(CGAL::Second_of_pair_property_map<Oriented>());
  CGAL::jet_estimate_normals<CGAL::Sequential_tag>(oriented, Neighbors, maps);
  oriented.erase(CGAL::mst_orient_normals(oriented, Neighbors, maps), oriented.end());
  const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, 6);
  CGAL::Polyhedron_3<Kernel> mesh;
  return CGAL::poisson_surface_reconstruction_delaunay(oriented.begin(), oriented.end(),
           CGAL::First_of_pair_property_map<Oriented>(),
           CGAL::Second_of_pair_property_map<Oriented>(), mesh, spacing) &&
    CGAL::IO::write_OFF(path, mesh);
}
}

int main(int argc, char* argv[])
{
  if (argc != 5)
  {
    std::fprintf(stderr, "CgalSurface front|poisson CLOUD.ply MESH.off noisy|clean\n");
    return 2;
  }
  std::vector<Point> points;
  if (!CGAL::IO::read_points(argv[2], std::back_inserter(points)))
  {
    std::fprintf(stderr, "%s cannot be read\n", argv[2]);
    return 1;
  }
  if (std::string(argv[4]) == "noisy")
  {
    points.erase(CGAL::remove_outliers<CGAL::Sequential_tag>(
                   points, Neighbors, CGAL::parameters::threshold_percent(OutlierPercentage)),
      points.end());
    const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, 6);
    points.erase(CGAL::grid_simplify_point_set(points, 2. * spacing), points.end());
    CGAL::jet_smooth_point_set<CGAL::Sequential_tag>(points, Neighbors);
  }
  const bool isFront = std::string(argv[1]) == "front";
  return (isFront ? writeFront(points, argv[3]) : writePoisson(points, argv[3])) ? 0 : 1;
}
