// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
    if (!isLarge(count))
    {
      return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(Alignment)));
    }
#ifdef __linux__
    // From the system, and back to it: as arrays grow, holes would be left in the heap.
    const std::size_t bytes = roundedBytes(count);
    void* const memory =
      mmap(nullptr, bytes + PageSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
    {
      throw std::bad_alloc();
    }
    auto* const begin = static_cast<std::byte*>(memory);
    const std::size_t before = (PageSize - std::uintptr_t(begin) % PageSize) % PageSize;
    if (before > 0)
    {
      munmap(begin, before);
    }
    munmap(begin + before + bytes, PageSize - before);
    madvise(begin + before, bytes, MADV_HUGEPAGE);
    return reinterpret_cast<T*>(begin + before);
#else
    return static_cast<T*>(::operator new(roundedBytes(count), std::align_val_t(PageSize)));
#endif
  }

  void deallocate(T* memory, std::size_t count)
  {
    if (!isLarge(count))
    {
      ::operator delete(memory, std::align_val_t(Alignment));
      return;
    }
#ifdef __linux__
    munmap(memory, roundedBytes(count));
#else
    ::operator delete(memory, std::align_val_t(PageSize));
#endif
  }

  /// Gives the memory of an array back to the system until it is used again; what was there is lost.
  static void release(T* memory, std::size_t count)
  {
#ifdef __linux__
    if (isLarge(count))
    {
      madvise(memory, roundedBytes(count), MADV_DONTNEED);
    }
#else
    static_cast<void>(memory);
    static_cast<void>(count);
#endif
  }

  /// The same for the first `done` values of `count`. Those that share a page with later ones stay.
  static void releaseFirst(T* memory, std::size_t count, std::size_t done)
  {
#ifdef __linux__
    if (isLarge(count))
    {
      madvise(memory, done * sizeof(T) / PageSize * PageSize, MADV_DONTNEED);
    }
#else
    static_cast<void>(memory);
    static_cast<void>(count);
    static_cast<void>(done);
#endif
  }

  /// Whether so many values are 0 when they come.
  static bool comesZeroed(std::size_t count)
  {
#ifdef __linux__
    return isLarge(count);
#else
    static_cast<void>(count);
    return false;
#endif
  }

  friend bool operator==(LargePageAllocator, LargePageAllocator) { return true; }

private:
  static constexpr std::size_t PageSize = std::size_t(1) << 21;
  /// Small ones begin with a cache line at least.
  static constexpr std::size_t Alignment = std::max<std::size_t>(alignof(T), 64);

  static bool isLarge(std::size_t count) { return count * sizeof(T) >= PageSize; }
  static std::size_t roundedBytes(std::size_t count)
  {
    return (count * sizeof(T) + PageSize - 1) / PageSize * PageSize;
  }
};

/// The arrays of the learning loop.
template <typename T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;
}
