// SPDX-License-Identifier: BSD-3-Clause
#include "InfoCommand.h"

#include "JSON.h"
#include "MeshReader.h"

#include "mesh/SurfaceReport.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using neuralmesh::SurfaceReport;

struct InfoOptions
{
  std::vector<std::string> Meshes;
  bool JSON = false;
};

SurfaceReport Report(const std::string& path)
{
  const auto data = ReadMesh(path);
  try
  {
    return neuralmesh::reportSurface(vtkTriangleMeshCollector::Collect(data));
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(path + ": " + error.what());
  }
}

void PrintReportJSON(const std::string& path, const SurfaceReport& report)
{
  nlohmann::ordered_json valences = nlohmann::ordered_json::object();
  for (const auto& [valence, vertices] : report.valences)
  {
    valences[std::to_string(valence)] = vertices;
  }
  nlohmann::ordered_json object{ { "file", path }, { "vertices", report.vertices },
    { "triangles", report.triangles }, { "regular_ratio", report.regularRatio },
    { "valences", valences }, { "triangle_quality", report.meanQuality },
    { "closed", report.isClosed() }, { "edge_manifold", report.isEdgeManifold() },
    { "vertex_manifold", report.isVertexManifold() }, { "oriented", report.isOriented() },
    { "components", report.components }, { "genus", nullptr },
    { "boundary_loops", report.boundaryLoops }, { "boundary_edges", report.boundaryEdges },
    { "folded_edges", report.foldedEdges }, { "non_manifold_edges", report.nonManifoldEdges },
    { "non_manifold_vertices", report.nonManifoldVertices },
    { "inconsistent_edges", report.inconsistentEdges }, { "surface_area", report.area },
    { "volume", nullptr }, { "bounding_box_diagonal", report.diagonal },
    { "degenerate_triangles", report.degenerateTriangles },
    { "unused_points", report.unusedPoints }, { "non_finite_points", report.nonFinitePoints } };
  if (report.genus)
  {
    object["genus"] = *report.genus;
  }
  if (report.volume)
  {
    object["volume"] = *report.volume;
  }
  constexpr auto anyBytes = nlohmann::ordered_json::error_handler_t::replace;
  std::cout << object.dump(-1, ' ', false, anyBytes) << std::endl;
}

std::string Count(std::size_t count, const std::string& what)
{
  return std::to_string(count) + " " + what;
}

/** yes, or no and what is against it. */
std::string YesUnless(const std::string& hindrance, bool yes)
{
  return yes ? "yes" : "no (" + hindrance + ")";
}

std::string SixDigits(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string Percent(std::size_t part, std::size_t whole)
{
  char text[32];
  std::snprintf(
    text, sizeof text, "%.2f %%", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
  return text;
}

/** The valences that are not rare each, the others in one. */
std::string Valences(const SurfaceReport& report)
{
  std::string text;
  std::size_t others = report.vertices;
  for (const auto& [valence, vertices] : report.valences)
  {
    if (vertices * 200 >= report.vertices)
    {
      text += std::to_string(valence) + ": " + Percent(vertices, report.vertices) + ", ";
      others -= vertices;
    }
  }
  return text + "others: " + Percent(others, report.vertices);
}

void PrintLine(const char* name, const std::string& value)
{
  std::printf("  %-18s  %s\n", name, value.c_str());
}

void PrintReportTable(const std::string& path, const SurfaceReport& report)
{
  std::printf("%s\n", path.c_str());
  PrintLine("vertices", std::to_string(report.vertices));
  PrintLine("triangles", std::to_string(report.triangles));
  PrintLine("regular vertices", SixDigits(100.0 * report.regularRatio) + " %");
  if (report.vertices > 0)
  {
    PrintLine("valences", Valences(report));
  }
  PrintLine(
    "triangle quality", SixDigits(report.meanQuality) + " (mean; 1: equilateral, 0: no area)");
  const std::string open = report.components > 0 ? Count(report.boundaryEdges, "boundary edges")
                                                 : "no triangle of three points";
  PrintLine("closed", YesUnless(open, report.isClosed()));
  PrintLine("manifold",
    YesUnless(Count(report.nonManifoldEdges, "edges and ") +
        Count(report.nonManifoldVertices, "vertices are not"),
      report.isEdgeManifold() && report.isVertexManifold()));
  PrintLine("oriented",
    YesUnless(
      Count(report.inconsistentEdges, "edges between opposite sides"), report.isOriented()));
  PrintLine("components", std::to_string(report.components));
  PrintLine("genus", report.genus ? std::to_string(*report.genus) : "not defined");
  PrintLine("boundary loops", std::to_string(report.boundaryLoops));
  PrintLine("folded edges", std::to_string(report.foldedEdges));
  PrintLine("area", SixDigits(report.area));
  PrintLine("volume", report.volume ? SixDigits(*report.volume) : "not defined");
  PrintLine("diagonal", SixDigits(report.diagonal));
  PrintLine("to be cleaned",
    Count(report.degenerateTriangles, "triangles without area, ") +
      Count(report.unusedPoints, "unused points, ") +
      Count(report.nonFinitePoints, "points not finite"));
}

int Inform(const InfoOptions& options)
{
  int status = 0;
  for (const std::string& path : options.Meshes)
  {
    try
    {
      const SurfaceReport report = Report(path);
      (options.JSON ? PrintReportJSON : PrintReportTable)(path, report);
    }
    catch (const std::runtime_error& error)
    {
      std::cerr << "neuralmesh: " << error.what() << std::endl;
      status = 1;
    }
  }
  return status;
}
}

std::function<int()> AddInfoCommand(CLI::App& application)
{
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
    application.add_subcommand("info", "Check whether meshes are sound, and how good they are");
  command->add_option("MESH", options->Meshes, "Meshes: .ply .vtp .vtk .obj .stl .off")->required();
  command->add_flag("--json", options->JSON, "Print a JSON object for each mesh, one per line");
  command->footer(
    "regular vertices   have six edges, or four on the boundary\n"
    "triangle quality   twice the radius of the inscribed over that of the circumscribed circle\n"
    "closed             every edge has at least two triangles\n"
    "manifold           an edge has at most two triangles, and those at a vertex are connected\n"
    "oriented           neighbouring triangles have their fronts on the same side\n"
    "components         pieces connected by edges\n"
    "genus              handles of all components, as if the holes were capped\n"
    "boundary loops     outlines and holes\n"
    "folded edges       where the surface turns by more than 150 degrees\n"
    "volume             positive if the normals point outwards\n"
    "Lengths are in units of the file.\n"
    "\nExit status: 0 done, 1 a file cannot be used (the message is on stderr, the other files "
    "are\n"
    "still reported), 2 wrong use.");
  return [options] { return Inform(*options); };
}
