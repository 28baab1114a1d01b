// SPDX-License-Identifier: BSD-3-Clause
#include "run/WarningTexts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace neuralmesh
{
std::string counted(std::size_t count, std::string_view one, std::string_view several)
{
  return std::to_string(count) + " " + std::string(count == 1 ? one : several);
}

std::string percent(double share)
{
  std::ostringstream text;
  text.precision(share > 0.1 ? 3 : 2);
  text << 100. * share << " %";
  return text.str();
}

std::string about(double points) { return std::to_string(std::llround(points)); }

std::string placeText(const Eigen::Vector3d& place, const PointCloud& cloud)
{
  const double step = std::max(1e-3 * cloud.diagonal() * cloud.unit(), 1e-300);
  const double largest = std::max(place.cwiseAbs().maxCoeff(), step);
  std::ostringstream text;
  text.precision(1 + int(std::ceil(std::log10(largest / step))));
  text << "(" << place[0] << ", " << place[1] << ", " << place[2] << ")";
  return text.str();
}

std::string otherPlaces(std::size_t count, std::size_t named)
{
  return count > named ? " and " + counted(count - named, "other place", "other places") : "";
}
}
