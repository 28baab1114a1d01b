// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CornerPlanes.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// As many points have a plane.
constexpr double LeastSamplesOfPlane = 3.;
/// Planes with at least that cosine are those of one face, and as many faces, at most, meet at a corner.
constexpr float LeastCosineOfFace = 0.95f;
constexpr std::size_t MostFaces = 4;
/// The regularisation of a quadric holds a place back a little: it is looked for again from there.
constexpr int SearchesForCorner = 4;

Vector4 meetingNear(Vector4 start, const PlaneQuadric& planes)
{
  Vector4 place = start;
  for (int i = 0; i < SearchesForCorner; ++i)
  {
    place = planes.least(place);
  }
  return place;
}
}

bool CornerPlanes::isConfirmed(const SampleLoad& load) const
{
  return load.count >= LeastSamplesOfPlane && !(load.excess(scale_) > 0.);
}

void CornerPlanes::collectAt(std::span<const VertexIndex> vertices)
{
  clear();
  for (const VertexIndex v : vertices)
  {
    around_.add(mesh_, v);
  }
  around_.finish();
  for (const Triangle& triangle : around_.triangles())
  {
    addPlane(triangle);
  }
}

void CornerPlanes::collectAround(std::span<const VertexIndex> vertices)
{
  clear();
  for (const VertexIndex v : vertices)
  {
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      around_.add(mesh_, neighbor);
    }
  }
  around_.finish();
  faces_.clear();
  double count = 0., area = 0.;
  for (const Triangle& triangle : around_.triangles())
  {
    const Found found = addPlane(triangle);
    count += found.count;
    area += double(found.length);
    if (found.isConfirmed)
    {
      addToFace(planes_.back().normal, found.middle, found.count);
    }
  }
  density_ = area > 0. ? count / area : 0.;
  std::stable_sort(faces_.begin(), faces_.end(),
    [](const Face& one, const Face& other) { return one.weight > other.weight; });
  faces_.resize(std::min(faces_.size(), MostFaces));
}

void CornerPlanes::clear()
{
  around_.clear();
  planes_.clear();
}

/// If samples confirm it.
CornerPlanes::Found CornerPlanes::addPlane(const Triangle& triangle)
{
  const auto& [a, b, c] = triangle;
  const SampleLoad load = samples_.load(a, b, c);
  const Vector4 pa = mesh_.position(a), pb = mesh_.position(b), pc = mesh_.position(c);
  const Vector4 normal = cross(pb - pa, pc - pa), middle = 1.f / 3.f * (pa + pb + pc);
  const float length = std::sqrt(squaredNorm(normal));
  const bool isFound = isConfirmed(load) && length > 0.f;
  if (isFound)
  {
    const Vector4 plane = 1.f / length * normal;
    planes_.push_back({ plane, dot(plane, middle) });
  }
  return { middle, length, load.count, isFound };
}

void CornerPlanes::addToFace(Vector4 plane, Vector4 middle, double weight)
{
  auto face = std::find_if(faces_.begin(), faces_.end(),
    [&](const Face& other) { return dot(other.normal, plane) > LeastCosineOfFace; });
  if (face == faces_.end())
  {
    faces_.push_back({ plane, 0., {} });
    face = faces_.end() - 1;
  }
  face->weight += weight;
  face->quadric.add(plane, middle, weight);
}

std::vector<Vector4> CornerPlanes::meetingsNear(Vector4 start) const
{
  std::vector<Vector4> places;
  for (std::size_t a = 0; a < faces_.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      const PlaneQuadric crease = faces_[a].quadric + faces_[b].quadric;
      places.push_back(meetingNear(start, crease));
      for (std::size_t c = 0; c < b; ++c)
      {
        places.push_back(meetingNear(start, crease + faces_[c].quadric));
      }
    }
  }
  return places;
}

/// For a small angle, 1 minus its cosine is half its square. So is a distance counted, against the size of the triangle.
float CornerPlanes::partOffPlanes(Vector4 normal, Vector4 middle) const
{
  const float length = std::sqrt(squaredNorm(normal));
  float least = 2.f;
  for (const Plane& plane : planes_)
  {
    const float away = dot(plane.normal, middle) - plane.offset;
    least = std::min(least, 1.f - (dot(plane.normal, normal) - 0.5f * away * away) / length);
  }
  return length > 0.f ? least : 0.f;
}

double CornerPlanes::crookedness(Vector4 a, Vector4 b, Vector4 c) const
{
  const Vector4 normal = cross(b - a, c - a);
  return double(partOffPlanes(normal, 1.f / 3.f * (a + b + c)) * std::sqrt(squaredNorm(normal)));
}

bool CornerPlanes::isCrooked(Vector4 a, Vector4 b, Vector4 c) const
{
  return partOffPlanes(cross(b - a, c - a), 1.f / 3.f * (a + b + c)) > 1.f - MostCosineOfCrooked;
}
}
