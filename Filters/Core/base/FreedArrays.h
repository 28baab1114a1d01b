// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace neuralmesh
{
/// For programs, not for libraries: arrays of 2 MiB or more go back to the system when they are freed. By itself, the
/// GNU library comes to keep those of up to 32 MiB, with holes between them.
inline void returnFreedArrays()
{
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 21);
#endif
}
}
