// SPDX-License-Identifier: BSD-3-Clause
#include "DistinctFiles.h"

#include "LearningParameters.h"

#include <filesystem>

namespace
{
namespace fs = std::filesystem;

bool IsSameFile(const std::string& a, const std::string& b)
{
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error)
  {
    return true;
  }
  // One of them, or both, are not there yet.
  const fs::path left = fs::weakly_canonical(fs::absolute(a, error), error);
  const fs::path right = fs::weakly_canonical(fs::absolute(b, error), error);
  return !left.empty() && left == right;
}
}

void RequireDistinctFiles(const std::vector<NamedFile>& files)
{
  for (auto one = files.begin(); one != files.end(); ++one)
  {
    for (auto other = files.begin(); other != one; ++other)
    {
      const bool areNamed = !one->Path.empty() && !other->Path.empty();
      const bool isTwice = one->Option == other->Option;
      if (areNamed && (isTwice || one->IsWritten || other->IsWritten) &&
        IsSameFile(one->Path, other->Path))
      {
        throw UsageError(one->Option + ": " + one->Path +
          (isTwice ? " is given twice" : " is the file of " + other->Option + ", too"));
      }
    }
  }
}
