// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"

#include <cstddef>

namespace neuralmesh
{
/// A vector of so many values without arguments. All threads touch its pages before one writes the values: the system
/// clears new pages for the thread that touches them, which takes longer than all that is written.
template <typename Vector>
Vector touchedVector(std::size_t count, const Executor& executor)
{
  constexpr std::size_t BytesOfPart = std::size_t(1) << 21, BytesOfPage = 4096;
  Vector result;
  result.reserve(count);
  auto* const bytes = reinterpret_cast<volatile unsigned char*>(result.data());
  executor.forEachRange(count * sizeof(*result.data()), BytesOfPart,
    [bytes](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; i += BytesOfPage)
      {
        bytes[i] = 0;
      }
    });
  result.resize(count);
  return result;
}
}
