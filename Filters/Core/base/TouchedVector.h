// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/LargePageAllocator.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace neuralmesh
{
/// Touches the pages of new memory, on all threads, before one writes there: the system clears new pages for the thread
/// that touches them, which takes longer than all that is written.
inline void touchPages(void* memory, std::size_t size, const Executor& executor)
{
  constexpr std::size_t BytesOfPart = std::size_t(1) << 21, BytesOfPage = 4096;
  auto* const bytes = static_cast<volatile unsigned char*>(memory);
  executor.forEachRange(size, BytesOfPart,
    [bytes](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; i += BytesOfPage)
      {
        bytes[i] = 0;
      }
    });
}

/// Those of the memory that an empty vector has reserved.
template <typename Vector>
void touchReserved(Vector& empty, const Executor& executor)
{
  touchPages(empty.data(), empty.capacity() * sizeof(*empty.data()), executor);
}

/// A vector of so many values without arguments.
template <typename Vector>
Vector touchedVector(std::size_t count, const Executor& executor)
{
  Vector result;
  result.reserve(count);
  touchReserved(result, executor);
  result.resize(count);
  return result;
}

/// As `values.reserve(count)`. What has moved gives its memory back at once, so that there is room for one array, not two.
template <typename T>
void reserveTouched(LargeVector<T>& values, std::size_t count, const Executor& executor)
{
  // Pages of so many come on several threads.
  constexpr std::size_t ValuesAtOnce = (std::size_t(8) << 20) / sizeof(T);
  if (values.capacity() >= count)
  {
    return;
  }
  LargeVector<T> result;
  result.reserve(count);
  const std::size_t capacity = values.capacity();
  for (std::size_t first = 0; first < count; first += ValuesAtOnce)
  {
    touchPages(result.data() + first, std::min(ValuesAtOnce, count - first) * sizeof(T), executor);
    const std::size_t end = std::min(first + ValuesAtOnce, values.size());
    if (first < end)
    {
      result.insert(
        result.end(), values.begin() + std::ptrdiff_t(first), values.begin() + std::ptrdiff_t(end));
      LargePageAllocator<T>::releaseFirst(values.data(), capacity, end);
    }
  }
  values = std::move(result);
}
}
