// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LargePageAllocator.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// Values all bits of which are 0 at first. A large array is not written for that, as the system gives its memory so: its pages
/// come when they are used first, by all threads that fill it.
template <typename T>
class ZeroedArray
{
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
  ZeroedArray() = default;
  explicit ZeroedArray(std::size_t count)
    : values_(count)
  {
  }

  std::size_t size() const { return values_.size(); }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  auto begin() { return values_.begin(); }
  auto begin() const { return values_.begin(); }
  auto end() { return values_.end(); }
  auto end() const { return values_.end(); }

  /// Gives memory of the first `count` values back to the system. They must not be read any more.
  void releaseFirst(std::size_t count)
  {
    LargePageAllocator<T>::releaseFirst(values_.data(), values_.size(), count);
  }

private:
  /// What it allocates is 0 already, so that nothing is constructed without a value.
  struct Allocator : LargePageAllocator<T>
  {
    template <typename Other>
    struct rebind
    {
      using other = typename ZeroedArray<Other>::Allocator;
    };

    T* allocate(std::size_t count)
    {
      T* const memory = LargePageAllocator<T>::allocate(count);
      if (!LargePageAllocator<T>::comesZeroed(count))
      {
        std::memset(static_cast<void*>(memory), 0, count * sizeof(T));
      }
      return memory;
    }
    void construct(T*) {}
    template <typename... Arguments>
    void construct(T* place, Arguments&&... arguments)
    {
      ::new (static_cast<void*>(place)) T(std::forward<Arguments>(arguments)...);
    }
  };

  std::vector<T, Allocator> values_;
};
}
