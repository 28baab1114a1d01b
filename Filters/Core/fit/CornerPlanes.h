// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/PlaneQuadric.h"
#include "fit/TriangleSamples.h"
#include "fit/TrianglesAround.h"
#include "mesh/Mesh.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The planes of the triangles near a corner that may be cut off, as far as samples confirm them.
class CornerPlanes
{
public:
  /// A triangle is crooked if all planes around are turned by more against it, or as far off as that turns it.
  static constexpr float MostCosineOfCrooked = 0.9f;

  /// `scale` is that of a sample's squared distance to the mesh.
  CornerPlanes(const Mesh& mesh, const TriangleSamples& samples, double scale)
    : mesh_(mesh)
    , samples_(samples)
    , scale_(scale)
  {
  }

  bool isConfirmed(const SampleLoad& load) const;

  /// Notes the planes of the triangles at some vertices. What is not crooked then is not crooked among more planes.
  void collectAt(std::span<const VertexIndex> vertices);

  /// Notes those at their neighbours, too.
  void collectAround(std::span<const VertexIndex> vertices);

  /// Where two or three of the planes meet, near `start`.
  std::vector<Vector4> meetingsNear(Vector4 start) const;

  /// By how much a triangle is turned against the plane that it comes closest to, and off it, times twice its area.
  double crookedness(Vector4 a, Vector4 b, Vector4 c) const;
  bool isCrooked(Vector4 a, Vector4 b, Vector4 c) const;

  /// All triangles there, with the least corner first, and the samples on them by the length of their normals.
  const std::vector<Triangle>& triangles() const { return around_.triangles(); }
  double density() const { return density_; }

private:
  /// Triangles that lie in about the same plane.
  struct Face
  {
    Vector4 normal; ///< of the first one
    double weight = 0.;
    PlaneQuadric quadric;
  };

  struct Plane
  {
    Vector4 normal; ///< unit
    float offset;   ///< along it
  };

  /// What is known of a triangle.
  struct Found
  {
    Vector4 middle;
    float length; ///< twice the area
    double count; ///< of samples
    bool isConfirmed;
  };

  void clear();
  Found addPlane(const Triangle& triangle);
  float partOffPlanes(Vector4 normal, Vector4 middle) const;
  void addToFace(Vector4 plane, Vector4 middle, double weight);

  const Mesh& mesh_;
  const TriangleSamples& samples_;
  double scale_;
  TrianglesAround around_;
  std::vector<Plane> planes_;
  std::vector<Face> faces_;
  double density_ = 0.;
};
}
