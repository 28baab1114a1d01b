// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace neuralmesh
{
/// Allocates large arrays on large pages, where the system has them: a sample touches a dozen
/// places of the mesh, and with pages of 4 KiB finding those takes as long as reading them.
template <typename T>
struct LargePageAllocator
{
  using value_type = T;

  LargePageAllocator() = default;
  template <typename Other>
  LargePageAllocator(const LargePageAllocator<Other>&)
  {
  }

  T* allocate(std::size_t count)
  {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < PageSize)
    {
      return static_cast<T*>(::operator new(bytes, std::align_val_t(alignof(T))));
    }
    const std::size_t rounded = (bytes + PageSize - 1) / PageSize * PageSize;
    void* memory = ::operator new(rounded, std::align_val_t(PageSize));
#ifdef __linux__
    madvise(memory, rounded, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t count)
  {
    const bool large = count * sizeof(T) >= PageSize;
    ::operator delete(memory, std::align_val_t(large ? PageSize : alignof(T)));
  }

  friend bool operator==(LargePageAllocator, LargePageAllocator) { return true; }

private:
  static constexpr std::size_t PageSize = std::size_t(1) << 21;
};

/// The arrays of the learning loop.
template <typename T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;
}
