// SPDX-License-Identifier: BSD-3-Clause
#include "Sides.h"

#include <stdexcept>

namespace neuralmesh::binding
{
OrientationHints Sides::hints() const
{
  OrientationHints result;
  result.viewpoints = placesOf(viewpoints);
  // The functions are called from several threads: they know nothing of Python.
  if (views && !result.viewpoints.empty())
  {
    result.viewOf = [values = valuesOf(*views)](std::uint32_t point) { return values[point]; };
  }
  if (normals)
  {
    result.normalOf = [values = valuesOf(*normals)](std::uint32_t point)
    { return Eigen::Vector3d(values.data() + 3 * std::size_t(point)); };
  }
  if (up)
  {
    result.up = Eigen::Vector3d(up->data());
  }
  return result;
}

void Sides::requireCount(std::size_t points) const
{
  if (views && views->size() != points)
  {
    throw std::invalid_argument("there are not as many views as points");
  }
  if (normals && normals->size() != 3 * points)
  {
    throw std::invalid_argument("there are not as many normals as points, of three numbers each");
  }
}
}
