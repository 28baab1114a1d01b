// SPDX-License-Identifier: BSD-3-Clause
#include "file/JoinedViews.h"

#include "cloud/OrientationHints.h"

namespace neuralmesh
{
FileViews joinedViews(std::span<const FileViews> parts)
{
  FileViews joined;
  bool areTold = true;
  for (const FileViews& part : parts)
  {
    areTold = areTold && (part.viewpoints.size() < 2 || part.views.size() == part.points);
    const auto first = std::uint32_t(joined.viewpoints.size());
    joined.points += part.points;
    joined.viewpoints.insert(
      joined.viewpoints.end(), part.viewpoints.begin(), part.viewpoints.end());
    if (part.viewpoints.size() < 2)
    {
      joined.views.resize(
        joined.points, part.viewpoints.empty() ? OrientationHints::NoView : first);
      continue;
    }
    for (const std::uint32_t view : part.views)
    {
      joined.views.push_back(
        view < part.viewpoints.size() ? first + view : OrientationHints::NoView);
    }
  }
  if (!areTold || joined.viewpoints.empty())
  {
    joined.views.clear();
  }
  return joined;
}
}
