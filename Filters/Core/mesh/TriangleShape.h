// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
/// Area of an equilateral triangle over the square of its edge.
inline const float EquilateralArea = std::sqrt(3.f) / 4.f;

inline float triangleArea(Vector4 a, Vector4 b, Vector4 c)
{
  return 0.5f * std::sqrt(squaredNorm(cross(b - a, c - a)));
}

inline float squaredLongestEdge(Vector4 a, Vector4 b, Vector4 c)
{
  return std::max({ squaredNorm(b - a), squaredNorm(c - b), squaredNorm(a - c) });
}

/// Twice the radius of the inscribed over that of the circumscribed circle: 1 for an equilateral triangle, 0
/// for one without area.
inline float radiusRatio(Vector4 a, Vector4 b, Vector4 c)
{
  const float x = std::sqrt(squaredNorm(c - b)), y = std::sqrt(squaredNorm(a - c));
  const float z = std::sqrt(squaredNorm(b - a)), product = x * y * z;
  return product > 0.f ? (y + z - x) * (z + x - y) * (x + y - z) / product : 0.f;
}

/// Cosine of the angle between two vectors; -1 if one has no length.
inline float cosineBetween(Vector4 a, Vector4 b)
{
  const float lengths = std::sqrt(squaredNorm(a) * squaredNorm(b));
  return lengths > 0.f ? dot(a, b) / lengths : -1.f;
}

inline float squaredDistanceToSegment(Vector4 point, Vector4 a, Vector4 b)
{
  const Vector4 side = b - a, toPoint = point - a;
  const float squared = squaredNorm(side);
  const float t = squared > 0.f ? std::clamp(dot(side, toPoint) / squared, 0.f, 1.f) : 0.f;
  return squaredNorm(toPoint - t * side);
}

inline float squaredDistanceToTriangle(Vector4 point, Vector4 a, Vector4 b, Vector4 c)
{
  const Vector4 ab = b - a, ac = c - a, toPoint = point - a;
  const Vector4 normal = cross(ab, ac);
  const float squared = squaredNorm(normal);
  const float atB = dot(cross(toPoint, ac), normal), atC = dot(cross(ab, toPoint), normal);
  if (atB >= 0.f && atC >= 0.f && atB + atC <= squared && squared > 0.f)
  {
    const float across = dot(toPoint, normal);
    return across * across / squared;
  }
  return std::min({ squaredDistanceToSegment(point, a, b), squaredDistanceToSegment(point, b, c),
    squaredDistanceToSegment(point, c, a) });
}

/// How far a triangle is from equilateral: 0 for an equilateral one, up to 1.
inline float inequality(Vector4 a, Vector4 b, Vector4 c)
{
  const float edges = squaredNorm(b - a) + squaredNorm(c - b) + squaredNorm(a - c);
  return edges > 0.f ? 1.f - 16.f * EquilateralArea * triangleArea(a, b, c) / edges : 1.f;
}
}
