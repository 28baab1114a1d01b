// SPDX-License-Identifier: BSD-3-Clause
#include "NearestNames.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace
{
constexpr std::size_t MostNames = 3;

std::string LowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/** The edit distance of two words, in which the swap of two neighbouring letters is one edit. */
std::size_t EditDistance(const std::string& a, const std::string& b)
{
  // distances[i][j] is that of the first i letters of a and the first j letters of b.
  std::vector<std::vector<std::size_t>> distances(
    a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
  {
    for (std::size_t j = 0; j <= b.size(); ++j)
    {
      std::size_t& distance = distances[i][j];
      if (i == 0 || j == 0)
      {
        distance = i + j;
        continue;
      }
      distance = std::min({ distances[i - 1][j] + 1, distances[i][j - 1] + 1,
        distances[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1) });
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        distance = std::min(distance, distances[i - 2][j - 2] + 1);
      }
    }
  }
  return distances[a.size()][b.size()];
}
}

std::vector<std::string> NearestNames(
  const std::string& mistyped, const std::vector<std::string>& names)
{
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& name : names)
  {
    const std::size_t limit = name.size() / 3;
    // Else the distance of a very long word takes much memory.
    if (mistyped.size() > name.size() + limit)
    {
      continue;
    }
    const std::size_t distance = EditDistance(LowerCase(mistyped), LowerCase(name));
    if (distance <= limit)
    {
      near.emplace_back(distance, name);
    }
  }
  std::stable_sort(near.begin(), near.end(),
    [](const auto& one, const auto& other) { return one.first < other.first; });
  near.resize(std::min(near.size(), MostNames));

  std::vector<std::string> nearest;
  nearest.reserve(near.size());
  for (const auto& [distance, name] : near)
  {
    nearest.push_back(name);
  }
  return nearest;
}

std::string DidYouMean(const std::string& mistyped, const std::vector<std::string>& names)
{
  std::string question;
  for (const std::string& name : NearestNames(mistyped, names))
  {
    question += (question.empty() ? "did you mean " : " or ") + name;
  }
  return question.empty() ? "" : question + "?";
}
