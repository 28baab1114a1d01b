// SPDX-License-Identifier: BSD-3-Clause
#ifndef DistinctFiles_h
#define DistinctFiles_h

#include <string>
#include <vector>

/** A file that an option of the command names. */
struct NamedFile
{
  std::string Option;
  std::string Path; ///< empty: none
  bool IsWritten = false;
};

/**
 * Throws UsageError where two options name the same file, by whatever path, and it is written: the one
 * would destroy the other. So it does where one option names a file twice: points of an INPUT would
 * count twice.
 */
void RequireDistinctFiles(const std::vector<NamedFile>& files);

#endif
