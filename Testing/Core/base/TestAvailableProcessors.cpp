// SPDX-License-Identifier: BSD-3-Clause
#include "base/AvailableProcessors.h"
#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#ifdef __linux__
#include <sched.h>
#include <thread>

namespace neuralmesh::testing
{
// Promise: a process that may use one processor starts one thread by default, and as many as are asked for.
TEST(AvailableProcessors, ObeyTheAffinityMask)
{
  EXPECT_GE(availableProcessors(), 1U);
  cpu_set_t before;
  CPU_ZERO(&before);
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_LE(availableProcessors(), unsigned(CPU_COUNT(&before)));
  std::thread(
    [&before]
    {
      int first = 0;
      while (!CPU_ISSET(first, &before))
      {
        ++first;
      }
      cpu_set_t one;
      CPU_ZERO(&one);
      CPU_SET(first, &one);
      // Of this thread alone.
      ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
      EXPECT_EQ(availableProcessors(), 1U);
      EXPECT_EQ(ThreadPool().threadCount(), 1U);
      EXPECT_EQ(ThreadPool(2).threadCount(), 2U);
    })
    .join();
}
}
#endif
