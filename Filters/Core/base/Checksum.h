// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace neuralmesh
{
/// A number of 64 bits that tells contents apart: by the steps of the SplitMix64 generator, eight
/// bytes at a time. It always tells a change within eight bytes, and any other one but for a chance
/// of 2^-64; it does not withstand those who want to deceive.
class Checksum
{
public:
  /// All parts but the last one must have a multiple of 8 bytes.
  void add(std::span<const std::byte> bytes)
  {
    assert(size_ % WordSize == 0);
    size_ += bytes.size();
    for (; bytes.size() >= WordSize; bytes = bytes.subspan(WordSize))
    {
      addWord(bytes.first(WordSize));
    }
    if (!bytes.empty())
    {
      addWord(bytes);
    }
  }

  std::uint64_t value() const { return mix(state_ ^ size_); }

private:
  static constexpr std::size_t WordSize = sizeof(std::uint64_t);

  void addWord(std::span<const std::byte> bytes)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), bytes.size());
    state_ = mix(state_ + 0x9e3779b97f4a7c15u) ^ word;
  }

  static std::uint64_t mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_ = 0;
  std::uint64_t size_ = 0;
};
}
