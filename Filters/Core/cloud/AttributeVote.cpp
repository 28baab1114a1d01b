// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/AttributeVote.h"

#include "cloud/NearestMarked.h"

#include <algorithm>
#include <unordered_map>

namespace neuralmesh
{
namespace
{
struct Vote
{
  std::uint32_t label;
  float weight;
};

/// The votes for each vertex: those for v end before those for v + 1 begin.
struct Ballots
{
  std::vector<Vote> votes;
  std::vector<std::size_t> begin;
};

Ballots collectVotes(const CloudPlaces& places, std::span<const std::uint32_t> labels)
{
  Ballots ballots;
  // First the counts, one vertex further; then the places to write to; at last the beginnings.
  ballots.begin.assign(places.mesh().indexEnd() + 2, 0);
  places.forEach(
    [&](std::size_t, const CloudPlaces::Corners& corners)
    {
      for (const auto& [v, weight] : corners)
      {
        ballots.begin[v + 2] += weight > 0. ? 1 : 0;
      }
    });
  for (std::size_t i = 2; i < ballots.begin.size(); ++i)
  {
    ballots.begin[i] += ballots.begin[i - 1];
  }
  ballots.votes.resize(ballots.begin.back());
  places.forEach(
    [&](std::size_t point, const CloudPlaces::Corners& corners)
    {
      for (const auto& [v, weight] : corners)
      {
        if (weight > 0.)
        {
          ballots.votes[ballots.begin[v + 1]++] = { labels[point],
            float(weight) * places.cloud().weight(point) };
        }
      }
    });
  return ballots;
}

/// NoLabel if there are no votes. Sorts them.
std::uint32_t winner(std::span<Vote> votes)
{
  std::sort(votes.begin(), votes.end(),
    [](const Vote& a, const Vote& b)
    { return a.label != b.label ? a.label < b.label : a.weight < b.weight; });
  std::uint32_t best = NoLabel;
  double most = -1.;
  for (std::size_t i = 0; i < votes.size();)
  {
    const std::uint32_t label = votes[i].label;
    double sum = 0.;
    for (; i < votes.size() && votes[i].label == label; ++i)
    {
      sum += double(votes[i].weight);
    }
    if (sum > most)
    {
      most = sum;
      best = label;
    }
  }
  return best;
}
}

std::vector<std::uint32_t> voteForLabels(
  const CloudPlaces& places, std::span<const std::uint32_t> labels)
{
  Ballots ballots = collectVotes(places, labels);
  std::vector<std::uint32_t> result(places.mesh().indexEnd());
  std::vector<bool> decided(result.size());
  for (VertexIndex v = 0; v < result.size(); ++v)
  {
    result[v] = winner(
      std::span(ballots.votes).subspan(ballots.begin[v], ballots.begin[v + 1] - ballots.begin[v]));
    decided[v] = result[v] != NoLabel;
  }
  const std::vector<VertexIndex> nearest = nearestMarked(places.mesh(), decided);
  for (VertexIndex v = 0; v < result.size(); ++v)
  {
    result[v] = nearest[v] == NoVertex ? NoLabel : result[nearest[v]];
  }
  return result;
}

std::vector<std::uint32_t> voteForKinds(const CloudPlaces& places, const KindOf& kindOf)
{
  const auto origins = places.cloud().origins();
  std::unordered_map<std::string, std::uint32_t> kinds;
  std::vector<std::uint32_t> lowest; // point of each kind
  std::vector<std::uint32_t> labels(origins.size());
  for (std::size_t point = 0; point < labels.size(); ++point)
  {
    const auto next = std::uint32_t(lowest.size());
    const auto place = kinds.try_emplace(kindOf(origins[point]), next).first;
    labels[point] = place->second;
    if (place->second == next)
    {
      lowest.push_back(origins[point]);
    }
    lowest[place->second] = std::min(lowest[place->second], origins[point]);
  }
  for (std::uint32_t& label : labels)
  {
    label = lowest[label];
  }
  return voteForLabels(places, labels);
}
}
