// SPDX-License-Identifier: BSD-3-Clause
// The short form of fuzzing, which needs no fuzzer: the same inputs each time.
//
//   ShortCampaign COUNT           runs the seeds, and COUNT inputs made from them by chance
//   ShortCampaign --write FOLDER  writes the seeds into a folder, for a fuzzer to begin with
#include "base/Random.h"
#include "FuzzTarget.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace
{
using Bytes = std::vector<std::uint8_t>;
using neuralmesh::Random;

void run(const Bytes& input) { LLVMFuzzerTestOneInput(input.data(), input.size()); }

/// Bytes replaced, put in, taken out, or the end cut off.
Bytes changed(Bytes input, Random& random)
{
  for (std::uint32_t i = random.below(8) + 1; i > 0 && !input.empty(); --i)
  {
    const std::size_t place = random.below(std::uint32_t(input.size()));
    const auto at = input.begin() + std::ptrdiff_t(place);
    switch (random.below(8))
    {
      case 0:
        input.insert(at, std::uint8_t(random.below(256)));
        break;
      case 1:
        input.erase(at);
        break;
      case 2:
        input.erase(at, i == 1 ? input.end() : at + 1);
        break;
      default:
        *at = std::uint8_t(random.below(256));
    }
  }
  return input;
}

void writeSeeds(const std::vector<Bytes>& seeds, const std::filesystem::path& folder)
{
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    std::ofstream file(folder / ("seed" + std::to_string(i)), std::ios::binary);
    file.write(reinterpret_cast<const char*>(seeds[i].data()), std::streamsize(seeds[i].size()));
  }
}
}

int main(int argc, char* argv[])
{
  const std::vector<Bytes> seeds = neuralmesh::testing::fuzzSeeds();
  if (argc == 3 && std::string(argv[1]) == "--write")
  {
    writeSeeds(seeds, argv[2]);
    return EXIT_SUCCESS;
  }
  const int count = argc == 2 ? std::atoi(argv[1]) : 0;
  if (count <= 0)
  {
    std::fprintf(stderr, "usage: %s COUNT | --write FOLDER\n", argv[0]);
    return 2;
  }
  for (const Bytes& seed : seeds)
  {
    run(seed);
  }
  Random random(1);
  for (int i = 0; i < count; ++i)
  {
    run(changed(seeds[random.below(std::uint32_t(seeds.size()))], random));
  }
  std::printf("%zu seeds and %d inputs: all well\n", seeds.size(), count);
  return EXIT_SUCCESS;
}
