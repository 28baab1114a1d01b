// SPDX-License-Identifier: BSD-3-Clause
#include "base/Vector4.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
/// In one function, as where a first surface comes to the coordinates of a cloud and back.
__attribute__((noinline)) void toLanesAndBack(const Eigen::Vector3d& in, Eigen::Vector3d& out)
{
  out = Vector4(in).toDouble();
}
}

// Keeps the promise that every compiler gives the same bytes: what comes out of the lanes has been rounded to
// float. GCC 12.2 leaves that out where it sees both ways at once.
TEST(Vector4, DoublesAreRoundedInLanes)
{
  for (int i = 1; i < 100; ++i)
  {
    const Eigen::Vector3d in(0.1 * i, 0.2 * i, 0.3 * i);
    Eigen::Vector3d out;
    toLanesAndBack(in, out);
    for (int axis = 0; axis < 3; ++axis)
    {
      volatile float rounded = float(in[axis]);
      EXPECT_EQ(out[axis], double(rounded));
    }
  }
}
}
