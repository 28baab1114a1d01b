// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef __linux__
#include <unistd.h>

#include <fstream>

namespace neuralmesh::testing
{
/// Bytes of memory in use that no file stands behind.
inline double anonymousBytes()
{
  std::ifstream file("/proc/self/statm");
  double size = 0., resident = 0., shared = 0.;
  file >> size >> resident >> shared;
  return (resident - shared) * double(sysconf(_SC_PAGESIZE));
}
}
#endif
