// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReadingGuard_h
#define ReadingGuard_h

#include <string>

/**
 * Lets VTK's readers loose on a file that may be damaged. Some damage makes them crash, abort,
 * allocate without bounds or run for ever. As long as a guard lives, the process may allocate only
 * so much and compute only so long as a file of this size can need; and what would end it, or
 * exceed that, ends it with exit status 1 and one line on stderr that names the file. What else is
 * written to stderr in the meantime is not shown.
 * There may be one guard at a time, and nothing may have been begun that needs to be cleaned up.
 */
class ReadingGuard
{
public:
  explicit ReadingGuard(const std::string& path);
  ~ReadingGuard();
  ReadingGuard(const ReadingGuard&) = delete;
  ReadingGuard& operator=(const ReadingGuard&) = delete;

  /** What is said of a file that cannot be read to its end. */
  static std::string Message(const std::string& path);
};

#endif
