// SPDX-License-Identifier: BSD-3-Clause
#include "base/AvailableProcessors.h"

#include <algorithm>
#include <thread>

#ifdef __linux__
#include <cmath>
#include <cstddef>
#include <fstream>
#include <memory>
#include <sched.h>
#include <string>
#endif

namespace neuralmesh
{
namespace
{
#ifdef __linux__
/// Of the affinity mask; 0 if it is unknown.
unsigned processorsOfMask()
{
  constexpr int Most = 65536; // masks of larger machines do not exist
  for (int count = CPU_SETSIZE; count <= Most; count *= 2)
  {
    const std::unique_ptr<cpu_set_t, void (*)(cpu_set_t*)> mask(
      CPU_ALLOC(count), [](cpu_set_t* set) { CPU_FREE(set); });
    const std::size_t size = CPU_ALLOC_SIZE(count);
    if (mask && sched_getaffinity(0, size, mask.get()) == 0)
    {
      return unsigned(CPU_COUNT_S(size, mask.get()));
    }
  }
  return 0;
}

/// The path of the control group of this process, as "/a/b"; "/" if there is none.
std::string controlGroup()
{
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);)
  {
    if (line.starts_with("0::/"))
    {
      return line.substr(3);
    }
  }
  return "/";
}

/// Whole processors of the least quota of the group and of those around it; 0 if there is none.
unsigned processorsOfQuota()
{
  double least = 0.;
  for (std::string group = controlGroup();;)
  {
    std::ifstream file("/sys/fs/cgroup" + group + "/cpu.max");
    double quota = 0., period = 0.;
    // "max 100000" is no quota.
    if (file >> quota >> period && quota > 0. && period > 0.)
    {
      least = least > 0. ? std::min(least, quota / period) : quota / period;
    }
    const std::size_t end = group.rfind('/');
    if (group.empty() || end == std::string::npos)
    {
      return unsigned(std::min(std::ceil(least), 1e6));
    }
    group.erase(end);
  }
}
#else
unsigned processorsOfMask() { return 0; }
unsigned processorsOfQuota() { return 0; }
#endif
}

unsigned availableProcessors()
{
  unsigned result = std::max(1U, std::thread::hardware_concurrency());
  for (const unsigned limit : { processorsOfMask(), processorsOfQuota() })
  {
    result = limit > 0 ? std::min(result, limit) : result;
  }
  return result;
}
}
