// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/FourVectors.h"

namespace neuralmesh
{
/// A triangle for the squared distances of many points to it, four at a time: with the bits of
/// squaredDistanceToTriangle().
class TriangleDistances
{
public:
  using Lanes = FourVectors::Lanes;

  TriangleDistances(Vector4 a, Vector4 b, Vector4 c)
    : ab_(a, b)
    , bc_(b, c)
    , ca_(c, a)
    , toB_(b - a)
    , toC_(c - a)
    , normal_(cross(b - a, c - a))
    , squaredNormal_(squaredNorm(normal_))
  {
  }

  Lanes squared(const FourVectors& points) const
  {
    constexpr Lanes zero{};
    const FourVectors toPoint = points - ab_.from;
    const Lanes atB = dot(cross(toPoint, toC_), normal_), atC = dot(cross(toB_, toPoint), normal_);
    const Lanes across = dot(toPoint, normal_);
    const FourVectors::Mask isAbove =
      (atB >= zero) & (atC >= zero) & (atB + atC <= squaredNormal_) & (squaredNormal_ > zero);
    const Lanes toEdges =
      lower(ab_.squared(points), lower(bc_.squared(points), ca_.squared(points)));
    return isAbove ? across * across / squaredNormal_ : toEdges;
  }

private:
  /// An edge.
  struct Segment
  {
    FourVectors from, side;
    Lanes squaredLength;

    Segment(Vector4 begin, Vector4 end)
      : from(begin)
      , side(end - begin)
      , squaredLength(squaredNorm(side))
    {
    }

    Lanes squared(const FourVectors& points) const
    {
      constexpr Lanes zero{};
      const FourVectors toPoint = points - from;
      const Lanes t =
        squaredLength > zero ? clampedToOne(dot(side, toPoint) / squaredLength) : zero;
      return squaredNorm(toPoint - t * side);
    }
  };

  static Lanes lower(Lanes a, Lanes b) { return b < a ? b : a; }

  Segment ab_, bc_, ca_;
  FourVectors toB_, toC_, normal_;
  Lanes squaredNormal_;
};
}
