// SPDX-License-Identifier: BSD-3-Clause
#include "fit/StoredPlaces.h"

#include "base/DifferenceBytes.h"

#include <array>

namespace neuralmesh
{
namespace
{
using Weights = std::array<float, 2>;

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

StoredPlaces::StoredPlaces(std::span<const PlaceOnMesh> places, const Executor& executor)
  : count_(places.size())
  , bytes_(
      places.size(), executor,
      [&](std::size_t begin, std::size_t end)
      { return sizeOfPlaces(places.subspan(begin, end - begin)); },
      [&](std::uint8_t* bytes, std::size_t begin, std::size_t end)
      { writePlaces(bytes, places.subspan(begin, end - begin)); })
{
}

ZeroedArray<PlaceOnMesh> StoredPlaces::places(const Executor& executor) const
{
  ZeroedArray<PlaceOnMesh> result(count_);
  executor.forEachRange(count_, ByteBlocks::ItemsOfBlock,
    [&](std::size_t begin, std::size_t end)
    { readPlaces(bytes_.from(begin), std::span(result).subspan(begin, end - begin)); });
  return result;
}
}
