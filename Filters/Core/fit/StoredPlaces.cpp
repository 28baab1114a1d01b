// SPDX-License-Identifier: BSD-3-Clause
#include "fit/StoredPlaces.h"

#include "base/DifferenceBytes.h"

#include <array>

namespace neuralmesh
{
namespace
{
constexpr std::size_t PlacesOfBlock = 4096;
/// Usual ones, for which there is room at once.
constexpr std::size_t BytesOfPlace = 16;
}

StoredPlaces::StoredPlaces(std::span<const PlaceOnMesh> places, const Executor& executor)
  : count_(places.size())
  , blocks_((places.size() + PlacesOfBlock - 1) / PlacesOfBlock)
{
  executor.forEachRange(count_, PlacesOfBlock,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<std::uint8_t> bytes;
      bytes.reserve(BytesOfPlace * (end - begin));
      VertexIndex last = 0;
      for (const PlaceOnMesh& place : places.subspan(begin, end - begin))
      {
        const auto& [a, b, c] = place.triangle;
        writeDifference(bytes, a, last);
        writeDifference(bytes, b, a);
        writeDifference(bytes, c, a);
        last = a;
        const std::array<float, 2> weights{ place.second, place.third };
        const std::size_t size = bytes.size();
        bytes.resize(size + sizeof(weights));
        __builtin_memcpy(bytes.data() + size, weights.data(), sizeof(weights));
      }
      blocks_[begin / PlacesOfBlock] = { bytes.begin(), bytes.end() };
    });
}

std::vector<PlaceOnMesh> StoredPlaces::places(const Executor& executor) const
{
  std::vector<PlaceOnMesh> result(count_);
  executor.forEachRange(count_, PlacesOfBlock,
    [&](std::size_t begin, std::size_t end)
    {
      const std::uint8_t* bytes = blocks_[begin / PlacesOfBlock].data();
      VertexIndex last = 0;
      for (std::size_t i = begin; i < end; ++i)
      {
        const VertexIndex a = readDifference(bytes, last);
        const VertexIndex b = readDifference(bytes, a);
        const VertexIndex c = readDifference(bytes, a);
        last = a;
        std::array<float, 2> weights{};
        __builtin_memcpy(weights.data(), bytes, sizeof(weights));
        bytes += sizeof(weights);
        result[i] = { { a, b, c }, weights[0], weights[1], 0.f };
      }
    });
  return result;
}
}
