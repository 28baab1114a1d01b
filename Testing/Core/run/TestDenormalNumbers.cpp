// SPDX-License-Identifier: BSD-3-Clause
// Promise: what is no number, as an index in a vector's last lane, or memory that is not used, is not computed with: it
// looks like a denormal number, with which processors are a hundred times slower.
#include "cloud/PackedGrid.h"
#include "mesh/Refinement.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <functional>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace neuralmesh::testing
{
namespace
{
/// Skips the test where the processor does not tell.
void expectNoDenormalIn(const std::function<void()>& work)
{
#if defined(__SSE2__)
  constexpr unsigned HasMetOne = 0x2; // of the register
  _mm_setcsr(_mm_getcsr() & ~HasMetOne);
  work();
  EXPECT_EQ(_mm_getcsr() & HasMetOne, 0u);
#else
  GTEST_SKIP() << "This processor does not tell of denormal numbers.";
#endif
}
}

TEST(DenormalNumbers, AreNowhereInARun)
{
  const PointCloud cloud(sphereCloud({ .noise = 0.002 }));
  Parameters parameters;
  parameters.numberOfVertices = 3000;
  expectNoDenormalIn([&] { EXPECT_TRUE(reconstruct(cloud, parameters, goOn).isComplete()); });
}

TEST(DenormalNumbers, AreNowhereInAGrid)
{
  Mesh mesh = meshOf(makeSphere(8));
  refine(mesh, 3000, goOn);
  const Vector4 corner(0.5f, 0.5f, 0.5f);
  expectNoDenormalIn(
    [&]
    {
      PackedGrid grid;
      grid.build(mesh, -1.f * corner, corner, 0.02f);
      EXPECT_NE(grid.closest(corner), NoVertex);
    });
}
}
