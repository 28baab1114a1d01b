// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/Piles.h"

namespace neuralmesh
{
namespace
{
bool comesBefore(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}
}

std::size_t pileAt(const Eigen::Vector3d& place, std::span<const Pile> piles)
{
  const auto found = std::lower_bound(piles.begin(), piles.end(), place,
    [](const Pile& pile, const Eigen::Vector3d& p) { return comesBefore(pile.place, p); });
  return found != piles.end() && found->place == place ? std::size_t(found - piles.begin())
                                                       : piles.size();
}

std::vector<Pile> PileSearch::find() const
{
  std::vector<Pile> piles = crowded_;
  std::sort(piles.begin(), piles.end(),
    [](const Pile& a, const Pile& b)
    { return a.count != b.count ? a.count > b.count : comesBefore(a.place, b.place); });
  std::size_t points = points_, found = 0;
  while (found < piles.size() && piles[found].count * places_ > TimesUsual * points)
  {
    points -= piles[found].count - 1;
    ++found;
  }
  piles.resize(found);
  std::sort(piles.begin(), piles.end(),
    [](const Pile& a, const Pile& b) { return comesBefore(a.place, b.place); });
  return piles;
}

std::size_t PileSearch::addDifferent(std::vector<Eigen::Vector3d>& all)
{
  std::sort(all.begin(), all.end(), comesBefore);
  std::size_t places = 0;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end, ++places)
  {
    while (end < all.size() && all[end] == all[begin])
    {
      ++end;
    }
    addPlace({ all[begin], end - begin });
  }
  return places;
}
}
