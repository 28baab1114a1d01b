// SPDX-License-Identifier: BSD-3-Clause
#include "fit/StoredPlaces.h"

#include "base/DifferenceBytes.h"

#include <algorithm>
#include <array>
#include <span>

namespace neuralmesh
{
namespace
{
using Weights = std::array<float, 2>;

/// While places are packed, memory is freed after each of some stages, if these have enough work for all threads.
constexpr std::size_t MostStages = 16;
constexpr std::size_t LeastBlocksOfStage = 64;

std::size_t stagesOf(std::size_t places)
{
  return std::clamp<std::size_t>(
    places / (LeastBlocksOfStage * ByteBlocks::ItemsOfBlock), 1, MostStages);
}

std::size_t sizeOfPlaces(std::span<const PlaceOnMesh> places)
{
  std::size_t size = places.size() * sizeof(Weights);
  VertexIndex last = 0;
  for (const PlaceOnMesh& place : places)
  {
    const auto& [a, b, c] = place.triangle;
    size += sizeOfDifference(a, last) + sizeOfDifference(b, a) + sizeOfDifference(c, a);
    last = a;
  }
  return size;
}

void writePlaces(std::uint8_t* bytes, std::span<const PlaceOnMesh> places)
{
  VertexIndex last = 0;
  for (const PlaceOnMesh& place : places)
  {
    const auto& [a, b, c] = place.triangle;
    writeDifference(bytes, a, last);
    writeDifference(bytes, b, a);
    writeDifference(bytes, c, a);
    last = a;
    const Weights weights{ place.second, place.third };
    __builtin_memcpy(bytes, weights.data(), sizeof(weights));
    bytes += sizeof(weights);
  }
}

void readPlaces(const std::uint8_t* bytes, std::span<PlaceOnMesh> places)
{
  VertexIndex last = 0;
  for (PlaceOnMesh& place : places)
  {
    const VertexIndex a = readDifference(bytes, last);
    const VertexIndex b = readDifference(bytes, a);
    const VertexIndex c = readDifference(bytes, a);
    last = a;
    Weights weights{};
    __builtin_memcpy(weights.data(), bytes, sizeof(weights));
    bytes += sizeof(weights);
    place = { { a, b, c }, weights[0], weights[1], 0.f };
  }
}
}

StoredPlaces::StoredPlaces(ZeroedArray<PlaceOnMesh>&& places, const Executor& executor)
  : count_(places.size())
  , bytes_(
      places.size(), executor,
      [&](std::size_t begin, std::size_t end)
      { return sizeOfPlaces(std::span(places).subspan(begin, end - begin)); },
      [&](std::uint8_t* bytes, std::size_t begin, std::size_t end)
      { writePlaces(bytes, std::span(places).subspan(begin, end - begin)); },
      stagesOf(places.size()), [&](std::size_t end) { places.releaseFirst(end); })
{
}

ZeroedArray<PlaceOnMesh> StoredPlaces::takePlaces(const Executor& executor)
{
  ZeroedArray<PlaceOnMesh> result(count_);
  bytes_.takeOut(
    count_, executor,
    [&](const std::uint8_t* bytes, std::size_t begin, std::size_t end)
    { readPlaces(bytes, std::span(result).subspan(begin, end - begin)); },
    stagesOf(count_));
  return result;
}
}
