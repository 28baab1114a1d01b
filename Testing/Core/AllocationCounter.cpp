// SPDX-License-Identifier: BSD-3-Clause
#include "AllocationCounter.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<std::size_t> count{ 0 };

void* allocateOrNull(std::size_t size, std::size_t alignment) noexcept
{
  count.fetch_add(1, std::memory_order_relaxed);
  // The size must be a multiple of the alignment.
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment);
}

void* allocate(std::size_t size, std::size_t alignment)
{
  void* const memory = allocateOrNull(size, alignment);
  if (memory == nullptr)
  {
    throw std::bad_alloc();
  }
  return memory;
}
}

// The forms for arrays call these. Those that do not throw would, but for the address sanitizer's,
// whose memory these must not free.
void* operator new(std::size_t size) { return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  return allocateOrNull(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return allocate(size, std::size_t(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace neuralmesh::testing
{
std::size_t allocationCount() { return count.load(std::memory_order_relaxed); }
}
