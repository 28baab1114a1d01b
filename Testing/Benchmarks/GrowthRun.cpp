// SPDX-License-Identifier: BSD-3-Clause
// Grows a mesh on a torus to the given number of vertices and prints how many samples that took:
// what the instruction counter is run on.
#include "cloud/CloudGenerator.h"
#include "learn/SequentialLearner.h"
#include "Shapes.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char* argv[])
{
  using namespace neuralmesh;
  Parameters parameters;
  parameters.numberOfVertices = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10000;
  const PointCloud cloud(generateCloud(makeTorus(), CloudOptions()));
  SequentialLearner learner(cloud, parameters);
  while (!learner.hasAllVertices())
  {
    learner.learn(4096);
  }
  std::printf("%llu\n", static_cast<unsigned long long>(learner.counts().iterations));
  return 0;
}
